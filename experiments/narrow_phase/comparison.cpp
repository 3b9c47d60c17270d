// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/narrow_phase/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <tuple>

#include "collision/shapes/box.hpp"
#include "experiments/narrow_phase/box_pairs.hpp"
#include "experiments/study/plot/axis.hpp"
#include "experiments/study/plot/figure_layout.hpp"
#include "experiments/study/plot/latex_table.hpp"
#include "experiments/study/text/csv.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::narrow_phase {
namespace {

struct Placed {
  Box a, b;
  Pose at_a, at_b;
  Distance sat;  ///< signed distance by `sat`, which is exact to round-off
  double smaller, larger;

  explicit Placed(const BoxPairCase& pair, const NarrowPhase& judge)
      : a(pair.a.half),
        b(pair.b.half),
        at_a(pair.a.posed().pose),
        at_b(pair.b.posed().pose),
        sat(judge.distance(a, at_a, b, at_b)),
        smaller(std::min(pair.a.half.minCoeff(), pair.b.half.minCoeff())),
        larger(std::max(pair.a.half.maxCoeff(), pair.b.half.maxCoeff())) {}
};

/// Smallest and largest value over the classes of pairs.
struct Range {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  void take(double x) { least = std::min(least, x), most = std::max(most, x); }
  std::string said() const { return fmt::format("{} to {} ns", number(least, 3), number(most, 3)); }
};

/// Time of one query, ns: the least of five rounds over all pairs.
template <class Ask>
double cost_ns(const std::vector<std::unique_ptr<Placed>>& pairs, const Ask& ask) {
  using Clock = std::chrono::steady_clock;
  double least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < 5; ++round) {
    const auto start = Clock::now();
    for (const auto& p : pairs) ask(*p);
    least = std::min(least, std::chrono::duration<double, std::nano>(Clock::now() - start).count());
  }
  return least / static_cast<double>(pairs.size());
}

/// The differences between the answers of one narrow phase and those of sat, over all classes.
struct Agreement {
  std::string name;
  std::size_t pairs = 0, wrong = 0, missed = 0;
  double difference = 0;  ///< largest, of the signed distance, in units of the smaller box
};

/// An answer: whether the narrow phases agree with sat.
Answer answer_of(const std::vector<Agreement>& all) {
  std::vector<std::string> agree, differ;
  double most = 0;
  std::size_t pairs = 0;
  for (const Agreement& a : all) {
    if (a.name == "sat") continue;  // the others are compared with it
    pairs = a.pairs;
    if (a.wrong + a.missed > 0) {
      differ.push_back(fmt::format("{} reports {} overlaps that are none and misses {}", a.name, a.wrong, a.missed));
      continue;
    }
    agree.push_back(a.name);
    most = std::max(most, a.difference);
  }
  Answer answer;
  if (!agree.empty())
    answer.sentences.push_back(fmt::format(
        "{} and sat agree on whether two boxes overlap, in each of {} pairs; their distances differ by at most "
        "{} of the smaller box.",
        fmt::format("{}", fmt::join(agree, ", ")), pairs, number(most, 2)));
  if (!differ.empty()) answer.sentences.push_back(fmt::format("Of {} pairs {}.", pairs, words(differ)));
  if (agree.empty() && differ.empty())
    answer.sentences.emplace_back("sat alone was asked; without --narrow-phase all are compared with it.");
  answer.sentences.emplace_back(
      "Which costs less is measured as wall time, which differs from call to call: the figure of costs shows it, and "
      "timings/costs.md has the numbers.");
  answer.depends = {"The pairs are random boxes of the classes in the table below.",
                    "Overlaps within the round-off of the poses are not counted as wrong."};
  return answer;
}

/// Time of each question by class of pair.
Figure cost_figure(const std::vector<std::vector<std::array<double, 3>>>& costs,
                   const std::vector<const NarrowPhaseEntry*>& entries) {
  Figure figure{.name = "cost_of_questions", .title = "Cost of a question, by narrow phase and class of pair"};
  std::vector<std::string> classes;
  for (const std::string& name : box_pair_classes()) classes.push_back(fmt::format("{} {}", classes.size() + 1, name));
  figure.caption = fmt::format("The best of five rounds over all pairs of a class. Classes: {}.", words(classes));
  std::vector<Panel> panels;
  for (const auto& [k, column, label] :
       {std::tuple(0U, "overlap_ns", "overlap (ns)"), std::tuple(1U, "distance_ns", "distance (ns)"),
        std::tuple(2U, "manifold_ns", "contacts (ns)")}) {
    Panel panel{.x = linear_axis("class of pair", 1, double(classes.size())), .x_column = "class", .y_column = column};
    std::vector<double> ys;
    for (std::size_t e = 0; e < entries.size(); ++e) {
      PlottedCurve curve{.label = entries[e]->name, .method = e};
      for (std::size_t c = 0; c < costs[e].size(); ++c) {
        curve.points.push_back({double(c + 1), costs[e][c][k], costs[e][c][k]});
        ys.push_back(costs[e][c][k]);
      }
      panel.curves.push_back(std::move(curve));
    }
    panel.y = log_axis(label, ys, {});
    panels.push_back(std::move(panel));
  }
  add_rows(figure, std::move(panels), 3);
  for (Panel& panel : figure.panels) panel.y.labelled = true;  // each has its own axis
  for (const NarrowPhaseEntry* entry : entries) figure.methods.push_back(entry->name);
  figure.variants = {""};
  note_marks(figure);
  return figure;
}

}  // namespace

void compare_narrow_phases(const std::vector<const NarrowPhaseEntry*>& entries, std::size_t count, std::uint64_t seed,
                           Analysis& analysis) {
  // Smallest distance or depth, over the size of the larger box, at which the round-off of the poses cannot change
  // whether the boxes overlap.
  constexpr double decided = 1e-14;
  const auto judge = find_narrow_phase("sat")->make();
  std::string csv = csv_row({"class", "narrow_phase", "pairs", "overlapping", "wrong_overlaps", "missed_overlaps",
                             "distance_difference_max_rel"});
  std::string costs = csv_row({"class", "narrow_phase", "overlap_ns", "distance_ns", "manifold_ns"});
  Table table{
      "Agreement with sat: overlaps that are none, overlaps that are missed, and the largest difference of the "
      "signed distance, in units of the smaller box.",
      {{.header = "class", .kind = Column::Kind::text, .apart = true},
       {"narrow phase", "", Column::Kind::name},
       {"pairs"},
       {.header = "wrong", .best = Column::Best::least},
       {.header = "missed", .best = Column::Best::least},
       {.header = "difference", .best = Column::Best::least}},
      {}};
  Table cost_table{"Cost of one question, the best of five rounds over all pairs of the class.",
                   {{.header = "class", .kind = Column::Kind::text, .apart = true},
                    {"narrow phase", "", Column::Kind::name},
                    {.header = "overlap", .unit = "ns", .best = Column::Best::least},
                    {.header = "distance", .unit = "ns", .best = Column::Best::least},
                    {.header = "contacts", .unit = "ns", .best = Column::Best::least}},
                   {}};
  // 1. For each class of pairs: errors and cost of each narrow phase.
  std::map<std::string, std::array<Range, 3>> ranges;
  std::vector<std::vector<std::array<double, 3>>> costs_by_class(entries.size());  // costs by narrow phase and class
  std::vector<Agreement> agreements;
  for (const NarrowPhaseEntry* entry : entries) agreements.push_back({entry->name});
  BoxPairs make(seed);
  const std::size_t classes = box_pair_classes().size();
  for (std::size_t k = 0; k < classes; ++k) {
    const std::string& name = box_pair_classes()[k];
    std::vector<std::unique_ptr<Placed>> pairs;
    std::size_t overlapping = 0;
    for (std::size_t i = 0; i < count; ++i) {
      pairs.push_back(std::make_unique<Placed>(make(i * classes + k), *judge));
      overlapping += pairs.back()->sat.distance <= 0;
    }
    for (std::size_t e = 0; e < entries.size(); ++e) {
      const NarrowPhaseEntry* entry = entries[e];
      const auto phase = entry->make();
      std::size_t wrong = 0, missed = 0;
      double most = 0;
      for (const auto& p : pairs) {
        const bool overlap = phase->overlap(p->a, p->at_a, p->b, p->at_b);
        const double distance = phase->distance(p->a, p->at_a, p->b, p->at_b).distance;
        wrong += overlap && p->sat.distance > decided * p->larger;
        missed += !overlap && p->sat.distance < -decided * p->larger;
        most = std::max(most, std::abs(distance - p->sat.distance) / p->smaller);
      }
      agreements[e].pairs += count;
      agreements[e].wrong += wrong;
      agreements[e].missed += missed;
      agreements[e].difference = std::max(agreements[e].difference, most);
      csv += csv_row({name, entry->name, std::to_string(count), std::to_string(overlapping), std::to_string(wrong),
                      std::to_string(missed), exact(most)});
      table.rows.push_back(
          {name, entry->name, std::to_string(count), std::to_string(wrong), std::to_string(missed), number(most, 2)});
      const double overlap_ns = cost_ns(pairs, [&](const Placed& p) { phase->overlap(p.a, p.at_a, p.b, p.at_b); });
      const double distance_ns = cost_ns(pairs, [&](const Placed& p) { phase->distance(p.a, p.at_a, p.b, p.at_b); });
      const double manifold_ns = cost_ns(pairs, [&](const Placed& p) { phase->manifold(p.a, p.at_a, p.b, p.at_b); });
      costs += csv_row({name, entry->name, number(overlap_ns, 4), number(distance_ns, 4), number(manifold_ns, 4)});
      cost_table.rows.push_back(
          {name, entry->name, number(overlap_ns, 3), number(distance_ns, 3), number(manifold_ns, 3)});
      costs_by_class[e].push_back({overlap_ns, distance_ns, manifold_ns});
      auto& range = ranges[entry->name];
      range[0].take(overlap_ns), range[1].take(distance_ns), range[2].take(manifold_ns);
    }
  }
  // 2. Sentences, tables, files and the figure of costs.
  analysis.answer = answer_of(agreements);
  analysis.timed.figures.push_back(cost_figure(costs_by_class, entries));
  for (const NarrowPhaseEntry* entry : entries) {
    const auto& [overlap, distance, manifold] = ranges[entry->name];
    analysis.timed.sentences.push_back(
        fmt::format("{}: an overlap takes {}, a distance {}, contacts {}, by the class of the pair.", entry->name,
                    overlap.said(), distance.said(), manifold.said()));
  }
  analysis.method.push_back(fmt::format(
      "{} pairs of boxes of each class, of scales from 1e-3 to 1e3 m and sizes up to 1e4 apart. An overlap is wrong or "
      "missed "
      "where sat's distance or depth is more than {} of the larger box, which is beyond the round-off of the poses.",
      count, decided));
  analysis.tables.push_back({"agreement", table});
  analysis.files.push_back({"comparison.csv", csv});
  analysis.timed.files.push_back({"costs.csv", costs});
  analysis.timed.files.push_back({"costs.md", markdown(cost_table)});
  analysis.timed.files.push_back({"costs.tex", latex_table(cost_table).text});
}

void measure_course_report(std::size_t count, std::uint64_t seed, Analysis& analysis) {
  constexpr int angles = 46;  // number of angles: 0 to 90 degrees in steps of 2
  const auto judge = find_narrow_phase("sat")->make(), course = find_narrow_phase("sat_course_report")->make();
  const Box cube(Vector3<double>::Constant(0.5));
  // 1. At each angle: pairs that are apart, those called overlapping, and all overlaps that are reported.
  std::string csv =
      csv_row({"angle_deg", "pairs_apart", "called_overlapping", "share_of_pairs_apart", "share_of_overlaps_reported"});
  PlottedCurve of_apart{.label = "of the pairs that are apart"},
      of_reported{.label = "of the overlaps that it reports", .variant = 1};
  double worst = 0, worst_angle = 0;
  for (int k = 0; k < angles; ++k) {
    const double angle_deg = 90.0 * k / (angles - 1), angle = angle_deg * std::numbers::pi / 180;
    std::size_t apart = 0, wrong = 0, reported = 0;
    PortableRandom random(seed);  // the same places and axes at each angle
    for (std::size_t i = 0; i < count; ++i) {
      // The centre is in the ball in which the spheres around the two cubes meet.
      const Vector3<double> centre = random.direction() * (std::sqrt(3.0) * std::cbrt(random.uniform(0, 1)));
      const Pose at_a,
          at_b{centre, rotation_matrix<double>(quaternion_from_rotation_vector<double>(random.direction() * angle))};
      const bool overlap = judge->overlap(cube, at_a, cube, at_b), said = course->overlap(cube, at_a, cube, at_b);
      apart += !overlap;
      wrong += said && !overlap;
      reported += said;
    }
    const double share = apart > 0 ? double(wrong) / double(apart) : 0,
                 in_reports = reported > 0 ? double(wrong) / double(reported) : 0;
    csv += csv_row({exact(angle_deg), std::to_string(apart), std::to_string(wrong), exact(share), exact(in_reports)});
    of_apart.points.push_back({angle_deg, 100 * share, 100 * share});
    of_reported.points.push_back({angle_deg, 100 * in_reports, 100 * in_reports});
    if (share > worst) {
      worst = share;
      worst_angle = angle_deg;
    }
  }
  // 2. Sentence, file and figure.
  analysis.sentences.push_back(
      fmt::format("sat_course_report calls up to {} % of the pairs of cubes that are apart, and whose "
                  "surrounding spheres meet, overlapping: at a turn of {} degrees about a random axis.",
                  number(100 * worst, 2), number(worst_angle, 3)));
  analysis.files.push_back({"course_report.csv", csv});
  Panel panel{.x = linear_axis("turn of one cube (degrees)", 0, 90),
              .y = linear_axis("overlaps reported that are none (%)", 0, 1.1 * 100 * worst),
              .x_column = "angle_deg",
              .y_column = "share_percent",
              .curves = {of_apart, of_reported}};
  Figure figure{
      .name = "course_report_errors",
      .title = "How often the course report's test errs",
      .caption = fmt::format("{} pairs of equal cubes at each angle, one turned about a random axis, its centre "
                             "anywhere in the ball in which the spheres around the cubes meet.",
                             count)};
  figure.panels = {panel};
  figure.methods = {"sat_course_report"};
  figure.used_methods = {0};
  figure.variants = {"of the pairs that are apart", "of the overlaps that it reports"};
  analysis.figures.push_back(figure);
}

}  // namespace polhode::study::narrow_phase
