// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/scenario/scenario.hpp"

#include <array>

#include "experiments/study/text/input_error.hpp"
#include "tests/fuzz/readers.hpp"

namespace polhode::fuzz {
namespace {

constexpr std::array<std::string_view, 34> scenario_words = {
    "[[body]]",    "[[force]]",    "mass = ",    "inertia = ",  "shape = ",
    "kind = ",     "\"cylinder\"", "radius = ",  "length = ",   "position",
    "velocity",    "gravity",      "invariants", "contact",     "static = true",
    "t_end = ",    "name = ",      "1e308",      "-1",          "nan",
    "[1, 2, 3]",   "{ ",           " }",         "\"box\"",     "repeat",
    "[[group]]",   "count = ",     "1000000000", "orientation", "point_masses",
    "restitution", "friction",     "# ",         "\"\"\"\n"};

void read_scenario(std::string_view bytes) {
  try {
    const auto source = study::ScenarioSource::parse(std::string(bytes), "fuzz.toml");
    source.resolve();
  } catch (const study::InputError&) {
  }
}

}  // namespace

Reader scenario_reader() { return {"scenario", read_scenario, scenario_words}; }

}  // namespace polhode::fuzz
