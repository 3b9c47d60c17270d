// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/results/best.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <utility>
#include <variant>

#include "experiments/results/groups.hpp"
#include "experiments/results/listing.hpp"
#include "experiments/results/output.hpp"
#include "experiments/study/query/run_columns.hpp"
#include "experiments/study/query/selection.hpp"
#include "experiments/study/record/run_id.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/value_lists.hpp"

namespace polhode::study::results {
namespace {

using Role = RunOption::Role;

/// Metrics that measure an error, the first of which that some run has is the default; those that measure a cost.
constexpr const char* errors[] = {"attitude_error_max_rad", "position_error_max_m", "angular_velocity_error_max_rel",
                                  "energy_drift_max_rel"};
constexpr const char* costs[] = {"rhs_evaluations", "wall_s"};

/// "COLUMN=X" of --at-most.
struct Bound {
  RunColumn column;
  double most = 0;
};

std::optional<Bound> bound_of(const std::string& text, const RunColumns& columns) {
  if (text.empty()) return std::nullopt;
  const std::size_t equals = text.find('=');
  const auto most = equals == std::string::npos ? std::nullopt : to_number(text.substr(equals + 1));
  if (!most) throw InputError("--at-most " + text + ": it takes a column and a number, as evaluations=1e5");
  return Bound{columns.find(text.substr(0, equals), "--at-most"), *most};
}

bool is_cost(const RunColumn& column) {
  return std::any_of(std::begin(costs), std::end(costs), [&](const char* name) { return column.name == name; }) ||
         column.name == "steps";
}

/// A run that is ok, with its values.
struct Point {
  std::vector<OptionValue> group;   ///< motion: scenario, varied keys, duration, what --group adds
  std::vector<OptionValue> method;  ///< method and formulation
  std::vector<OptionValue> sizes;   ///< step, tolerance
  std::string run;
  std::vector<std::optional<double>> values;  ///< values in the columns of asked()
};

std::optional<double> number_of(const OptionValue& value) {
  if (const auto* n = std::get_if<std::int64_t>(&value)) return static_cast<double>(*n);
  const auto* x = std::get_if<double>(&value);
  return x && std::isfinite(*x) ? std::optional(*x) : std::nullopt;
}

/// The columns of --by and --at-most and those that may stand in for them.
class Question {
 public:
  Question(const ResultsOptions& options, const RunColumns& columns) : bound_(bound_of(options.at_most, columns)) {
    if (!options.by.empty()) by_ = columns.find(options.by, "--by");
    for (const char* name : errors) asked_.push_back(columns.find(name, "--by"));
    for (const char* name : costs) asked_.push_back(columns.find(name, "--by"));
    if (by_) asked_.push_back(*by_);
    if (bound_) asked_.push_back(bound_->column);
    for (const RunColumn& column : asked_) {
      if (!column.in_store() && column.of != RunColumn::Of::option && column.of != RunColumn::Of::scenario)
        throw InputError("--by " + column.name + ": it is no number");
    }
  }

  const std::vector<RunColumn>& asked() const { return asked_; }

  /// Chooses the columns by what the runs have: indices in asked().
  void settle(const std::vector<Point>& points) {
    const auto first_of = [&](auto names) -> std::size_t {
      for (const char* name : names) {
        const std::size_t k = index(name);
        const auto has = [&](const Point& p) { return p.values[k] && (!is_cost(asked_[k]) || *p.values[k] > 0); };
        if (std::any_of(points.begin(), points.end(), has)) return k;
      }
      return index(*std::begin(names));
    };
    const std::size_t error = first_of(std::to_array(errors)), cost = first_of(std::to_array(costs));
    if (bound_) {
      other = index(bound_->column.name);
      by = by_ ? index(by_->name) : is_cost(bound_->column) ? error : cost;
    } else {
      by = by_ ? index(by_->name) : error;
      other = is_cost(asked_[by]) ? error : cost;
    }
    if (by == other) {
      throw InputError("--by and --at-most are both " + asked_[by].name +
                       "; bound a cost and ask for an error, or the other way round");
    }
  }

  const std::optional<Bound>& bound() const { return bound_; }
  std::size_t by = 0, other = 0;

 private:
  std::size_t index(const std::string& name) const {
    const auto at = std::find_if(asked_.begin(), asked_.end(), [&](const RunColumn& c) { return c.name == name; });
    return static_cast<std::size_t>(at - asked_.begin());
  }

  std::optional<RunColumn> by_;
  std::optional<Bound> bound_;
  std::vector<RunColumn> asked_;
};

std::vector<RunColumn> columns_of(const RunColumns& columns, std::initializer_list<Role> roles) {
  std::vector<RunColumn> found;
  for (const RunColumn& column : columns.options()) {
    const RunOption* option = option_of_column(column.name);
    if (option && std::find(roles.begin(), roles.end(), option->role) != roles.end()) found.push_back(column);
  }
  return found;
}

/// True for each column in which rows differ, and for those that are always shown.
std::vector<bool> differing(const std::vector<Point>& points, std::vector<OptionValue> Point::*row,
                            const std::vector<RunColumn>& columns) {
  std::vector<bool> differs(columns.size());
  for (std::size_t k = 0; k < columns.size(); ++k) {
    differs[k] = columns[k].name == "scenario" || columns[k].name == "integrator" ||
                 std::any_of(points.begin(), points.end(),
                             [&](const Point& p) { return compare((p.*row)[k], (points.front().*row)[k]) != 0; });
  }
  return differs;
}

/// Columns of the answer.
struct Headings {
  std::vector<RunColumn> group, method, sizes;
};

std::vector<Point> read_points(const ResultStores& stores, const SelectedRuns& selection, const Headings& headings,
                               const std::vector<RunColumn>& asked, std::size_t status, const ScenarioNames& scenarios,
                               Damage& damage) {
  std::vector<Point> points;
  CellReader cells(scenarios);
  damage = RunReader(stores).read(selection, [&](const CheckedRow& row) {
    const auto* said = std::get_if<std::string_view>(&row.values[status]);
    if (!said || *said != "ok") return true;
    const auto value = [&](const RunColumn& column) {
      return cells.value(column, row.place, column.in_store() ? row.values[column.index] : Value());
    };
    Point& point = points.emplace_back();
    for (const RunColumn& column : headings.group) point.group.push_back(value(column));
    for (const RunColumn& column : headings.method) point.method.push_back(value(column));
    for (const RunColumn& column : headings.sizes) point.sizes.push_back(value(column));
    for (const RunColumn& column : asked) point.values.push_back(number_of(value(column)));
    point.run = id_of_number(static_cast<std::uint64_t>(row.place.id));
    return true;
  });
  return points;
}

}  // namespace

std::vector<std::size_t> pareto_front(const std::vector<WorkPoint>& points) {
  std::vector<std::size_t> order(points.size()), front;
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return points[a].cost != points[b].cost ? points[a].cost < points[b].cost : points[a].error < points[b].error;
  });
  for (const std::size_t k : order) {
    if (front.empty() || points[k].error < points[front.back()].error) front.push_back(k);
  }
  return front;
}

int list_best(const ResultStores& stores, const ResultsOptions& options) {
  const RunColumns columns(stores);
  Question question(options, columns);
  const SelectedRuns selection = select(stores, columns, conditions_of(options), {});
  Headings headings;
  headings.group = columns_of(columns, {Role::scenario});
  for (const std::string& key : selection.varied_keys)
    headings.group.push_back({.of = RunColumn::Of::scenario, .name = key, .key = key});
  const auto durations = columns_of(columns, {Role::duration});
  headings.group.insert(headings.group.end(), durations.begin(), durations.end());
  for (const std::string& name : options.group) headings.group.push_back(columns.find(name, "--group"));
  headings.method = columns_of(columns, {Role::method, Role::variant});
  headings.sizes = columns_of(columns, {Role::size});

  Damage damage;
  const ScenarioNames scenarios(stores);
  const std::vector<Point> points =
      read_points(stores, selection, headings, question.asked(), columns.index("status"), scenarios, damage);
  question.settle(points);
  const std::size_t by = question.by, other = question.other;
  const auto show_group = differing(points, &Point::group, headings.group);
  const auto show_method = differing(points, &Point::method, headings.method);
  std::vector<std::string> names;
  const auto add_names = [&](const std::vector<RunColumn>& of, const std::vector<bool>& shown) {
    for (std::size_t k = 0; k < of.size(); ++k) {
      if (shown[k]) names.push_back(of[k].name);
    }
  };
  add_names(headings.group, show_group);
  if (question.bound()) names.emplace_back("place");
  add_names(headings.method, show_method);
  names.push_back(question.asked()[by].name);
  names.push_back(question.asked()[other].name);
  if (!question.bound()) names.emplace_back("best of all");
  add_names(headings.sizes, std::vector<bool>(headings.sizes.size(), true));
  names.emplace_back("run");

  // Runs by group and method, in their order, without those that lack one of the two values.
  std::map<std::vector<OptionValue>, std::map<std::vector<OptionValue>, std::vector<const Point*>, RowLess>, RowLess>
      groups;
  for (const Point& point : points) {
    if (point.values[by] && point.values[other]) groups[point.group][point.method].push_back(&point);
  }
  Output output(options.format.value_or(Format::table), options.out, names);
  const auto add = [&](const Point& point, std::optional<std::int64_t> place, std::optional<std::string> of_all) {
    std::vector<OptionValue> row;
    const auto add_values = [&](const std::vector<OptionValue>& values, const std::vector<bool>& shown) {
      for (std::size_t k = 0; k < values.size(); ++k) {
        if (shown[k]) row.push_back(values[k]);
      }
    };
    add_values(point.group, show_group);
    if (place) row.emplace_back(*place);
    add_values(point.method, show_method);
    row.emplace_back(*point.values[by]);
    row.emplace_back(*point.values[other]);
    if (of_all) row.emplace_back(*of_all);
    add_values(point.sizes, std::vector<bool>(point.sizes.size(), true));
    row.emplace_back(point.run);
    output.add(row);
  };
  for (const auto& [group, methods] : groups) {
    if (question.bound()) {
      std::vector<const Point*> best;  // best run of each method that has a run within the bound
      for (const auto& [method, runs] : methods) {
        const Point* least = nullptr;
        for (const Point* run : runs) {
          if (*run->values[other] > question.bound()->most) continue;
          const auto key = [&](const Point* p) { return std::pair(*p->values[by], *p->values[other]); };
          if (!least || key(run) < key(least)) least = run;
        }
        if (least) best.push_back(least);
      }
      std::stable_sort(best.begin(), best.end(),
                       [&](const Point* a, const Point* b) { return *a->values[by] < *b->values[by]; });
      const std::size_t most = std::min(best.size(), options.limit.value_or(best.size()));
      for (std::size_t k = 0; k < most; ++k) add(*best[k], static_cast<std::int64_t>(k) + 1, {});
      continue;
    }
    const std::size_t cost = is_cost(question.asked()[by]) ? by : other, error = cost == by ? other : by;
    const auto front_of = [&](const std::vector<const Point*>& runs) {
      std::vector<WorkPoint> all;
      for (const Point* run : runs) all.push_back({*run->values[cost], *run->values[error]});
      std::vector<const Point*> front;
      for (const std::size_t k : pareto_front(all)) front.push_back(runs[k]);
      return front;
    };
    std::vector<const Point*> everything;
    for (const auto& [method, runs] : methods) everything.insert(everything.end(), runs.begin(), runs.end());
    const std::vector<const Point*> all = front_of(everything);
    const std::set<const Point*> of_all(all.begin(), all.end());
    for (const auto& [method, runs] : methods) {
      for (const Point* run : front_of(runs)) add(*run, {}, of_all.contains(run) ? "yes" : "");
    }
  }
  output.finish();
  if (groups.empty()) {
    fmt::print(stderr, "results: no run that is ok has both {} and {}; choose others with --by and --at-most\n",
               question.asked()[by].name, question.asked()[other].name);
  }
  return say_damage(damage);
}

}  // namespace polhode::study::results
