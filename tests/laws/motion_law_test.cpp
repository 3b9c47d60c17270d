// SPDX-License-Identifier: BSD-3-Clause
// The identities of the operations by which methods move a system (core/system/rigid_bodies.hpp): the group step, the
// inertia map, the body's frame, and the two flows of a splitting. Each holds in every formulation, for one body, for
// many, and in lanes.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <string>
#include <vector>

#include "tests/laws/formulations.hpp"
#include "tests/laws/operations.hpp"
#include "tests/laws/plain_equations.hpp"
#include "tests/laws/reference_flow.hpp"

namespace polhode::laws::motion_law_test {
namespace {

using Vector = VectorX<double>;

constexpr double law_instant = 0.75;  // a time at which the shaking force is not zero, s

/// The largest difference of two vectors, relative to 1 + the largest number of the second.
double gap(const Vector& a, const Vector& b) { return (a - b).cwiseAbs().maxCoeff() / (1 + b.cwiseAbs().maxCoeff()); }

/// df/ds at s = 0 by central differences of order four, to about 1e-11 where f varies over s = 1.
template <class F>
Vector slope(const F& f) {
  const double h = 1e-3;
  return (8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h);
}

Vector configuration(const Subject& s, const Vector& y) { return y.head(s.plain->layout().configuration_size); }
/// Velocities and work.
Vector rest(const Subject& s, const Vector& y) { return y.tail(y.size() - s.plain->layout().configuration_size); }
double work(const Vector& y) { return y[y.size() - 1]; }

/// The places of the parts of body i in a tangent vector.
Eigen::Index angular_index(const Subject& s, std::size_t i) {
  return s.plain->layout().slots[i].angular - s.plain->layout().configuration_size;
}
Eigen::Index linear_index(const Subject& s, std::size_t i) {
  return s.plain->layout().slots[i].velocity - s.plain->layout().configuration_size;
}
bool is_pinned(const Subject& s, std::size_t i) { return s.problem.bodies[i].pinned; }

/// Numbers in [−size, size] in place of a tangent vector.
Vector some_tangent(const Subject& s, double size, std::uint32_t seed) {
  const std::vector<double> numbers = random_numbers(std::size_t(s.plain->layout().velocity_size), seed);
  return size * Eigen::Map<const Vector>(numbers.data(), Eigen::Index(numbers.size()));
}

/// The tangent vector with linear(i), angular(i) of each body.
template <class Linear, class Angular>
Vector tangent_of(const Subject& s, const Linear& linear, const Angular& angular) {
  Vector xi = Vector::Zero(s.plain->layout().velocity_size);
  for (std::size_t i = 0; i < s.plain->moving(); ++i) {
    xi.segment<3>(angular_index(s, i)) = angular(i);
    if (!is_pinned(s, i)) xi.segment<3>(linear_index(s, i)) = linear(i);
  }
  return xi;
}

/// (f, τ) of every body as the forces say.
Vector plain_wrench(const Subject& s, double t, const Vector& y) {
  const auto wrenches = plain_wrenches(*s.plain, t, y);
  return tangent_of(
      s, [&](std::size_t i) { return wrenches[i].force; }, [&](std::size_t i) { return wrenches[i].torque; });
}

/// The state with other velocities at the same configuration.
Vector other_velocities(const Subject& s, std::uint32_t seed) {
  Vector y = s.y;
  y.segment(s.plain->layout().configuration_size, s.plain->layout().velocity_size) += some_tangent(s, 1, seed);
  return y;
}

/// The rotation by the rotation vector θ.
Matrix3<double> rotation_by(const Vector3<double>& theta) {
  const double angle = theta.norm();
  return Eigen::AngleAxisd(angle, angle > 0 ? Vector3<double>(theta / angle) : Vector3<double>::UnitX())
      .toRotationMatrix();
}

class MotionLaw : public testing::TestWithParam<Formulation> {
 protected:
  bool in_body() const { return GetParam().angular_state == AngularState::velocity_body; }

  template <class Check>
  void for_every_subject(const Check& check) const {
    for (std::uint32_t seed = 1; seed <= 3; ++seed) {
      for (const Subject& s : subjects(GetParam(), seed)) {
        SCOPED_TRACE(s.name + ", seed " + std::to_string(seed));
        check(s, *s.operations, seed);
      }
    }
  }

  /// Every body turned by exp(θ) on its body's side, or on the world's, and moved by the linear part.
  static void expect_group_step(const Subject& s, const Vector& from, const Vector& to, const Vector& xi, bool body) {
    const auto before = plain_bodies(*s.plain, from), after = plain_bodies(*s.plain, to);
    for (std::size_t i = 0; i < before.size(); ++i) {
      const Matrix3<double> turn = rotation_by(xi.segment<3>(angular_index(s, i)));
      const Matrix3<double>& r = before[i].rotation;
      const Matrix3<double> expected = body ? Matrix3<double>(r * turn) : Matrix3<double>(turn * r);
      EXPECT_LT((after[i].rotation - expected).norm(), 2e-14);
      if (is_pinned(s, i)) continue;
      EXPECT_LT((after[i].position - before[i].position - xi.segment<3>(linear_index(s, i))).norm(), 1e-14);
    }
    EXPECT_EQ(rest(s, to), rest(s, from)) << "configurations alone move";
  }
};
INSTANTIATE_TEST_SUITE_P(Every, MotionLaw, testing::ValuesIn(all_formulations()),
                         [](const auto& param_info) { return label(param_info.param); });

// ---- the flat ODE
// ----------------------------------------------------------------------------------------------------

TEST_P(MotionLaw, RateIsThePlainEquations) {
  for_every_subject([](const Subject& s, const Operations& o, std::uint32_t seed) {
    const Vector y = off_manifold(*s.plain, s.y, 0.1, seed);
    EXPECT_LT(gap(o.rate(law_instant, y), plain_rate(*s.plain, law_instant, y)), 5e-14);
  });
}

// P(P(y)) = P(y), and P(y) = y on the manifold.
TEST_P(MotionLaw, ProjectionIsIdempotentAndLeavesTheManifold) {
  for_every_subject([](const Subject& s, const Operations& o, std::uint32_t seed) {
    EXPECT_LT(gap(o.project(s.y), s.y), 5e-16);
    const Vector once = o.project(off_manifold(*s.plain, s.y, 0.1, seed));
    EXPECT_LT(s.plain->measure(once).orientation_defect, 2e-15);
    EXPECT_LT(gap(o.project(once), once), 5e-16);
    EXPECT_EQ(rest(s, once), rest(s, s.y));
  });
}

// ---- the Lie group
// ---------------------------------------------------------------------------------------------------

// q ⊕ 0 = q, to the bit, off the manifold too.
TEST_P(MotionLaw, RetractByZeroIsTheIdentity) {
  for_every_subject([](const Subject& s, const Operations& o, std::uint32_t seed) {
    const Vector y = off_manifold(*s.plain, s.y, 0.1, seed);
    EXPECT_EQ(o.retract(y, 0 * some_tangent(s, 1, seed)), y);
    EXPECT_EQ(o.retract_in_body(y, 0 * some_tangent(s, 1, seed)), y);
  });
}

// d/ds (q ⊕ s ξ) = q̇ at s = 0 with the twist ξ of the state, off the manifold too.
TEST_P(MotionLaw, RetractAlongTheTwistIsTheKinematicEquation) {
  for_every_subject([](const Subject& s, const Operations& o, std::uint32_t seed) {
    for (const Vector& y : {s.y, off_manifold(*s.plain, s.y, 0.1, seed)}) {
      const Vector xi = o.twist(y);
      const Vector along = slope([&](double part) { return configuration(s, o.retract(y, part * xi)); });
      EXPECT_LT(gap(along, configuration(s, plain_rate(*s.plain, law_instant, y))), 1e-9);
    }
    const Vector in_body = o.body_twist(s.y);
    const Vector along = slope([&](double part) { return configuration(s, o.retract_in_body(s.y, part * in_body)); });
    EXPECT_LT(gap(along, configuration(s, plain_rate(*s.plain, law_instant, s.y))), 1e-9);
  });
}

// q ⊕ ξ = (p + ξ, exp(ξ) R) with ξ in the world's axes, (p + ξ, R exp(ξ)) with ξ in the body's; it stays on the
// manifold, for any ξ.
TEST_P(MotionLaw, RetractIsTheExponential) {
  for_every_subject([&](const Subject& s, const Operations& o, std::uint32_t seed) {
    for (const double size : {1e-9, 1e-2, 1.0, 4.0}) {
      const Vector xi = some_tangent(s, size, seed + 5);
      const Vector moved = o.retract(s.y, xi), moved_in_body = o.retract_in_body(s.y, xi);
      expect_group_step(s, s.y, moved, xi, in_body());
      expect_group_step(s, s.y, moved_in_body, xi, true);
      EXPECT_LT(s.plain->measure(moved).orientation_defect, 3e-15);
      EXPECT_LT(s.plain->measure(moved_in_body).orientation_defect, 3e-15);
    }
  });
}

// With θ̇ = dexp⁻¹_θ η: d/ds (q ⊕ (θ + s θ̇)) = d/ds ((q ⊕ θ) ⊕ s η) at s = 0.
TEST_P(MotionLaw, DexpInverseIsTheRateInTheAlgebra) {
  for_every_subject([](const Subject& s, const Operations& o, std::uint32_t seed) {
    for (const double size : {0.0, 0.04, 0.3, 1.5}) {
      const Vector theta = some_tangent(s, size, seed + 1), eta = some_tangent(s, 1, seed + 2);
      const Vector rate = o.dexp_inverse(theta, eta);
      const Vector there = o.retract(s.y, theta);
      const Vector in_algebra =
          slope([&](double part) { return configuration(s, o.retract(s.y, theta + part * rate)); });
      const Vector in_group = slope([&](double part) { return configuration(s, o.retract(there, part * eta)); });
      EXPECT_LT(gap(in_algebra, in_group), 1e-10) << "|theta| up to " << size;
    }
  });
}

// exp(ε a) exp(ε b) exp(−ε a) exp(−ε b) = exp(ε² [a, b] + O(ε³)), composed on the body's side; translations commute.
TEST_P(MotionLaw, BracketIsTheCommutatorOfGroupSteps) {
  for_every_subject([](const Subject& s, const Operations& o, std::uint32_t seed) {
    const Vector a = some_tangent(s, 1, seed + 1), b = some_tangent(s, 1, seed + 2);
    const double e = 1e-4;
    Vector y = s.y;
    for (const Vector& step : {Vector(e * a), Vector(e * b), Vector(-e * a), Vector(-e * b)}) {
      y = o.retract_in_body(y, step);
    }
    const Vector commutator = (configuration(s, y) - configuration(s, s.y)) / (e * e);
    const Vector bracket = o.bracket(a, b);
    const Vector expected =
        slope([&](double part) { return configuration(s, o.retract_in_body(s.y, part * bracket)); });
    EXPECT_LT(gap(commutator, expected), 1e-3);
    EXPECT_EQ(bracket, Vector(-o.bracket(b, a)));
    for (std::size_t i = 0; i < s.plain->moving(); ++i) {
      const Vector3<double> of_a = a.segment<3>(angular_index(s, i)), of_b = b.segment<3>(angular_index(s, i));
      EXPECT_LT((bracket.segment<3>(angular_index(s, i)) - of_a.cross(of_b)).norm(), 1e-16);
    }
  });
}

// ---- the inertia map
// -------------------------------------------------------------------------------------------------

TEST_P(MotionLaw, WrenchIsThatOfTheForces) {
  for_every_subject([](const Subject& s, const Operations& o, std::uint32_t) {
    EXPECT_LT(gap(o.wrench(law_instant, s.y), plain_wrench(s, law_instant, s.y)), 2e-15);
  });
}

// (m v, R I Rᵀ ω), world axes.
TEST_P(MotionLaw, MomentumIsMassTimesVelocity) {
  for_every_subject([](const Subject& s, const Operations& o, std::uint32_t) {
    const auto bodies = plain_bodies(*s.plain, s.y);
    const Vector expected = tangent_of(
        s, [&](std::size_t i) { return Vector3<double>(s.problem.bodies[i].mass * bodies[i].velocity); },
        [&](std::size_t i) {
          const Matrix3<double>& r = bodies[i].rotation;
          return Vector3<double>(r * s.problem.bodies[i].inertia * r.transpose() * bodies[i].angular_velocity);
        });
    EXPECT_LT(gap(o.momentum(s.y), expected), 1e-14);
  });
}

TEST_P(MotionLaw, SetMomentumIsTheInverseOfMomentum) {
  for_every_subject([](const Subject& s, const Operations& o, std::uint32_t seed) {
    EXPECT_LT(gap(o.set_momentum(o.momentum(s.y), other_velocities(s, seed)), s.y), 1e-14);
    const Vector p = some_tangent(s, 3, seed);
    const Vector y = o.set_momentum(p, s.y);
    EXPECT_LT(gap(o.momentum(y), p), 1e-14);
    EXPECT_EQ(configuration(s, y), configuration(s, s.y));
    EXPECT_EQ(work(y), work(s.y));
  });
}

// ---- the body's frame
// ------------------------------------------------------------------------------------------------

// (v, Rᵀω).
TEST_P(MotionLaw, BodyTwistHasTheAngularVelocityInTheBody) {
  for_every_subject([](const Subject& s, const Operations& o, std::uint32_t) {
    const auto bodies = plain_bodies(*s.plain, s.y);
    const Vector expected = tangent_of(
        s, [&](std::size_t i) { return bodies[i].velocity; },
        [&](std::size_t i) { return Vector3<double>(bodies[i].rotation.transpose() * bodies[i].angular_velocity); });
    EXPECT_LT(gap(o.body_twist(s.y), expected), 1e-14);
  });
}

TEST_P(MotionLaw, SetBodyTwistIsTheInverseOfBodyTwist) {
  for_every_subject([](const Subject& s, const Operations& o, std::uint32_t seed) {
    EXPECT_LT(gap(o.set_body_twist(o.body_twist(s.y), other_velocities(s, seed)), s.y), 1e-14);
    const Vector xi = some_tangent(s, 3, seed);
    const Vector y = o.set_body_twist(xi, s.y);
    EXPECT_LT(gap(o.body_twist(y), xi), 1e-14);
    EXPECT_EQ(configuration(s, y), configuration(s, s.y));
    EXPECT_EQ(work(y), work(s.y));
  });
}

// m v̇ = f and I Ω̇ + Ω × I Ω = Rᵀτ, under any wrench.
TEST_P(MotionLaw, BodyAccelerationIsNewtonAndEuler) {
  for_every_subject([](const Subject& s, const Operations& o, std::uint32_t seed) {
    const Vector wrench = some_tangent(s, 2, seed), rate = o.body_acceleration(s.y, wrench);
    const auto bodies = plain_bodies(*s.plain, s.y);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const Matrix3<double>& inertia = s.problem.bodies[i].inertia;
      const Vector3<double> w = bodies[i].rotation.transpose() * bodies[i].angular_velocity;
      const Vector3<double> torque = bodies[i].rotation.transpose() * wrench.segment<3>(angular_index(s, i));
      const Vector3<double> left = inertia * rate.segment<3>(angular_index(s, i)) + w.cross(inertia * w);
      EXPECT_LT((left - torque).norm(), 1e-13);
      if (is_pinned(s, i)) continue;
      const Vector3<double> force = wrench.segment<3>(linear_index(s, i));
      EXPECT_LT((s.problem.bodies[i].mass * rate.segment<3>(linear_index(s, i)) - force).norm(), 1e-14);
    }
  });
}

// q moves as by retract_in_body, and the momentum in the world grows by the impulse.
TEST_P(MotionLaw, CarryMomentumAddsTheImpulse) {
  for_every_subject([](const Subject& s, const Operations& o, std::uint32_t seed) {
    const Vector theta = some_tangent(s, 0.7, seed), impulse = some_tangent(s, 2, seed + 1);
    const Vector y = o.carry_momentum(theta, impulse, s.y);
    EXPECT_EQ(configuration(s, y), configuration(s, o.retract_in_body(s.y, theta)));
    EXPECT_LT(gap(o.momentum(y), o.momentum(s.y) + impulse), 3e-14);
    EXPECT_EQ(work(y), work(s.y));
  });
}

// ---- the splitting
// ---------------------------------------------------------------------------------------------------

// The momentum grows by h times the wrench, at rest in q.
TEST_P(MotionLaw, KickAddsTheImpulseOfTheWrench) {
  for_every_subject([](const Subject& s, const Operations& o, std::uint32_t seed) {
    const double h = 0.3;
    const Vector y = o.kick(law_instant, h, s.y);
    EXPECT_LT(gap(o.momentum(y), o.momentum(s.y) + h * plain_wrench(s, law_instant, s.y)), 1e-14);
    EXPECT_EQ(configuration(s, y), configuration(s, s.y));
    const Vector seen = other_velocities(s, seed), after = o.kick(law_instant, h, seen, s.y);
    EXPECT_LT(gap(o.momentum(after), o.momentum(s.y) + h * plain_wrench(s, law_instant, seen)), 1e-14);
    EXPECT_EQ(configuration(s, after), configuration(s, s.y));
  });
}

// The work is that of the wrench along the kick: ∫ P(t, q, v(s)) ds by Simpson's rule where the wrench does not depend
// on v, so that v(s) is linear; by the trapezoidal rule where it does. P is that of the state `seen` if one is given.
TEST_P(MotionLaw, KickDoesTheWorkOfTheWrench) {
  for_every_subject([](const Subject& s, const Operations& o, std::uint32_t seed) {
    const double h = 0.3;
    const Vector end = o.kick(law_instant, h, s.y), middle = o.kick(law_instant, h / 2, s.y);
    const auto power = [&](const Vector& y) { return plain_power(*s.plain, law_instant, y); };
    const double expected = s.plain->forces_read_velocity() ? h / 2 * (power(s.y) + power(end))
                                                            : h / 6 * (power(s.y) + 4 * power(middle) + power(end));
    EXPECT_NEAR(work(end) - work(s.y), expected, 2e-13 * (1 + std::abs(expected)));
    const Vector seen = other_velocities(s, seed);
    EXPECT_NEAR(work(o.kick(law_instant, h, seen, s.y)) - work(s.y), h * power(seen),
                2e-13 * (1 + std::abs(power(seen))));
  });
}

// The motion of the same bodies without forces, against extrapolation in long double; momentum and energy stay.
TEST_P(MotionLaw, FreeFlowIsTheMotionWithoutForces) {
  for_every_subject([&](const Subject& s, const Operations& o, std::uint32_t) {
    if (!o.has_free_flow()) return;
    const double h = 0.2;
    const Vector y = o.free_flow(h, s.y);
    EXPECT_LT(gap(o.momentum(y), o.momentum(s.y)), 3e-14);
    EXPECT_EQ(work(y), work(s.y));
    Problem free = s.problem;
    free.forces.clear();
    Formulation formulation = GetParam();
    formulation.gyroscopic = true;
    const auto system = make_system<long double>(free, formulation);
    const VectorX<long double> start = s.y.cast<long double>(), end = y.cast<long double>();
    EXPECT_NEAR(double(system->measure(end).energy() - system->measure(start).energy()), 0,
                1e-13 * double(1 + system->measure(start).energy()));
    const VectorX<long double> expected = reference_flow(*system, start, 0, h, 32);
    EXPECT_LT(gap(y, expected.cast<double>()), 5e-14);
  });
}

}  // namespace
}  // namespace polhode::laws::motion_law_test
