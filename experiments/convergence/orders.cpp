// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/convergence/orders.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "experiments/study/curves/curves.hpp"
#include "experiments/study/curves/declared_order.hpp"
#include "experiments/study/curves/error_ladder.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/statistics/order_estimate.hpp"
#include "experiments/study/text/csv.hpp"
#include "experiments/study/text/notation.hpp"
#include "integrators/catalogue.hpp"

namespace polhode::study::convergence {
namespace {

constexpr std::size_t most_items = 16;  // largest number of items of a sentence

/// The quantity that has an error.
enum class Of { attitude, position, velocity, reactions };

std::string word_of(Of of) {
  switch (of) {
    case Of::attitude: return "attitude";
    case Of::position: return "position";
    case Of::velocity: return "velocity";
    case Of::reactions: break;
  }
  return "reactions";
}

Quantity quantity_of(Of of) {
  switch (of) {
    case Of::attitude: return quantity::attitude_error();
    case Of::position: return quantity::position_error();
    case Of::velocity: return quantity::velocity_error();
    case Of::reactions: break;
  }
  return quantity::reaction_error();
}

struct Order {
  const Curve* curve;
  Of of;
  Quantity quantity;
  std::optional<double> declared;  ///< declared order, 1 for an adaptive method; absent: exact
  OrderEstimate estimate;
  OrderVerdict verdict;
};

Order order_of(const Curve& curve, Of of, const Quantity& quantity, std::optional<double> declared) {
  const auto estimate = observed_order(curve, quantity);
  return {&curve, of, quantity, declared, estimate, order_verdict(estimate, declared)};
}

/// The analysis:
/// 1. group(): curves of runs that differ only in the step or the tolerance.
/// 2. add(): for each curve the observed order of the attitude and the position error, with joints also of the velocity
///    and the reactions, and its verdict beside the declared order.
/// 3. drop_trivial(): removes the position errors of motions that every method computes exactly.
/// 4. analysis(): sentences, the table of orders, orders.csv.
class Orders {
 public:
  explicit Orders(const StudyView& study) : study_(study), grouping_(group(study)) {
    for (const auto& curve : grouping_.curves) add(curve);
    drop_trivial();
  }

  Analysis analysis() const {
    Analysis found{.heading = "Observed order"};
    found.answer.sentences = answer();
    found.sentences = sentences();
    found.method = {
        "Order: p in error ∝ step^p, a straight line fitted by least squares to the logarithms of the largest error of "
        "each run, with the 95 % confidence interval of Student’s t. The stretch begins at the smallest step at which "
        "the error is ten times what rounding may add, and grows towards larger steps while no point is further than "
        "10 "
        "% from the line; steps at which the motion is lost (an attitude off by 0.5 rad or more, or a run that did not "
        "end), and larger ones, are left out. As declared: within 0.25, with an interval of ±0.5 at most.",
        "A method that chooses its own steps has its error set against its tolerance (declared: 1, an error in "
        "proportion to the tolerance); there the whole ladder above rounding counts."};
    if (!orders_.empty()) found.tables.push_back({"orders", table()});
    found.files.push_back({"orders.csv", csv()});
    return found;
  }

 private:
  void add(const Curve& curve) {
    const auto& config = curve.runs.front()->config;
    const auto* entry = find_integrator(config.integrator);
    const auto scenario = std::find_if(study_.scenarios.begin(), study_.scenarios.end(),
                                       [&](const auto& s) { return s.name == config.scenario; });
    // Runs without the gyroscopic term solve another equation: their distance from the exact motion has no order.
    if (entry == nullptr || scenario == study_.scenarios.end() || !config.formulation.gyroscopic) return;
    for (const Of of : {Of::attitude, Of::position, Of::velocity, Of::reactions}) {
      const Quantity quantity = quantity_of(of);
      const bool measured = std::any_of(curve.runs.begin(), curve.runs.end(),
                                        [&](const auto* run) { return quantity.of(run->result).has_value(); });
      if (!measured) continue;
      orders_.push_back(order_of(curve, of, quantity, declared(curve, *entry, *scenario, of)));
    }
  }

  static std::optional<double> declared(const Curve& curve, const IntegratorEntry& entry, const Scenario& scenario,
                                        Of of) {
    if (curve.adaptive) return 1;
    if (of == Of::reactions) return declared_reaction_order(entry.declaration, scenario);
    return declared_order(entry.declaration, scenario, of == Of::attitude);
  }

  /// Removes the position errors of motions that every method computes exactly, such as those of a body at rest.
  void drop_trivial() {
    std::set<std::pair<std::size_t, std::string>> seen;
    for (const Order& o : orders_) {
      if (!o.estimate.exact) seen.emplace(o.curve->case_index, o.quantity.column);
    }
    std::erase_if(orders_, [&](const Order& o) {
      return o.of != Of::attitude && !seen.contains({o.curve->case_index, o.quantity.column});
    });
  }

  const std::string& method(const Order& o) const { return grouping_.methods[o.curve->method_index]; }

  /// "rk4 (matrix) on hairer_vilmart", with ", position" for the position error, and so on.
  std::string label(const Order& o) const {
    std::string text = grouping_.label(*o.curve);
    if (grouping_.cases.size() > 1) text += " on " + grouping_.cases[o.curve->case_index].label();
    if (o.of != Of::attitude) text += ", " + word_of(o.of);
    return text;
  }

  static std::string observed(const Order& o) {
    if (o.estimate.exact) return "round-off";
    if (!o.estimate.line) {
      return fmt::format("{} left: {}", count(o.estimate.points, "point"),
                         why_not_told(*o.curve, o.quantity, o.estimate));
    }
    return fmt::format("{:.2f} ± {:.2f} over {}", o.estimate.line->order, o.estimate.line->half_width_95,
                       count(o.estimate.points, "point"));
  }

  static std::string against(const Order& o) { return o.curve->adaptive ? "tolerance" : "step"; }
  static std::string declared(const Order& o) { return o.declared ? number(*o.declared) : "exact"; }

  std::string listed(OrderVerdict verdict, bool against_step) const {
    std::vector<std::string> items;
    for (const Order& o : orders_) {
      if (o.verdict != verdict || o.curve->adaptive == against_step) continue;
      items.push_back(fmt::format("{} ({}{})", label(o), observed(o), against_step ? ", declared " + declared(o) : ""));
    }
    return words(first_items(std::move(items), most_items));
  }

  /// "At round-off at every step or tolerance on peters_hsu, position: rk4 and heun."
  std::vector<std::string> exact_here() const {
    std::map<std::string, std::vector<std::string>> places;
    for (const Order& o : orders_) {
      if (o.verdict != OrderVerdict::exact_here) continue;
      std::string place = grouping_.cases[o.curve->case_index].label();
      if (o.of != Of::attitude) place += ", " + word_of(o.of);
      places[place].push_back(grouping_.label(*o.curve));
    }
    std::vector<std::string> all;
    for (auto& [place, labels] : places) {
      all.push_back(fmt::format("At round-off at every step or tolerance on {}: {}.", place,
                                words(first_items(std::move(labels), most_items))));
    }
    return all;
  }

  /// Methods whose orders all agree with the declared ones or are exact; and the number of all fixed-step or all
  /// adaptive methods.
  std::pair<std::vector<std::string>, std::size_t> as_declared(bool against_step) const {
    std::set<std::string> all, good, bad;
    for (const Order& o : orders_) {
      if (o.curve->adaptive == against_step) continue;
      all.insert(method(o));
      if (o.verdict == OrderVerdict::as_declared || o.verdict == OrderVerdict::exact_here) good.insert(method(o));
      if (o.verdict == OrderVerdict::higher || o.verdict == OrderVerdict::lower) bad.insert(method(o));
    }
    std::vector<std::string> names;
    for (const auto& name : grouping_.methods) {
      if (good.contains(name) && !bad.contains(name)) names.push_back(name);
    }
    return {names, all.size()};
  }

  std::vector<std::string> answer() const {
    std::vector<std::string> all;
    if (const auto [names, n] = as_declared(true); n > 0) {
      all.push_back(fmt::format("{} of {} with a declared order {} at it wherever an order is seen.", names.size(),
                                count(n, "method"), names.size() == 1 ? "converges" : "converge"));
      const std::string higher = listed(OrderVerdict::higher, true), lower = listed(OrderVerdict::lower, true);
      if (!lower.empty()) all.push_back("Lower than declared: " + lower + ".");
      else if (!higher.empty()) all.push_back("Higher than declared: " + higher + ".");
    }
    if (const auto [names, n] = as_declared(false); n > 0)
      all.push_back(fmt::format("{} of {} with a tolerance {} the error in proportion to it.", names.size(),
                                count(n, "method"), names.size() == 1 ? "keeps" : "keep"));
    return all;
  }

  std::vector<std::string> sentences() const {
    std::vector<std::string> all;
    if (const auto [names, n] = as_declared(true); n > 0) {
      all.push_back(fmt::format("{} of {} with a declared order {} as declared wherever an order is seen{}{}.",
                                names.size(), count(n, "method"), names.size() == 1 ? "is" : "are",
                                names.empty() ? "" : ": ", words(names)));
      for (const auto& [verdict, start] :
           {std::pair(OrderVerdict::higher, "Higher than declared: "),
            std::pair(OrderVerdict::lower, "Lower than declared: "),
            std::pair(OrderVerdict::too_few, "Not seen, for want of points: "),
            std::pair(OrderVerdict::scattered, "Not seen, for the points scatter about a line: ")}) {
        if (const auto items = listed(verdict, true); !items.empty()) all.push_back(start + items + ".");
      }
    }
    if (const auto [names, n] = as_declared(false); n > 0) {
      all.push_back(fmt::format(
          "{} of {} with a tolerance {} the error in proportion to it (slope 1 to within 0.25){}{}.", names.size(),
          count(n, "method"), names.size() == 1 ? "keeps" : "keep", names.empty() ? "" : ": ", words(names)));
      for (const auto& [verdict, start] :
           {std::pair(OrderVerdict::higher, "The error falls faster than the tolerance: "),
            std::pair(OrderVerdict::lower, "The error falls more slowly than the tolerance: "),
            std::pair(OrderVerdict::too_few, "Against the tolerance no slope is seen, for want of points: "),
            std::pair(OrderVerdict::scattered, "Against the tolerance no slope is seen, for the points scatter: ")}) {
        if (const auto items = listed(verdict, false); !items.empty()) all.push_back(start + items + ".");
      }
    }
    for (auto& text : exact_here()) all.push_back(std::move(text));
    for (auto& text : left_out()) all.push_back(std::move(text));
    return all;
  }

  std::vector<std::string> left_out() const {
    std::vector<std::string> all;
    std::set<std::string> with;
    for (const Order& o : orders_) with.insert(o.curve->runs.front()->config.scenario);
    std::vector<std::string> without;
    bool other_equation = false;
    for (const auto& scenario : study_.scenarios) {
      if (!with.contains(scenario.name)) without.push_back(scenario.name);
    }
    for (const auto& run : study_.runs) other_equation = other_equation || !run.config.formulation.gyroscopic;
    if (other_equation) {
      all.emplace_back(
          "Runs without the gyroscopic term solve another equation: their distance from the exact motion has no "
          "order.");
    }
    if (!without.empty()) {
      all.push_back(fmt::format(
          "No error was measured on {}, so no order: no exact solution is known, or no run ended.", words(without)));
    }
    return all;
  }

  static std::string range(const Order& o) {
    if (o.estimate.points == 0) return "";
    return fmt::format("{} … {}", number(o.estimate.largest), number(o.estimate.smallest));
  }

  static std::string dropped(const OrderEstimate& e) {
    std::vector<std::string> parts;
    if (e.blown_up > 0) parts.push_back(fmt::format("{} lost", e.blown_up));
    if (e.not_straight > 0) parts.push_back(fmt::format("{} not straight", e.not_straight));
    if (e.at_round_off > 0) parts.push_back(fmt::format("{} round-off", e.at_round_off));
    return fmt::format("{}", fmt::join(parts, ", "));
  }

  Table table() const {
    using Kind = Column::Kind;
    Table table{.caption = "Observed and declared order; ±: 95 % confidence; left out: points that are no part of it",
                .columns = {{"method", "", Kind::name},
                            {"motion", "", Kind::text},
                            {"formulation", "", Kind::text},
                            {"error of", "", Kind::text},
                            {"against", "", Kind::text},
                            {"declared"},
                            {"observed"},
                            {"±"},
                            {"verdict", "", Kind::text},
                            {"points"},
                            {"from … to", "", Kind::text},
                            {"left out", "", Kind::text}},
                .rows = {}};
    const bool others = std::any_of(orders_.begin(), orders_.end(), [](const auto& o) { return o.of != Of::attitude; });
    const bool adaptive = std::any_of(orders_.begin(), orders_.end(), [](const auto& o) { return o.curve->adaptive; });
    for (const Order& o : orders_) {
      const auto& line = o.estimate.line;
      table.rows.push_back({method(o), grouping_.cases.size() > 1 ? grouping_.cases[o.curve->case_index].label() : "",
                            grouping_.variants[o.curve->variant_index], others ? word_of(o.of) : "",
                            adaptive ? against(o) : "", declared(o),
                            line               ? fmt::format("{:.2f}", line->order)
                            : o.estimate.exact ? "exact"
                                               : "",
                            line ? fmt::format("{:.2f}", line->half_width_95) : "", word_of(o.verdict),
                            std::to_string(o.estimate.points), range(o), dropped(o.estimate)});
    }
    return without_empty_columns(std::move(table));
  }

  std::string csv() const {
    auto header = config_columns(study_.varied_keys, study_.named, {RunOption::Role::size});
    for (const char* c :
         {"error_of", "against", "declared_order", "observed_order", "standard_error", "confidence_95_low",
          "confidence_95_high", "points", "step_smallest_s", "step_largest_s", "tolerance_smallest",
          "tolerance_largest", "left_out_lost", "left_out_round_off", "left_out_not_straight", "verdict"}) {
      header.emplace_back(c);
    }
    std::string text = csv_row(header);
    for (const Order& o : orders_) {
      auto row = config_cells(o.curve->runs.front()->config, study_.named, {RunOption::Role::size});
      const auto& e = o.estimate;
      const auto of_line = [&](auto number) { return e.line ? exact(number(*e.line)) : std::string(); };
      const bool step = !o.curve->adaptive, any = e.points > 0;
      for (auto& cell : std::vector<std::string>{
               o.quantity.column, against(o), declared(o), of_line([](const auto& l) { return l.order; }),
               of_line([](const auto& l) { return l.standard_error; }),
               of_line([](const auto& l) { return l.order - l.half_width_95; }),
               of_line([](const auto& l) { return l.order + l.half_width_95; }), std::to_string(e.points),
               any && step ? exact(e.smallest) : "", any && step ? exact(e.largest) : "",
               any && !step ? exact(e.smallest) : "", any && !step ? exact(e.largest) : "", std::to_string(e.blown_up),
               std::to_string(e.at_round_off), std::to_string(e.not_straight), word_of(o.verdict)}) {
        row.push_back(std::move(cell));
      }
      text += csv_row(row);
    }
    return text;
  }

  const StudyView& study_;
  Grouping grouping_;
  std::vector<Order> orders_;
};

}  // namespace

Analysis observed_orders(const StudyView& study) { return Orders(study).analysis(); }

}  // namespace polhode::study::convergence
