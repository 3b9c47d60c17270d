// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/judge/first_line.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>
#include <vector>

#include "experiments/study/text/notation.hpp"

namespace polhode::study::judge {
namespace {

/// Largest drift or error of a quantity that is kept, relative or in rad; beyond it the quantity is lost.
constexpr double held = 0.01;

/// "energy holds to 1e-9, angular momentum is lost by 123 %"
std::string invariants_words(const RunResult& r) {
  std::vector<std::pair<std::string, double>> drifts;
  const auto add = [&](const std::string& name, const std::optional<double>& drift) {
    if (drift) drifts.emplace_back(name, *drift);
  };
  add("energy", r.energy_drift_max_rel);
  add("linear momentum", r.linear_momentum_drift_max_rel);
  add("angular momentum", r.angular_momentum_drift_max_rel);
  for (const auto& [name, drift] : r.invariant_drift_max_rel) add(name, drift);
  std::vector<std::string> holds, lost;
  for (const auto& [name, drift] : drifts) {
    const std::string to = drift > 0 ? "to " + number(drift) : "exactly";
    if (drift <= held) holds.push_back(fmt::format("{}{} {}", name, holds.empty() ? " holds" : "", to));
    else lost.push_back(fmt::format("{} {} {} %", name, lost.empty() ? "is lost by" : "by", number(100 * drift)));
  }
  holds.insert(holds.end(), lost.begin(), lost.end());
  return fmt::format("{}", fmt::join(holds, ", "));
}

/// "attitude is right to 1e-9 rad, angular velocity is off by 20 %"
std::string errors_words(const RunResult& r) {
  std::vector<std::string> words;
  if (r.position_error_max == 0.0) words.emplace_back("position is exact");
  else if (r.position_error_max)
    words.push_back(fmt::format("position is right to {} m", number(*r.position_error_max)));
  if (r.attitude_error_max) {
    const bool right = *r.attitude_error_max <= held;
    if (*r.attitude_error_max == 0) words.emplace_back("attitude is exact");
    else
      words.push_back(
          fmt::format("attitude is {} {} rad", right ? "right to" : "off by", number(*r.attitude_error_max)));
  }
  if (const auto& e = r.angular_velocity_error_max_rel) {
    if (*e == 0) words.emplace_back("angular velocity is exact");
    else
      words.push_back(*e <= held ? fmt::format("angular velocity is right to {}", number(*e))
                                 : fmt::format("angular velocity is off by {} %", number(100 * *e)));
  }
  return fmt::format("{}", fmt::join(words, ", "));
}

struct Pace {
  /// Time by which the momentum is ahead along the polhode, s; its rate of change, s/s; distance from the polhode,
  /// relative.
  double phase = 0, rate = 0, off = 0;
};
std::optional<Pace> pace_of(const TrajectoryScore& score) {
  Pace pace;
  const ErrorPoint *first = nullptr, *last = nullptr;
  for (const ErrorPoint& p : score.errors) {
    if (!p.phase || !p.off) continue;
    if (!first) first = &p;
    last = &p;
    pace.off = std::max(pace.off, *p.off);
  }
  if (!first || last->t <= first->t) return std::nullopt;
  pace.phase = *last->phase;
  pace.rate = (*last->phase - *first->phase) / (last->t - first->t);
  return pace;
}

std::string pace_words(const TrajectoryScore& score) {
  const std::string name = polhode_pace(score);
  if (name.empty()) return "";
  const Pace pace = *pace_of(score);
  if (name == "off") return fmt::format("it leaves its polhode by {} %", number(100 * pace.off));
  if (name == "standing") return "it stands still on its polhode";
  if (name == "backwards") {
    return fmt::format("it goes backwards along its polhode, at {} of the right speed", number(-1 - pace.rate));
  }
  if (name == "on_time") return fmt::format("it is on time along its polhode, to {} s", number(std::abs(pace.phase)));
  return fmt::format("it is {} along its polhode by {} s at the end", name, number(std::abs(pace.phase)));
}

void append(std::string& text, const std::string& clause) {
  if (!clause.empty()) text += (text.ends_with(": ") ? "" : "; ") + clause;
}

}  // namespace

std::string polhode_pace(const TrajectoryScore& score) {
  constexpr double far_off = 0.1, still = 0.1 /* of the right speed */;
  const auto pace = pace_of(score);
  if (!pace) return "";
  if (!(pace->off <= far_off)) return "off";
  if (pace->rate < -1 - still) return "backwards";
  if (pace->rate < -1 + still) return "standing";
  const double angle = score.record.result.polhode_phase_error_max_rad.value_or(0);
  if (angle <= held) return "on_time";
  return pace->phase < 0 ? "late" : "early";
}

std::string first_line(const Judged& judged) {
  const TrajectoryScore& score = judged.score;
  const RunResult& r = score.record.result;
  const Diagnosis& d = judged.diagnosis;
  std::string text = score.record.config.integrator + ": ";
  const auto large = [](const std::optional<double>& x) { return x && !(*x <= held); };
  const bool off = large(r.energy_drift_max_rel) || large(r.linear_momentum_drift_max_rel) ||
                   large(r.angular_momentum_drift_max_rel) || large(r.attitude_error_max) ||
                   large(r.angular_velocity_error_max_rel);
  const std::string measured = invariants_words(r) + errors_words(r);
  if (d.name.empty()) {
    text += measured.empty() ? "nothing can be measured"
            : off            ? "off, and no cause can be sought"
                             : "sound as far as can be seen";
  } else if (d.name == "unexplained") {
    text += fmt::format(
        "wrong, and no cause that was tried explains it (its rows miss the scenario's motion by {} rad in "
        "{} rad)",
        number(d.miss), number(d.span));
  } else if (d.name != "none") {
    text += d.words;
    if (d.factor) {
      text += fmt::format(" (fits {} times better than the scenario's {}", number(*d.factor, 2),
                          d.margin ? "own motion" : "inertia");
      const bool alone = d.margin && *d.margin >= naming_factor;
      text += alone ? fmt::format(", {} times better than any other cause tried)", number(*d.margin, 2)) : ")";
    }
  } else if (off) {
    text +=
        fmt::format("no wrong convention or equation: {} rad of the motion are right to {} rad, and the errors add up",
                    number(d.span, 2), number(d.miss));
  } else {
    text += "sound";
  }
  if (!d.untried.empty()) text += " (" + d.untried + ")";
  text += ": ";
  append(text, r.message);
  append(text, invariants_words(r));
  append(text, errors_words(r));
  append(text, pace_words(score));
  append(text, d.remark);
  if (judged.meant) {
    const RunResult& m = judged.meant->record.result;
    append(text, "read rightly, " +
                     fmt::format("{}", fmt::join(
                                           [&] {
                                             std::vector<std::string> parts;
                                             for (const std::string& part : {invariants_words(m), errors_words(m)}) {
                                               if (!part.empty()) parts.push_back(part);
                                             }
                                             return parts;
                                           }(),
                                           ", ")));
  }
  if (!r.attitude_error_max && !score.record.config.reference) {
    append(text, "no exact motion is known, --reference measures the errors");
  }
  if (text.ends_with(": ")) text.resize(text.size() - 2);
  return text + ".";
}

}  // namespace polhode::study::judge
