// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/broad_phase/recorded.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iterator>

#include "experiments/study/text/csv_reader.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/notation.hpp"
#include "experiments/study/text/text_file.hpp"

namespace polhode::study::broad_phase {
namespace {

struct Row {
  std::int64_t step = 0, id = 0;
  Bounds box;
  std::size_t line = 0;
};

Bounds box_of(const CsvReader& csv, const std::array<std::size_t, 3>& half, const std::array<std::size_t, 3>& centre) {
  Vector3<double> h, p;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    h[axis] = csv.number(half[k]);
    p[axis] = csv.number(centre[k]);
    if (h[axis] < 0) csv.fail(half[k], "a negative half extent; give 0 or more");
    if (!std::isfinite(p[axis]))
      csv.fail(centre[k], "an infinite centre; give a finite one, and an infinite half extent");
  }
  return {p - h, p + h};
}

}  // namespace

std::vector<RecordedStep> read_recorded_motion(const std::string& path) {
  CsvReader csv(path);
  const std::size_t step = csv.column("step"), id = csv.column("id");
  const std::array half{csv.column("hx"), csv.column("hy"), csv.column("hz")};
  const std::array centre{csv.column("px"), csv.column("py"), csv.column("pz")};
  std::vector<Row> rows;
  while (csv.next()) rows.push_back({csv.integer(step), csv.integer(id), box_of(csv, half, centre), csv.line()});
  const auto before = [](const Row& a, const Row& b) {
    return a.step != b.step ? a.step < b.step : a.id != b.id ? a.id < b.id : a.line < b.line;
  };
  if (!std::is_sorted(rows.begin(), rows.end(), before)) std::sort(rows.begin(), rows.end(), before);
  std::vector<RecordedStep> motion;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Row& row = rows[k];
    if (k == 0 || row.step != rows[k - 1].step) {
      motion.emplace_back().step = row.step;
    } else if (row.id == rows[k - 1].id) {
      throw InputError(
          fmt::format("{}:{}:1: id {} stands twice in step {}, on line {} too; give each body one row in each "
                      "step",
                      path, row.line, row.id, row.step, rows[k - 1].line));
    }
    motion.back().ids.push_back(row.id);
    motion.back().boxes.push_back(row.box);
  }
  return motion;
}

void answer_recorded_motion(const std::vector<RecordedStep>& motion, const BroadPhaseEntry& entry,
                            const std::string& out) {
  using Clock = std::chrono::steady_clock;
  const auto phase = entry.make();
  std::string text = "step,a,b\n", times = "step,boxes,pairs,time_s\n";
  std::size_t boxes = 0;
  double total = 0;
  for (const RecordedStep& step : motion) {
    const auto start = Clock::now();
    phase->update(step.boxes);
    const auto pairs = phase->pairs();
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    for (const BodyPair& p : pairs) {
      fmt::format_to(std::back_inserter(text), "{},{},{}\n", step.step, step.ids[p.a], step.ids[p.b]);
    }
    fmt::format_to(std::back_inserter(times), "{},{},{},{}\n", step.step, step.boxes.size(), pairs.size(),
                   number(seconds, 4));
    boxes += step.boxes.size();
    total += seconds;
  }
  write_text(out, text);
  fmt::print("{}# {}: {} s per step, {} ns per box\n", times, entry.name,
             number(total / static_cast<double>(std::max<std::size_t>(motion.size(), 1))),
             number(1e9 * total / static_cast<double>(std::max<std::size_t>(boxes, 1))));
}

}  // namespace polhode::study::broad_phase
