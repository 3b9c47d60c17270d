// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/rerun/comparison.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <type_traits>

#include "experiments/study/record/metric_table.hpp"
#include "experiments/study/text/value_lists.hpp"

namespace polhode::study::rerun {
namespace {

/// All digits, with a sign and infinities; equal texts mean equal numbers.
std::string digits_of(const std::optional<double>& x) { return x && !std::isnan(*x) ? exact(*x + 0.0) : ""; }

void compare_texts(const std::string& name, const std::string& stored, const std::string& again,
                   std::vector<Difference>& found) {
  if (stored != again) found.push_back({name, stored, again});
}

void compare_metric(const Metric& metric, const RunResult& stored, const RunResult& again,
                    std::vector<Difference>& found) {
  with_value(metric, stored, [&]<class Value>(const Value& a) {
    with_value(metric, again, [&]<class Other>(const Other& b) {
      if constexpr (!std::is_same_v<Value, Other>) {
        return;
      } else if constexpr (std::is_same_v<Value, std::optional<double>>) {
        compare_texts(metric.column, digits_of(a), digits_of(b), found);
      } else if constexpr (std::is_same_v<Value, std::int64_t>) {
        compare_texts(metric.column, std::to_string(a), std::to_string(b), found);
      } else if constexpr (std::is_same_v<Value, std::string>) {
        compare_texts(metric.column, a, b, found);
      } else {
        std::set<std::string> names;
        for (const auto& [name, number] : a) names.insert(name);
        for (const auto& [name, number] : b) names.insert(name);
        const auto digits = [](const Value& numbers, const std::string& name) {
          const auto at = numbers.find(name);
          return at == numbers.end() ? std::string() : digits_of(at->second);
        };
        for (const std::string& name : names)
          compare_texts(name + "_drift_max_rel", digits(a, name), digits(b, name), found);
      }
    });
  });
}

std::string words_of(const SeriesPoint& p) {
  return fmt::format("({}, {}, {}, {}, {})", exact(p.t), exact(p.energy_drift_rel), exact(p.linear_momentum_drift_rel),
                     exact(p.angular_momentum_drift_rel), exact(p.orientation_defect));
}
std::string words_of(const AttitudeError& e) { return fmt::format("({}, {})", exact(e.t), exact(e.error_rad)); }

template <class Point>
void compare_curves(const std::string& name, const std::vector<Point>& stored, const std::vector<Point>& again,
                    std::vector<Difference>& found) {
  for (std::size_t k = 0; k < std::max(stored.size(), again.size()); ++k) {
    const std::string a = k < stored.size() ? words_of(stored[k]) : "", b = k < again.size() ? words_of(again[k]) : "";
    if (a == b) continue;
    found.push_back({fmt::format("{}, point {}", name, k + 1), a, b});
    return;
  }
}

}  // namespace

std::vector<Difference> differences(const RunResult& stored, const RunResult& again) {
  std::vector<Difference> found;
  for (const Metric& metric : metric_table()) compare_metric(metric, stored, again, found);
  compare_texts("t_reached_s", digits_of(stored.t_reached), digits_of(again.t_reached), found);
  if (!stored.series.empty() || !stored.attitude_errors.empty()) {
    compare_curves("series", stored.series, again.series, found);
    compare_curves("attitude_errors", stored.attitude_errors, again.attitude_errors, found);
  }
  return found;
}

}  // namespace polhode::study::rerun
