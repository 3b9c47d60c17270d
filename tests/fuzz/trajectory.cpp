// SPDX-License-Identifier: BSD-3-Clause
#include <array>

#include "experiments/study/scenario/scenario.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/trajectory/trajectory_reader.hpp"
#include "tests/fuzz/readers.hpp"

namespace polhode::fuzz {
namespace {

constexpr std::array<std::string_view, 16> trajectory_words = {"t_s", "body", "qw",   "qx,qy,qz", "r11", "x_m,y_m,z_m",
                                                               ",",   "\n",   "\r\n", "1e308",    "nan", "-0",
                                                               "\"",  "0.1",  "#",    "inf"};

void read_trajectory(std::string_view bytes) {
  static const study::Scenario one = study::ScenarioSource::open("free_symmetric_top").resolve();
  static const study::Scenario two = study::ScenarioSource::open("two_bodies").resolve();
  for (const study::Scenario* scenario : {&one, &two}) {
    try {
      study::parse_trajectory(bytes, "fuzz.csv", scenario->problem);
    } catch (const study::InputError&) {
    }
  }
}

}  // namespace

Reader trajectory_reader() { return {"trajectory", read_trajectory, trajectory_words}; }

}  // namespace polhode::fuzz
