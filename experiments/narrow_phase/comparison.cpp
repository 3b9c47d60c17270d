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

#include "collision/shapes/box.hpp"
#include "experiments/narrow_phase/box_pairs.hpp"
#include "experiments/study/plot/axis.hpp"
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
      {{"class", "", Column::Kind::text},
       {"narrow phase", "", Column::Kind::name},
       {"pairs"},
       {"wrong"},
       {"missed"},
       {"difference"}},
      {}};
  Table cost_table{"Cost of one question, the best of five rounds over all pairs of the class.",
                   {{"class", "", Column::Kind::text},
                    {"narrow phase", "", Column::Kind::name},
                    {"overlap", "ns"},
                    {"distance", "ns"},
                    {"contacts", "ns"}},
                   {}};
  // 1. For each class of pairs: errors and cost of each narrow phase.
  std::map<std::string, std::array<Range, 3>> ranges;
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
    for (const NarrowPhaseEntry* entry : entries) {
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
      auto& range = ranges[entry->name];
      range[0].take(overlap_ns), range[1].take(distance_ns), range[2].take(manifold_ns);
    }
  }
  // 2. Sentences, tables and files.
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
  analysis.timed.files.push_back({"costs.tex", latex(cost_table)});
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
