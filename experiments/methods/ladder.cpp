// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/methods/ladder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "experiments/study/record/first_impact.hpp"
#include "experiments/study/record/run_options.hpp"

namespace polhode::study::methods {
namespace {

constexpr double steps_at_first = 16;  // steps of the first run in a characteristic time
constexpr int loosest = 1, tightest = 14, first_tolerance = 3;
constexpr int most_halvings = 40;

/// Right-hand sides that a run may cost.
double allowed(const RunRecord& run) { return budget * run.config.t_end / characteristic_time(run); }

/// A rung by number: dt = t_end/(samples 2^rung), or tolerance = 10^-rung.
RunConfig rung_of_number(const RunRecord& any, int rung) {
  RunConfig config = any.config;
  config.samples = samples;
  if (config.tolerance) {
    config.tolerance = std::pow(10.0, -rung);
    config.max_steps = std::llround(allowed(any));  // a step costs one right-hand side at least
  } else {
    config.dt = std::ldexp(config.t_end / samples, -rung);
  }
  return config;
}

int rung_of(const RunConfig& config) {
  return config.tolerance ? static_cast<int>(std::lround(-std::log10(*config.tolerance)))
                          : static_cast<int>(std::lround(std::log2(config.t_end / samples / *config.dt)));
}

int first_rung(const RunRecord& run) {
  if (run.config.tolerance) return first_tolerance;
  const double steps = steps_at_first * run.config.t_end / characteristic_time(run);
  return std::max(0, static_cast<int>(std::lround(std::log2(steps / samples))));
}

class Climb {
 public:
  Climb(const Rungs& ladder, const Ruler& ruler) : ladder_(ladder), ruler_(ruler) {}

  /// The rungs to try next; none if the ladder is whole.
  std::vector<int> next() const {
    const auto& runs = ladder_.runs;
    if (runs.empty()) {
      if (ladder_.any->result.status == "refused") return {};
      return {first_rung(*ladder_.any)};
    }
    std::vector<int> rungs;
    const RunRecord &coarse = *runs.front(), &fine = *runs.back();
    const int low = coarse.config.tolerance ? loosest : 0;
    if (rung_of(coarse.config) > low && error(coarse) < target(0) && saves())
      rungs.push_back(rung_of(coarse.config) - 1);
    if (may_go_on(fine)) rungs.push_back(rung_of(fine.config) + 1);
    return rungs;
  }

 private:
  /// +inf if the run broke off.
  double error(const RunRecord& run) const {
    return ruler_.error(run).value_or(std::numeric_limits<double>::infinity());
  }

  bool may_go_on(const RunRecord& fine) const {
    const int rung = rung_of(fine.config);
    if (rung >= (fine.config.tolerance ? tightest : most_halvings)) return false;
    if (fine.result.status == "refused" || (fine.result.status == "ok" && !ruler_.error(fine))) return false;
    const bool may_be_exact = !fine.config.tolerance && ladder_.runs.size() == 1;  // a second step decides
    if (error(fine) <= target(targets - 1) && !may_be_exact) return false;
    const double spent = std::max(double(fine.result.evaluations), fine.config.tolerance ? 0 : steps(fine));
    return 2 * spent <= allowed(fine) && !at_floor();
  }

  /// False if the coarsest run costs as much as the next one: it is located impacts that cost.
  bool saves() const {
    const auto& runs = ladder_.runs;
    constexpr double something = 0.95;
    return runs.size() < 2 || double(runs[0]->result.evaluations) < something * double(runs[1]->result.evaluations);
  }

  static double steps(const RunRecord& run) { return run.config.t_end / *run.config.dt; }

  /// True if the error is small and the last two rungs did not lower it.
  bool at_floor() const {
    const auto& runs = ladder_.runs;
    constexpr double small = 1e-6;
    if (runs.size() < 3) return false;
    const double last = error(**(runs.end() - 1)), before = error(**(runs.end() - 3));
    return before < small && last >= before;
  }

  const Rungs& ladder_;
  const Ruler& ruler_;
};

}  // namespace

double target(std::size_t k) { return std::pow(10.0, first_decade - static_cast<int>(k)); }

std::string error_text(std::size_t k) { return fmt::format("1e{}", first_decade - static_cast<int>(k)); }

bool is_of_ladder(const RunConfig& config) { return config.samples == samples; }

std::vector<Rungs> ladders(const StudyView& study) {
  std::vector<Rungs> all;
  std::map<std::string, std::size_t> places;
  for (const RunRecord& run : study.runs) {
    if (is_first_impact_reference(run.config) || !run.config.formulation.gyroscopic) continue;
    RunConfig config = run.config;
    if (config.dt) config.dt = 1;
    if (config.tolerance) config.tolerance = 1;
    config.samples.reset();
    config.max_steps.reset();
    const std::string key = identity_of(config);
    const auto [at, added] = places.emplace(key, all.size());
    if (added) all.push_back({.key = key, .any = &run});
    if (is_of_ladder(run.config)) all[at->second].runs.push_back(&run);
  }
  for (Rungs& ladder : all) {
    std::stable_sort(ladder.runs.begin(), ladder.runs.end(),
                     [](const auto* a, const auto* b) { return rung_of(a->config) < rung_of(b->config); });
  }
  return all;
}

std::vector<RunConfig> next_rungs(const StudyView& study) {
  const Ruler ruler(study);
  std::vector<RunConfig> wanted;
  std::set<std::string> impacts;  // motions whose first impact was requested
  for (const Rungs& ladder : ladders(study)) {
    const RunRecord& any = *ladder.any;
    if (ruler.lacks_first_impact(any)) {
      if (impacts.insert(motion_of(any.config)).second) wanted.push_back(first_impact_reference(any));
      continue;  // its errors are known in the next round
    }
    for (const int rung : Climb(ladder, ruler).next()) wanted.push_back(rung_of_number(any, rung));
  }
  return wanted;
}

}  // namespace polhode::study::methods
