// SPDX-License-Identifier: BSD-3-Clause
// Runs with values in every column, for tests of the store.
#pragma once

#include <bit>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "experiments/study/record/metric_table.hpp"
#include "experiments/study/record/run_id.hpp"
#include "experiments/study/record/run_record.hpp"
#include "experiments/study/store/store.hpp"

namespace polhode::study::store_tests {

/// Run number k: its id and its values follow from k.
inline RunRecord made_up_run(std::uint64_t k) {
  RunRecord run;
  run.id = id_of_number((k + 1) * 0x9e3779b97f4a7c15u);  // spread over all 64 bits
  RunResult& r = run.result;
  double next = 0.1 + 1.5 * static_cast<double>(k);
  for (const Metric& metric : metric_table()) {
    with_value(metric, r, [&]<class Value>(Value& value) {
      if constexpr (std::is_same_v<Value, std::string>) {
        value = metric.words.empty() ? "text of " + metric.column : metric.words.back();
      } else if constexpr (std::is_same_v<Value, std::int64_t>) {
        value = static_cast<std::int64_t>(next * 1e6);
      } else if constexpr (std::is_same_v<Value, std::optional<double>>) {
        value = next;
      } else {
        value = {{"p_phi", next}, {"p_psi", -next}};
      }
    });
    next *= 1.7;
  }
  r.status = k % 3 == 0 ? "diverged" : "ok";
  r.position_reference = std::numeric_limits<double>::infinity();
  r.attitude_reference.reset();
  r.energy_initial = -7;  // SQLite keeps it as an integer
  r.t_reached = 0.3;
  r.seconds = 0.7;
  r.series = {{0, 1, 2, 3, 4}, {5, 6, 7, 8, next}};
  r.attitude_errors = {{0.1, 0.2}, {0.1, 0.3}};
  return run;
}

inline std::vector<RunRecord> made_up_runs(std::uint64_t count) {
  std::vector<RunRecord> runs;
  for (std::uint64_t k = 0; k < count; ++k) runs.push_back(made_up_run(k));
  return runs;
}

inline std::string exact_bits(double x) { return std::to_string(std::bit_cast<std::uint64_t>(x)) + " "; }

/// All values of a result as text; texts are equal if the results are.
inline std::string text_of_result(const RunResult& r) {
  std::string text;
  for (const Metric& metric : metric_table()) {
    text += metric.column + " ";
    with_value(metric, r, [&]<class Value>(const Value& value) {
      if constexpr (std::is_same_v<Value, std::string>) text += value;
      else if constexpr (std::is_same_v<Value, std::int64_t>) text += std::to_string(value);
      else if constexpr (std::is_same_v<Value, std::optional<double>>) text += value ? exact_bits(*value) : "-";
      else
        for (const auto& [name, number] : value) text += name + exact_bits(number);
    });
    text += "\n";
  }
  text += exact_bits(r.t_reached) + exact_bits(r.seconds);
  for (const SeriesPoint& p : r.series) {
    for (const double x :
         {p.t, p.energy_drift_rel, p.linear_momentum_drift_rel, p.angular_momentum_drift_rel, p.orientation_defect})
      text += exact_bits(x);
  }
  for (const AttitudeError& e : r.attitude_errors) text += exact_bits(e.t) + exact_bits(e.error_rad);
  return text;
}

}  // namespace polhode::study::store_tests
