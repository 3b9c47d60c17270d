// SPDX-License-Identifier: BSD-3-Clause
// A fuzzer of the reader that POLHODE_FUZZED names, driven by libFuzzer (preset `fuzz`).
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "tests/fuzz/readers.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const auto read = polhode::fuzz::find_reader(POLHODE_FUZZED)->read;
  read({reinterpret_cast<const char*>(bytes), size});
  return 0;
}
