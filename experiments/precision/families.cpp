// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/precision/families.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "experiments/study/record/run_options.hpp"
#include "experiments/study/statistics/line_fit.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::precision {
namespace {

constexpr double agrees = 1.25;  ///< largest ratio of two errors that are truncation alone, whichever is larger
constexpr double dominates = 3;  ///< smallest error over truncation error at which rounding dominates
/// Smallest such ratio for measuring the growth of the rounding error in time.
constexpr double clearly_dominates = 10;
// Rounding errors of the measurement, which is made in double: energy, relative; attitude, rad.
constexpr double energy_in_double = 2 * std::numeric_limits<double>::epsilon();
constexpr double motion_in_double = 16 * std::numeric_limits<double>::epsilon();

/// Texts that distinguish problems, besides the method.
using Key = std::vector<std::string>;
struct Texts {
  Key motion, formulation;
};

Texts texts_of(const RunConfig& c) {
  Texts texts{
      {c.scenario, fmt::format("t_end = {} s", rounded(c.t_end)),
       c.samples ? fmt::format("{} samples", *c.samples) : "every step seen", c.reference ? "with a reference" : ""},
      {}};
  for (const RunOption* option : options_of_role(RunOption::Role::variant)) {
    const bool arithmetic = option->name == "precision" || option->name == "summation";
    if (!arithmetic) texts.formulation.push_back(label_of(*option, c));
  }
  return texts;
}

/// The texts that differ between runs of the study, joined.
std::string varying(const std::vector<Texts>& all, const Key Texts::*part, const Key& of) {
  std::vector<std::string> kept;
  for (std::size_t k = 0; k < of.size(); ++k) {
    const bool varies = std::any_of(all.begin(), all.end(), [&](const auto& t) { return (t.*part)[k] != of[k]; });
    if (varies && !of[k].empty()) kept.push_back(of[k]);
  }
  return fmt::format("{}", fmt::join(kept, ", "));
}

/// The most precise family; null if this one is.
const Family* yardstick_of(const RoundingProblem& problem, const Family& family) {
  const Family* best = nullptr;
  for (const Family& other : problem.families) {
    if (other.precision > family.precision) best = &other;  // families ascend in precision, compensated last
  }
  return best;
}

void match(RoundingProblem& problem) {
  for (Family& family : problem.families) {
    const Family* yardstick = yardstick_of(problem, family);
    if (yardstick == nullptr) continue;
    for (Rung& rung : family.rungs) {
      const auto same_step = std::find_if(yardstick->rungs.begin(), yardstick->rungs.end(),
                                          [&](const Rung& other) { return other.step == rung.step; });
      if (same_step == yardstick->rungs.end()) continue;
      for (auto& [run, exact] : rung.runs) {
        for (const auto& other : same_step->runs) {
          if (other.run->config.varied == run->config.varied) exact = other.run;
        }
      }
    }
  }
}

template <class Pick>
std::optional<double> root_mean_square(const Rung& rung, const Quantity& quantity, const Pick& pick) {
  double sum = 0;
  std::size_t measured = 0;
  for (const auto& both : rung.runs) {
    const RunRecord* run = pick(both);
    if (run == nullptr) return std::nullopt;
    if (!completed(*run)) return std::numeric_limits<double>::quiet_NaN();
    if (const auto found = value(*run, quantity)) sum += *found * *found, ++measured;
  }
  if (measured < rung.runs.size()) return std::nullopt;
  return std::sqrt(sum / static_cast<double>(measured));
}

/// Least-squares exponent p of b ∝ a^p. Absent for fewer than three points.
std::optional<double> power(const std::vector<std::pair<double, double>>& points) {
  if (points.size() < 3) return std::nullopt;
  std::vector<LinePoint> logs;
  for (const auto& [a, b] : points) logs.push_back({std::log(a), std::log(b)});
  return fit_line(logs).slope;
}

}  // namespace

std::string Family::arithmetic() const {
  const std::string plain(name(precision));
  return compensated ? plain + ", compensated" : plain;
}

std::string RoundingProblem::label() const {
  std::string text = method;
  if (!formulation.empty()) text += fmt::format(" ({})", formulation);
  return motion.empty() ? text : fmt::format("{} on {}", text, motion);
}

std::vector<RoundingProblem> problems_of(const StudyView& study) {
  std::vector<Texts> all;
  for (const auto& run : study.runs) all.push_back(texts_of(run.config));
  std::vector<RoundingProblem> problems;
  std::map<std::tuple<Key, Key, std::string>, std::size_t> seen;
  for (std::size_t i = 0; i < study.runs.size(); ++i) {
    const RunRecord& run = study.runs[i];
    const auto step = abscissa(run);
    if (run.result.status == "refused" || !step) continue;
    const auto [at, is_new] =
        seen.emplace(std::tuple(all[i].motion, all[i].formulation, run.config.integrator), problems.size());
    if (is_new) {
      problems.push_back({run.config.integrator,
                          varying(all, &Texts::motion, all[i].motion),
                          varying(all, &Texts::formulation, all[i].formulation),
                          {}});
    }
    auto& families = problems[at->second].families;
    const bool compensated = is_compensated(run.config);
    auto family = std::find_if(families.begin(), families.end(), [&](const Family& f) {
      return f.precision == run.config.precision && f.compensated == compensated;
    });
    if (family == families.end()) family = families.insert(family, {run.config.precision, compensated, {}});
    auto rung =
        std::find_if(family->rungs.begin(), family->rungs.end(), [&](const Rung& r) { return r.step <= *step; });
    if (rung == family->rungs.end() || rung->step != *step) rung = family->rungs.insert(rung, {*step, {}});
    rung->runs.push_back({&run, nullptr});
  }
  for (RoundingProblem& problem : problems) {
    std::sort(problem.families.begin(), problem.families.end(), [](const Family& a, const Family& b) {
      return std::pair(a.precision, a.compensated) < std::pair(b.precision, b.compensated);
    });
    match(problem);
  }
  return problems;
}

std::optional<double> error_of(const Rung& rung, const Quantity& quantity) {
  return root_mean_square(rung, quantity, [](const Rung::Run& r) { return r.run; });
}
std::optional<double> truncation_of(const Rung& rung, const Quantity& quantity) {
  return root_mean_square(rung, quantity, [](const Rung::Run& r) { return r.exact; });
}

std::optional<Split> split(const Family& family, const Quantity& quantity) {
  Split found;
  std::vector<LadderPoint> truncated;
  std::vector<std::pair<double, double>> rounded;
  bool rounding_so_far = false;
  const double lost = quantity.bounded ? motion_lost : std::numeric_limits<double>::infinity();
  found.least_error = std::numeric_limits<double>::infinity();
  for (const Rung& rung : family.rungs) {
    auto error = error_of(rung, quantity);
    const auto exact = truncation_of(rung, quantity);
    if (!error) continue;
    if (!(*error < lost)) error = std::numeric_limits<double>::infinity();
    if (*error < found.least_error) found.least_error = *error, found.at_step = rung.step;
    found.has_yardstick = found.has_yardstick || exact;
    if (!exact || !(std::isfinite(*error)) || (*error <= agrees * *exact && *exact <= agrees * *error)) {
      truncated.push_back({rung.step, *error, motion_in_double});
    }
    if (exact && std::isfinite(*error) && *error > dominates * *exact) rounded.emplace_back(rung.step, *error);
    const bool now = exact && *exact<lost&& * error> 2 * *exact;  // rounding exceeds truncation
    if (now && !rounding_so_far) found.takes_over = rung.step;
    if (!now) found.takes_over.reset();
    rounding_so_far = now;
  }
  if (!std::isfinite(found.least_error)) return std::nullopt;
  found.truncation = estimate_order(std::move(truncated), {.lost = quantity.bounded ? lost_to_fits : lost});
  const auto& line = found.truncation.line;
  if (line && line->half_width_95 > widest_order_interval) found.truncation.line.reset();
  found.rounding_power = power(rounded);
  return found;
}

std::vector<PathPoint> energy_path(const RunRecord& run) {
  std::vector<PathPoint> path;
  for (const auto& p : run.result.series) path.push_back({p.t, p.energy_drift_rel});
  return path;
}

std::vector<PathPoint> attitude_path(const RunRecord& run) {
  std::vector<PathPoint> path;
  for (const auto& p : run.result.attitude_errors) path.push_back({p.t, p.error_rad});
  return path;
}

bool is_rounding(const Rung::Run& run) {
  if (run.exact == nullptr || !completed(*run.run) || !completed(*run.exact)) return false;
  const auto drift = run.run->result.energy_drift_max_rel, exact = run.exact->result.energy_drift_max_rel;
  return drift && exact && *drift > clearly_dominates * std::max(*exact, energy_in_double);
}

bool is_rounding_in_attitude(const Rung::Run& run) {
  if (!is_rounding(run)) return false;
  const auto error = run.run->result.attitude_error_max, exact = run.exact->result.attitude_error_max;
  return error && exact && *error<motion_lost&& * error> clearly_dominates * *exact;
}

}  // namespace polhode::study::precision
