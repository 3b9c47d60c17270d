// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/stability/stability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "experiments/stability/charts.hpp"
#include "experiments/stability/findings.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/text/csv.hpp"
#include "experiments/study/text/notation.hpp"
#include "experiments/study/text/value_lists.hpp"
#include "integrators/catalogue.hpp"

namespace polhode::study::stability {
namespace {

using Kind = CriticalStep::Kind;
using Role = RunOption::Role;

constexpr std::size_t most_items = 16;  // largest number of items of a sentence

constexpr int rough = 3;  // significant digits of a limit of the motion

std::string digits_of(double x, int digits) { return fmt::format("{:.{}g}", x, digits); }
std::string four(double x) { return digits_of(x, 4); }

/// A spectral radius with enough digits for its distance from 1.
std::string radius_text(double r) {
  const double off = r - 1;
  if (std::abs(off) <= radius_tolerance) return "1";
  if (std::abs(off) < 1e-3) return fmt::format("1 {} {}", off < 0 ? "−" : "+", number(std::abs(off), 2));
  return number(r, 4);
}

/// The analysis of the runs, to which bisection() (step_ladder.hpp) has added those that narrow the brackets:
/// 1. group(): curves of runs that differ only in the step.
/// 2. stability_findings(): for each curve the critical steps, the verdict below them, the energy gain, and linear
/// theory.
/// 3. analysis(): sentences, tables, charts, maps, critical_steps.csv and stability.csv.
class Stability {
 public:
  explicit Stability(const StudyView& study)
      : study_(study), grouping_(group(study)), found_(stability_findings(grouping_)) {}

  Analysis analysis() const {
    Analysis all{.heading = "Stability"};
    all.answer.sentences = answer();
    all.sentences = sentences();
    all.method = method();
    for (const bool varied : {false, true}) {
      Table one = table(varied);
      if (!one.rows.empty())
        all.tables.push_back({varied ? "critical_steps_varied" : "critical_steps", std::move(one)});
    }
    all.figures = stability_charts(grouping_, found_);
    if (study_.varied_keys.size() == 1) {
      for (auto& figure : stability_maps(grouping_, found_, study_.varied_keys.front())) {
        all.figures.push_back(std::move(figure));
      }
    }
    for (auto& figure : all.figures) figure.methods = grouping_.methods;
    all.files.push_back({"critical_steps.csv", critical_csv()});
    all.files.push_back({"stability.csv", runs_csv()});
    return all;
  }

 private:
  static std::vector<std::string> method() {
    return {
        fmt::format("Critical step: the smallest step at which the energy of a run grows (gaining or blown up), looked "
                    "for from below among the steps of --dt and then by bisection until the bracket is {} % wide. A "
                    "window of growth narrower than the distance of two steps of that scan may be missed. Each run "
                    "takes whole steps, and 500 at least. Where the energy is gained at the critical step but not at "
                    "the next larger one, a run {} times as long decides.",
                    number(100 * bracket_width), number(confirmed_by)),
        fmt::format(
            "Verdicts, from the signed energy drift in the four quarters of a run: blown up: diverged, failed, a "
            "relative drift or an orientation defect above {}; gaining or damped: the middle of the range moves "
            "the same way from quarter to quarter, by more than {} of the widest range, or that of the last "
            "quarter is more than {} of its ranges away from the start; gaining slowly: by less than {} % of "
            "the energy scale in a turn 2π/|ω|, which in a system that is not linear is an error of "
            "truncation, not an instability; stable: neither, or a change below {} (or 64 ε √steps, or what "
            "rounding may add up to).",
            number(verdict::lost), number(verdict::trend), number(verdict::settled), number(100 * verdict::slow),
            number(verdict::counted)),
        fmt::format("The motion is followed by a run as long as asked for in which the attitude error stays below {} "
                    "rad and the position error below {} of the largest displacement, both against the exact motion or "
                    "a reference, the relative drift of momenta and further invariants below {} (of the energy too, "
                    "where the motion is not known), and the orientation defect below {}. The largest step at which it "
                    "is followed is looked for from below, like the "
                    "critical step.",
                    number(followed::attitude), number(followed::position), number(followed::momentum),
                    number(followed::defect)),
        "|ω|: the largest √(k/m) of the springs, |ω| of the bodies at the start, √(m g l/I) of a pinned body under "
        "gravity and √(GM/r³) of a pair. Gain: the least-squares slope of the energy drift over the energy scale. "
        "Spectral radius: the largest modulus of the eigenvalues of the map of one step, taken from the method "
        "itself, where the system is linear."};
  }

  std::string label(const StabilityFinding& f) const { return grouping_.label(*f.ladder.curve); }
  const std::string& motion(const StabilityFinding& f) const {
    return f.ladder.steps.front().longest().config.scenario;
  }

  /// A step as h|ω|; in s for a motion without a characteristic rate.
  static std::string in_units(const StabilityFinding& f, double dt, int digits = 4) {
    return f.rate ? digits_of(dt * *f.rate, digits) : digits_of(dt, digits) + " s";
  }
  bool all_have_rates() const {
    return std::all_of(found_.begin(), found_.end(), [](const auto& f) { return f.rate.has_value(); });
  }
  std::string symbol() const { return all_have_rates() ? "h|ω|" : "h"; }

  static std::string step_text(const StabilityFinding& f, const CriticalStep& c, bool seconds) {
    const auto& steps = f.ladder.steps;
    const auto as = [&](double dt) { return seconds ? four(dt) : in_units(f, dt); };
    switch (c.kind) {
      case Kind::found: return as(c.fails);
      case Kind::none: return fmt::format("none to {}", as(steps.back().dt));
      default: return c.holds_again ? fmt::format("below {}", as(c.fails)) : "every step";
    }
  }

  /// The largest step at which the motion is followed.
  static std::string followed_text(const StabilityFinding& f, bool seconds) {
    const CriticalStep& c = f.motion;
    const auto as = [&](double dt) { return seconds ? digits_of(dt, rough) : in_units(f, dt, rough); };
    if (c.kind == Kind::from_start) return fmt::format("below {}", as(c.fails));
    if (c.kind == Kind::none) return f.ladder.measured ? fmt::format("all to {}", as(c.holds)) : "";
    return (f.ladder.measured ? "" : "at most ") + as(c.holds);
  }

  /// Energy gain over the energy scale per turn; per second if a motion of the study has no characteristic rate.
  double in_a_turn(const StabilityFinding& f, double per_second) const {
    return all_have_rates() ? per_second * 2 * std::numbers::pi / *f.rate : per_second;
  }
  std::string gain_text(const StabilityFinding& f) const {
    return f.gain ? number(in_a_turn(f, f.gain->per_second), 2) : "";
  }

  static std::string radius_range(const StabilityFinding& f) {
    if (!f.linear) return "";
    const std::string low = radius_text(f.linear->smallest), high = radius_text(f.linear->largest);
    return low == high ? low : fmt::format("{} … {}", low, high);
  }

  bool is_varied(const StabilityFinding& f) const {
    return !grouping_.cases[f.ladder.curve->case_index].details.empty();
  }

  Table table(bool varied) const {
    using C = Column::Kind;
    const auto unit = symbol();
    Table table{
        .caption = fmt::format("Critical steps{}, and up to which step the motion is followed; every step: the energy "
                               "grows at the smallest step tried and at all others; gain: of energy over its scale at "
                               "the largest step at which it does not grow and the motion is followed, or else at the "
                               "smallest step",
                               varied ? " with varied keys" : ""),
        .columns = {{"method", "", C::name},
                    {.header = "motion", .kind = C::text, .apart = true},
                    {"formulation", "", C::text},
                    {.header = "critical " + unit, .best = Column::Best::greatest},
                    {.header = "critical step", .unit = "s", .best = Column::Best::greatest},
                    {"blows up from " + unit},
                    {"energy below", "", C::text},
                    {all_have_rates() ? "gain per turn" : "gain per s"},
                    {.header = "followed up to " + unit, .best = Column::Best::greatest},
                    {.header = "followed up to", .unit = "s", .best = Column::Best::greatest},
                    {"then lost", "", C::text},
                    {"linear theory"},
                    {"spectral radius"}},
        .rows = {}};
    for (const auto& f : found_) {
      if (is_varied(f) != varied) continue;
      const Curve& curve = *f.ladder.curve;
      table.rows.push_back({grouping_.methods[curve.method_index],
                            grouping_.cases.size() > 1 ? grouping_.cases[curve.case_index].label() : "",
                            grouping_.variants[curve.variant_index], step_text(f, f.growth, false),
                            f.rate ? step_text(f, f.growth, true) : "", step_text(f, f.blow_up, false),
                            std::string(name(f.below)), gain_text(f), followed_text(f, false),
                            f.rate ? followed_text(f, true) : "", std::string(name(f.lost)),
                            f.linear ? step_text(f, f.linear->critical, false) : "", radius_range(f)});
    }
    return without_empty_columns(std::move(table));
  }

  // The functions below give words.

  static std::string listed(std::vector<std::string> items) { return words(first_items(std::move(items), most_items)); }

  /// The findings of one method in one variant on one scenario; several if keys of the scenario are varied.
  struct Group {
    std::string label;
    std::vector<const StabilityFinding*> members{};
  };

  std::vector<Group> groups(const std::string& scenario) const {
    std::vector<Group> all;
    for (const auto& f : found_) {
      if (motion(f) != scenario) continue;
      std::string name = label(f);
      if (is_varied(f)) name += " with varied keys";
      const auto known = std::find_if(all.begin(), all.end(), [&](const auto& g) { return g.label == name; });
      Group& group = known == all.end() ? all.emplace_back(Group{name}) : *known;
      group.members.push_back(&f);
    }
    return all;
  }

  /// The findings of a group that pass a test: their name, and the range of their limits.
  struct Passed {
    std::string label;
    double low = 0;
    std::string limits;  ///< "2.83", "1.2 … 2.5"
  };
  template <class Test>
  static std::optional<Passed> passed(const Group& group, const Test& test, CriticalStep StabilityFinding::*limit) {
    std::vector<std::pair<double, std::string>> at;
    for (const auto* f : group.members) {
      const bool of_motion = limit == &StabilityFinding::motion;
      const double dt = of_motion ? f->motion.holds : (f->*limit).fails;
      if (test(*f)) at.emplace_back(dt * f->rate.value_or(1), in_units(*f, dt, of_motion ? rough : 4));
    }
    if (at.empty()) return std::nullopt;
    std::sort(at.begin(), at.end());
    const std::string &from = at.front().second, &to = at.back().second;
    Passed found{group.label, at.front().first, from == to ? from : fmt::format("{} … {}", from, to)};
    if (at.size() < group.members.size()) found.label += fmt::format(" ({} of {})", at.size(), group.members.size());
    return found;
  }

  template <class Test>
  std::vector<Passed> all_passed(const std::string& scenario, const Test& test,
                                 CriticalStep StabilityFinding::*limit = &StabilityFinding::growth) const {
    std::vector<Passed> all;
    for (const auto& group : groups(scenario)) {
      if (auto found = passed(group, test, limit)) all.push_back(std::move(*found));
    }
    return all;
  }

  static std::string names_of(const std::vector<Passed>& all) {
    std::vector<std::string> names;
    for (const auto& p : all) names.push_back(p.label);
    return listed(std::move(names));
  }

  /// Limits in ascending order with their methods: "2 (dmv and velocity_verlet), 2.83 (rk4)".
  static std::string limits_of(std::vector<Passed> all) {
    std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.low < b.low; });
    std::vector<std::pair<std::string, std::vector<std::string>>> by_limit;
    for (auto& p : all) {
      if (by_limit.empty() || by_limit.back().first != p.limits) by_limit.push_back({p.limits, {}});
      by_limit.back().second.push_back(std::move(p.label));
    }
    std::vector<std::string> items;
    for (const auto& [limit, names] : by_limit) items.push_back(fmt::format("{} ({})", limit, words(names)));
    return fmt::format("{}", fmt::join(items, ", "));
  }

  /// The methods that follow the motion of a scenario up to the largest steps, for each scenario.
  std::vector<std::string> answer() const {
    constexpr std::size_t most_sentences = 3, most_named = 4;
    std::vector<std::string> all;
    for (const auto& scenario : study_.scenarios) {
      std::vector<const StabilityFinding*> followed;
      std::vector<std::string> at_all_steps;
      for (const StabilityFinding& f : found_) {
        if (motion(f) != scenario.name || is_varied(f) || !f.ladder.measured) continue;
        if (f.motion.kind == Kind::none) at_all_steps.push_back(label(f));
        if (f.motion.kind == Kind::found) followed.push_back(&f);
      }
      std::stable_sort(followed.begin(), followed.end(),
                       [](const auto* a, const auto* b) { return a->motion.holds > b->motion.holds; });
      std::vector<std::string> parts;
      if (!at_all_steps.empty())
        parts.push_back("at all steps tried by " + words(first_items(std::move(at_all_steps), most_named)));
      const StabilityFinding* next = nullptr;
      if (!followed.empty()) {
        const StabilityFinding& best = *followed.front();
        std::vector<std::string> names;
        for (const StabilityFinding* f : followed) {
          if (in_units(*f, f->motion.holds, rough) == in_units(best, best.motion.holds, rough))
            names.push_back(label(*f));
          else if (!next) next = f;
        }
        parts.push_back(fmt::format("up to {} {} by {}", symbol(), in_units(best, best.motion.holds, rough),
                                    words(first_items(std::move(names), most_named))));
      }
      if (parts.empty()) continue;
      std::string text = fmt::format("On {} the motion is followed {}", scenario.name, words(parts));
      if (next) text += fmt::format("; next is {} ({})", label(*next), in_units(*next, next->motion.holds, rough));
      all.push_back(text + ".");
    }
    if (all.size() > most_sentences) {
      const std::size_t left = all.size() - (most_sentences - 1);
      all.resize(most_sentences - 1);
      all.push_back(fmt::format("{} more below.", count(left, "motion")));
    }
    return all;
  }

  std::vector<std::string> sentences() const {
    std::vector<std::string> all;
    const auto grows = [](Kind k) { return [k](const StabilityFinding& f) { return f.growth.kind == k; }; };
    const auto breaks = [](const StabilityFinding& f) {
      return f.blow_up.kind == Kind::found && f.growth.fails < f.blow_up.fails;
    };
    for (const auto& scenario : study_.scenarios) {
      const std::string& where = scenario.name;
      const auto say = [&](const std::string& start, const std::string& items) {
        if (!items.empty()) all.push_back(fmt::format("{}, {}: {}.", where, start, items));
      };
      for (auto& text : motion_sentences(where)) all.push_back(std::move(text));
      say(fmt::format("critical {} of the energy", symbol()), limits_of(all_passed(where, grows(Kind::found))));
      say("no critical step up to the largest tried", names_of(all_passed(where, grows(Kind::none))));
      say("the energy grows at the smallest step tried already", names_of(all_passed(where, grows(Kind::from_start))));
      say(fmt::format("the energy grows before the run breaks down, which it does from {}", symbol()),
          limits_of(all_passed(where, breaks, &StabilityFinding::blow_up)));
      say("the energy stays bounded again at some larger step",
          names_of(all_passed(where, [](const auto& f) { return f.growth.holds_again; })));
      for (const Verdict v : {Verdict::gaining_slowly, Verdict::damped}) {
        say(fmt::format("{} below the critical step, over its scale {}",
                        v == Verdict::damped ? "energy is lost" : "energy is gained slowly, not by an instability,",
                        all_have_rates() ? "in a turn" : "in a second"),
            gains(where, v));
      }
      if (auto text = linear_sentence(where); !text.empty()) all.push_back(std::move(text));
    }
    if (auto text = left_out(); !text.empty()) all.push_back(std::move(text));
    return all;
  }

  std::vector<std::string> motion_sentences(const std::string& where) const {
    const auto known = [](Kind k) {
      return [k](const StabilityFinding& f) { return f.motion.kind == k && f.ladder.measured; };
    };
    const auto limit = &StabilityFinding::motion;
    const auto at = std::find_if(found_.begin(), found_.end(), [&](const auto& f) { return motion(f) == where; });
    if (at == found_.end()) return {};
    std::vector<std::string> parts;
    const auto add = [&](const std::string& start, const std::string& items) {
      if (!items.empty()) parts.push_back(start + items);
    };
    add(fmt::format("up to {} ", symbol()), limits_of(all_passed(where, known(Kind::found), limit)));
    add("at all steps tried by ", names_of(all_passed(where, known(Kind::none), limit)));
    add("not even at the smallest step tried by ", names_of(all_passed(where, known(Kind::from_start), limit)));
    std::vector<std::string> all;
    if (!parts.empty()) {
      all.push_back(fmt::format("{}, the motion is followed for {} s: {}.", where, number(at->ladder.duration),
                                fmt::join(parts, "; ")));
    }
    const auto unknown = all_passed(
        where, [](const auto& f) { return !f.ladder.measured; }, limit);
    if (!unknown.empty()) {
      const bool contact = at->ladder.steps.front().longest().config.contact.has_value();
      all.push_back(
          fmt::format("{}: no exact motion is known, so that invariants and the orientation alone say up to where it "
                      "is followed at most{}.",
                      where, contact ? "" : "; --reference measures the motion"));
    }
    return all;
  }

  /// "rk4 (4.3e-10 at h|ω| 0.063 to 1.1e-5 at h|ω| 0.72, ∝ h^5.0)", for findings without varied keys.
  std::string gains(const std::string& where, Verdict verdict) const {
    std::vector<std::string> items;
    for (const auto& f : found_) {
      if (motion(f) != where || is_varied(f) || f.below != verdict || !f.gain) continue;
      const auto at = [&](double dt, double per_second) {
        return fmt::format("{} at {} {}", number(std::abs(in_a_turn(f, per_second)), 2), symbol(),
                           in_units(f, dt, rough));
      };
      std::string text = at(f.gain->smallest_dt, f.gain->smallest_per_second);
      if (f.gain->dt != f.gain->smallest_dt) text += " to " + at(f.gain->dt, f.gain->per_second);
      if (f.gain->exponent) text += fmt::format(", ∝ h^{:.1f}", *f.gain->exponent);
      items.push_back(fmt::format("{} ({})", label(f), text));
    }
    return items.empty() ? "" : listed(std::move(items));
  }

  static bool agrees(const StabilityFinding& f) {
    const CriticalStep &a = f.growth, &b = f.linear->critical;
    return a.kind == b.kind && (a.kind != Kind::found || std::abs(a.fails - b.fails) <= 0.01 * b.fails);
  }

  std::string linear_sentence(const std::string& scenario) const {
    std::size_t n = 0, same = 0;
    for (const auto& f : found_) {
      if (motion(f) != scenario || !f.linear) continue;
      ++n;
      same += agrees(f) ? 1 : 0;
    }
    if (n == 0) return "";
    std::string text =
        fmt::format("{} is linear: the spectral radius of the step map gives the same limit to 1 % for {} of {}",
                    scenario, same, count(n, "case"));
    std::vector<std::string> others;
    for (const auto& f : found_) {
      if (motion(f) != scenario || !f.linear || agrees(f)) continue;
      others.push_back(fmt::format("{} (measured {}, by linear theory {})", label(f), step_text(f, f.growth, false),
                                   step_text(f, f.linear->critical, false)));
    }
    return text + (others.empty() ? "." : "; not for " + listed(std::move(others)) + ".");
  }

  static std::string left_out() {
    std::vector<std::string> names;
    for (const auto& entry : integrator_catalogue()) {
      if (entry.declaration.adaptive) names.push_back(entry.declaration.name);
    }
    return names.empty() ? "" : fmt::format("Left out, since they choose their own steps: {}.", words(names));
  }

  // Files.

  static std::string kind_text(const CriticalStep& c) {
    return c.kind == Kind::found ? "found" : c.kind == Kind::none ? "none" : "from the smallest";
  }

  static void add_limit(std::vector<std::string>& row, const StabilityFinding& f, const CriticalStep& c) {
    const auto cell = [](bool there, double x) { return there ? exact(x) : std::string(); };
    row.push_back(kind_text(c));
    row.push_back(cell(c.kind != Kind::from_start, c.holds));
    row.push_back(cell(c.kind != Kind::none, c.fails));
    row.push_back(cell(c.kind != Kind::none && f.rate, c.fails * f.rate.value_or(0)));
  }

  std::string critical_csv() const {
    auto header = config_columns(study_.varied_keys, study_.named, {Role::size, Role::duration});
    for (const char* c : {"characteristic_rate_rad_per_s",
                          "smallest_step_s",
                          "largest_step_s",
                          "growth",
                          "largest_holding_step_s",
                          "critical_step_s",
                          "critical_h_omega",
                          "holds_again",
                          "blow_up",
                          "largest_step_before_blow_up_s",
                          "blow_up_step_s",
                          "blow_up_h_omega",
                          "linear_theory",
                          "linear_largest_holding_step_s",
                          "linear_critical_step_s",
                          "linear_critical_h_omega",
                          "spectral_radius_min",
                          "spectral_radius_max",
                          "energy_below",
                          "energy_gain_per_s",
                          "energy_gain_step_s",
                          "energy_gain_exponent",
                          "motion_duration_s",
                          "motion_measured",
                          "motion",
                          "largest_following_step_s",
                          "motion_lost_step_s",
                          "motion_lost_h_omega",
                          "motion_lost_by"}) {
      header.emplace_back(c);
    }
    std::string text = csv_row(header);
    for (const auto& f : found_) {
      const auto& steps = f.ladder.steps;
      auto row = config_cells(steps.front().longest().config, study_.named, {Role::size, Role::duration});
      for (auto& cell : {csv_cell(f.rate), exact(steps.front().dt), exact(steps.back().dt)}) row.push_back(cell);
      add_limit(row, f, f.growth);
      row.emplace_back(f.growth.holds_again ? "yes" : "no");
      add_limit(row, f, f.blow_up);
      if (f.linear) {
        add_limit(row, f, f.linear->critical);
        row.push_back(exact(f.linear->smallest));
        row.push_back(exact(f.linear->largest));
      } else {
        row.resize(row.size() + 6);
      }
      row.emplace_back(name(f.below));
      row.push_back(f.gain ? exact(f.gain->per_second) : "");
      row.push_back(f.gain ? exact(f.gain->dt) : "");
      row.push_back(f.gain ? csv_cell(f.gain->exponent) : "");
      row.push_back(exact(f.ladder.duration));
      row.emplace_back(f.ladder.measured ? "yes" : "no");
      add_limit(row, f, f.motion);
      row.emplace_back(name(f.lost));
      text += csv_row(row);
    }
    return text;
  }

  std::string runs_csv() const {
    std::vector<std::string> header = {"run"};
    for (auto& c : config_columns(study_.varied_keys, study_.named)) header.push_back(std::move(c));
    for (const char* c : {"steps", "h_omega", "verdict", "spectral_radius", "energy_gain_per_s", "motion_lost"}) {
      header.emplace_back(c);
    }
    std::string text = csv_row(header);
    for (const auto& f : found_) {
      for (std::size_t i = 0; i < f.ladder.steps.size(); ++i) {
        const auto& step = f.ladder.steps[i];
        for (const RunRecord* run : step.runs) {
          std::vector<std::string> row = {run->id};
          for (auto& cell : config_cells(run->config, study_.named)) row.push_back(std::move(cell));
          row.push_back(std::to_string(run->result.steps));
          row.push_back(f.rate ? exact(step.dt * *f.rate) : "");
          row.emplace_back(name(energy_verdict(*run, f.ladder.turn)));
          row.push_back(f.linear ? csv_cell(f.linear->radius[i]) : "");
          row.push_back(csv_cell(energy_gain_rate(*run)));
          row.emplace_back(name(what_is_lost(*run, f.ladder.displacement)));
          text += csv_row(row);
        }
      }
    }
    return text;
  }

  const StudyView& study_;
  Grouping grouping_;
  std::vector<StabilityFinding> found_;
};

}  // namespace

Analysis stability(const StudyView& study) { return Stability(study).analysis(); }

}  // namespace polhode::study::stability
