// SPDX-License-Identifier: BSD-3-Clause
// Every narrow phase that answers hulls against the exact judge, on random and degenerate pairs.
#include <gtest/gtest.h>

#include <map>
#include <sstream>
#include <tuple>

#include "collision/narrow_phase.hpp"
#include "tests/collision/narrow/exact_hulls.hpp"
#include "tests/collision/narrow/hull_pairs.hpp"

namespace polhode {

void PrintTo(const NarrowPhaseEntry& e, std::ostream* out) { *out << e.name; }

namespace hull_judge_test {
namespace {

using Vector = Vector3<double>;
using Real = long double;

/// The gap between the shadows of the hulls on n, if B lies beyond A.
Real shadow_gap(const HullPairCase& pair, const Vector& n) {
  const Vector3<Real> m = n.cast<Real>();
  const auto reach = [&](const std::vector<Vector>& points, const Pose& at, Real sign) {
    const Vector3<Real> in_body = at.rotation.cast<Real>().transpose() * m * sign;
    Real most = -std::numeric_limits<Real>::infinity();
    for (const Vector& p : points) most = std::max(most, in_body.dot(p.cast<Real>()));
    return most + sign * m.dot(at.position.cast<Real>());
  };
  return -reach(pair.points_a, pair.at_a, 1) - reach(pair.points_b, pair.at_b, -1);
}

/// Half the largest extent of the larger hull, and of the smaller one.
struct Sizes {
  double larger, smaller;

  explicit Sizes(const HullPairCase& pair) {
    const auto half_size = [](const ConvexHull& hull) { return 0.5 * hull.bounds({}).sizes().maxCoeff(); };
    std::tie(smaller, larger) = std::minmax({half_size(*pair.a), half_size(*pair.b)});
  }
};

class Faults {
 public:
  explicit Faults(const HullPairCase& pair) : pair_(pair) {}

  void expect_at_most(double error, double bound, const char* what) {
    if (!(error <= bound)) said_ << "; " << what << " " << error << " exceeds " << bound;
  }
  void expect(bool holds, const char* what) {
    if (!holds) said_ << "; " << what;
  }
  std::string said() const { return said_.str().empty() ? "" : pair_.what + said_.str(); }

 private:
  const HullPairCase& pair_;
  std::ostringstream said_;
};

/// The faults of the answers to a pair; empty: none.
std::string faults(const NarrowPhase& narrow, double tolerance, const HullPairCase& pair) {
  const ExactDistance exact = exact_distance(ExactHull{pair.points_a, pair.at_a}, ExactHull{pair.points_b, pair.at_b});
  const Sizes sizes(pair);
  const Distance d = narrow.distance(*pair.a, pair.at_a, *pair.b, pair.at_b);
  const bool overlap = narrow.overlap(*pair.a, pair.at_a, *pair.b, pair.at_b);
  const double rounding =
      4e-16 * (pair.at_a.position.norm() + pair.at_b.position.norm() + sizes.larger);  // rounding of the poses
  const double slack = tolerance * sizes.smaller + rounding;
  Faults faults(pair);
  faults.expect_at_most(double(std::abs(d.distance - exact.distance)), slack, "error of the signed distance");
  if (std::abs(exact.distance) > 1e-14L * sizes.larger) {
    faults.expect(overlap == (exact.sign < 0), "wrong overlap");
    faults.expect((d.distance <= 0) == (exact.sign < 0), "wrong sign");
  }
  faults.expect_at_most(std::abs(d.normal.norm() - 1), 1e-14, "normal's length off by");
  if (d.distance <= 0) {
    const double left = double(-(shadow_gap(pair, -d.normal) - d.distance));
    faults.expect_at_most(left, 1e-9 * sizes.smaller + rounding, "depth left after moving B");
  }
  faults.expect_at_most((d.on_a - d.on_b - d.distance * d.normal).norm(), slack, "witnesses' gap");
  return faults.said();
}

class HullJudge : public testing::TestWithParam<NarrowPhaseEntry> {
 protected:
  void judge(std::uint64_t seed, std::uint64_t count) {
    const auto narrow = GetParam().make();
    const double tolerance = GetParam().name == "sat" ? 1e-9 : 1e-8;
    std::map<std::string, std::size_t> wrong;
    std::ostringstream first;
    for (std::uint64_t k = 0; k < count; ++k) {
      const HullPairCase pair = hull_pair_case(seed, k);
      std::string said;
      try {
        said = faults(*narrow, tolerance, pair);
      } catch (const std::invalid_argument& refusal) {
        if (k > 0 || !std::string(refusal.what()).starts_with(GetParam().name + ":")) throw;
        GTEST_SKIP() << refusal.what();
      }
      if (!said.empty() && ++wrong[pair.what] <= 10)
        first << "hull_pair_case(" << seed << ", " << k << "): " << said << "\n";
    }
    for (const auto& [what, number] : wrong) ADD_FAILURE() << number << " pairs wrong of class " << what;
    EXPECT_EQ(first.str(), "");
  }
};

// hull_pair_case makes a pair that fails once more.
TEST_P(HullJudge, FindsNothingWrong) { judge(1, 500); }
TEST_P(HullJudge, FindsNothingWrongInManyPairsSlow) { judge(2, 20000); }

INSTANTIATE_TEST_SUITE_P(All, HullJudge, testing::ValuesIn(narrow_phase_catalogue()),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace hull_judge_test
}  // namespace polhode
