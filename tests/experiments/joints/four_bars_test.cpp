// SPDX-License-Identifier: BSD-3-Clause
// Benchmark A02 of the IFToMM library with 40 squares: 81 bodies and one freedom, through the configuration in which
// all rods lie flat and the equations lose rank.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "tests/experiments/joints/joint_run.hpp"
#include "tests/experiments/joints/reduced_motion.hpp"

namespace polhode::study::joints_tests::four_bars_test {
namespace {

/// n squares in a row of rods of 1 m and 1 kg, as in the scenario `four_bar`. The links are turned by an angle (rad)
/// from upright, and their upper ends move at 1 m/s. Links 0 to n are the first bodies, couplers 0 to n - 1 the next
/// ones.
Problem squares_in_a_row(std::size_t n, double angle) {
  Problem problem;
  ForceParameters weight{"uniform_gravity", {}, {{"acceleration", Vector(0, -9.81, 0)}}};
  const auto rod = [&](const std::string& name, const Vector& inertia, const BodyStart& start) {
    Body body;
    body.name = name;
    body.mass = 1;
    body.inertia = inertia.asDiagonal();
    weight.bodies.push_back(problem.bodies.size());
    problem.bodies.push_back(body);
    problem.starts.push_back(start);
  };
  const auto join = [&](const std::string& name, const char* kind, std::vector<std::size_t> bodies,
                        const Vector& on_first, const Vector& world, const Vector& on_second) {
    ForceParameters of{kind, std::move(bodies), {{"anchor_body", on_first}, {"axis_body", Vector(0, 0, 1)}}};
    of.values["anchor_world"] = world;
    of.values["anchor_body_2"] = on_second;
    problem.joints.push_back({name, of});
  };
  const Vector zero = Vector::Zero(), upper(std::sin(angle), std::cos(angle), 0), speed(upper[1], -upper[0], 0);
  for (std::size_t i = 0; i <= n; ++i) {
    const std::string number = std::to_string(i);
    const auto x = static_cast<double>(i);
    BodyStart start;
    start.position = Vector(x, 0, 0) + upper / 2;
    start.orientation = {std::cos(angle / 2), 0, 0, -std::sin(angle / 2)};
    start.velocity = speed / 2;
    start.angular_velocity = {0, 0, -1};
    rod("link_" + number, {1 / 12.0, 1 / 1200.0, 1 / 12.0}, start);
    join("plane of link " + number, "planar", {i}, zero, zero, zero);
    join("ground " + number, "pin", {i}, {0, -0.5, 0}, {x, 0, 0}, zero);
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::string number = std::to_string(i);
    const std::size_t coupler = n + 1 + i;
    BodyStart start;
    start.position = Vector(static_cast<double>(i) + 0.5, 0, 0) + upper;
    start.velocity = speed;
    rod("coupler_" + number, {1 / 1200.0, 1 / 12.0, 1 / 12.0}, start);
    join("plane of coupler " + number, "planar", {coupler}, zero, zero, zero);
    join("left " + number, "pin", {coupler, i}, {-0.5, 0, 0}, zero, {0, 0.5, 0});
    join("right " + number, "pin", {coupler, i + 1}, {0.5, 0, 0}, zero, {0, 0.5, 0});
  }
  problem.forces.push_back(weight);
  return problem;
}

/// The links' angle from upright after t (s): the n + 1 links turn about their lower ends, the n couplers do not turn,
/// so that 1/2 [(n + 1)/3 + n] φ'² + [(n + 1)/2 + n] g cos φ is constant. φ' is 1 rad/s at φ = 0 and never 0.
double links_after(std::size_t n, double t) {
  const long double links = static_cast<long double>(n + 1), couplers = static_cast<long double>(n);
  const long double pull = 2 * (links / 2 + couplers) * 9.81L / (links / 3 + couplers);
  const auto rate = [&](const Reduced<1>& y) { return Reduced<1>{std::sqrt(1 + pull * (1 - std::cos(y[0])))}; };
  return static_cast<double>(reduced_motion<1>(rate, {0}, static_cast<long double>(t), static_cast<int>(1e4 * t))[0]);
}

/// The reduced motion is that of the published numbers for one square and two.
TEST(FourBars, ReducedMotionIsThePublishedOne) {
  EXPECT_NEAR(std::sin(links_after(1, 10)), 0.478385057760970559, 1e-13);
  EXPECT_NEAR(std::cos(links_after(1, 10)), 0.878150178791209301, 1e-13);
  EXPECT_NEAR(std::sin(links_after(2, 4)), 0.117616102376808612, 1e-13);
  EXPECT_NEAR(std::cos(links_after(2, 4)), 0.993059138451325101, 1e-13);
}

/// Upright, the 81 bodies have one freedom. Flat, each of the 41 links may turn alone, as long as it turns little.
TEST(FourBars, FortySquaresLoseRankWhereTheyLieFlat) {
  const auto rank_at = [](double angle) {
    const auto system = make_system<double>(squares_in_a_row(40, angle), {});
    return system->constraints()->rank(motions_of(*system, system->start().y));
  };
  const ConstraintRank upright = rank_at(0), flat = rank_at(std::numbers::pi / 2);
  EXPECT_EQ(upright.rows, 485u);
  EXPECT_EQ(upright.rank, 485u);
  EXPECT_EQ(flat.rank, 445u);
  EXPECT_FALSE(flat.dependent.empty());
}

/// A whole turn and more, past the two flat configurations. Rounding errors grow there by as much as a step comes close
/// to them: the largest error is 4e-11 m at this step and 4e-9 m at 1 ms.
TEST(FourBars, FortySquaresPassTheirSingularConfigurations) {
  constexpr std::size_t n = 40;
  const double t_end = 1600 * 1.3e-3;
  const End end = run(squares_in_a_row(n, 0), 1.3e-3, t_end);
  const double angle = links_after(n, t_end);
  EXPECT_GT(angle, 2 * std::numbers::pi);
  const Vector upper(std::sin(angle), std::cos(angle), 0);
  double farthest = 0, turned = 0;
  for (std::size_t i = 0; i <= n; ++i) {
    const Vector ground(static_cast<double>(i), 0, 0);
    farthest = std::max(farthest, (end.point(i, {0, -0.5, 0}) - ground).norm());
    farthest = std::max(farthest, (end.point(i, {0, 0.5, 0}) - ground - upper).norm());
    if (i == n) continue;
    const std::size_t coupler = n + 1 + i;
    farthest = std::max(farthest, (end.point(coupler, {-0.5, 0, 0}) - ground - upper).norm());
    turned = std::max(turned, (end.motion(coupler).rotation - Matrix3<double>::Identity()).norm());
  }
  EXPECT_LT(farthest, 1e-9);
  EXPECT_LT(turned, 1e-12);
  EXPECT_LT(end.largest_gap, 1e-12) << "the residuals g of the joints at all steps";
  EXPECT_LT(end.largest_drift, 1e-6) << "J, of 1187 J between highest and lowest";
}

}  // namespace
}  // namespace polhode::study::joints_tests::four_bars_test
