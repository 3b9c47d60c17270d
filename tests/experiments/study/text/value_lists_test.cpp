// SPDX-License-Identifier: BSD-3-Clause
// Lists of numbers, held as numbers or as texts, and the hash of a text in parts.
#include "experiments/study/text/value_lists.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/text_hash.hpp"

namespace polhode::study::value_lists_test {
namespace {

TEST(ValueLists, OfNumbersAreTheTextsThatAStudyHolds) {
  for (const char* text : {"3", "0.1, 1e-3,-0,+2", "1:5:7", "-1,1e-4:1e-1:10:log,1:2:3,1", "1:5:7,1e300"}) {
    const auto numbers = toml_numbers(text, "--vary");
    ASSERT_TRUE(numbers) << text;
    std::vector<std::string> texts;
    for (const double x : *numbers) texts.push_back(exact(x));
    EXPECT_EQ(texts, toml_values(text, "--vary")) << text;
    EXPECT_EQ(texts.size(), count_values(text)) << text;
  }
}

TEST(ValueLists, WithAnythingButNumbersAreNotHeldAsNumbers) {
  for (const char* text : {"[1,2,3];[4,5,6]", "true,1", "1,word", "\"1\"", "nan", "1;2"})
    EXPECT_FALSE(toml_numbers(text, "--vary")) << text;
  for (const char* text : {"", "1,,2", "1:2", "1:2:0", "1:2:3:4", "0:1:3:log"})
    EXPECT_THROW(toml_numbers(text, "--vary"), InputError) << text;
}

TEST(TextHash, OfPartsIsThatOfTheWholeText) {
  std::string whole;
  TextHash parts;
  EXPECT_EQ(parts.text(), text_hash(""));
  for (int k = 0; k < 500; ++k) {
    const std::string part(std::size_t(k % 37), char('a' + k % 26));
    whole += part;
    parts.add(part);
    ASSERT_EQ(parts.text(), text_hash(whole)) << k;
  }
}

}  // namespace
}  // namespace polhode::study::value_lists_test
