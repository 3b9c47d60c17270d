// SPDX-License-Identifier: BSD-3-Clause
// Penalty and augmented Lagrangian, and projections in two metrics, by hand along a vertical line of rods.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "core/system/constraints.hpp"
#include "core/system/joint_projection.hpp"
#include "core/system/system.hpp"
#include "tests/laws/problems.hpp"

namespace polhode::soft_joints_test {
namespace {

Formulation treated(Stabilization s, double alpha = 0, double beta = 0, double penalty = 0) {
  Formulation f;
  f.joints = {.stabilization = s, .alpha = alpha, .beta = beta, .penalty = penalty};
  return f;
}

double upward_acceleration(const Problem& problem, const Formulation& f, std::size_t body) {
  const auto system = make_system<double>(problem, f);
  const State<double> start = system->start();
  VectorX<double> rate(start.y.size());
  system->rate(0.0, start.y.data(), rate.data());
  return rate[system->layout().slots[body].velocity + 2];
}

// One rod of 2 kg: g = 0.01 m, G v = 0.3 m/s; λ/a + λ/m = −(−9.81) − 2·5·0.3 − 49·0.01 with a = 3 m.
TEST(SoftJoints, PenaltyLeavesAShareOfTheAcceleration) {
  const Problem one = laws::hanging_rods({2}, {-0.01}, {0.3});
  const double wanted = -2 * 5 * 0.3 - 49 * 0.01, lambda = (9.81 + wanted) / (1 / 2.0 + 1 / 6.0);
  EXPECT_NEAR(upward_acceleration(one, treated(Stabilization::penalty, 5, 7, 3), 0), -9.81 + lambda / 2, 1e-12);
  EXPECT_NEAR(upward_acceleration(one, treated(Stabilization::augmented_lagrangian, 5, 7, 3), 0), wanted, 1e-12);
  EXPECT_NEAR(upward_acceleration(one, treated(Stabilization::baumgarte, 5, 7), 0), wanted, 1e-12);
}

// The gaps that are left fall as 1/a.
TEST(SoftJoints, PenaltyIsOfFirstOrderInItsInverse) {
  const Problem rods = laws::hanging_rods({1, 4, 2}, {0, 0, 0}, {0, 0, 0});
  const double at_1e4 = upward_acceleration(rods, treated(Stabilization::penalty, 0, 0, 1e4), 2);
  const double at_1e5 = upward_acceleration(rods, treated(Stabilization::penalty, 0, 0, 1e5), 2);
  EXPECT_NEAR(at_1e4 / at_1e5, 10, 0.01);
  EXPECT_LT(at_1e4, -1e-5);
}

// Two equal joints in one place have one redundant row each: no rank is computed, and each carries a half.
TEST(SoftJoints, DependentJointsShareTheLoad) {
  Problem twice = laws::hanging_rods({2}, {0}, {0});
  twice.joints.push_back(twice.joints.front());
  twice.joints.back().name = "again";
  for (const auto s : {Stabilization::penalty, Stabilization::augmented_lagrangian}) {
    const auto system = make_system<double>(twice, treated(s, 0, 0, 1e7));
    const State<double> start = system->start();
    VectorX<double> rate(start.y.size());
    system->rate(0.0, start.y.data(), rate.data());
    const VectorX<double> lambda = system->constraints()->multipliers();
    EXPECT_NEAR(lambda[2], 9.81, 1e-5);
    EXPECT_NEAR(lambda[5], 9.81, 1e-5);
  }
}

// A joint between 1 kg and 1000 kg, open by 1 mm: in the metric of the masses the light rod closes it, in the unit
// metric both go half of the way. The joint with the world is closed by the upper rod alone.
TEST(ProjectionMetrics, MassesDecideWhoMoves) {
  Problem two = laws::hanging_rods({1, 1000}, {0, 1e-3}, {0, 0});
  two.joints.erase(two.joints.begin());
  two.starts[1].velocity.z() = -0.5;
  for (const auto metric : {ProjectionMetric::mass, ProjectionMetric::unit}) {
    Formulation f = treated(Stabilization::both);
    f.joints.metric = metric;
    const double share = metric == ProjectionMetric::mass ? 1000.0 / 1001 : 0.5;  // share of the upper rod
    const auto system = make_system<double>(two, f);
    VectorX<double> y = system->start().y;
    project_joints(*system, y);
    EXPECT_NEAR(system->motion_of(y, 0).position.z(), -0.5 - share * 1e-3, 1e-14);
    EXPECT_NEAR(system->motion_of(y, 1).position.z(), -1.501 + (1 - share) * 1e-3, 1e-14);
    EXPECT_NEAR(system->motion_of(y, 0).velocity.z(), -share * 0.5, 1e-13);
    EXPECT_NEAR(system->motion_of(y, 1).velocity.z(), -0.5 + (1 - share) * 0.5, 1e-13);
  }
}

// A change of velocities that is orthogonal in the unit metric is a combination of the rows: for a turned rod at a ball
// joint the turn is the lever times the shift.
TEST(ProjectionMetrics, UnitMetricMovesAlongTheRows) {
  Problem p = laws::jointed_rods();
  Formulation f = treated(Stabilization::velocity);
  f.joints.metric = ProjectionMetric::unit;
  p.starts[0].velocity += Vector3<double>(0.1, -0.2, 0.3);
  p.starts[1].angular_velocity += Vector3<double>(0.4, 0.1, -0.3);
  const auto system = make_system<double>(p, f);
  const VectorX<double> before = system->start().y;
  VectorX<double> y = before;
  project_joints(*system, y);
  const auto then = motions_of(*system, before), now = motions_of(*system, y);
  const Constraints<double>& joints = *system->constraints();
  joints.evaluate(now);
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(Eigen::Index(joints.rows()), 12);
  Eigen::VectorXd change(12), unit(12);
  std::vector<Wrench<double>> twists(2);
  VectorX<double> column;
  for (std::size_t i = 0; i < 2; ++i) {
    const Eigen::Index at = 6 * Eigen::Index(i);
    change.segment<3>(at) = now[i].velocity - then[i].velocity;
    change.segment<3>(at + 3) = now[i].angular_velocity - then[i].angular_velocity;
    for (Eigen::Index k = 0; k < 6; ++k) {
      twists.assign(2, {});
      (k < 3 ? twists[i].force[k] : twists[i].torque[k - 3]) = 1;
      joints.multiply(twists, column);
      rows.col(at + k) = column;
    }
  }
  const Eigen::VectorXd lambda = (rows * rows.transpose()).llt().solve(rows * change);
  EXPECT_GT(change.norm(), 0.1);
  EXPECT_LT((change - rows.transpose() * lambda).norm(), 1e-12);
  for (std::size_t j = 0; j < joints.count(); ++j) EXPECT_LT(joints.violation(j, now).velocity, 1e-13);
}

}  // namespace
}  // namespace polhode::soft_joints_test
