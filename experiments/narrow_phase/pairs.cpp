// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/narrow_phase/pairs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "collision/shapes/box.hpp"
#include "experiments/study/text/csv.hpp"
#include "experiments/study/text/csv_reader.hpp"
#include "experiments/study/text/input_error.hpp"

namespace polhode::study::narrow_phase {
namespace {

constexpr const char* of_a_box[] = {"hx", "hy", "hz", "px", "py", "pz", "qw", "qx", "qy", "qz"};
constexpr std::size_t numbers_of_a_box = std::size(of_a_box);

struct Columns {
  std::size_t id = 0;
  std::array<std::size_t, 2 * numbers_of_a_box> numbers{};
};

Columns columns_of(const CsvReader& file, const std::string& path) {
  Columns columns;
  const auto& names = file.names();
  const auto name = [](std::size_t k) {
    return (k < numbers_of_a_box ? "a" : "b") + std::string(of_a_box[k % numbers_of_a_box]);
  };
  bool named = false;
  for (std::size_t k = 0; k < columns.numbers.size(); ++k)
    named |= std::find(names.begin(), names.end(), name(k)) != names.end();
  if (named) {
    columns.id = file.column("id");
    for (std::size_t k = 0; k < columns.numbers.size(); ++k) columns.numbers[k] = file.column(name(k));
    return columns;
  }
  if (names.size() < 2 + columns.numbers.size()) {
    throw InputError(path + ": " + std::to_string(names.size()) +
                     " columns, not 22: id, class, then of A ahx, ahy, ahz, apx, " +
                     "apy, apz, aqw, aqx, aqy, aqz, and likewise of B");
  }
  for (std::size_t k = 0; k < columns.numbers.size(); ++k) columns.numbers[k] = 2 + k;
  return columns;
}

PosedBox read_box(const CsvReader& file, const std::size_t* columns) {
  std::array<double, numbers_of_a_box> x;
  for (std::size_t k = 0; k < x.size(); ++k) {
    x[k] = file.number(columns[k]);
    if (!std::isfinite(x[k])) file.fail(columns[k], "an infinite number; give a finite one");
  }
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(x[k] > 0))
      file.fail(columns[k], "a half extent that is not positive; give half of the edge length, more than 0");
  }
  const Quaternion<double> q(x[6], x[7], x[8], x[9]);
  const double length = q.stableNorm();
  if (!(length > 0))
    file.fail(columns[6], "a quaternion of length 0, which is no orientation; give w x y z, 1 0 0 0 for none");
  return {{x[0], x[1], x[2]}, {{x[3], x[4], x[5]}, rotation_matrix<double>(q / length)}};
}

}  // namespace

std::vector<BoxPair> read_pairs(const std::string& path) {
  CsvReader file(path);
  const Columns columns = columns_of(file, path);
  std::vector<BoxPair> pairs;
  while (file.next()) {
    const PosedBox a = read_box(file, columns.numbers.data());
    const PosedBox b = read_box(file, columns.numbers.data() + numbers_of_a_box);
    pairs.push_back({file.text(columns.id), a, b});
  }
  return pairs;
}

std::string answers(const std::vector<BoxPair>& pairs, const NarrowPhase& narrow_phase) {
  std::string text = csv_row({"id", "overlap", "sdist", "nx", "ny", "nz"});
  for (const BoxPair& pair : pairs) {
    try {
      const Box a(pair.a.half), b(pair.b.half);
      const bool overlap = narrow_phase.overlap(a, pair.a.pose, b, pair.b.pose);
      const Distance d = narrow_phase.distance(a, pair.a.pose, b, pair.b.pose);
      const auto leaving = [&](int k) { return exact(0.0 - d.normal[k]); };
      text += csv_row({pair.id, overlap ? "1" : "0", exact(d.distance), leaving(0), leaving(1), leaving(2)});
    } catch (const std::invalid_argument& error) {
      throw InputError("pair '" + pair.id + "': " + error.what());
    }
  }
  return text;
}

}  // namespace polhode::study::narrow_phase
