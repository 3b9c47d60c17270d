// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/judge/diagnosis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "experiments/judge/clock_fit.hpp"
#include "experiments/judge/hypothesis.hpp"
#include "experiments/judge/miss.hpp"
#include "experiments/judge/own_columns.hpp"
#include "experiments/judge/row_states.hpp"
#include "experiments/judge/step_fit.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::judge {
namespace {

/// Largest miss of a trajectory without a fault, rad: a program in double precision cannot be expected to do better.
constexpr double flawless = 1e-7;
/// Smallest relative change of the clock's rate that is remarked upon.
constexpr double small_rate = 2e-3;

/// Reason for which no hypothesis can be tried; empty: hypotheses can be tried.
std::string obstacle(const RowStates& rows) {
  if (!rows.trajectory.has_angular_velocity && !rows.trajectory.has_angular_momentum) {
    return "without angular velocity or momentum no reading can be tried";
  }
  if (!rows.scenario.colliders.empty()) {
    return "what its contacts do is not in the file, so energy, momenta and errors are against a motion without them "
           "and "
           "no reading can be tried";
  }
  if (rows.right.system().forces_exert_torques() && !rows.knows_paths()) {
    return "without positions and velocities the torques are not known, so no reading can be tried";
  }
  return {};
}

/// True if rows with this miss (rad) do not follow the equations at all.
bool astray(const RowStates& rows, double miss) {
  constexpr double per_rad = 0.1, most = 0.5;
  return miss > std::min(per_rad * rows.span, most);
}

/// True if the errors of the whole run are so large that the size of the steps may be their cause. miss: miss of the
/// plain reading, rad.
bool large_errors(const RowStates& rows, const RunResult& r, double miss) {
  constexpr double small = 0.01;  // rad and relative
  const auto large = [](const std::optional<double>& x) { return x && !(*x < small); };
  if (large(r.attitude_error_max) || large(r.energy_drift_max_rel) || large(r.angular_momentum_drift_max_rel))
    return true;
  const auto& t = rows.trajectory.times;
  return miss / rows.span * rows.rate * (t.back() - t.front()) > small;
}

/// The best hypothesis and the best one with another cause; null: there is none.
std::pair<const Hypothesis*, const Hypothesis*> best_two(const std::vector<Hypothesis>& list) {
  const Hypothesis *best = nullptr, *other = nullptr;
  for (const Hypothesis& h : list) {
    if (!best || h.miss < best->miss) best = &h;
  }
  for (const Hypothesis& h : list) {
    if (h.causes != best->causes && (!other || h.miss < other->miss)) other = &h;
  }
  return {best, other};
}

/// All hypotheses with a single fault, with their misses. try_steps: includes first-order steps.
std::vector<Hypothesis> single_hypotheses(const RowStates& rows, const Hypothesis& plain, bool try_steps) {
  std::vector<Hypothesis> list = other_readings(plain, rows.trajectory);
  for (Hypothesis& h : other_motions(plain, rows.trajectory.moving, rows.right.system().forces_exert_torques())) {
    list.push_back(std::move(h));
  }
  for (Hypothesis& h : list) h.miss = miss_of(rows, h);
  if (auto fit = fitted_shift(rows, plain)) list.push_back(std::move(*fit));
  list.push_back(fitted_rate(rows, plain));
  if (try_steps) {
    list.push_back(fitted_steps(rows, plain));
    if (auto fit = fitted_steps_without_projection(rows, plain)) list.push_back(std::move(*fit));
  }
  return list;
}

/// Hypotheses with two faults, with their misses. Left out are pairs without a fitted parameter whose miss exceeds
/// `worst` (rad).
std::vector<Hypothesis> paired_hypotheses(const RowStates& rows, const Hypothesis& plain,
                                          const std::vector<Hypothesis>& single, double worst) {
  constexpr std::size_t few_spans = 4;
  std::vector<Hypothesis> list;
  const auto fitted = [](const Hypothesis& h) {
    return h.touched.contains(Part::clock) || h.touched.contains(Part::steps);
  };
  for (std::size_t i = 0; i < single.size(); ++i) {
    if (fitted(single[i])) continue;
    for (std::size_t j = 0; j < i; ++j) {
      if (fitted(single[j]) || !disjoint(single[i], single[j])) continue;
      Hypothesis h = both(single[j], single[i]);
      if (miss_of(rows, h, rows.stride_for(few_spans)) > worst) continue;
      h.miss = miss_of(rows, h);
      list.push_back(std::move(h));
    }
  }
  // Clock and steps must be fitted anew for each pair. They are combined with the best single hypotheses only.
  constexpr std::size_t most = 3;
  std::vector<const Hypothesis*> helpful;
  for (const Hypothesis& h : single) {
    if (!fitted(h) && h.miss < plain.miss / 2) helpful.push_back(&h);
  }
  std::stable_sort(helpful.begin(), helpful.end(), [](auto a, auto b) { return a->miss < b->miss; });
  helpful.resize(std::min(most, helpful.size()));
  for (const Hypothesis* h : helpful) {
    if (auto fit = fitted_shift(rows, *h)) list.push_back(std::move(*fit));
    list.push_back(fitted_rate(rows, *h));
    if (!h->touched.contains(Part::turning)) list.push_back(fitted_steps(rows, *h));
  }
  return list;
}

std::string joined(const std::vector<std::string>& parts, const char* between) {
  return fmt::format("{}", fmt::join(parts, between));
}

std::string name_of(const Hypothesis& h) {
  std::vector<std::string> causes = h.causes;
  causes.erase(std::unique(causes.begin(), causes.end()), causes.end());
  return joined(causes, "+");
}

/// True if only the columns or the clock are wrong; the motion and its start are right.
bool only_misread(const Hypothesis& h) {
  const auto& parts = h.touched;
  return std::none_of(parts.begin(), parts.end(), [](Part part) {
    return part == Part::start || part == Part::gyroscopic_term || part == Part::turning || part == Part::inertia ||
           part == Part::steps;
  });
}

/// The diagnosis that names hypothesis h. other: the best hypothesis with another cause, or null. simpler: a further
/// hypothesis with which h is compared.
Diagnosis named(const RowStates& rows, const Hypothesis& h, const Hypothesis* other, const Hypothesis& plain,
                const Hypothesis& simpler) {
  Diagnosis result;
  result.miss = plain.miss;
  result.span = rows.span;
  const double least = std::max(h.miss, 1e-12);
  result.factor = plain.miss / least;
  result.margin = std::min(other ? other->miss : unknown_miss, simpler.miss) / least;
  result.name = name_of(h);
  result.words = joined(h.words, ", and ");
  if (other && *result.margin < naming_factor) {
    result.name += "|" + name_of(*other);
    result.words = "either " + result.words + ", or " + joined(other->words, ", and ");
    return result;
  }
  if (only_misread(h)) result.meant = retimed(read_so(rows.trajectory, h.reading), h.clock, h.shift);
  return result;
}

/// The diagnosis of the rows; the start counts if rows.first is not empty. plain: the plain reading with its miss.
Diagnosis verdict(const RowStates& rows, const Hypothesis& plain, const RunResult& errors) {
  Diagnosis result;
  result.name = "none";
  result.miss = plain.miss;
  result.span = rows.span;
  if (plain.miss <= flawless) return result;
  const bool large = large_errors(rows, errors, plain.miss);
  const std::vector<Hypothesis> single = single_hypotheses(rows, plain, large);
  const auto [best, other] = best_two(single);
  const bool explains = best->miss * naming_factor <= plain.miss;
  // Pairs of faults are tried if a single fault leaves a large miss.
  constexpr double much = 1e-3;  // large miss, rad
  if (explains ? best->miss > much : astray(rows, plain.miss) || large) {
    const double to_beat = std::min(best->miss, plain.miss);
    const std::vector<Hypothesis> pairs = paired_hypotheses(rows, plain, single, to_beat);
    if (!pairs.empty()) {
      const auto [pair, other_pair] = best_two(pairs);
      if (pair->miss * naming_factor <= to_beat && !pair->excused) return named(rows, *pair, other_pair, plain, *best);
    }
  }
  if (explains && !best->excused) return named(rows, *best, other, plain, plain);
  if (explains && std::abs(best->clock - 1) > small_rate) {
    result.remark =
        fmt::format("at t_s it is where it should be at {} t_s, by its steps or its clock", number(best->clock, 5));
  }
  if (astray(rows, plain.miss)) result.name = "unexplained";
  return result;
}

/// The diagnosis of rows that do not start as the scenario does. They miss every motion from that start, so that the
/// start does not count: rows.first is cleared. Absent if the rows do start there, or if no motion from their own start
/// explains them.
std::optional<Diagnosis> verdict_without_start(RowStates& rows, Hypothesis& plain, const RunResult& errors) {
  constexpr double least = 1e-3;  // smallest distance of another start, rad
  const double off = miss_of_start(rows, plain);
  rows.first.clear();
  plain.miss = miss_of(rows, plain);
  if (!(off > least && off > naming_factor * plain.miss)) return std::nullopt;
  Diagnosis result = verdict(rows, plain, errors);
  const std::string words = fmt::format("it starts {} rad away from the scenario's start", number(off));
  if (result.name == "unexplained") return std::nullopt;
  if (result.name == "none") {
    result.name = "start";
    result.words = words + " and follows the scenario's equations from there";
  } else {
    result.name = "start+" + result.name;
    result.words += ", and " + words;
  }
  return result;
}

}  // namespace

Diagnosis diagnose(const Trajectory& trajectory, const Scenario& scenario, const TrajectoryScore& plain_score) {
  // 1. Whether the columns of the file suffice for hypotheses.
  RowStates rows(trajectory, scenario);
  if (std::string why = obstacle(rows); !why.empty()) {
    Diagnosis none;
    none.untried = std::move(why);
    return none;
  }
  // 2. The miss of the plain reading, and the hypotheses that explain it.
  const RunResult& errors = plain_score.record.result;
  Hypothesis plain;
  plain.problem = scenario.problem;
  plain.miss = miss_of(rows, plain);
  Diagnosis result = verdict(rows, plain, errors);
  // 3. Rows that no hypothesis explains may start elsewhere than the scenario.
  if (result.name == "none" || result.name == "unexplained") {
    if (auto elsewhere = verdict_without_start(rows, plain, errors)) return *elsewhere;
  }
  // 4. In a right motion the file's own columns of momentum and energy may be wrong.
  if (result.name == "none") {
    if (auto fault = own_column_fault(rows)) {
      result.name = fault->name;
      result.words = fault->words;
      result.factor = fault->factor;
    }
  }
  return result;
}

}  // namespace polhode::study::judge
