// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/certificate/certificate_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "experiments/certificate/certificate.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/text/csv.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::certificate {
namespace {

constexpr std::size_t most_items = 16;  // largest number of items of a sentence

/// The run options that distinguish certificates.
constexpr std::array subject_options = {"integrator", "orientation",   "angular-state", "gyroscopic",
                                        "normalize",  "rotation-from", "precision"};

bool is_order(const std::string& trait) { return trait.starts_with("order_"); }
bool is_count(const std::string& trait) { return trait == "evaluations_per_step"; }

/// The number in a cell: "4.00", "1.3e-16", "exact".
std::string measured_text(const Finding& finding) {
  if (!finding.measured) return is_order(finding.trait) && finding.verdict == TraitVerdict::holds ? "exact" : "";
  if (is_order(finding.trait)) return fmt::format("{:.2f}", *finding.measured);
  if (is_count(finding.trait)) return number(*finding.measured);
  return number(*finding.measured, 2);
}

/// Mark of the verdict in a cell; the last sentences of the report explain the marks.
std::string mark(const Finding& finding) {
  const bool claims_nothing = finding.declared.empty() && finding.verdict == TraitVerdict::absent;
  switch (finding.verdict) {
    case TraitVerdict::holds: return is_order(finding.trait) || is_count(finding.trait) ? "" : "yes ";
    case TraitVerdict::does_not_hold: return "NOT ";
    case TraitVerdict::undeclared: return "(yes) ";
    case TraitVerdict::absent: return claims_nothing ? "" : "no ";
    case TraitVerdict::undecided: return "? ";
    default: return "";
  }
}

std::string cell(const Finding& finding) {
  if (finding.verdict == TraitVerdict::not_applicable) return "";
  std::string text = mark(finding) + measured_text(finding);
  if (finding.verdict == TraitVerdict::does_not_hold && (is_order(finding.trait) || is_count(finding.trait))) {
    text += fmt::format(", declared {}", finding.declared);
  }
  // The class of the drift, or the status "diverged" without its message.
  if (finding.trait == "energy_forced" && !finding.note.empty()) {
    text += " " + finding.note.substr(0, finding.note.find(':'));
  }
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

/// The analysis:
/// 1. measures_of(): settings of the measurements, from the runs of the study.
/// 2. certify(): for each method and formulation the traits, from the runs and from measurements of single steps.
/// 3. analysis(): sentences, tables, certificate.csv; cost.csv from wall times.
class Report {
 public:
  explicit Report(const StudyView& study)
      : study_(study), measures_(measures_of(study)), certificates_(certify(study, measures_)) {}

  Analysis analysis() const {
    Analysis found{.alone = true, .heading = "Declared and measured"};
    found.sentences = sentences();
    found.answer.sentences = {found.sentences.front()};
    if (const auto items = of_verdict(TraitVerdict::does_not_hold, Share::any); !items.empty())
      found.answer.sentences.push_back("Declared, and measured not to hold: " + joined(items) + ".");
    found.tables.push_back({"certificate", overview()});
    if (several_variants()) found.tables.push_back({"certificate_by_formulation", by_formulation()});
    found.method = method();
    found.files.push_back({"certificate.csv", csv()});
    found.timed.files.push_back({"cost.csv", cost(found.timed.sentences)});
    return found;
  }

 private:
  bool several_variants() const {
    return std::any_of(certificates_.begin(), certificates_.end(), [](const auto& c) { return !c.variant.empty(); });
  }

  static const std::string& name_of(const Certificate& c) { return c.entry->declaration.name; }
  static std::string label(const Certificate& c) {
    return c.variant.empty() ? name_of(c) : fmt::format("{} ({})", name_of(c), c.variant);
  }

  std::vector<std::string> methods() const {
    std::vector<std::string> all;
    for (const Certificate& c : certificates_) {
      if (std::find(all.begin(), all.end(), name_of(c)) == all.end()) all.push_back(name_of(c));
    }
    return all;
  }

  enum class Share { any, some, all };  ///< formulations with the verdict: at least one, not all, or all

  /// One item for each method and trait with the verdict: "rk4: order, forced 3.20, declared 4 in matrix,
  /// velocity_body".
  std::vector<std::string> of_verdict(TraitVerdict verdict, Share share) const {
    std::vector<std::string> items;
    for (const std::string& method : methods()) {
      for (std::size_t k = 0; k < trait_columns().size(); ++k) {
        std::vector<const Certificate*> those;
        std::size_t all = 0;
        for (const Certificate& c : certificates_) {
          if (name_of(c) != method || c.findings[k].verdict == TraitVerdict::not_applicable) continue;
          ++all;
          if (c.findings[k].verdict == verdict) those.push_back(&c);
        }
        if (those.empty() || (share == Share::all && those.size() < all)) continue;
        if (share == Share::some && those.size() == all) continue;
        const Finding& first = those.front()->findings[k];
        std::string text = fmt::format("{}: {}", method, trait_columns()[k].heading);
        if (const std::string shown = measured_text(first); !shown.empty()) text += " " + shown;
        if (verdict == TraitVerdict::does_not_hold) text += fmt::format(", declared {}", first.declared);
        if (verdict == TraitVerdict::undecided && !first.note.empty()) text += fmt::format(" ({})", first.note);
        if (those.size() < all) {
          text += those.size() == 1 ? fmt::format(" in {}", those.front()->variant)
                                    : fmt::format(" in {} of {} formulations", those.size(), all);
        }
        items.push_back(std::move(text));
      }
    }
    return items;
  }

  static std::string joined(std::vector<std::string> items) {
    return fmt::format("{}", fmt::join(first_items(std::move(items), most_items), "; "));
  }

  std::vector<std::string> sentences() const {
    std::map<TraitVerdict, std::size_t> counts;
    for (const Certificate& c : certificates_) {
      for (const Finding& f : c.findings) ++counts[f.verdict];
    }
    const auto declared = counts[TraitVerdict::holds] + counts[TraitVerdict::does_not_hold];
    std::vector<std::string> all = {fmt::format("{} of {} of {}{} that were decided by a measurement hold.",
                                                counts[TraitVerdict::holds], count(declared, "declared trait"),
                                                count(methods().size(), "method"),
                                                several_variants() ? ", counted in every formulation," : "")};
    if (const auto items = of_verdict(TraitVerdict::does_not_hold, Share::any); !items.empty()) {
      all.push_back("Declared, and measured not to hold: " + joined(items) + ".");
    }
    if (const auto items = of_verdict(TraitVerdict::undeclared, Share::all); !items.empty()) {
      all.push_back(fmt::format("Not declared, and measured to hold{}: {}.",
                                several_variants() ? " in every formulation" : "", joined(items)));
    }
    if (const auto items = of_verdict(TraitVerdict::undeclared, Share::some); !items.empty()) {
      all.push_back(fmt::format(
          "In some formulations only, {} hold that {} not declared: where the world’s momentum is the state nothing "
          "moves it without a torque, and in body axes energy and Casimir are quadratic.",
          count(items.size(), "trait"), items.size() == 1 ? "is" : "are"));
    }
    if (const auto items = of_verdict(TraitVerdict::undecided, Share::any); !items.empty()) {
      all.push_back("Undecided: " + joined(items) + ".");
    }
    all.emplace_back(
        "In the table: yes, declared and measured to hold; NOT, declared, and it does not hold; (yes), holds though "
        "not "
        "declared; no, neither, in brackets in how many formulations it holds all the same; ?, undecided; –, makes no "
        "sense. Orders and counts without a mark are as declared; of adaptive methods the slope of the error against "
        "the tolerance stands for the order.");
    if (!study_.varied_keys.empty()) {
      all.emplace_back(
          "Reversibility, symplecticity, Casimir, the order under f(t) and the counts are of the scenarios as they "
          "stand, without the varied keys.");
    }
    return all;
  }

  /// The worst finding over the formulations. more: " (2 of 6)" if an undeclared trait holds in only some of them.
  static Finding over_formulations(const std::vector<const Certificate*>& those, std::size_t k, std::string& more) {
    std::vector<Finding> findings;
    std::size_t held = 0, all = 0;
    for (const Certificate* c : those) {
      findings.push_back(c->findings[k]);
      if (c->findings[k].verdict == TraitVerdict::not_applicable) continue;
      ++all;
      held +=
          c->findings[k].verdict == TraitVerdict::undeclared || c->findings[k].verdict == TraitVerdict::holds ? 1 : 0;
    }
    const Finding found = worst(findings);
    if (found.verdict == TraitVerdict::absent && held > 0) more = fmt::format(" ({} of {})", held, all);
    return found;
  }

  Table overview() const {
    Table table{.caption = several_variants() ? "Declared and measured, the worst over the formulations"
                                              : "Declared and measured",
                .columns = {{.header = "method", .kind = Column::Kind::name, .key = true}},
                .rows = {}};
    for (const TraitColumn& column : trait_columns()) table.columns.push_back({column.heading, "", Column::Kind::text});
    for (const std::string& method : methods()) {
      std::vector<const Certificate*> those;
      for (const Certificate& c : certificates_) {
        if (name_of(c) == method) those.push_back(&c);
      }
      std::vector<std::string> row = {method};
      for (std::size_t k = 0; k < trait_columns().size(); ++k) {
        std::string more;
        const Finding found = over_formulations(those, k, more);
        row.push_back(cell(found) + more);
      }
      table.rows.push_back(std::move(row));
    }
    return table;
  }

  Table by_formulation() const {
    Table table{.caption = "Declared and measured, formulation by formulation",
                .columns = {{.header = "method", .kind = Column::Kind::name, .key = true},
                            {.header = "formulation", .kind = Column::Kind::text, .key = true}},
                .rows = {}};
    for (const TraitColumn& column : trait_columns()) table.columns.push_back({column.heading, "", Column::Kind::text});
    for (const Certificate& c : certificates_) {
      std::vector<std::string> row = {name_of(c), c.variant};
      for (const Finding& finding : c.findings) row.push_back(cell(finding));
      table.rows.push_back(std::move(row));
    }
    return table;
  }

  std::vector<std::string> method() const {
    const Course& course = measures_.course;
    return {
        "Orders: as in the experiment convergence, from the shortest runs of each scenario; f(t): the same over 1 s "
        "under a force and a torque that depend on time.",
        fmt::format(
            "Reversible: ‖Φ₋ₕΦₕy − y‖/(1 + ‖y‖) at h = {0} s from a point off all symmetries, up to {1}; many: 20 "
            "steps there and 20 back, up to {2}. Symplectic: ‖DᵀωD − ω‖/‖ω‖ of one step of {0} s in the "
            "left-trivialised phase space, in long double where the method works in it, also at half, a quarter and an "
            "eighth of that step.",
            number(measures_.map_step()), number(return_limit), number(many_return_limit)),
        fmt::format(
            "Energy, momentum, Casimir |IΩ| and orientation: the largest relative drift, or defect, over {} s at "
            "h = {} s (adaptive methods: tolerance {}); kept: up to {}. What a drift under forces grows like "
            "stands behind it.",
            number(course.t_end), number(course.step), number(course.tolerance), number(kept_limit)),
        fmt::format("Right-hand sides per step are counted by a force; the time of a step is in {}/cost.csv.",
                    timings_folder)};
  }

  static std::vector<std::string> subject_columns() {
    std::vector<std::string> columns;
    for (const char* name : subject_options) columns.push_back(run_option(name).column);
    return columns;
  }
  static std::vector<std::string> subject_cells(const RunConfig& config) {
    std::vector<std::string> cells;
    for (const char* name : subject_options) cells.push_back(config_cell(run_option(name), config));
    return cells;
  }

  std::string csv() const {
    auto header = subject_columns();
    for (const char* c : {"trait", "declared", "measured", "unit", "limit", "verdict", "scenario", "note"}) {
      header.emplace_back(c);
    }
    std::string text = csv_row(header);
    for (const Certificate& c : certificates_) {
      for (const Finding& f : c.findings) {
        auto row = subject_cells(c.config);
        for (auto& cell : std::vector<std::string>{f.trait, f.declared, csv_cell(f.measured), f.measured ? f.unit : "",
                                                   csv_cell(f.limit), word_of(f.verdict), f.on, f.note}) {
          row.push_back(std::move(cell));
        }
        text += csv_row(row);
      }
    }
    return text;
  }

  /// Text of cost.csv. Methods are timed one after another, so that they do not slow each other down.
  std::string cost(std::vector<std::string>& sentences) const {
    auto header = subject_columns();
    for (const char* c : {"step_ns", "rhs_per_step", "rhs_ns"}) header.emplace_back(c);
    std::string text = csv_row(header);
    std::map<double, std::string> by_time;
    for (const Certificate& c : certificates_) {
      const double ns = nanoseconds_per_step({*c.entry, c.config.formulation}, measures_.test_cases, measures_.course);
      auto row = subject_cells(c.config);
      const auto& asked = c.findings.back().measured;
      row.push_back(std::isfinite(ns) ? fmt::format("{:.1f}", ns) : "");
      row.push_back(csv_cell(asked));
      row.push_back(std::isfinite(ns) && asked && *asked > 0 ? fmt::format("{:.1f}", ns / *asked) : "");
      text += csv_row(row);
      if (std::isfinite(ns)) by_time.emplace(ns, label(c));
    }
    if (by_time.size() > 1) {
      const auto [least, cheap] = *by_time.begin();
      const auto [most, dear] = *by_time.rbegin();
      sentences.push_back(
          fmt::format("A step takes {} ns ({}) to {} ns ({}).", number(least), cheap, number(most), dear));
    }
    return text;
  }

  const StudyView& study_;
  Measures measures_;
  std::vector<Certificate> certificates_;
};

}  // namespace

Analysis certificates(const StudyView& study) { return Report(study).analysis(); }

}  // namespace polhode::study::certificate
