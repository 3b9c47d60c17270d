// SPDX-License-Identifier: BSD-3-Clause
// Jointed scenarios against motions known in closed form, by quadrature, or in extended precision by two formulations.
// The numbers are those of the sources that the scenario files name.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/exact/exact_motion.hpp"
#include "tests/experiments/joints/joint_run.hpp"

namespace polhode::study::joints_tests::joint_truth_test {
namespace {

TEST(JointTruth, PendulumOnARod) {
  const End end = run("rod_pendulum", 1e-3, 10);
  EXPECT_NEAR(end.point(0, Vector::Zero())[0], -0.27508746257611686, 1e-9);
  EXPECT_NEAR(end.point(0, Vector::Zero())[1], -0.961419205099125064, 1e-9);
  EXPECT_NEAR(reaction(end, 0).norm(), 28.29456720606725, 1e-7);
  EXPECT_LT(end.largest_gap, 1e-13);
  EXPECT_LT(end.largest_drift, 5e-5) << "the limit of the benchmark library";
}

TEST(JointTruth, TensionPointsAlongTheRodTowardsTheWorld) {
  const End end = run("rod_pendulum", 1e-3, 10);
  const Vector force = reaction(end, 0), towards = -end.point(0, Vector::Zero());
  EXPECT_NEAR(force.normalized().dot(towards.normalized()), 1, 1e-12);
}

TEST(JointTruth, HeavyTopOnABallJoint) {
  const End end = run("ball_joint_top", 1e-4, 1);
  EXPECT_LT(
      (end.point(0, Vector::Zero()) - Vector(0.173343964098386043, 0.640088592070568783, -0.748490791133581309)).norm(),
      1e-9);
  EXPECT_LT((reaction(end, 0) - Vector(-517.6007394769, -396.8431014895542, 404.5749251628847)).norm(), 1e-5);
}

TEST(JointTruth, ReactionOfTheTopAtItsStart) {
  End end = run("ball_joint_top", 1e-4, 1e-4);
  end.state = end.system->start();
  EXPECT_LT((reaction(end, 0) - Vector(0, -319.525988166, -317.2624615384615)).norm(), 1e-8);
}

/// The jointed top and the pinned one are two formulations of one motion.
TEST(JointTruth, PinnedAndJointedTopAgree) {
  const Problem jointed = problem_of("ball_joint_top");
  Problem pinned = jointed;
  pinned.joints.clear();
  Body& body = pinned.bodies[0];
  body.pinned = true;
  body.center_of_mass = Vector(0, 1, 0);
  body.inertia += body.mass * Vector(1, 0, 1).asDiagonal().toDenseMatrix();
  pinned.starts[0].position.setZero();
  const auto at_end = [](const Problem& problem) {
    Formulation f{.angular_state = AngularState::velocity_body};
    f.joints.stabilization = Stabilization::both;
    const auto system = make_system<double>(problem, f);
    const auto method = find_integrator("odeint_fehlberg78")->make(*system, {.tolerance = 1e-13, .t_end = 0.1});
    State<double> state = system->start();
    Observer nothing;
    Schedule schedule;
    schedule.t_end = 0.1;
    schedule.adaptive = true;
    simulate<double>(*system, *system, *method, state, schedule, nothing);
    return system->snapshot(state.y, 0);
  };
  const auto a = at_end(jointed), b = at_end(pinned);
  EXPECT_LT((a.position - b.position).norm(), 1e-10);
  EXPECT_LT((a.position - Vector(0.421296658925402044, 0.894571974345592991, -0.149164700561899612)).norm(), 1e-10);
  EXPECT_LT(angle_between(a.orientation, b.orientation), 1e-10);
}

TEST(JointTruth, FourBarThroughItsSingularConfiguration) {
  const End one = run("four_bar", 1e-3, 10);
  EXPECT_LT((one.point(0, {0, 0.5, 0}) - Vector(0.478385057760970559, 0.878150178791209301, 0)).norm(), 1e-8);
  const End two = run("two_four_bars", 1e-3, 4);
  EXPECT_LT((two.point(0, {0, 0.5, 0}) - Vector(0.117616102376808612, 0.993059138451325101, 0)).norm(), 1e-8);
  EXPECT_LT(two.largest_gap, 1e-13);
}

TEST(JointTruth, BricardsMechanismWithDependentEquations) {
  const End end = run("bricard", 1e-3, 1);
  EXPECT_LT(
      (end.point(1, {0, -0.5, 0}) - Vector(0.274481319264623041217, -0.886707938734672018281, -0.462330002687376038074))
          .norm(),
      1e-8);
  const ConstraintRank rank = end.system->constraints()->rank(motions_of(*end.system, end.state.y));
  EXPECT_EQ(rank.rows, 30u);
  EXPECT_EQ(rank.rank, 29u);
  EXPECT_FALSE(rank.dependent.empty());
}

TEST(JointTruth, DoublePendulum) {
  const End end = run("double_pendulum", 2e-4, 2);
  // Angles from downward at 2 s.
  const double upper = -0.082758306820570847, lower = 0.407362074911907234;
  const Vector elbow(std::sin(upper), -std::cos(upper), 0), tip = elbow + Vector(std::sin(lower), -std::cos(lower), 0);
  EXPECT_LT((end.point(0, {0.5, 0, 0}) - elbow).norm(), 1e-8);
  EXPECT_LT((end.point(1, {0.5, 0, 0}) - tip).norm(), 1e-8);
}

TEST(JointTruth, DiskThatRolls) {
  for (const AngularState state :
       {AngularState::velocity_world, AngularState::velocity_body, AngularState::momentum_world}) {
    const End end = run("rolling_disk", 5e-4, 1, Stabilization::both, state);
    EXPECT_LT((end.point(0, Vector::Zero()) - Vector(2.777198908942067, 3.235529398577041, 0.6922818752022209)).norm(),
              1e-8);
  }
}

TEST(JointTruth, SqueezerAnglesRatesAndMultipliers) {
  const End end = run("squeezer", 1e-5, 0.03);
  const double beta = 15.8107711951537070971, theta = -15.7563710584118394697, gamma = 0.0408222401196458048583,
               phi = -0.534730116342079593770, delta = 0.524409965879954069372, epsilon = 1.04808074104193787307;
  const double angles[] = {beta, beta + theta, gamma, phi + delta, delta, -phi + epsilon, epsilon};
  const double rates[] = {1139.92030225910606420,  1139.92030225910606420 - 1424.37929517754007320,
                          11.0329119106185937453,  19.2933741050320408316 + 0.573569914829502453818,
                          0.573569914829502453818, -19.2933741050320408316 + 0.323179149249130874991,
                          0.323179149249130874991};
  for (std::size_t i = 0; i < 7; ++i) {
    SCOPED_TRACE(i + 1);
    const BodyMotion<double> m = end.system->motion_of(end.state.y, i);
    const double angle = std::atan2(m.rotation(1, 0), m.rotation(0, 0));
    EXPECT_NEAR(std::remainder(angle - angles[i], 2 * std::numbers::pi), 0, 1e-8);
    EXPECT_NEAR(m.angular_velocity[2], rates[i], 1e-6);
  }
  // The multipliers of the source are the forces at the point where three bodies meet.
  const std::pair<const char*, Vector> multipliers[] = {
      {"k3 at P", {199.175348104538628186, -29.7553099749717633244, 0}},
      {"k4 at P", {23.0665436116221511286, 31.4527252757711370754, 0}},
      {"k6 at P", {22.6424947863943785777, 11.6173923526112559068, 0}}};
  for (const auto& [name, force] : multipliers) {
    SCOPED_TRACE(name);
    std::size_t joint = 0;
    while (end.system->constraints()->name(joint) != name) ++joint;
    EXPECT_LT((reaction(end, joint) - force).norm(), 1e-6);
  }
  EXPECT_LT(end.largest_gap, 1e-13);
}

TEST(JointTruth, GovernorOnStiffSprings) {
  const End end = run("governor", 2e-5, 1);
  EXPECT_NEAR(end.point(1, Vector::Zero())[2], 0.5014209223795676507, 1e-8);
  const double start = end.system->measure(end.system->start().y).angular_momentum[2];
  EXPECT_NEAR(end.system->measure(end.state.y).angular_momentum[2], start, 1e-9 * start)
      << "the bearing exerts no torque about its axis";
}

/// Rods of 1 kg and 1 m that hang from each other by ball joints, with a ball at the end of the last one; turned from
/// the vertical by angles (rad) about y.
Problem hanging_chain(const std::vector<double>& angles, double ball) {
  Problem problem;
  ForceParameters gravity{"uniform_gravity", {}, {{"acceleration", Vector(0, 0, -9.81)}}};
  Vector joint = Vector::Zero();
  const std::size_t n = angles.size();
  for (std::size_t i = 0; i < n; ++i) {
    const double m = i + 1 == n ? ball : 0, center = (0.5 + m) / (1 + m);  // mass centre from the upper end
    const double across = 1.0 / 12 + (center - 0.5) * (center - 0.5) + m * (1 - center) * (1 - center);
    Body rod;
    rod.name = "rod" + std::to_string(i);
    rod.mass = 1 + m;
    rod.inertia = Vector(across, across, 1e-3).asDiagonal();
    BodyStart start;
    start.orientation = {std::cos(angles[i] / 2), 0, std::sin(angles[i] / 2), 0};
    const Vector down(-std::sin(angles[i]), 0, -std::cos(angles[i]));
    start.position = joint + center * down;
    joint += down;
    const double above = i == 0 ? 0 : 0.5 - 1;  // all but the last one have their mass centre in the middle
    ForceParameters ends{"ball",
                         {i},
                         {{"anchor_body", Vector(0, 0, center)},
                          {"anchor_world", Vector(0, 0, 0)},
                          {"anchor_body_2", Vector(0, 0, above)}}};
    if (i > 0) ends.bodies.push_back(i - 1);
    problem.joints.push_back({"joint" + std::to_string(i), ends});
    problem.bodies.push_back(rod);
    problem.starts.push_back(start);
    gravity.bodies.push_back(i);
  }
  problem.forces.push_back(gravity);
  return problem;
}

TEST(JointTruth, JointsOfAChainCarryWhatHangsBelow) {
  for (const double ball : {0.0, 1.0, 100.0, 1e4}) {
    const Problem problem = hanging_chain(std::vector<double>(10, 0.0), ball);
    End end{make_system<double>(problem, {}), {}, {}};
    end.state = end.system->start();
    for (std::size_t k = 0; k < 10; ++k) {
      const double carried = (ball + 10 - static_cast<double>(k)) * 9.81;
      EXPECT_LT((reaction(end, k) - Vector(0, 0, carried)).norm(), 1e-9 + 1e-11 * carried) << ball << " " << k;
    }
  }
}

/// The frequencies of small swings, from the angular accelerations at rest in turned positions.
TEST(JointTruth, FrequenciesOfAChain) {
  const auto frequencies = [](std::size_t n, double ball) {
    constexpr double turn = 3e-4;
    Eigen::MatrixXd stiffness(n, n);
    const auto accelerations = [&](std::size_t j, double angle) {
      std::vector<double> angles(n, 0.0);
      angles[j] = angle;
      const auto system = make_system<double>(hanging_chain(angles, ball), {});
      const VectorX<double> y = system->start().y;
      VectorX<double> dy(y.size());
      system->rate(0, y.data(), dy.data());
      Eigen::VectorXd all(n);
      for (std::size_t i = 0; i < n; ++i) all[Eigen::Index(i)] = dy[system->layout().slots[i].angular + 1];
      return all;
    };
    // Central differences, extrapolated twice: an error of the order turn⁶.
    for (std::size_t j = 0; j < n; ++j) {
      const auto slope = [&](double angle) -> Eigen::VectorXd {
        return (accelerations(j, angle) - accelerations(j, -angle)) / (2 * angle);
      };
      const Eigen::VectorXd coarse = slope(4 * turn), middle = slope(2 * turn), fine = slope(turn);
      stiffness.col(Eigen::Index(j)) = -(64 * fine - 20 * middle + coarse) / 45;
    }
    const Eigen::VectorXd squares = stiffness.eigenvalues().real();
    std::vector<double> found;
    for (const double square : squares) found.push_back(std::sqrt(square));
    std::sort(found.begin(), found.end());
    return found;
  };
  const std::vector<double> two = frequencies(2, 0), free = frequencies(10, 0), loaded = frequencies(10, 100);
  EXPECT_NEAR(two[0], std::sqrt((3 - 6 / std::sqrt(7.0)) * 9.81), 1e-8);
  EXPECT_NEAR(two[1], std::sqrt((3 + 6 / std::sqrt(7.0)) * 9.81), 1e-8);
  EXPECT_NEAR(free[0], 1.1912959338622340, 1e-8);
  EXPECT_NEAR(free[1], 2.7601376236998327, 1e-8);
  EXPECT_NEAR(free[9], 26.637701525004112, 1e-8);
  EXPECT_NEAR(loaded[0], 0.99831361610755684, 1e-8);
  EXPECT_NEAR(loaded[1], 10.220296787948910, 1e-8);
  EXPECT_NEAR(loaded[9], 107.28836927818960, 1e-8);
}

/// Without stabilization the joints drift open, and the ledger books the work that their reactions then do.
TEST(JointTruth, LedgerClosesWithTheWorkOfTheJoints) {
  for (const Stabilization s : {Stabilization::none, Stabilization::baumgarte, Stabilization::position,
                                Stabilization::velocity, Stabilization::both}) {
    SCOPED_TRACE(name(s));
    const Problem problem = problem_of("double_pendulum");
    const auto drift = [&](double dt) {
      Formulation f;
      f.joints = {.stabilization = s};
      if (s == Stabilization::baumgarte) f.joints.alpha = f.joints.beta = 20;
      End end{make_system<double>(problem, f), {}, {}};
      end.state = end.system->start();
      const auto method = find_integrator("rk4")->make(*end.system, {.dt = dt});
      Watch watch(end);
      Schedule schedule;
      schedule.t_end = 2;
      schedule.dt = dt;
      simulate<double>(*end.system, *end.system, *method, end.state, schedule, watch);
      return std::pair(end.largest_drift, std::abs(end.last.joint_work) + std::abs(end.last.projection));
    };
    const auto [coarse, unused] = drift(0.01);
    const auto [fine, put_in] = drift(0.0025);
    EXPECT_GT(std::log(coarse / fine) / std::log(4.0), 3.5) << "closes to the method's order";
    EXPECT_GT(put_in, 1e-9) << "and something was booked";
  }
}

/// The exact motions of jointed bodies agree with accurate runs.
TEST(JointTruth, ExactMotionsOfJointedBodies) {
  for (const char* scenario : {"rod_pendulum", "ball_joint_top"}) {
    const End end = run(scenario, 1e-4, 1);
    const ExactMotion exact(*end.system);
    ASSERT_TRUE(exact.is_complete()) << scenario;
    const ExactMotion::Error error = exact.error(*end.system, end.state);
    EXPECT_LT(*error.position, 1e-9) << scenario;
    EXPECT_LT(*error.attitude, 5e-9) << scenario;
  }
  EXPECT_FALSE(ExactMotion(*make_system<double>(problem_of("double_pendulum"), {})).has_anything());
}

}  // namespace
}  // namespace polhode::study::joints_tests::joint_truth_test
