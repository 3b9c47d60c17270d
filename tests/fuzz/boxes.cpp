// SPDX-License-Identifier: BSD-3-Clause
#include <array>

#include "experiments/broad_phase/recorded.hpp"
#include "experiments/study/text/input_error.hpp"
#include "tests/fuzz/readers.hpp"

namespace polhode::fuzz {
namespace {

constexpr std::array<std::string_view, 12> boxes_words = {"step", "id", "hx,hy,hz", "px,py,pz", ",",  "\n",
                                                          "inf",  "-1", "9e18",     "nan",      "\"", "0"};

void read_boxes(std::string_view bytes) {
  const MemoryFile file(bytes);
  try {
    study::broad_phase::read_recorded_motion(file.path());
  } catch (const study::InputError&) {
  }
}

}  // namespace

Reader boxes_reader() { return {"boxes", read_boxes, boxes_words}; }

}  // namespace polhode::fuzz
