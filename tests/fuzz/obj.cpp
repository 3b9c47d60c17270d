// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <stdexcept>

#include "collision/shapes/compound.hpp"
#include "tests/fuzz/readers.hpp"

namespace polhode::fuzz {
namespace {

constexpr std::array<std::string_view, 14> obj_words = {"v ", "f ",    "o ",  "g ",   "\n",  "1/1/1", "1//1",
                                                        "-1", "1e308", "nan", "0.5 ", "vn ", "# ",    "\\\n"};

void read_obj(std::string_view bytes) {
  const MemoryFile file(bytes);
  try {
    Compound::parts_of_obj(file.path());
  } catch (const std::invalid_argument&) {
  }
}

}  // namespace

Reader obj_reader() { return {"obj", read_obj, obj_words}; }

}  // namespace polhode::fuzz
