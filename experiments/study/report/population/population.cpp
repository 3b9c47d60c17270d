// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report/population/population.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <utility>

#include "experiments/study/plot/axis.hpp"
#include "experiments/study/plot/figure_layout.hpp"
#include "experiments/study/plot/plain_panel.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/text/csv.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::inline report::inline population {
namespace {

constexpr std::size_t most_axes = 4;
constexpr std::size_t most_methods_drawn = 8;
constexpr double logarithmic_from = 30;  // ratio of the ends of a range
constexpr std::array<double, 7> shares_in_file = {0.01, 0.05, 0.25, 0.5, 0.75, 0.95, 0.99};

std::optional<double> number_in(const std::string& cell) {
  double x = 0;
  const auto read = std::from_chars(cell.data(), cell.data() + cell.size(), x);
  if (cell.empty() || read.ec != std::errc() || read.ptr != cell.data() + cell.size()) return std::nullopt;
  return x;
}

std::optional<double> value_of(const Metric& metric, const RunResult& result) {
  std::optional<double> value;
  with_value(metric, result, [&](const auto& found) {
    if constexpr (std::is_same_v<std::decay_t<decltype(found)>, std::optional<double>>) value = found;
  });
  return value && std::isfinite(*value) ? value : std::nullopt;
}

bool is_number(const Metric& metric) {
  return std::holds_alternative<std::optional<double> RunResult::*>(metric.member) ||
         std::holds_alternative<std::optional<double> ContactMeasures::*>(metric.member);
}

std::string named(const Metric& metric) {
  return metric.unit.empty() ? metric.label : fmt::format("{} ({})", metric.label, metric.unit);
}

/// Ten shades for decades, from light to dark; those of a colour map that colour-blind readers can order (viridis).
constexpr std::array<const char*, 10> ramp = {"FDE725", "B5DE2B", "6ECE58", "35B779", "1F9E89",
                                              "26828E", "31688E", "3E4989", "482878", "440154"};

}  // namespace

std::size_t Population::NumericAxis::bin(double value) const {
  const double place =
      logarithmic ? std::log(std::max(value, low) / low) / std::log(high / low) : (value - low) / (high - low);
  const double number = std::floor(place * static_cast<double>(bins));
  return static_cast<std::size_t>(std::clamp(number, 0.0, static_cast<double>(bins - 1)));
}

double Population::NumericAxis::edge(std::size_t number) const {
  const double share = static_cast<double>(number) / static_cast<double>(bins);
  return logarithmic ? low * std::pow(high / low, share) : low + share * (high - low);
}

double Population::NumericAxis::middle(std::size_t number) const {
  return logarithmic ? std::sqrt(edge(number) * edge(number + 1)) : (edge(number) + edge(number + 1)) / 2;
}

Population::Population(const StudyView& sample) {
  for (const Metric* metric : in_table_order(sample.metrics)) {
    if (!is_number(*metric) || !(metric->in_summary || !metric->terminal_label.empty())) continue;
    metrics_.push_back(metric);
    if (!metric->terminal_label.empty()) drawn_.push_back(metric);
  }
  find_axes(sample);
}

/// The columns of the configuration with the most different numbers.
void Population::find_axes(const StudyView& sample) {
  const std::vector<std::string> names = config_columns(sample.varied_keys, sample.named);
  std::vector<std::set<double>> numbers(names.size());
  for (const RunRecord& run : sample.runs) {
    const std::vector<std::string> cells = config_cells(run.config, sample.named);
    for (std::size_t k = 0; k < names.size(); ++k) {
      if (const auto x = number_in(cells[k])) numbers[k].insert(*x);
    }
  }
  std::vector<std::pair<std::size_t, NumericAxis>> found;
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (numbers[k].size() < 3) continue;
    NumericAxis axis{k, names[k], false, *numbers[k].begin(), *numbers[k].rbegin()};
    axis.logarithmic = axis.low > 0 && axis.high > logarithmic_from * axis.low;
    found.emplace_back(numbers[k].size(), axis);
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  for (std::size_t k = 0; k < std::min(found.size(), most_axes); ++k) axes_.push_back(found[k].second);
}

void Population::add(const RunRecord& run, const std::vector<std::string>& cells) {
  ++runs_;
  cheapest_.add(run);
  Outcome& outcome = outcomes_[run.result.status];
  if (++outcome.runs == 1) outcome.message = run.result.message;
  const auto method =
      static_cast<std::size_t>(std::find(methods_.begin(), methods_.end(), run.config.integrator) - methods_.begin());
  if (method == methods_.size()) {
    methods_.push_back(run.config.integrator);
    found_.emplace_back(metrics_.size());
  }
  std::vector<std::optional<std::size_t>> places;  // bins on the axes
  for (const NumericAxis& axis : axes_) {
    const auto x = number_in(cells[axis.column]);
    places.push_back(x ? std::optional(axis.bin(*x)) : std::nullopt);
  }
  for (std::size_t k = 0; k < metrics_.size(); ++k) {
    const auto value = value_of(*metrics_[k], run.result);
    if (!value) continue;
    Distribution& d = found_[method][k];
    if (d.all.count() == 0 || *value > d.all.largest()) d.largest_in = run.id;
    d.all.add(*value);
    const bool drawn = std::find(drawn_.begin(), drawn_.end(), metrics_[k]) != drawn_.end();
    if (!drawn || method >= most_methods_drawn) continue;
    d.along.resize(axes_.size());
    for (std::size_t a = 0; a < axes_.size(); ++a) {
      if (places[a]) d.along[a][*places[a]].add(*value);
    }
    if (metrics_[k] != drawn_.front() || axes_.size() < 2 || !places[0] || !places[1]) continue;
    d.map.resize(bins * bins);
    d.map[*places[0] * bins + *places[1]].add(*value);
  }
}

const Population::Distribution* Population::find(std::size_t method, const Metric& metric) const {
  const auto k = static_cast<std::size_t>(std::find(metrics_.begin(), metrics_.end(), &metric) - metrics_.begin());
  const Distribution& d = found_[method][k];
  return d.all.count() > 0 ? &d : nullptr;
}

bool Population::has_values(const Metric& metric) const {
  for (std::size_t m = 0; m < methods_.size(); ++m) {
    if (find(m, metric)) return true;
  }
  return false;
}

Table Population::table() const {
  using Kind = Column::Kind;
  Table table{.caption = "Distributions over all runs: quantiles are within 1 % of a value of their rank",
              .columns = {{"metric", "", Kind::text},
                          {"method", "", Kind::name},
                          {"runs"},
                          {"least"},
                          {"5 %"},
                          {"median"},
                          {"95 %"},
                          {"largest"},
                          {"largest in run", "", Kind::text}},
              .rows = {}};
  for (const Metric* metric : metrics_) {
    for (std::size_t m = 0; m < methods_.size(); ++m) {
      const Distribution* d = find(m, *metric);
      if (!d) continue;
      table.rows.push_back({named(*metric), methods_[m], std::to_string(d->all.count()), number(d->all.least()),
                            number(*d->all.quantile(0.05)), number(*d->all.quantile(0.5)),
                            number(*d->all.quantile(0.95)), number(d->all.largest()), d->largest_in});
    }
  }
  return table;
}

std::string Population::csv() const {
  std::vector<std::string> header = {"metric", "integrator", "runs", "least"};
  for (const double share : shares_in_file) header.push_back(fmt::format("quantile_{:g}", share));
  header.insert(header.end(), {"largest", "largest_in_run"});
  std::string text = csv_row(header);
  for (const Metric* metric : metrics_) {
    for (std::size_t m = 0; m < methods_.size(); ++m) {
      const Distribution* d = find(m, *metric);
      if (!d) continue;
      std::vector<std::string> row = {metric->column, methods_[m], std::to_string(d->all.count()),
                                      exact(d->all.least())};
      for (const double share : shares_in_file) row.push_back(exact(*d->all.quantile(share)));
      row.insert(row.end(), {exact(d->all.largest()), d->largest_in});
      text += csv_row(row);
    }
  }
  return text;
}

Figure Population::distributions() const {
  constexpr int points = 40;
  std::vector<Panel> panels;
  for (const Metric* metric : drawn_) {
    std::vector<PlainCurve> curves;
    for (std::size_t m = 0; m < std::min(methods_.size(), most_methods_drawn); ++m) {
      const Distribution* d = find(m, *metric);
      if (!d) continue;
      PlainCurve curve{methods_[m], m, 0};
      for (int k = 0; k <= points; ++k) {
        const double share = k / double(points), value = *d->all.quantile(share);
        if (value > 0) curve.points.emplace_back(value, share);  // zeros lie to the left of every value
      }
      curves.push_back(std::move(curve));
    }
    panels.push_back(
        plain_panel("", {metric->column, named(*metric)}, {"share_of_runs", "share of runs", Scale::linear}, curves));
  }
  return plain_figure(
      "distributions", "Distributions over all runs",
      "The share of the runs of a method whose value is at most the one on the axis. A curve that begins "
      "above 0 has runs whose value is exactly zero.",
      methods_, {""}, std::move(panels));
}

Figure Population::envelopes() const {
  std::vector<Panel> panels;
  const bool ends = methods_.size() <= 3;
  for (std::size_t a = 0; a < axes_.size() && !drawn_.empty(); ++a) {
    const Metric& metric = *drawn_.front();
    const NumericAxis& axis = axes_[a];
    if (!(axis.low > 0)) continue;
    std::vector<PlainCurve> curves;
    for (std::size_t m = 0; m < std::min(methods_.size(), most_methods_drawn); ++m) {
      const Distribution* d = find(m, metric);
      if (!d || d->along.empty()) continue;
      for (const auto& [share, variant] : {std::pair(0.5, 0U), std::pair(0.05, 1U), std::pair(0.95, 1U)}) {
        if (variant > 0 && !ends) continue;
        PlainCurve curve{variant == 0 ? methods_[m] : fmt::format("{}, {:g} %", methods_[m], 100 * share), m, variant};
        for (std::size_t b = 0; b < bins; ++b) {
          if (const auto value = d->along[a][b].quantile(share))
            curve.points.emplace_back(axis.middle(b), std::abs(*value));
        }
        curves.push_back(std::move(curve));
      }
    }
    panels.push_back(plain_panel("", {axis.name, axis.name, axis.logarithmic ? Scale::logarithmic : Scale::linear},
                                 {metric.column, named(metric)}, curves));
  }
  return plain_figure("envelopes", "Quantiles against the axes",
                      fmt::format("Each point stands for the runs in one of {} equal parts of the axis{}.", bins,
                                  ends ? "; the dashed curves enclose nine runs of ten" : ""),
                      methods_,
                      ends ? std::vector<std::string>{"median", "5 % and 95 %"} : std::vector<std::string>{"median"},
                      std::move(panels));
}

Figure Population::maps() const {
  Figure figure{.name = "maps", .title = {}, .caption = {}, .methods = methods_, .variants = {""}};
  if (axes_.size() < 2 || drawn_.empty()) return figure;
  const Metric& metric = *drawn_.front();
  std::vector<double> medians;
  for (std::size_t m = 0; m < methods_.size(); ++m) {
    const Distribution* d = find(m, metric);
    for (std::size_t k = 0; d && k < d->map.size(); ++k) {
      if (const auto median = d->map[k].quantile(0.5); median && *median > 0) medians.push_back(*median);
    }
  }
  if (medians.empty()) return figure;
  const auto [least, largest] = std::minmax_element(medians.begin(), medians.end());
  const double bottom = std::floor(std::log10(*least)), top = std::floor(std::log10(*largest));
  const double step = std::max(1.0, std::ceil((top - bottom + 1) / double(ramp.size())));
  for (double decade = bottom; decade <= top; decade += step) {
    const auto k = static_cast<std::size_t>((decade - bottom) / step);
    figure.shades.push_back({fmt::format("1e{:g} to 1e{:g}", decade, decade + step), ramp[k]});
  }
  figure.title = fmt::format("Map of the {}", metric.label);
  figure.caption =
      fmt::format("Median of the {} of the runs in each of {} by {} parts of the axes.", named(metric), bins, bins);
  std::vector<Panel> panels;
  for (std::size_t m = 0; m < std::min(methods_.size(), most_methods_drawn); ++m) {
    const Distribution* d = find(m, metric);
    if (!d || d->map.empty()) continue;
    const auto axis_of = [](const NumericAxis& axis) {
      Axis drawn =
          axis.logarithmic ? step_axis(axis.name, {axis.low, axis.high}) : linear_axis(axis.name, axis.low, axis.high);
      drawn.low = axis.low;
      drawn.high = axis.high;
      std::erase_if(drawn.ticks, [&](const Tick& tick) { return tick.at < axis.low || tick.at > axis.high; });
      return drawn;
    };
    Panel panel{.title = {methods_[m]}, .x = axis_of(axes_[0]), .y = axis_of(axes_[1])};
    panel.x_column = axes_[0].name;
    panel.y_column = axes_[1].name;
    for (std::size_t k = 0; k < d->map.size(); ++k) {
      const auto median = d->map[k].quantile(0.5);
      if (!median || !(*median > 0)) continue;
      const auto shade = static_cast<std::size_t>((std::floor(std::log10(*median)) - bottom) / step);
      panel.cells.push_back({axes_[0].edge(k / bins), axes_[0].edge(k / bins + 1), axes_[1].edge(k % bins),
                             axes_[1].edge(k % bins + 1), std::min(shade, figure.shades.size() - 1)});
    }
    panels.push_back(std::move(panel));
  }
  add_rows(figure, std::move(panels), 2);
  return figure;
}

Analysis Population::analysis() const {
  Analysis found{.alone = true, .answer = cheapest_.answer(), .heading = "Distributions over all runs"};
  found.tables.push_back({"distributions", table()});
  found.files.push_back({"distributions.csv", csv()});
  found.method = {
      "A study of more than 10 000 runs is described by distributions. Each run is counted; quantiles come from bins "
      "of "
      "2 % relative width (DDSketch), least and largest values are exact."};
  for (Figure figure : {distributions(), envelopes(), maps()}) {
    if (!figure.panels.empty()) found.figures.push_back(std::move(figure));
  }
  return found;
}

}  // namespace polhode::study::report::population
