// SPDX-License-Identifier: BSD-3-Clause
// The laws of a mechanical system, in every formulation and on every problem of tests/laws/problems.hpp.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <Eigen/SVD>
#include <cmath>
#include <set>

#include "core/system/concepts.hpp"
#include "core/system/visit_system.hpp"
#include "tests/laws/formulations.hpp"
#include "tests/laws/plain_equations.hpp"
#include "tests/laws/probe_forces.hpp"
#include "tests/laws/problems.hpp"
#include "tests/laws/random_motion.hpp"

namespace polhode::laws::system_law_test {
namespace {

using Real = long double;
using Flat = VectorX<Real>;

// Some time that is not zero: the forces of the catalogue do not read it.
constexpr Real instant = 0.75L;

template <class S>
VectorX<S> rate(const System<S>& system, const VectorX<S>& y) {
  VectorX<S> dy = VectorX<S>::Constant(y.size(), S(7));  // a number that is not written stays 7
  system.rate(S(instant), y.data(), dy.data());
  return dy;
}

/// The largest difference of two vectors, relative to 1 + the largest number of the second.
template <class A, class B>
double difference(const A& a, const B& b) {
  return double((a - b).cwiseAbs().maxCoeff() / (1 + b.cwiseAbs().maxCoeff()));
}

/// d/ds f(y + s dy) at s = 0 by central differences of order four: to about 1e-13 in long double.
template <class F>
auto derivative_along(const F& f, const Flat& y, const Flat& dy) {
  const Real h = 1e-4L;
  const auto at = [&](Real s) { return f(Flat(y + s * dy)); };
  using Value = std::decay_t<decltype(f(y))>;
  return Value((8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h));
}

/// A system in a state of which nothing is special, orientations on the manifold.
struct Instance {
  std::unique_ptr<System<Real>> system;
  Flat y;
};
Instance instance(const Problem& problem, const Formulation& formulation) {
  Instance i{make_system<Real>(problem, formulation), {}};
  i.y = i.system->start().y;
  i.system->project(i.y);
  i.y[i.system->layout().work()] = 0.5L;
  return i;
}

class SystemLaw : public testing::TestWithParam<Formulation> {
 protected:
  /// check(problem) for every problem in several random states.
  template <class Check>
  static void for_every_problem(const Check& check) {
    for (const NamedProblem& named : all_problems()) {
      for (std::uint32_t seed = 1; seed <= 4; ++seed) {
        SCOPED_TRACE(named.name + ", seed " + std::to_string(seed));
        check(moved(named.problem, seed));
      }
    }
  }
};
INSTANTIATE_TEST_SUITE_P(Every, SystemLaw, testing::ValuesIn(all_formulations()),
                         [](const auto& param_info) { return label(param_info.param); });

// y = (configurations, velocities, work): every number has one place.
TEST_P(SystemLaw, LayoutCoversEveryNumberOnce) {
  const int chart = GetParam().orientation == Orientation::quaternion ? 4 : 9;
  for_every_problem([&](const Problem& problem) {
    const auto system = make_system<double>(problem, GetParam());
    const Layout& layout = system->layout();
    ASSERT_EQ(layout.slots.size(), problem.moving());
    std::multiset<int> configuration, velocity;
    for (std::size_t i = 0; i < layout.slots.size(); ++i) {
      const Layout::Slot& s = layout.slots[i];
      EXPECT_EQ(s.position < 0, problem.bodies[i].pinned);
      EXPECT_EQ(s.velocity < 0, problem.bodies[i].pinned);
      for (int k = 0; k < 3 && s.position >= 0; ++k) configuration.insert(s.position + k);
      for (int k = 0; k < chart; ++k) configuration.insert(s.orientation + k);
      for (int k = 0; k < 3 && s.velocity >= 0; ++k) velocity.insert(s.velocity + k);
      for (int k = 0; k < 3; ++k) velocity.insert(s.angular + k);
    }
    std::multiset<int> all = configuration;
    all.insert(velocity.begin(), velocity.end());
    all.insert(layout.work());
    int expected = 0;
    for (const int index : all) EXPECT_EQ(index, expected++);
    EXPECT_EQ(expected, layout.size());
    EXPECT_EQ(int(configuration.size()), layout.configuration_size);
    EXPECT_EQ(int(velocity.size()), layout.velocity_size);
    EXPECT_LT(*configuration.rbegin(), *velocity.begin());
    EXPECT_EQ(system->start().y.size(), layout.size());
  });
}

template <class S>
void expect_halves_agree(const Problem& problem, const Formulation& formulation) {
  const auto erased = make_system<S>(problem, formulation);
  const VectorX<S> start = off_manifold(*erased, erased->start().y, 0.1, 11);
  visit_system(*erased, [&](const auto& system) {
    using FlatOf = typename std::decay_t<decltype(system)>::Flat;
    static_assert(MechanicalSystem<std::decay_t<decltype(system)>>);
    const FlatOf y = start;
    FlatOf whole = system.zero(), velocity = system.zero(), configuration = system.zero();
    system.rate(S(instant), y, whole);
    system.acceleration(S(instant), y, velocity);
    system.configuration_rate(S(instant), y, configuration);
    EXPECT_EQ(system.velocity_part(velocity), system.velocity_part(whole));
    EXPECT_EQ(system.configuration_part(configuration), system.configuration_part(whole));
    EXPECT_EQ(system.work_part(configuration)[0], system.work_part(whole)[0]);
    EXPECT_EQ(rate(*erased, start), VectorX<S>(whole)) << "the erased rate";
    // The halves must write their own half only: methods keep the other.
    EXPECT_TRUE(system.configuration_part(velocity).isZero(0));
    EXPECT_EQ(system.work_part(velocity)[0], S(0));
    EXPECT_TRUE(system.velocity_part(configuration).isZero(0));
  });
}

TEST_P(SystemLaw, RateIsItsTwoHalvesToTheBit) {
  for_every_problem([&](const Problem& problem) {
    expect_halves_agree<float>(problem, GetParam());
    expect_halves_agree<double>(problem, GetParam());
    expect_halves_agree<Real>(problem, GetParam());
  });
}

// The whole meaning of a formulation, on and off the manifold, against the equations as a textbook writes them.
TEST_P(SystemLaw, RateIsThePlainEquations) {
  for_every_problem([&](const Problem& problem) {
    const auto [system, on] = instance(problem, GetParam());
    for (const double distance : {0.0, 1e-3, 0.2}) {
      const Flat y = off_manifold(*system, on, distance, 5);
      EXPECT_LT(difference(rate(*system, y), plain_rate(*system, instant, y)), 2e-17) << "distance " << distance;
      const auto in_double = make_system<double>(problem, GetParam());
      const VectorX<double> yd = y.cast<double>();
      EXPECT_LT(difference(rate(*in_double, yd), plain_rate(*in_double, double(instant), yd)), 5e-14);
    }
  });
}

TEST_P(SystemLaw, MeasurementIsThePlainEquations) {
  for_every_problem([&](const Problem& problem) {
    const auto [system, on] = instance(problem, GetParam());
    for (const double distance : {0.0, 0.2}) {
      const Flat y = off_manifold(*system, on, distance, 5);
      const Measurement<Real> m = system->measure(y);
      const auto bodies = plain_bodies(*system, y);
      const auto motions = plain_motions(*system, y);
      Real kinetic = 0, potential = 0, defect = 0;
      Vector3<Real> linear = Vector3<Real>::Zero(), angular = Vector3<Real>::Zero();
      for (std::size_t i = 0; i < bodies.size(); ++i) {
        const PlainBody<Real>& b = bodies[i];
        const Body& body = problem.bodies[i];
        kinetic += b.kinetic;
        // m × the velocity of the mass centre, of a pinned body too: its orbit about the world's origin.
        const Vector3<Real> p =
            Real(body.mass) *
            (body.pinned ? Vector3<Real>(b.angular_velocity.cross(b.rotation * body.center_of_mass.cast<Real>()))
                         : b.velocity);
        if (!body.pinned) linear += p;
        angular += b.angular_momentum;
        if (bodies.size() > 1) angular += b.position.cross(p);
        const Real* c = y.data() + system->layout().slots[i].orientation;
        const Matrix3<Real> r = plain_rotation(GetParam(), c);
        defect = std::max(defect, GetParam().orientation == Orientation::quaternion
                                      ? std::abs(Eigen::Map<const Quaternion<Real>>(c).norm() - 1)
                                      : (r.transpose() * r - Matrix3<Real>::Identity()).norm());
      }
      for (const auto& force : system->forces()) potential += force->potential_energy(motions);
      EXPECT_NEAR(double(m.kinetic - kinetic), 0, 1e-16 * double(1 + kinetic));
      EXPECT_NEAR(double(m.potential - potential), 0, 1e-16 * double(1 + std::abs(potential)));
      EXPECT_LT(difference(m.linear_momentum, linear), 1e-16);
      EXPECT_LT(difference(m.angular_momentum, angular), 1e-16);
      EXPECT_NEAR(double(m.orientation_defect - defect), 0, 1e-17);
      if (distance > 0) {
        EXPECT_GT(m.orientation_defect, 1e-3L);
      }
    }
  });
}

TEST_P(SystemLaw, SnapshotIsThePlainEquations) {
  for_every_problem([&](const Problem& problem) {
    const auto [system, on] = instance(problem, GetParam());
    for (const double distance : {0.0, 0.2}) {
      const Flat y = off_manifold(*system, on, distance, 5);
      const auto bodies = plain_bodies(*system, y);
      for (std::size_t i = 0; i < bodies.size(); ++i) {
        const PlainBody<Real>& b = bodies[i];
        const BodySnapshot<Real> s = system->snapshot(y, i);
        const Vector3<Real> arm = b.rotation * problem.bodies[i].center_of_mass.cast<Real>();
        EXPECT_LT(difference(s.rotation, b.rotation), 1e-17);
        EXPECT_LT(difference(s.position, b.position + arm), 1e-17);
        EXPECT_LT(difference(s.velocity, b.velocity + b.angular_velocity.cross(arm)), 1e-17);
        EXPECT_LT(difference(s.angular_velocity, b.angular_velocity), 1e-17);
        EXPECT_LT(difference(s.angular_momentum, b.angular_momentum), 1e-17);
        if (GetParam().orientation == Orientation::quaternion) {
          EXPECT_EQ(s.orientation, (Quaternion<Real>(y.segment<4>(system->layout().slots[i].orientation))));
        } else if (distance == 0) {
          EXPECT_NEAR(double(s.orientation.norm()), 1, 1e-17);
          EXPECT_LT(difference(plain_rotation(Formulation{}, s.orientation.data()), b.rotation), 1e-17);
        }
      }
    }
  });
}

// The start of a problem, read back from the state that it makes.
TEST_P(SystemLaw, StartIsTheProblem) {
  for_every_problem([&](Problem problem) {
    for (const bool in_body : {false, true}) {
      for (BodyStart& s : problem.starts) s.angular_velocity_in_body = in_body;
      const auto system = make_system<double>(problem, GetParam());
      const State<double> state = system->start();
      EXPECT_EQ(state.t, 0);
      EXPECT_EQ(state.y[system->layout().work()], 0);
      for (std::size_t i = 0; i < problem.moving(); ++i) {
        const BodyStart& start = problem.starts[i];
        const BodySnapshot<double> s = system->snapshot(state.y, i);
        const Matrix3<double> r = rotation_matrix(start.orientation);
        const Vector3<double> w = in_body ? Vector3<double>(r * start.angular_velocity) : start.angular_velocity;
        const Vector3<double> arm = r * problem.bodies[i].center_of_mass;
        EXPECT_LT(difference(s.angular_velocity, w), 2e-15);
        EXPECT_LT(difference(s.rotation, r), 2e-15);
        EXPECT_LT(difference(s.position, start.position + arm), 1e-15);
        EXPECT_LT(difference(s.velocity, start.velocity + w.cross(arm)), 2e-15);
      }
    }
  });
}

// d(kinetic + potential)/dt is the power of the forces without a potential. The gyroscopic term does no work, so this
// holds without it too.
TEST_P(SystemLaw, EnergyChangesByThePowerOfNonConservativeForces) {
  for_every_problem([&](const Problem& problem) {
    const auto [system, y] = instance(problem, GetParam());
    const Flat dy = rate(*system, y);
    const auto energy = [&s = *system](const Flat& at) {
      const Measurement<Real> m = s.measure(at);
      return Real(m.kinetic + m.potential);
    };
    const Real power = plain_power(*system, instant, y);
    EXPECT_NEAR(double(derivative_along(energy, y, dy) - power), 0, 1e-10 * double(1 + std::abs(energy(y))));
    EXPECT_NEAR(double(dy[system->layout().work()] - power), 0, 1e-17 * double(1 + std::abs(power)))
        << "the work that the method integrates";
  });
}

// dL/dt = torque about the reference point of each body; leaving the gyroscopic term out adds ω × L.
// dp/dt = force.
TEST_P(SystemLaw, MomentaChangeByForceAndTorque) {
  for_every_problem([&](const Problem& problem) {
    const auto [system, y] = instance(problem, GetParam());
    const Flat dy = rate(*system, y);
    const auto wrenches = plain_wrenches(*system, instant, y);
    Vector3<Real> force = Vector3<Real>::Zero();
    for (std::size_t i = 0; i < problem.moving(); ++i) {
      const auto momentum = [&s = *system, i](const Flat& at) {
        return Vector3<Real>(s.snapshot(at, i).angular_momentum);
      };
      Vector3<Real> expected = wrenches[i].torque;
      if (!GetParam().gyroscopic) expected += system->snapshot(y, i).angular_velocity.cross(momentum(y));
      EXPECT_LT(difference(derivative_along(momentum, y, dy), expected), 1e-11);
      if (!problem.bodies[i].pinned) force += wrenches[i].force;
    }
    const auto linear = [&s = *system](const Flat& at) { return Vector3<Real>(s.measure(at).linear_momentum); };
    EXPECT_LT(difference(derivative_along(linear, y, dy), force), 1e-11);
  });
}

// dR/dt = ω* R, and the mass centre moves with its velocity.
TEST_P(SystemLaw, ConfigurationMovesWithTheVelocity) {
  for_every_problem([&](const Problem& problem) {
    const auto [system, y] = instance(problem, GetParam());
    const Flat dy = rate(*system, y);
    for (std::size_t i = 0; i < problem.moving(); ++i) {
      const BodySnapshot<Real> now = system->snapshot(y, i);
      const auto rotation = [&s = *system, i](const Flat& at) { return Matrix3<Real>(s.snapshot(at, i).rotation); };
      const auto position = [&s = *system, i](const Flat& at) { return Vector3<Real>(s.snapshot(at, i).position); };
      EXPECT_LT(difference(derivative_along(rotation, y, dy), star(now.angular_velocity) * now.rotation), 1e-12);
      EXPECT_LT(difference(derivative_along(position, y, dy), now.velocity), 1e-12);
    }
  });
}

// One body in double is an instantiation of its own: the same digits as one among many.
TEST_P(SystemLaw, OneAndManyAgreeToTheBit) {
  const auto fields = [](const System<double>& system, const VectorX<double>& at) {
    const Measurement<double> m = system.measure(at);
    const BodySnapshot<double> s = system.snapshot(at, 0);
    VectorX<double> all(3 + 6 + 12 + 4 + 9);
    all << m.kinetic, m.potential, m.orientation_defect, m.linear_momentum, m.angular_momentum, s.position, s.velocity,
        s.angular_velocity, s.angular_momentum, s.orientation, s.rotation.reshaped();
    return all;
  };
  for (const Problem& start :
       {free_top(), projectile(true), box_on_spring(), box_on_spring(turned_inertia({1, 2, 2.5}, {1, 1, 0, 2}))}) {
    const Problem problem = moved(start, 9);
    Problem with_static = problem;
    with_static.bodies.push_back({.name = "static", .fixed = true});
    with_static.starts.push_back({});
    const auto one = make_system<double>(problem, GetParam()), many = make_system<double>(with_static, GetParam());
    visit_system(*one, [](const auto& system) { EXPECT_TRUE(system.is_one); });
    visit_system(*many, [](const auto& system) { EXPECT_FALSE(system.is_one); });
    EXPECT_EQ(one->start().y, many->start().y);
    VectorX<double> y = off_manifold(*one, one->start().y, 0.1, 3);
    EXPECT_EQ(rate(*one, y), rate(*many, y));
    EXPECT_EQ(fields(*one, y), fields(*many, y));
    VectorX<double> other = y;
    one->project(y);
    many->project(other);
    EXPECT_EQ(y, other);
  }
}

// Methods that are compiled for many bodies alone treat a single body with all its forces, and give its digits.
TEST_P(SystemLaw, TheFormOfManyBodiesIsTheSameSystem) {
  for (const Problem& start : {free_top(), projectile(true), box_on_spring()}) {
    const Problem problem = moved(start, 9);
    const auto one = make_system<double>(problem, GetParam());
    one->add_force(std::make_unique<Shaking<double>>(1));
    const auto form = many_bodies_form(*one);
    ASSERT_EQ(form->forces().size(), one->forces().size());
    EXPECT_EQ(form->forces().back(), one->forces().back());
    EXPECT_EQ(form->start().y, one->start().y);
    const VectorX<double> y = off_manifold(*one, one->start().y, 0.1, 3);
    EXPECT_EQ(rate<double>(*form, y), rate(*one, y));
    EXPECT_EQ(form->measure(y).energy(), one->measure(y).energy());
    EXPECT_EQ(many_bodies_form<double>(*form).get(), form.get()) << "many bodies are that form already";
  }
}

// Each scalar works to its own precision: what is computed from the same numbers differs by round-off, and not by less.
TEST_P(SystemLaw, ScalarsWorkToTheirPrecision) {
  double most_float = 0, most_double = 0;
  for_every_problem([&](const Problem& problem) {
    const auto of_float = make_system<float>(problem, GetParam());
    const auto of_double = make_system<double>(problem, GetParam());
    const auto of_long = make_system<Real>(problem, GetParam());
    const VectorX<float> y = of_float->start().y;
    const Flat exact = rate<Real>(*of_long, y.cast<Real>());
    const double error_float = difference(rate<float>(*of_float, y).cast<Real>(), exact);
    const double error_double = difference(rate<double>(*of_double, y.cast<double>()).cast<Real>(), exact);
    EXPECT_LT(error_float, 3e-6);
    EXPECT_LT(error_double, 5e-15);
    most_float = std::max(most_float, error_float);
    most_double = std::max(most_double, error_double);
  });
  EXPECT_GT(most_float, 1e-9);
  EXPECT_GT(most_double, 1e-18);
}

TEST_P(SystemLaw, ProjectionGivesTheNearestRotationAndTouchesNothingElse) {
  for_every_problem([&](const Problem& problem) {
    const auto [system, on] = instance(problem, GetParam());
    for (const double distance : {1e-9, 1e-3, 0.2}) {
      const Flat before = off_manifold(*system, on, distance, 17);
      Flat after = before;
      system->project(after);
      EXPECT_LT(system->measure(after).orientation_defect, 5e-19L);
      Flat twice = after;
      system->project(twice);
      EXPECT_LT(difference(twice, after), 5e-19);
      Flat rest = after;
      for (const Layout::Slot& slot : system->layout().slots) {
        if (GetParam().orientation == Orientation::quaternion) {
          const Quaternion<Real> q = before.segment<4>(slot.orientation);
          EXPECT_LT(difference(after.segment<4>(slot.orientation), q / q.norm()), 5e-19);
          rest.segment<4>(slot.orientation) = q;
        } else {
          const Matrix3<Real> r = Eigen::Map<const Matrix3<Real>>(before.data() + slot.orientation);
          const Eigen::JacobiSVD<Matrix3<Real>> svd(r, Eigen::ComputeFullU | Eigen::ComputeFullV);
          const Matrix3<Real> polar = svd.matrixU() * svd.matrixV().transpose();
          EXPECT_LT(difference(Eigen::Map<const Matrix3<Real>>(after.data() + slot.orientation), polar), 2e-18);
          rest.segment<9>(slot.orientation) = before.segment<9>(slot.orientation);
        }
      }
      EXPECT_EQ(rest, before) << "only orientations move";
    }
  });
}

TEST_P(SystemLaw, ProjectionChangesTheEnergyWhereTheSystemSaysSo) {
  Real most = 0;
  for_every_problem([&](const Problem& problem) {
    const auto [system, on] = instance(problem, GetParam());
    Flat y = off_manifold(*system, on, 0.05, 23);
    const auto energy = [&s = *system](const Flat& at) {
      return Real(s.measure(at).kinetic + s.measure(at).potential);
    };
    const Real before = energy(y);
    system->project(y);
    const Real change = std::abs(energy(y) - before) / (1 + std::abs(before));
    if (!system->projection_changes_energy()) {
      EXPECT_LT(change, 1e-17L);
    }
    most = std::max(most, change);
  });
  const auto system = make_system<double>(free_top(), GetParam());
  if (system->projection_changes_energy()) {
    EXPECT_GT(most, 1e-4L) << "it never does";
  }
}

// α = dω/dt is the same in all formulations that say the same (with or without the gyroscopic term), at any state.
Vector3<Real> angular_acceleration(const Problem& problem, const Formulation& formulation, std::size_t body) {
  const auto [system, y] = instance(problem, formulation);
  const auto velocity = [&s = *system, body](const Flat& at) {
    return Vector3<Real>(s.snapshot(at, body).angular_velocity);
  };
  return derivative_along(velocity, y, rate(*system, y));
}

TEST(SystemLaws, EveryFormulationGivesTheSameMotion) {
  for (const NamedProblem& named : all_problems()) {
    const std::size_t count = named.problem.bodies.size() * numbers_per_body;
    const auto number = rc::gen::map(rc::gen::inRange(-1000, 1001), [](int k) { return k / 1000.0; });
    EXPECT_TRUE(rc::check("the same α in every formulation: " + named.name, [&] {
      const Problem problem = moved(named.problem, *rc::gen::container<std::vector<double>>(count, number));
      const auto body = *rc::gen::inRange<std::size_t>(0, problem.moving());
      for (const bool gyroscopic : {true, false}) {
        const Vector3<Real> expected = angular_acceleration(problem, {.gyroscopic = gyroscopic}, body);
        for (const Formulation& f : all_formulations()) {
          if (f.gyroscopic != gyroscopic) continue;
          const double error = difference(angular_acceleration(problem, f, body), expected);
          if (error > 1e-11) RC_FAIL(label(f) + " differs by " + std::to_string(error * 1e11) + "e-11");
        }
      }
    }));
  }
}

// The matrix chart has one rotation: what rotation_from says cannot matter.
TEST(SystemLaws, RotationFromMeansNothingToTheMatrixChart) {
  const Problem problem = moved(five_bodies(), 3u);
  Formulation f{.orientation = Orientation::matrix};
  const auto normalized = make_system<double>(problem, f);
  f.rotation_from = RotationFrom::stored;
  const auto stored = make_system<double>(problem, f);
  const VectorX<double> y = off_manifold(*stored, stored->start().y, 0.1, 4);
  EXPECT_EQ(rate(*normalized, y), rate(*stored, y));
}

TEST(SystemLaws, WhatMakesNoSenseIsRefused) {
  for (const Orientation o : {Orientation::quaternion, Orientation::matrix}) {
    EXPECT_THROW(make_system<double>(free_top(), {o, AngularState::momentum_world, false}), std::invalid_argument);
  }
  Problem still = free_top();
  still.bodies[0].fixed = true;
  EXPECT_THROW(make_system<double>(still, {}), std::invalid_argument);
}

TEST(SystemLaws, AForceCanBeRegisteredBeforeARun) {
  const Problem problem = box_on_spring();
  Problem bare = problem;
  bare.forces.clear();
  const auto whole = make_system<double>(problem, {}), built = make_system<double>(bare, {});
  EXPECT_FALSE(built->has_forces());
  for (const ForceParameters& f : problem.forces) built->add_force(make_force<double>(f, bare.bodies));
  EXPECT_TRUE(built->forces_do_work());
  EXPECT_TRUE(built->forces_exert_torques());
  EXPECT_EQ(rate(*built, built->start().y), rate(*whole, whole->start().y));
}

}  // namespace
}  // namespace polhode::laws::system_law_test
