// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/precision/rounding.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>

#include "experiments/precision/families.hpp"
#include "experiments/precision/growth_estimate.hpp"
#include "experiments/precision/rounding_figures.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/text/csv.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::precision {
namespace {

using namespace precision;
using precision::RoundingProblem;

/// The run options that the CSV files name.
constexpr std::array named_options = {"scenario",   "integrator", "orientation",   "angular-state",
                                      "gyroscopic", "normalize",  "rotation-from", "t-end",
                                      "samples",    "precision",  "summation"};

struct Ladder {
  const RoundingProblem* problem;
  const Family* family;
  Quantity quantity;
  Split split;
};

/// Growth of energy drift and attitude error in time, over the runs in which rounding dominates.
struct Rise {
  const RoundingProblem* problem;
  const Family* family;
  std::optional<GrowthEstimate> energy, attitude;
};

Rise rise_of(const RoundingProblem& problem, const Family& family) {
  std::vector<double> energy, attitude;
  for (const Rung& rung : family.rungs) {
    for (const auto& run : rung.runs) {
      if (!is_rounding(run)) continue;
      if (const auto p = path_exponent(energy_path(*run.run))) energy.push_back(*p);
      if (!is_rounding_in_attitude(run)) continue;
      if (const auto p = path_exponent(attitude_path(*run.run))) attitude.push_back(*p);
    }
  }
  return {&problem, &family, estimate_growth(energy), estimate_growth(attitude)};
}

std::string step_text(const Family& family, double step) {
  return family.adaptive() ? fmt::format("tolerance {}", rounded(step)) : fmt::format("dt = {} s", rounded(step));
}
std::string words_of(const Quantity& quantity) {
  return quantity.unit == " rad" ? "attitude" : quantity.unit == " m" ? "position" : "energy";
}
std::string between(const GrowthEstimate& e) { return fmt::format("{:.2f} ± {:.2f}", e.exponent, e.half_width_95); }

/// The analysis:
/// 1. problems_of(): runs by problem, arithmetic and step, each with its counterpart in the highest precision.
/// 2. split(): rounding and truncation errors of each ladder of steps.
/// 3. rise_of(): growth in time of the errors in which rounding dominates.
/// 4. drop_trivial_positions(): removes the position errors of bodies at rest.
/// 5. analysis(): sentences, tables, figures, rounding.csv and growth.csv.
class Rounding {
 public:
  explicit Rounding(const StudyView& study) : problems_(problems_of(study)) {
    for (const RoundingProblem& problem : problems_) {
      for (const Family& family : problem.families) {
        for (const auto& quantity :
             {quantity::attitude_error(), quantity::position_error(), quantity::energy_drift()}) {
          if (const auto found = split(family, quantity)) ladders_.push_back({&problem, &family, quantity, *found});
        }
        rises_.push_back(rise_of(problem, family));
      }
    }
    drop_trivial_positions();
  }

  Analysis analysis() const {
    Analysis found{.heading = "Rounding and truncation"};
    found.answer.sentences = answer();
    for (auto part : {&Rounding::takes_over, &Rounding::saved, &Rounding::growth, &Rounding::not_told}) {
      for (auto& text : (this->*part)()) found.sentences.push_back(std::move(text));
    }
    found.method = {
        "Rounding is told from truncation by the run from the same start, at the same step, in the highest precision "
        "of "
        "the study. Truncation: the steps at which the two agree to a quarter; its order is the slope of the "
        "logarithms "
        "there. Rounding takes over at the largest step from which on the error is more than twice the more precise "
        "one. All errors are root mean squares over the starts.",
        "Growth: |error| ∝ t^p, from the root mean squares of each octave of time, for each run whose energy drift is "
        "ten "
        "times that of its more precise counterpart; mean over these runs, with the 95 % confidence interval of "
        "Student’s t. "
        "Unbiased rounding makes the energy a random walk, p = ½ (Brouwer’s law), and the attitude, which adds it up, "
        "p = 3/2; "
        "biased rounding makes them 1 and 2, a bounded drift 0 and 1. Told where within 0.2, with ±0.2 at most.",
        "Compensated summation keeps what rounding loses of each increment and adds it to the next one. The state "
        "itself is "
        "still stored to its precision, so that a compensated energy stays some units of that above zero.",
        "Energies and errors are measured in double, and so is the exact motion: of runs in long double nothing below "
        "about 1e-15 (energy) and 1e-14 (attitude, growing with time) is seen."};
    if (!ladders_.empty()) found.tables.push_back({"rounding", ladder_table()});
    if (has_growth()) found.tables.push_back({"growth", growth_table()});
    found.figures = rounding_figures(problems_);
    found.files = {{"rounding.csv", ladder_csv()}, {"growth.csv", growth_csv()}};
    return found;
  }

 private:
  /// Removes the position errors of bodies at rest.
  void drop_trivial_positions() {
    const auto trivial = [](const Ladder& l) {
      return l.quantity.unit == " m" && l.split.least_error < 1e-30 && !l.split.truncation.line;
    };
    std::erase_if(ladders_, trivial);
  }

  bool has_growth() const {
    return std::any_of(rises_.begin(), rises_.end(), [](const Rise& r) { return r.energy || r.attitude; });
  }

  /// "rk4, attitude: in float below dt = 0.0625 s (least error 2e-5 rad at 0.03125 s); …"
  /// For each arithmetic without compensation: from which steps down rounding takes over, and the least error.
  std::vector<std::string> answer() const {
    struct Over {
      std::string arithmetic;
      std::size_t ladders = 0, reached = 0;
      double smallest = 0, largest = 0;  // steps from which it takes over
      const Ladder* least = nullptr;
    };
    std::vector<Over> all;
    for (const Ladder& l : ladders_) {
      if (l.family->compensated || l.family->adaptive() || !l.split.has_yardstick || is_second(l)) continue;
      const std::string arithmetic = l.family->arithmetic();
      auto at = std::find_if(all.begin(), all.end(), [&](const Over& o) { return o.arithmetic == arithmetic; });
      if (at == all.end()) at = all.insert(all.end(), Over{arithmetic});
      ++at->ladders;
      if (!l.split.takes_over) continue;
      const double step = *l.split.takes_over;
      at->smallest = at->reached == 0 ? step : std::min(at->smallest, step);
      at->largest = std::max(at->largest, step);
      ++at->reached;
      if (!at->least || l.split.least_error < at->least->split.least_error) at->least = &l;
    }
    constexpr std::size_t most_sentences = 3;
    std::vector<std::string> sentences;
    for (const Over& o : all) {
      if (sentences.size() == most_sentences) break;
      if (o.reached == 0) {
        sentences.push_back(fmt::format("In {} rounding takes over at none of these steps.", o.arithmetic));
        continue;
      }
      const std::string steps = o.smallest == o.largest
                                    ? rounded(o.smallest)
                                    : fmt::format("{} to {}", rounded(o.smallest), rounded(o.largest));
      sentences.push_back(fmt::format(
          "In {} rounding takes over from dt = {} s down, with {} of {} methods and motions; the least {} of these is "
          "{}{}, with {} at {}.",
          o.arithmetic, steps, o.reached, o.ladders, o.least->quantity.words, number(o.least->split.least_error),
          o.least->quantity.unit, o.least->problem->label(), step_text(*o.least->family, o.least->split.at_step)));
    }
    return sentences;
  }

  std::vector<std::string> takes_over() const {
    std::vector<std::string> all;
    for (const RoundingProblem& problem : problems_) {
      std::vector<std::string> parts, never;
      for (const Ladder& l : ladders_) {
        if (l.problem != &problem || l.family->compensated || !l.split.has_yardstick || is_second(l)) continue;
        if (!l.split.takes_over) {
          never.push_back(l.family->arithmetic());
          continue;
        }
        parts.push_back(fmt::format("in {} from {} down (least {} {}{}, at {})", l.family->arithmetic(),
                                    step_text(*l.family, *l.split.takes_over), l.quantity.words,
                                    number(l.split.least_error), l.quantity.unit,
                                    step_text(*l.family, l.split.at_step)));
      }
      if (!never.empty()) parts.push_back(fmt::format("not at any of these steps in {}", words(never)));
      if (!parts.empty()) all.push_back(fmt::format("{}: rounding takes over {}.", problem.label(), words(parts)));
    }
    return all;
  }

  /// True if the family has an earlier ladder. Sentences mention only the first one; the table contains all.
  bool is_second(const Ladder& ladder) const {
    for (const Ladder& l : ladders_) {
      if (l.family == ladder.family) return &l != &ladder;
    }
    return false;
  }

  /// Errors with plain and with compensated summation, at the smallest step if it is the same for both, and if plain
  /// summation shows rounding there.
  std::vector<std::string> saved() const {
    std::vector<std::string> all;
    for (const RoundingProblem& problem : problems_) {
      std::vector<std::string> parts;
      for (const Family& plain : problem.families) {
        const auto other = std::find_if(problem.families.begin(), problem.families.end(), [&](const Family& f) {
          return f.compensated && !plain.compensated && f.precision == plain.precision;
        });
        if (other == problem.families.end() || plain.rungs.back().step != other->rungs.back().step) continue;
        std::vector<std::string> gains;
        for (const auto& quantity : {quantity::attitude_error(), quantity::energy_drift()}) {
          const auto before = error_of(plain.rungs.back(), quantity), after = error_of(other->rungs.back(), quantity);
          const auto exact = truncation_of(plain.rungs.back(), quantity);
          if (!before || !after || !exact || !(*before > 2 * *exact)) continue;
          gains.push_back(
              fmt::format("the {} from {} to {}{}", quantity.words, number(*before), number(*after), quantity.unit));
        }
        if (!gains.empty()) {
          parts.push_back(fmt::format("in {} {} at {}", name(plain.precision), words(gains),
                                      step_text(plain, plain.rungs.back().step)));
        }
      }
      if (!parts.empty()) {
        all.push_back(fmt::format("{}: compensated summation brings {}.", problem.label(),
                                  fmt::format("{}", fmt::join(parts, "; "))));
      }
    }
    return all;
  }

  std::vector<std::string> growth() const {
    std::vector<std::string> all;
    for (const auto& [kind, start] :
         {std::pair(Growth::random_walk, "Brouwer’s law is seen, an energy drift of rounding as a random walk, ∝ √t: "),
          std::pair(Growth::linear, "Biased rounding, an energy drift in proportion to time: "),
          std::pair(Growth::bounded, "An energy drift of rounding that does not grow: "),
          std::pair(Growth::not_told, "None of these, or not told: ")}) {
      std::vector<std::string> items;
      for (const Rise& r : rises_) {
        if (!r.energy || judge_energy_growth(*r.energy) != kind) continue;
        std::string item =
            fmt::format("{} in {}, t^({})", r.problem->label(), r.family->arithmetic(), between(*r.energy));
        if (r.attitude) item += fmt::format(", attitude t^({})", between(*r.attitude));
        items.push_back(fmt::format("{} ({})", item, count(r.energy->paths, "run")));
      }
      if (!items.empty()) all.push_back(start + fmt::format("{}", fmt::join(items, "; ")) + ".");
    }
    return all;
  }

  std::vector<std::string> not_told() const {
    std::set<std::string> alone;
    for (const Ladder& l : ladders_) {
      if (!l.split.has_yardstick) alone.insert(fmt::format("{} in {}", l.problem->label(), name(l.family->precision)));
    }
    if (alone.empty()) return {};
    return {fmt::format("There is no higher precision against which to tell the rounding of {}.",
                        words({alone.begin(), alone.end()}))};
  }

  Table ladder_table() const {
    using Kind = Column::Kind;
    Table table{.caption = "Where truncation ends and rounding begins",
                .columns = {{"method", "", Kind::name},
                            {.header = "motion", .kind = Kind::text, .apart = true},
                            {"formulation", "", Kind::text},
                            {"arithmetic", "", Kind::text},
                            {.header = "error of", .kind = Kind::text, .apart = true},
                            {"order"},
                            {"±"},
                            {"truncation alone", "", Kind::text},
                            {"rounding takes over at"},
                            {.header = "least error", .best = Column::Best::least},
                            {"at"},
                            {"rounding ∝ step to the"}},
                .rows = {}};
    for (const Ladder& l : ladders_) {
      const auto& t = l.split.truncation;
      table.rows.push_back({l.problem->method, l.problem->motion, l.problem->formulation, l.family->arithmetic(),
                            words_of(l.quantity), t.line ? fmt::format("{:.2f}", t.line->order) : "",
                            t.line ? fmt::format("{:.2f}", t.line->half_width_95) : "",
                            t.line ? fmt::format("{} … {}", number(t.largest), number(t.smallest)) : "",
                            l.split.takes_over      ? number(*l.split.takes_over)
                            : l.split.has_yardstick ? "nowhere"
                                                    : "",
                            number(l.split.least_error), number(l.split.at_step),
                            l.split.rounding_power ? fmt::format("{:.2f}", *l.split.rounding_power) : ""});
    }
    return without_empty_columns(std::move(table));
  }

  Table growth_table() const {
    using Kind = Column::Kind;
    Table table{.caption = "How errors of rounding grow in time, ∝ t^p; ±: 95 % confidence",
                .columns = {{"method", "", Kind::name},
                            {"motion", "", Kind::text},
                            {"formulation", "", Kind::text},
                            {"arithmetic", "", Kind::text},
                            {"runs"},
                            {"energy p"},
                            {"±"},
                            {"energy", "", Kind::text},
                            {"attitude p"},
                            {"±"},
                            {"told by the attitude", "", Kind::text}},
                .rows = {}};
    for (const Rise& r : rises_) {
      if (!r.energy && !r.attitude) continue;
      const auto digits = [](const std::optional<GrowthEstimate>& e, double GrowthEstimate::*of) {
        return e ? fmt::format("{:.2f}", (*e).*of) : std::string();
      };
      table.rows.push_back(
          {r.problem->method, r.problem->motion, r.problem->formulation, r.family->arithmetic(),
           r.energy ? std::to_string(r.energy->paths) : "", digits(r.energy, &GrowthEstimate::exponent),
           digits(r.energy, &GrowthEstimate::half_width_95), r.energy ? word_of(judge_energy_growth(*r.energy)) : "",
           digits(r.attitude, &GrowthEstimate::exponent), digits(r.attitude, &GrowthEstimate::half_width_95),
           r.attitude ? word_of(judge_attitude_growth(*r.attitude)) : ""});
    }
    return without_empty_columns(std::move(table));
  }

  static std::vector<std::string> named(const Family& family) {
    std::vector<std::string> cells;
    for (const char* name : named_options) {
      const RunOption& option = run_option(name);
      const OptionValue value = option.value(family.config());
      cells.push_back(text_of(value == OptionValue{} ? option.usual : value));
    }
    return cells;
  }
  static std::vector<std::string> with_names(std::initializer_list<const char*> more) {
    std::vector<std::string> all;
    for (const char* name : named_options) {
      const RunOption& option = run_option(name);
      all.push_back(option.column.empty() ? file_key(option) : option.column);
    }
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  std::string ladder_csv() const {
    std::string text =
        csv_row(with_names({"error_of", "against", "order", "confidence_95_low", "confidence_95_high",
                            "truncation_largest_step", "truncation_smallest_step", "rounding_takes_over_at",
                            "least_error", "least_error_at", "rounding_power_of_step"}));
    for (const Ladder& l : ladders_) {
      auto row = named(*l.family);
      const auto& t = l.split.truncation;
      const auto of_line = [&](double number) { return t.line ? exact(number) : std::string(); };
      const double order = t.line ? t.line->order : 0, half = t.line ? t.line->half_width_95 : 0;
      for (auto& cell : std::vector<std::string>{
               l.quantity.column, l.family->adaptive() ? "tolerance" : "dt_s", of_line(order), of_line(order - half),
               of_line(order + half), of_line(t.largest), of_line(t.smallest), csv_cell(l.split.takes_over),
               exact(l.split.least_error), exact(l.split.at_step), csv_cell(l.split.rounding_power)}) {
        row.push_back(std::move(cell));
      }
      text += csv_row(row);
    }
    return text;
  }

  std::string growth_csv() const {
    std::string all =
        csv_row(with_names({"growth_of", "runs", "exponent", "confidence_95_low", "confidence_95_high", "growth"}));
    const auto add = [&](const Rise& r, const char* of, const std::optional<GrowthEstimate>& e, auto judge) {
      if (!e) return;
      auto row = named(*r.family);
      for (auto& cell : std::vector<std::string>{of, std::to_string(e->paths), exact(e->exponent),
                                                 exact(e->exponent - e->half_width_95),
                                                 exact(e->exponent + e->half_width_95), word_of(judge(*e))}) {
        row.push_back(std::move(cell));
      }
      all += csv_row(row);
    };
    for (const Rise& r : rises_) {
      add(r, "energy_drift_rel", r.energy, judge_energy_growth);
      add(r, "attitude_error_rad", r.attitude, judge_attitude_growth);
    }
    return all;
  }

  std::vector<RoundingProblem> problems_;
  std::vector<Ladder> ladders_;
  std::vector<Rise> rises_;
};

}  // namespace

Analysis rounding_and_truncation(const StudyView& study) { return Rounding(study).analysis(); }

}  // namespace polhode::study::precision
