// SPDX-License-Identifier: BSD-3-Clause
#include <array>

#include "experiments/study/plan/cells_file.hpp"
#include "experiments/study/text/input_error.hpp"
#include "tests/fuzz/readers.hpp"

namespace polhode::fuzz {
namespace {

constexpr std::array<std::string_view, 20> cells_words = {
    "dt",      "tolerance", "integrator", "scenario", "body.0.mass", "orientation", "t_end",
    "samples", ",",         "\n",         "\r\n",     "\"",          "rk4",         "matrix",
    "1e-3",    "1e999",     "nan",        "1:2:3",    "all",         "\xEF\xBB\xBF"};

void read_cells(std::string_view bytes) {
  const MemoryFile file(bytes);
  try {
    const auto cells = study::CellsFile::read(file.path());
    for (std::size_t row = 0; row < cells->rows(); ++row) {
      for (std::size_t i = 0; i < cells->keys().size(); ++i) {
        cells->text(row, i);
        cells->place(row, i);
      }
    }
  } catch (const study::InputError&) {
  }
}

}  // namespace

Reader cells_reader() { return {"cells", read_cells, cells_words}; }

}  // namespace polhode::fuzz
