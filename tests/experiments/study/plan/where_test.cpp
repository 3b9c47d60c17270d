// SPDX-License-Identifier: BSD-3-Clause
// Conditions on cells: what they mean, and the errors of those that mean nothing.
#include "experiments/study/plan/where.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "experiments/study/text/input_error.hpp"

namespace polhode::study::where_tests::where_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

bool holds(const std::string& text) {
  static const std::map<std::string, WhereValue> cell = {
      {"dt", 0.01}, {"t_end", 10.0}, {"integrator", "rk4"}, {"body.0.inertia.1", 2.0}};  // and no tolerance
  const Where where(text, "--where");
  std::vector<WhereValue> values;
  for (const std::string& key : where.keys()) values.push_back(cell.contains(key) ? cell.at(key) : WhereValue{});
  return where.holds(values);
}

std::string error_of(const std::string& text) {
  try {
    holds(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Where, HoldsAsItReads) {
  for (const char* text : {"dt < 0.1 * body.0.inertia.1 and not (integrator == 'rk4' and t_end > 10)",
                           "dt == 1e-2",
                           "dt <= .01",
                           "integrator == \"rk4\"",
                           "integrator != 'rk44'",
                           "1 + 2 * 3 == 7",
                           "(1 + 2) * 3 == 9",
                           "8 / 4 / 2 == 1",
                           "5 - 2 - 1 == 2",
                           "-dt < 0",
                           "- -dt > 0",
                           "min(3, dt, 2) == dt",
                           "max(3, dt) == 3",
                           "abs(-2) == 2",
                           "1 < 0 and 1 < 0 or 1 > 0",
                           "not 1 < 0 and 1 > 0",
                           "not (1 > 0 and 1 < 0)",
                           "given(dt)",
                           "not given(tolerance)",
                           "t_end >= 10 or dt > 5",
                           "true == 'true'",
                           "dt>0.001 and(dt<1)"})
    EXPECT_TRUE(holds(text)) << text;
  for (const char* text :
       {"dt > 0.1", "integrator == 'RK4'", "not given(dt)", "1 > 0 and 1 < 0", "dt < dt", "1 / 0 < 5"})
    EXPECT_FALSE(holds(text)) << text;
}

TEST(Where, AComparisonWithAnAbsentKeyIsFalse) {
  for (const char* text : {"tolerance < 1", "tolerance > 1", "tolerance == 1", "tolerance != 1", "tolerance == 'x'",
                           "tolerance + dt > 0", "max(tolerance, 1) > 0", "abs(tolerance) >= 0"})
    EXPECT_FALSE(holds(text)) << text;
  EXPECT_TRUE(holds("not (tolerance < 1)"));
  EXPECT_TRUE(holds("tolerance < 1e-6 or dt < 1"));
}

TEST(Where, KeysAreFoundOnceEach) {
  EXPECT_THAT(Where("dt < t_end and dt > body.0.mass or given(tolerance)", "").keys(),
              ElementsAre("dt", "t_end", "body.0.mass", "tolerance"));
}

TEST(Where, ErrorsNameTheCharacter) {
  EXPECT_THAT(error_of(""), HasSubstr("--where: character 1: the condition ends too early"));
  EXPECT_THAT(error_of("dt"), HasSubstr("character 1: a comparison is expected here"));
  EXPECT_THAT(error_of("dt = 1"), HasSubstr("character 4: '=' compares nothing; write =="));
  EXPECT_THAT(error_of("dt < 1 and t_end"), HasSubstr("character 12: a comparison is expected"));
  EXPECT_THAT(error_of("(dt < 1"), HasSubstr("character 8: ')' is missing"));
  EXPECT_THAT(error_of("dt < 1)"), HasSubstr("character 7: ')' is not expected here"));
  EXPECT_THAT(error_of("0 < dt < 1"), HasSubstr("character 8: a second comparison in a row"));
  EXPECT_THAT(error_of("integrator == 'rk4"), HasSubstr("character 15: a quote is opened"));
  EXPECT_THAT(error_of("dt < 1s"), HasSubstr("character 6: a number ends in a letter"));
  EXPECT_THAT(error_of("dt < 1e999"), HasSubstr("no double can hold"));
  EXPECT_THAT(error_of("sin(dt) < 1"), HasSubstr("character 1: there is no function 'sin'"));
  EXPECT_THAT(error_of("(dt < 1) + 1 < 2"), HasSubstr("a value is expected here"));
  EXPECT_THAT(error_of("dt < and"), HasSubstr("character 6: a number, a 'text' or a key"));
  EXPECT_THAT(error_of("dt # 1"), HasSubstr("character 4"));
  EXPECT_THAT(error_of("dt < 'rk4'"), HasSubstr("it compares the number 0.01 with 'rk4'"));
  EXPECT_THAT(error_of("integrator + 1 < 2"), HasSubstr("it calculates with the text 'rk4'"));
}

TEST(Where, NestingIsBoundedAndLengthIsNot) {
  EXPECT_THAT(error_of(std::string(100'000, '(')), HasSubstr("nested more than 100 deep"));
  EXPECT_THAT(error_of(std::string(100'000, '-') + "1 < 0"), HasSubstr("nested more than 100 deep"));
  std::string text = "dt < 1", nots;
  for (int i = 0; i < 50'000; ++i) text += " and dt < 1";
  EXPECT_TRUE(holds(text));
  for (int i = 0; i < 100'000; ++i) nots += "not ";
  EXPECT_THAT(error_of(nots + "dt < 1"), HasSubstr("nested more than 100 deep"));
}

}  // namespace
}  // namespace polhode::study::where_tests::where_test
