// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/plot/run_figures.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "experiments/study/curves/curves.hpp"
#include "experiments/study/plot/axis.hpp"
#include "experiments/study/plot/figure_layout.hpp"
#include "experiments/study/plot/figure_style.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::plot_program {
namespace {

constexpr double panel_height = 150;  // pixels
constexpr std::size_t most_impacts_marked = 200;

/// A linear axis about the values, with a margin; not shorter than six digits resolve.
Axis axis_about(const std::string& label, double low, double high) {
  if (low == 0 && high == 0) return linear_axis(label, -1, 1);
  const double least = std::max(2e-5 * std::max(std::abs(low), std::abs(high)), 1e-12);
  if (high - low < least) low -= least / 2, high += least / 2;
  const double margin = 0.05 * (high - low);
  return linear_axis(label, low - margin, high + margin);
}

class RunFigureMaker {
 public:
  RunFigureMaker(const std::vector<Recording>& runs, const std::vector<const PlotQuantity*>& quantities,
                 const FigureLook& look)
      : runs_(runs), quantities_(quantities), look_(look) {
    std::set<std::string> scenarios;
    for (const Recording& run : runs) {
      scenarios.insert(run.config.scenario);
      t_end_ = std::max(t_end_, run.config.t_end);
    }
    view_.experiment = "plot";
    for (const Recording& run : runs)
      view_.runs.push_back({.id = {}, .config = run.config, .result = run.result, .scenario = {}});
    grouping_ = group(view_);
    for (const RunRecord& run : view_.runs) {
      for (const Curve& curve : grouping_.curves) {
        if (std::find(curve.runs.begin(), curve.runs.end(), &run) == curve.runs.end()) continue;
        std::string rest =
            scenarios.size() > 1 || grouping_.cases.size() > 1 ? grouping_.cases[curve.case_index].label() + ", " : "";
        if (const auto& variant = grouping_.variants[curve.variant_index]; !variant.empty()) rest += variant + ", ";
        rest += step_label(run);
        const auto known = std::find(rests_.begin(), rests_.end(), rest);
        places_.push_back({curve.method_index, static_cast<std::size_t>(known - rests_.begin())});
        if (known == rests_.end()) rests_.push_back(rest);
      }
    }
  }

  RunFigures figures() && {
    for (std::size_t q = 0; q < quantities_.size(); ++q) {
      const PlotQuantity& quantity = *quantities_[q];
      const bool known = std::any_of(runs_.begin(), runs_.end(), [&](const auto& run) { return run.tracks[q].known; });
      if (!known) {
        made_.absent.push_back(quantity.name + ": these motions do not have it, or it is not known for them");
        continue;
      }
      switch (quantity.drawn) {
        case Drawn::against_time: against_time(q); break;
        case Drawn::portrait: portraits(q); break;
        case Drawn::polhode: polhode(q); break;
        case Drawn::herpolhode: herpolhode(q); break;
        case Drawn::stacked: stacked(q); break;
        case Drawn::events: events(q); break;
      }
    }
    return std::move(made_);
  }

 private:
  std::string label(std::size_t run) const {
    return fmt::format("{}, {}", grouping_.methods[places_[run].first], rests_[places_[run].second]);
  }
  std::vector<std::string> variants() const { return rests_.size() > 1 ? rests_ : std::vector<std::string>{""}; }

  Figure begun(std::size_t q) const {
    const PlotQuantity& quantity = *quantities_[q];
    std::string caption = quantity.shows;
    if (!caption.empty()) caption[0] = static_cast<char>(std::toupper(caption[0]));
    caption += ".";
    if (rests_.size() == 1) caption += fmt::format(" {}.", rests_.front());
    for (std::size_t r = 0; r < runs_.size(); ++r) {
      const RunResult& result = runs_[r].result;
      if (result.status != "ok")
        caption += fmt::format(" {} {} at {} s: {}.", label(r), result.status, number(result.t_reached),
                               one_line(result.message));
    }
    std::string title = quantity.name;
    std::replace(title.begin(), title.end(), '_', ' ');
    title[0] = static_cast<char>(std::toupper(title[0]));
    return {.name = quantity.name,
            .title = title,
            .caption = caption,
            .methods = grouping_.methods,
            .variants = variants(),
            .look = look_};
  }

  PlottedCurve curve_of(std::size_t run) const {
    return {.label = label(run),
            .method = places_[run].first,
            .variant = places_[run].second,
            .points = {},
            .muted = false};
  }

  void against_time(std::size_t q) {
    const PlotQuantity& quantity = *quantities_[q];
    Figure figure = begun(q);
    std::vector<Panel> panels;
    for (std::size_t c = 0; c < quantity.components.size(); ++c) {
      Panel panel{.x = time_axis(t_end_), .x_column = "t_s", .y_column = quantity.components[c].column};
      std::vector<double> positive;
      double low = std::numeric_limits<double>::infinity(), high = -low, quietest = low;
      for (std::size_t r = 0; r < runs_.size(); ++r) {
        if (!runs_[r].tracks[q].known) continue;
        PlottedCurve curve = curve_of(r);
        double largest = 0;
        for (const SeriesValue& p : runs_[r].tracks[q].series[c]) {
          if (!std::isfinite(p.y)) continue;
          const bool zero = quantity.scale == Scale::logarithmic && p.y == 0;
          curve.points.push_back({p.t, p.y, p.y, zero ? Mark::zero : Mark::value});
          low = std::min(low, p.y), high = std::max(high, p.y), largest = std::max(largest, std::abs(p.y));
          if (p.y > 0) positive.push_back(p.y);
        }
        if (largest > 0) quietest = std::min(quietest, largest);
        if (!curve.points.empty()) panel.curves.push_back(std::move(curve));
      }
      if (panel.curves.empty()) continue;
      std::vector<Panel> one = {std::move(panel)};
      const std::string& label = quantity.components[c].label;
      share_y_axis(one, quantity.scale == Scale::symlog
                            ? symlog_axis(label, low, high, std::isfinite(quietest) ? quietest : 0)
                        : quantity.scale == Scale::logarithmic ? log_axis(label, positive, needs_of(one))
                                                               : axis_about(label, low, high));
      panels.push_back(std::move(one.front()));
    }
    add_rows(figure, std::move(panels), 1);
    if (figure.panels.size() > 1) figure.panel_height = panel_height;
    note_marks(figure);
    figure.caption += marks_caption(figure);
    made_.figures.push_back(std::move(figure));
  }

  void portraits(std::size_t q) {
    const PlotQuantity& quantity = *quantities_[q];
    Figure figure = begun(q);
    std::vector<Panel> panels;
    for (const auto& [i, j] : {std::pair<std::size_t, std::size_t>{0, 1}, {1, 2}, {2, 0}}) {
      Panel panel{.x_column = quantity.components[i].column, .y_column = quantity.components[j].column};
      double low[2] = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()},
             high[2] = {-low[0], -low[1]};
      for (std::size_t r = 0; r < runs_.size(); ++r) {
        PlottedCurve curve = curve_of(r);
        for (const auto& row : runs_[r].tracks[q].rows) {
          curve.points.push_back({row[i], row[j], row[j], Mark::value});
          for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
            low[k] = std::min(low[k], row[k == 0 ? i : j]);
            high[k] = std::max(high[k], row[k == 0 ? i : j]);
          }
        }
        panel.curves.push_back(std::move(curve));
      }
      panel.x = axis_about(quantity.components[i].label, low[0], high[0]);
      panel.y = axis_about(quantity.components[j].label, low[1], high[1]);
      panels.push_back(std::move(panel));
    }
    add_rows(figure, std::move(panels), 2);
    for (Panel& panel : figure.panels) panel.y.labelled = true;  // each has its own axis
    note_marks(figure);
    made_.figures.push_back(std::move(figure));
  }

  SpaceFigure begun_in_space(std::size_t q) const {
    const Figure like = begun(q);
    return {.name = like.name,
            .title = like.title,
            .caption = like.caption,
            .methods = like.methods,
            .variants = like.variants,
            .look = look_};
  }

  void add_curves(SpaceFigure& figure, std::size_t q, const Matrix3<double>& axes) const {
    for (std::size_t r = 0; r < runs_.size(); ++r) {
      SpaceCurve curve{.label = rests_.size() > 1 ? label(r) : grouping_.methods[places_[r].first],
                       .method = places_[r].first,
                       .variant = places_[r].second,
                       .points = {}};
      for (const auto& row : runs_[r].tracks[q].rows) {
        const Vector3<double> at = axes.transpose() * Vector3<double>(row[0], row[1], row[2]);
        curve.points.push_back({at[0], at[1], at[2]});
      }
      figure.curves.push_back(std::move(curve));
    }
  }

  void polhode(std::size_t q) {
    SpaceFigure figure = begun_in_space(q);
    const Recording& first = runs_.front();
    const Eigen::SelfAdjointEigenSolver<Matrix3<double>> principal(first.inertia);
    Matrix3<double> axes = principal.eigenvectors();
    for (int k = 0; k < 3; ++k) {  // the directions of the body axes that they are nearest to
      Eigen::Index largest = 0;
      axes.col(k).cwiseAbs().maxCoeff(&largest);
      if (axes(largest, k) < 0) axes.col(k) *= -1;
    }
    const Vector3<double> omega = first.rotation.transpose() * first.omega;
    const double twice_energy = omega.dot(first.inertia * omega);
    if (!(twice_energy > 0)) return made_.absent.push_back("polhode: the body does not turn at the start");
    Place semi{};
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(k);
      semi[i] = std::sqrt(twice_energy / principal.eigenvalues()[k]);
      figure.axes[i] = fmt::format("ω{} (rad/s)", k == 0 ? "₁" : k == 1 ? "₂" : "₃");
      figure.columns[i] = fmt::format("omega_{}_rad_per_s", k + 1);
    }
    figure.semi_axes = semi;
    figure.caption += fmt::format(
        " The axes are the principal axes of inertia, the least moment first: {}, {} and {} kg m². What lies behind "
        "the "
        "ellipsoid is dotted.",
        number(principal.eigenvalues()[0]), number(principal.eigenvalues()[1]), number(principal.eigenvalues()[2]));
    add_curves(figure, q, axes);
    made_.in_space.push_back(std::move(figure));
  }

  void herpolhode(std::size_t q) {
    SpaceFigure figure = begun_in_space(q);
    const Recording& first = runs_.front();
    const double size = first.momentum.norm();
    if (!(size > 0)) return made_.absent.push_back("herpolhode: the body has no angular momentum at the start");
    Matrix3<double> axes;
    axes.col(2) = first.momentum / size;
    Eigen::Index least = 0;
    axes.col(2).cwiseAbs().minCoeff(&least);
    axes.col(0) = Vector3<double>::Unit(least).cross(axes.col(2)).normalized();
    axes.col(1) = axes.col(2).cross(axes.col(0));
    figure.axes = {"across L(0), first (rad/s)", "across L(0), second (rad/s)", "along L(0) (rad/s)"};
    figure.columns = {"omega_across_1_rad_per_s", "omega_across_2_rad_per_s", "omega_along_rad_per_s"};
    figure.plane = first.omega.dot(axes.col(2));
    figure.caption +=
        " The square lies in the plane that contains all ω of a free body with this energy and angular momentum.";
    add_curves(figure, q, axes);
    made_.in_space.push_back(std::move(figure));
  }

  /// Rectangles between neighbouring instants, at most 300 of them a component.
  void stacked(std::size_t q) {
    const PlotQuantity& quantity = *quantities_[q];
    Figure figure = begun(q);
    // The colours differ by their lightness too.
    const std::array<std::string, 4> colours = {"08306B", "4292C6", "FDE0A0", "F0A030"};
    for (std::size_t c = 0; c < quantity.components.size(); ++c)
      figure.shades.push_back({quantity.components[c].label, colours[c]});
    const bool impacts = std::any_of(runs_.begin(), runs_.end(), [](const auto& run) { return !run.impacts.empty(); });
    if (impacts) figure.shades.push_back({"impact", "000000"});
    std::vector<Panel> panels;
    for (std::size_t r = 0; r < runs_.size(); ++r) {
      const Track& track = runs_[r].tracks[q];
      if (track.rows.size() < 2) continue;
      // Potential energy and losses have no zero of their own: they stand above their least values.
      std::vector<double> least(4, 0);
      for (const std::size_t c : {std::size_t{2}, std::size_t{3}}) {
        least[c] = track.rows.front()[c];
        for (const auto& row : track.rows) least[c] = std::min(least[c], row[c]);
      }
      Panel panel{.title = {label(r)}, .x_column = "t_s", .y_column = "energy_J"};
      double highest = 0;
      const std::size_t stride = (track.rows.size() + 299) / 300;
      for (std::size_t k = 0; k + 1 < track.rows.size(); k += stride) {
        const std::size_t next = std::min(k + stride, track.rows.size() - 1);
        double below = 0;
        for (std::size_t c = 0; c < 4; ++c) {
          const double height = std::max(0.0, track.rows[k][c] - least[c]);
          if (height > 0) panel.cells.push_back({track.times[k], track.times[next], below, below + height, c});
          below += height;
        }
        highest = std::max(highest, below);
      }
      if (!(highest > 0)) continue;
      panel.x = time_axis(t_end_);
      panel.y = linear_axis("energy (J)", 0, 1.06 * highest);
      for (std::size_t i = 0; i < std::min(runs_[r].impacts.size(), most_impacts_marked); ++i) {
        const double t = runs_[r].impacts[i].t, half = 0.001 * t_end_;
        panel.cells.push_back({std::max(0.0, t - half), std::min(t_end_, t + half), 0, 1.06 * highest, 4});
      }
      panels.push_back(std::move(panel));
    }
    if (panels.empty()) return made_.absent.push_back(quantity.name + ": the energy is zero throughout");
    add_rows(figure, std::move(panels), 1);
    figure.methods.clear();
    figure.caption +=
        " Potential energy, and losses in contact less the work of other forces, stand above their least values.";
    const bool too_many = std::any_of(runs_.begin(), runs_.end(),
                                      [](const auto& run) { return run.impacts.size() > most_impacts_marked; });
    if (too_many) figure.caption += fmt::format(" The first {} impacts are marked.", most_impacts_marked);
    note_marks(figure);
    made_.figures.push_back(std::move(figure));
  }

  void events(std::size_t q) {
    Figure figure = begun(q);
    figure.shades = {{"impact", "0072B2"}, {"end of sliding", "E69F00"}};
    std::vector<Panel> panels;
    for (std::size_t r = 0; r < runs_.size(); ++r) {
      const Recording& run = runs_[r];
      std::map<std::pair<std::size_t, std::size_t>, std::size_t> rows;
      for (const Impact& impact : run.impacts) rows.emplace(std::pair(impact.a, impact.b), 0);
      for (const Transition& end : run.slides_end) rows.emplace(std::pair(end.a, end.b), 0);
      if (rows.empty()) continue;
      Panel panel{.title = {fmt::format("{}: {}", label(r), count(run.impacts.size(), "impact"))},
                  .x_column = "t_s",
                  .y_column = "row"};
      panel.x = time_axis(t_end_);
      panel.y = {.low = 0, .high = static_cast<double>(rows.size()), .named = true};
      std::size_t row = 0;
      for (auto& [pair, number] : rows) {
        number = row++;
        panel.y.ticks.push_back(
            {static_cast<double>(number) + 0.5, run.bodies[pair.first] + " – " + run.bodies[pair.second]});
      }
      const double half = 0.0015 * t_end_;
      const auto add = [&](double t, std::size_t a, std::size_t b, std::size_t shade) {
        const auto at = static_cast<double>(rows.at({a, b}));
        panel.cells.push_back({std::max(0.0, t - half), std::min(t_end_, t + half), at + 0.15, at + 0.85, shade});
      };
      for (const Transition& end : run.slides_end) add(end.t, end.a, end.b, 1);
      for (const Impact& impact : run.impacts) add(impact.t, impact.a, impact.b, 0);
      panels.push_back(std::move(panel));
    }
    if (panels.empty()) return made_.absent.push_back("events: no run had an impact");
    figure.panel_height = 0;
    for (const Panel& panel : panels) figure.panel_height = std::max(figure.panel_height, 40 + 22 * panel.y.high);
    add_rows(figure, std::move(panels), 1);
    figure.methods.clear();
    note_marks(figure);
    made_.figures.push_back(std::move(figure));
  }

  const std::vector<Recording>& runs_;
  const std::vector<const PlotQuantity*>& quantities_;
  const FigureLook look_;
  StudyView view_;
  Grouping grouping_;
  std::vector<std::pair<std::size_t, std::size_t>> places_;  // method and variant of each run
  std::vector<std::string> rests_;                           // label of each run without its method
  double t_end_ = 0;
  RunFigures made_;
};

}  // namespace

RunFigures figures_of_runs(const std::vector<Recording>& runs, const std::vector<const PlotQuantity*>& quantities,
                           const FigureLook& look) {
  return RunFigureMaker(runs, quantities, look).figures();
}

}  // namespace polhode::study::plot_program
