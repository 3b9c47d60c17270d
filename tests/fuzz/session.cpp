// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <string>

#include "experiments/study/text/input_error.hpp"
#include "experiments/viewer/session/segment_run.hpp"
#include "experiments/viewer/session/session_record.hpp"
#include "tests/fuzz/readers.hpp"

namespace polhode::fuzz {
namespace {

constexpr std::array<std::string_view, 30> session_words = {"version = 1\n",
                                                            "scenario = ",
                                                            "scenario_digest = ",
                                                            "[[override]]\n",
                                                            "key = ",
                                                            "value = ",
                                                            "[[segment]]\n",
                                                            "from_segment = ",
                                                            "from_step = ",
                                                            "drive = ",
                                                            "\"accumulator\"",
                                                            "\"frame_clock\"",
                                                            "integrator = ",
                                                            "\"cvode_adams\"",
                                                            "dt = ",
                                                            "tolerance = ",
                                                            "t_end = ",
                                                            "response = ",
                                                            "gyroscopic = false",
                                                            "orientation = \"matrix\"",
                                                            "[[segment.part]]\n",
                                                            "steps = ",
                                                            "sizes = [",
                                                            "digest = \"0123456789abcdef\"",
                                                            "9e15",
                                                            "-1",
                                                            "1e308",
                                                            "nan",
                                                            "\"\"\"",
                                                            "{ "};

/// The first lines of a record with contact. They hold a digest of the scenario, which no change of bytes finds.
std::string first_lines() {
  const std::string name = "bouncing_ball";
  const study::Scenario scenario = study::ScenarioSource::open(name).resolve();
  return "version = 1\nscenario = \"" + name + "\"\nscenario_digest = \"" + viewer::digest(scenario.canonical()) +
         "\"\n";
}

/// Reads the bytes alone, and behind the first lines of a record.
void read_session(std::string_view bytes) {
  static const std::string first = first_lines();
  for (const std::string& text : {std::string(bytes), first + std::string(bytes)}) {
    try {
      viewer::parse_session(text, "fuzz.toml");
    } catch (const study::InputError&) {
    }
  }
}

}  // namespace

Reader session_reader() { return {"session", read_session, session_words}; }

}  // namespace polhode::fuzz
