// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/broad_phase/costs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <map>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "experiments/broad_phase/flying_boxes.hpp"
#include "experiments/study/plot/axis.hpp"
#include "experiments/study/plot/figure_layout.hpp"
#include "experiments/study/plot/table.hpp"
#include "experiments/study/record/study_view.hpp"
#include "experiments/study/report/article/article.hpp"
#include "experiments/study/report/figures/study_figures.hpp"
#include "experiments/study/report/page/report.hpp"
#include "experiments/study/report/tables/summary.hpp"
#include "experiments/study/report/tables/tables.hpp"
#include "experiments/study/statistics/line_fit.hpp"
#include "experiments/study/text/csv.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::broad_phase {
namespace {

using Clock = std::chrono::steady_clock;

/// Cost of a step at one number of bodies. The mean decides the cost of a run: some broad phases do most of their work
/// in a few steps.
struct Cost {
  double ns_per_box = 0, median_ns_per_box = 0;
  double pairs_per_box = 0;  ///< mean of the first Measurement::fewest measured steps, the same on every machine
  std::size_t steps = 0;     ///< measured steps
};

struct Runner {
  const BroadPhaseEntry* entry = nullptr;
  std::unique_ptr<BroadPhase> phase;
  std::vector<double> seconds;
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The measurement:
/// 1. run(): for each number of bodies the mean and the median cost of a step, and a comparison of the pairs.
/// 2. finish(): writes table, CSV, figure and report.
class Measurement {
 public:
  explicit Measurement(const BroadPhaseOptions& options) : options_(options) {}

  void run() {
    for (const std::size_t n : options_.bodies) measure(n);
  }

  /// Writes the results and returns the exit status. The files depend on wall times and differ from call to call.
  int finish() const {
    StudyView view;
    view.experiment = "broad_phase";
    view.question = broad_phase_question;
    view.command = options_.command;
    view.folder = options_.out.empty() ? "results/broad_phase" : options_.out;
    view.analysis = Analysis{.alone = true, .heading = "Cost of a step", .sentences = notes_};
    view.analysis->answer = answer();
    view.analysis->tables.push_back({"cost", cost_table()});
    view.analysis->files.push_back({"cost.csv", csv()});
    if (options_.figures) view.analysis->figures.push_back(figure());
    view.figure_choice.look = options_.look;
    choose_figures(view.figure_choice, view.analysis->figures);
    std::error_code error;
    std::filesystem::create_directories(view.folder, error);
    if (error) throw InputError("--out: cannot create " + view.folder.string() + ": " + error.message());
    write_tables(view);
    if (const std::string said = write_figures(view); !said.empty()) fmt::print(stderr, "broad_phase: {}\n", said);
    write_report(view);
    if (options_.article) {
      if (const std::string said = write_article(view); !said.empty()) fmt::print(stderr, "broad_phase: {}\n", said);
    }
    fmt::print("{}\n{}\n", summary_table(view), (view.folder / "report.html").string());
    for (const std::string& d : differences_) fmt::print(stderr, "broad_phase: {}\n", d);
    return differences_.empty() ? 0 : 1;
  }

 private:
  /// Measures all broad phases at one number of bodies. They take turns at each step, so that other load on the machine
  /// affects all alike. There are two rounds; the smaller time of each step counts.
  void measure(std::size_t n) {
    std::vector<Runner> runners = runners_for(n);
    if (runners.empty()) return;
    const double pairs = first_round(n, runners);
    const std::size_t steps = runners.front().seconds.size();
    second_round(n, runners);
    const auto count = static_cast<double>(n);
    for (const Runner& r : runners) {
      const double mean = std::accumulate(r.seconds.begin(), r.seconds.end(), 0.0) / static_cast<double>(steps);
      costs_[r.entry][n] = {1e9 * mean / count, 1e9 * median(r.seconds) / count,
                            pairs / static_cast<double>(fewest) / count, steps};
    }
  }

  /// Numbers of steps. The first `warm` are not measured: in them most boxes leave their initial margins in the broad
  /// phase.
  static constexpr std::size_t warm = 40, fewest = 20, most = 200;

  /// Takes steps until the time is used up, and compares the pairs of all broad phases. Returns the number of pairs in
  /// the first `fewest` measured steps: how many follow depends on the speed of the machine.
  double first_round(std::size_t n, std::vector<Runner>& runners) {
    constexpr double long_enough = 2;  // time of all broad phases together, s
    FlyingBoxes boxes(n, options_.filling, options_.motion, options_.seed);
    double total = 0, pairs = 0;
    for (std::size_t k = 0; k < warm + most && (k < warm + fewest || total < long_enough); ++k, boxes.step()) {
      std::vector<BodyPair> first;
      for (Runner& r : runners) {
        std::span<const BodyPair> found;
        const double seconds = step(r, boxes, found);
        total += seconds;
        if (k >= warm) r.seconds.push_back(seconds);
        if (&r == &runners.front()) first.assign(found.begin(), found.end());
        else compare(*runners.front().entry, first, *r.entry, found, n, k);
      }
      ++steps_compared_;
      if (k >= warm && k < warm + fewest) pairs += static_cast<double>(first.size());
    }
    return pairs;
  }

  void second_round(std::size_t n, std::vector<Runner>& runners) {
    FlyingBoxes boxes(n, options_.filling, options_.motion, options_.seed);
    for (Runner& r : runners) r.phase = r.entry->make();
    const std::size_t steps = warm + runners.front().seconds.size();
    for (std::size_t k = 0; k < steps; ++k, boxes.step()) {
      for (Runner& r : runners) {
        std::span<const BodyPair> found;
        const double seconds = step(r, boxes, found);
        if (k >= warm) r.seconds[k - warm] = std::min(r.seconds[k - warm], seconds);
      }
    }
  }

  static double step(Runner& r, const FlyingBoxes& boxes, std::span<const BodyPair>& found) {
    const auto start = Clock::now();
    r.phase->update(boxes.bounds());
    found = r.phase->pairs();
    return std::chrono::duration<double>(Clock::now() - start).count();
  }

  /// The broad phases to measure. Left out are those whose step would take longer than --patience, extrapolated from
  /// fewer bodies as n².
  std::vector<Runner> runners_for(std::size_t n) {
    std::vector<Runner> runners;
    for (const BroadPhaseEntry* entry : options_.phases) {
      const auto known = costs_.find(entry);
      if (known != costs_.end()) {
        const auto& [fewer, cost] = *std::prev(known->second.end());
        const double seconds = 1e-9 * cost.ns_per_box * double(n) * std::max(1.0, double(n) / double(fewer));
        if (seconds > options_.patience) {
          notes_.push_back(fmt::format("{} is left out at {} bodies: a step may take {} s; see --patience.",
                                       entry->name, n, number(seconds, 2)));
          continue;
        }
      }
      runners.push_back({entry, entry->make(), {}});
    }
    return runners;
  }

  void compare(const BroadPhaseEntry& one, const std::vector<BodyPair>& expected, const BroadPhaseEntry& other,
               std::span<const BodyPair> found, std::size_t n, std::size_t step) {
    if (std::equal(expected.begin(), expected.end(), found.begin(), found.end())) return;
    constexpr std::size_t shown_at_most = 20;
    if (differences_.size() == shown_at_most) return;
    const auto [a, b] = std::mismatch(expected.begin(), expected.end(), found.begin(), found.end());
    const auto shown = [](bool there, const BodyPair* p) {
      return there ? fmt::format("({}, {})", p->a, p->b) : "no more";
    };
    differences_.push_back(fmt::format(
        "{} bodies, step {}: {} reports {} pairs and {} {}; first {} where the other has {}", n, step, one.name,
        expected.size(), other.name, found.size(), shown(a != expected.end(), &*a), shown(b != found.end(), &*b)));
  }

  /// The exponent p of the cost of a step ∝ n^p, as text: least-squares slope of the logarithms over the upper half of
  /// the numbers of bodies.
  static std::string growth(const std::map<std::size_t, Cost>& costs) {
    std::vector<LinePoint> points;
    for (const auto& [n, cost] : costs) points.push_back({std::log(double(n)), std::log(double(n) * cost.ns_per_box)});
    if (points.size() < 2) return "";
    const std::size_t upper = std::max<std::size_t>(2, (points.size() + 1) / 2);
    return number(fit_line(std::span(points).last(upper)).slope, 3);
  }

  /// The broad phases that were measured at n boxes with their ns for each box, the cheapest first.
  std::vector<std::pair<double, std::string>> order_at(std::size_t n) const {
    std::vector<std::pair<double, std::string>> order;
    for (const BroadPhaseEntry* entry : options_.phases) {
      const auto known = costs_.find(entry);
      if (known == costs_.end()) continue;
      if (const auto at = known->second.find(n); at != known->second.end())
        order.emplace_back(at->second.ns_per_box, entry->name);
    }
    std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    return order;
  }

  /// The cheapest broad phase for each number of boxes, and whether all report the same pairs.
  Answer answer() const {
    struct Stretch {
      std::string name;
      std::size_t first = 0, last = 0;
    };
    std::vector<Stretch> stretches;
    std::size_t largest = 0;
    for (const std::size_t n : options_.bodies) {
      const auto order = order_at(n);
      if (order.empty()) continue;
      largest = n;
      const std::string& name = order.front().second;
      if (stretches.empty() || stretches.back().name != name) stretches.push_back({name, n, n});
      stretches.back().last = n;
    }
    Answer answer;
    if (stretches.empty()) {
      answer.sentences.emplace_back("No broad phase was measured; a larger --patience would decide.");
      return answer;
    }
    std::vector<std::string> parts;
    for (const Stretch& s : stretches)
      parts.push_back(s.first == s.last ? fmt::format("{} for {} boxes", s.name, s.first)
                                        : fmt::format("{} for {} to {} boxes", s.name, s.first, s.last));
    answer.sentences.push_back(fmt::format("A step costs the least with {}.", words(first_items(parts, 5))));
    const auto order = order_at(largest);
    const double ratio = order.size() > 1 ? order[1].first / order[0].first : 0;
    answer.sentences.push_back(
        fmt::format("At {} boxes {} takes {} ns for each box; {}.", largest, order[0].second, number(order[0].first),
                    order.size() < 2 ? std::string("no other was measured there")
                                     : fmt::format("{} {} with {} times as much", order[1].second,
                                                   ratio <= 1.2 ? "ties within 20 %" : "is next", number(ratio))));
    answer.sentences.push_back(
        differences_.empty() ? fmt::format("All report the same pairs, at each of {}.", count(steps_compared_, "step"))
                             : "They do not all report the same pairs: " + differences_.front() + ".");
    answer.depends = {
        fmt::format("Boxes fly about and fill {} of the space; a step's path is {} of an edge. --filling and "
                    "--motion change both.",
                    number(options_.filling), number(options_.motion)),
        "Wall times are those of this machine in this call."};
    return answer;
  }

  Table cost_table() const {
    Table table{"Cost of a step, ns per box (mean), and p of a step's cost ∝ nᵖ over the upper half of n.",
                {{"broad phase", "", Column::Kind::name}},
                {}};
    for (const std::size_t n : options_.bodies)
      table.columns.push_back({.header = fmt::format("n = {}", n), .best = Column::Best::least});
    table.columns.push_back({"p", "", Column::Kind::number});
    for (const BroadPhaseEntry* entry : options_.phases) {
      const auto known = costs_.find(entry);
      if (known == costs_.end()) continue;
      std::vector<std::string> row = {entry->name};
      for (const std::size_t n : options_.bodies) {
        const auto cost = known->second.find(n);
        row.push_back(cost == known->second.end() ? "" : number(cost->second.ns_per_box, 3));
      }
      row.push_back(growth(known->second));
      table.rows.push_back(std::move(row));
    }
    return table;
  }

  Figure figure() const {
    Figure figure{.name = "cost_against_bodies",
                  .title = "Cost of a broad phase against the number of bodies",
                  .caption = fmt::format("Mean time of a step per box: boxes that fly about, {} of the space filled, a "
                                         "step's path {} of an edge. Level: linear growth of a step.",
                                         number(options_.filling), number(options_.motion))};
    Panel panel{.x_column = "bodies", .y_column = "ns_per_box"};
    std::vector<double> xs, ys;
    for (const BroadPhaseEntry* entry : options_.phases) {
      figure.methods.push_back(entry->name);
      const auto known = costs_.find(entry);
      if (known == costs_.end()) continue;
      PlottedCurve curve{.label = entry->name, .method = figure.methods.size() - 1};
      for (const auto& [n, cost] : known->second) {
        curve.points.push_back({double(n), cost.ns_per_box, cost.ns_per_box});
        xs.push_back(double(n));
        ys.push_back(cost.ns_per_box);
      }
      panel.curves.push_back(std::move(curve));
    }
    panel.x = step_axis("bodies", xs);
    panel.y = log_axis("time of a step per box (ns)", ys, {});
    figure.variants = {""};
    add_rows(figure, {std::move(panel)}, 1);
    note_marks(figure);
    return figure;
  }

  std::string csv() const {
    std::string csv = csv_row({"broad_phase", "bodies", "ns_per_box", "median_ns_per_box", "pairs_per_box", "steps"});
    for (const BroadPhaseEntry* entry : options_.phases) {
      const auto known = costs_.find(entry);
      if (known == costs_.end()) continue;
      for (const auto& [n, cost] : known->second) {
        csv += csv_row({entry->name, std::to_string(n), exact(cost.ns_per_box), exact(cost.median_ns_per_box),
                        exact(cost.pairs_per_box), std::to_string(cost.steps)});
      }
    }
    return csv;
  }

  const BroadPhaseOptions& options_;
  std::map<const BroadPhaseEntry*, std::map<std::size_t, Cost>> costs_;
  std::vector<std::string> notes_, differences_;
  std::size_t steps_compared_ = 0;
};

}  // namespace

int measure_costs(const BroadPhaseOptions& options) {
  Measurement measurement(options);
  measurement.run();
  return measurement.finish();
}

}  // namespace polhode::study::broad_phase
