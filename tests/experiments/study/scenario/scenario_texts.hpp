// SPDX-License-Identifier: BSD-3-Clause
// A scenario as text, changes of it, and what the reader makes of it: a scenario or an error.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "experiments/study/scenario/scenario.hpp"
#include "experiments/study/text/input_error.hpp"

namespace polhode::study::scenario_tests {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;
using Vector = Vector3<double>;

/// Line numbers stand at the left in the tests below.
inline const std::string base = R"(title = "Test"
gravity = [0.0, 0.0, -9.81]
t_end = 10.0

[[body]]
name = "box"
mass = 2.0
inertia = [1.0, 2.0, 2.5]
orientation = [1.0, 0.0, 0.0, 0.0]
angular_velocity = [0.1, 0.2, 0.3]

[[body]]
name = "ground"
static = true

[[body]]
mass = 3
shape = { kind = "sphere", radius = 0.1 }

[[force]]
kind = "spring"
bodies = ["box"]
stiffness = 40.0

[[force]]
kind = "constant_torque"
bodies = ["box", "body2"]
torque = [0.0, 0.0, 0.1]
frame = "body"
)";

inline Scenario resolved(const std::string& text, const std::vector<Override>& overrides = {}) {
  return ScenarioSource::parse(text, "test.toml").resolve(overrides);
}

inline std::string error_of(const std::string& text, const std::vector<Override>& overrides = {}) {
  try {
    resolved(text, overrides);
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  return "no error";
}

/// `base` with the one place where `from` stands changed.
inline std::string changed(const std::string& from, const std::string& to) {
  const std::size_t at = base.find(from);
  EXPECT_TRUE(at != std::string::npos && base.find(from, at + 1) == std::string::npos) << from << " must stand once";
  return base.substr(0, at) + to + base.substr(at + from.size());
}

}  // namespace polhode::study::scenario_tests
