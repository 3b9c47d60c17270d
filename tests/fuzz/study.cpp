// SPDX-License-Identifier: BSD-3-Clause
#include <array>

#include "experiments/study/plan/options.hpp"
#include "experiments/study/text/input_error.hpp"
#include "tests/fuzz/readers.hpp"

namespace polhode::fuzz {
namespace {

constexpr std::array<std::string_view, 20> study_words = {"scenario = ",
                                                          "integrator = ",
                                                          "dt = ",
                                                          "[vary]\n",
                                                          "\"rk4\"",
                                                          "\"1e-4:1e-1:10:log\"",
                                                          "reference = true",
                                                          "t_end = ",
                                                          "orientation",
                                                          "[1e-3, 1e-2]",
                                                          "\"all\"",
                                                          "samples",
                                                          "normalize",
                                                          "[[1, 0, 0]]",
                                                          "tolerance",
                                                          "gyroscopic",
                                                          "1e999",
                                                          ":",
                                                          "{}",
                                                          "\"body.0.mass\" = "};

void read_study(std::string_view bytes) {
  const MemoryFile file(bytes);
  try {
    study::read_study_file(file.path(), 1);
  } catch (const study::InputError&) {
  }
}

}  // namespace

Reader study_reader() { return {"study", read_study, study_words}; }

}  // namespace polhode::fuzz
