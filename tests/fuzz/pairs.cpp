// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/narrow_phase/pairs.hpp"

#include <array>

#include "experiments/study/text/input_error.hpp"
#include "tests/fuzz/readers.hpp"

namespace polhode::fuzz {
namespace {

constexpr std::array<std::string_view, 12> pairs_words = {"id",  "class", "ahx,ahy,ahz", ",",  "\n",   "1e308",
                                                          "nan", "0",     "-1",          "\"", "\r\n", "1e-320"};

void read_pairs(std::string_view bytes) {
  const MemoryFile file(bytes);
  try {
    study::narrow_phase::read_pairs(file.path());
  } catch (const study::InputError&) {
  }
}

}  // namespace

Reader pairs_reader() { return {"pairs", read_pairs, pairs_words}; }

}  // namespace polhode::fuzz
