// SPDX-License-Identifier: BSD-3-Clause
// The laws of every manifold, of every two kinds of shapes that a narrow phase answers: near enough points on both
// surfaces, as deep as the pair, each with a name of its own, and a touch once the pair is moved out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>

#include "collision/narrow_phase.hpp"
#include "collision/shapes/half_space.hpp"
#include "tests/collision/narrow/manifold_parts.hpp"
#include "tests/laws/shape_pairs.hpp"

namespace polhode {

void PrintTo(const NarrowPhaseEntry& e, std::ostream* out);

namespace laws::manifold_law_test {
namespace {

using Vector = Vector3<double>;

/// The distance of a point outside a shape's convex hull, by the planes across many directions: never too large.
double outside(const Shape& shape, const Pose& pose, const Vector& point) {
  const Vector x = pose.to_body(point);
  if (shape.tag() == ShapeTag::half_space) {
    const auto& floor = static_cast<const HalfSpace&>(shape);
    return floor.normal().dot(x) - floor.offset();
  }
  constexpr int directions = 200;
  double most = -1e300;
  for (int k = 0; k < directions; ++k) {
    const double z = 1 - (2 * k + 1) / double(directions), angle = 2.399963229728653 * k, r = std::sqrt(1 - z * z);
    const Vector d(r * std::cos(angle), r * std::sin(angle), z);
    most = std::max(most, d.dot(x - shape.support(d)));
  }
  return most;
}

void check(const NarrowPhase& narrow, const ShapePair& p, double margin) {
  const Distance d = narrow.distance(*p.a, p.at_a, *p.b, p.at_b);
  const Manifold m = narrow.manifold(*p.a, p.at_a, *p.b, p.at_b, margin);
  if (m.count == 0 || !std::isfinite(d.distance)) return;
  const double slack = (p.round ? 1e-6 : 1e-9) * p.scale;
  ASSERT_LE(m.count, Manifold::capacity);
  ASSERT_GE(deepest(m), d.distance > 0 ? -margin * (1 + 1e-9) : -d.distance - slack);
  std::set<FeatureName> names;
  // A point is no better than the witnesses of the distance, where it is made of them.
  const double witnesses = (d.on_a - d.on_b - d.distance * d.normal).norm();
  for (std::size_t i = 0; i < m.count; ++i) {
    const ContactPoint& c = m.points[i];
    names.insert({c.feature.kind, c.feature.of_a, c.feature.of_b});
    // Parts of a compound have normals of their own, 0.1 rad from the manifold's at most.
    const double tolerance = 1e-5 * p.scale + witnesses + (p.convex ? 0 : 0.1 * std::abs(c.depth));
    if (!p.convex && p.round) continue;  // the witnesses of its other parts are unknown here
    ASSERT_LE(outside(*p.a, p.at_a, c.point - 0.5 * c.depth * m.normal), tolerance);
    ASSERT_LE(outside(*p.b, p.at_b, c.point + 0.5 * c.depth * m.normal), tolerance);
  }
  ASSERT_EQ(names.size(), m.count);
  if (d.distance > 0 || !p.convex) return;
  // Moved out by the depth, it touches: a hair further is apart.
  Pose moved = p.at_b;
  moved.position -= deepest(m) * m.normal;
  const double after = narrow.distance(*p.a, p.at_a, *p.b, moved).distance;
  ASSERT_LE(after, slack + deepest(m) * 0.05);
  ASSERT_GE(after, -slack - deepest(m) * 0.05);
}

class ManifoldLaw : public testing::TestWithParam<NarrowPhaseEntry> {
 protected:
  void run(std::uint64_t seeds) {
    if (GetParam().name == "sat_course_report") GTEST_SKIP() << "it overlooks axes by design";
    const auto narrow = GetParam().make();
    for (const std::string& a : shape_kinds()) {
      for (const std::string& b : shape_kinds()) {
        for (std::uint64_t seed = 0; seed < seeds; ++seed) {
          const ShapePair p = shape_pair(a, b, seed);
          try {
            check(*narrow, p, seed % 2 == 0 ? 0.05 * p.smaller : 0);
          } catch (const std::invalid_argument&) {
            break;  // a pair that the narrow phase refuses
          }
          ASSERT_FALSE(HasFatalFailure()) << "shape_pair(\"" << a << "\", \"" << b << "\", " << seed << ")";
        }
      }
    }
  }
};

TEST_P(ManifoldLaw, PointsLieOnBothSurfacesAsDeepAsThePair) { run(60); }
TEST_P(ManifoldLaw, PointsLieOnBothSurfacesOfManyPairsSlow) { run(2000); }

INSTANTIATE_TEST_SUITE_P(Catalogue, ManifoldLaw, testing::ValuesIn(narrow_phase_catalogue()),
                         [](const auto& phase) { return phase.param.name; });

}  // namespace
}  // namespace laws::manifold_law_test
}  // namespace polhode
