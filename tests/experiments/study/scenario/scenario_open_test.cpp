// SPDX-License-Identifier: BSD-3-Clause
// Scenarios by name and by path.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "experiments/study/scenario/scenario.hpp"
#include "tests/experiments/study/scenario/scenario_texts.hpp"
#include "tests/temporary_folder.hpp"

namespace polhode::study::scenario_tests::scenario_open_test {
namespace {

std::string open_error(const std::string& name) {
  try {
    ScenarioSource::open(name).resolve();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
  return "no error";
}

TEST(ScenarioOpen, UnknownNames) {
  EXPECT_THAT(open_error("dzanibekov"),
              HasSubstr("no built-in scenario is called 'dzanibekov'; did you mean 'dzhanibekov'?"));
  EXPECT_THAT(open_error("coursework.toml"), StartsWith("--scenario: there is no file coursework.toml"));
  EXPECT_THAT(open_error("coursework.toml"), HasSubstr("did you mean 'coursework'?"));
  EXPECT_THAT(open_error("./coursework"), testing::Eq("--scenario: there is no file ./coursework"));
  EXPECT_THAT(open_error("no/such/file.toml"), testing::Eq("--scenario: there is no file no/such/file.toml"));
  EXPECT_THAT(open_error("./"), HasSubstr("is a folder"));
  EXPECT_THAT(open_error(""), HasSubstr("; ./run energy_drift --list scenarios prints all "));
  EXPECT_THAT(open_error("a\nb/c"), testing::Eq("--scenario: there is no file a\\x0ab/c"));
}

TEST(ScenarioOpen, FilesByPath) {
  const TemporaryFolder folder;
  const std::string path = (folder.path() / "my top.toml").string();
  std::ofstream(path) << base;
  const ScenarioSource source = ScenarioSource::open(path);
  EXPECT_EQ(source.name(), "my top");
  EXPECT_EQ(source.resolve().canonical(), resolved(base).canonical());
  std::ofstream(path) << changed("mass = 2.0", "mass = 0");
  EXPECT_THAT(open_error(path), StartsWith(path + ":7:8: body.0.mass: 0 is not a valid mass"));
}

}  // namespace
}  // namespace polhode::study::scenario_tests::scenario_open_test
