// SPDX-License-Identifier: BSD-3-Clause
// The Lie group methods: published figures, convergence far from the identity, what free bodies keep, stiff steps.
#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "tests/integrators/motion.hpp"

namespace polhode::by_hand::lie_group_test {
namespace {

const std::vector<std::string> lie_methods = {"lie_euler", "crouch_grossman3", "rkmk4",    "commutator_free4",
                                              "buss2",     "lie_midpoint",     "simo_wong"};

// Hairer & Vilmart 2006, |Δy| at t = 10 with h = 0.05 and the body angular velocity as state, to 1 %; Lie–Euler with
// the coadjoint action, that is, with the world momentum. (The rows of the textbook methods:
// rotation_closed_form_test.cpp.)
TEST(HairerVilmart, ErrorsOfLieMethods) {
  const auto error = [](const char* method, const Formulation& f) {
    Motion run(method, hairer_vilmart(), f);
    run.steps(0.05, 200);
    return (run.body_momentum() - hairer_vilmart_end).norm();
  };
  for (const Orientation o : {Orientation::quaternion, Orientation::matrix}) {
    const Formulation body{o, AngularState::velocity_body}, momentum{o, AngularState::momentum_world};
    EXPECT_NEAR(error("lie_euler", momentum) / 8.080e-1, 1, 0.01);
    EXPECT_NEAR(error("lie_midpoint", body) / 6.558e-3, 1, 0.01);
  }
}

// Methods that carry the momentum are the same in every formulation.
TEST(HairerVilmart, MomentumMethodsDoNotSeeTheFormulation) {
  for (const std::string method : {"buss2", "lie_midpoint", "simo_wong"}) {
    Motion first(method, hairer_vilmart(), {});
    first.steps(0.05, 200);
    for (const Formulation& f : laws::gyroscopic_formulations()) {
      Motion run(method, hairer_vilmart(), f);
      run.steps(0.05, 200);
      EXPECT_LT((run.body_momentum() - first.body_momentum()).norm(), 1e-12) << method << ", " << laws::label(f);
      EXPECT_LT(angle_between(run.body().orientation, first.body().orientation), 1e-12) << method;
    }
  }
}

// Buss 2000: R' = exp(h ω + h²/2 α + h³/12 α × ω) R with α = R I⁻¹ Rᵀ (τ − ω × L), all in the world.
TEST(Buss2, TurnsAsThePaperWrites) {
  const double h = 0.1;
  for (const Problem& p : {laws::free_top(), laws::heavy_top()}) {
    for (const Formulation& f : laws::gyroscopic_formulations()) {
      Motion run("buss2", p, f);
      const BodySnapshot<double> start = run.body();
      const Body& body = p.bodies[0];
      const V3 w = start.angular_velocity;
      const V3 torque = p.forces.empty()
                            ? V3(V3::Zero())
                            : V3((start.rotation * body.center_of_mass).cross(V3(0, 0, -9.81 * body.mass)));
      const Matrix3<double> inverse = start.rotation * body.inertia.inverse() * start.rotation.transpose();
      const V3 a = inverse * (torque - w.cross(start.angular_momentum));
      const V3 turn = h * w + h * h / 2 * a + h * h * h / 12 * a.cross(w);
      run.steps(h);
      const Quaternion<double> end = product(quaternion_from_rotation_vector<double>(turn), start.orientation);
      EXPECT_LT(angle_between(run.body().orientation, end), 1e-14) << laws::label(f);
    }
  }
}

// The order in y and in the attitude, which both charts and all frames must give, from an attitude far from the
// identity, over some five turns. A product of exponentials in the wrong order shows here.
TEST(LieMethods, ConvergeFarFromTheIdentity) {
  const Quaternion<double> start = quaternion_from_rotation_vector<double>(V3(-1.7, 2.1, 1.2));
  Problem p = hairer_vilmart();
  p.starts[0].orientation = start;
  const Quaternion<double> end = product(start, hairer_vilmart_turn);
  const auto declared = [](const std::string& method) { return double(find_integrator(method)->declaration.order); };
  for (const std::string& method : lie_methods) {
    for (const Formulation& f : laws::gyroscopic_formulations()) {
      SCOPED_TRACE(method + ", " + laws::label(f));
      double momentum = 0, attitude = 0;
      const int coarse = declared(method) > 1 ? 1200 : 6400;
      for (const int n : {coarse, 2 * coarse}) {
        Motion run(method, p, f);
        run.steps(10.0 / n, n);
        const double dy = (run.body_momentum() - hairer_vilmart_end).norm();
        const double dq = angle_between(run.body().orientation, end);
        if (momentum > 0) {
          EXPECT_NEAR(std::log2(momentum / dy), declared(method), 0.25) << dy;
          EXPECT_NEAR(std::log2(attitude / dq), declared(method), 0.25) << dq;
        }
        momentum = dy;
        attitude = dq;
      }
    }
  }
}

TEST(LieMethods, StayOnTheManifold) {
  const double round_off = std::numeric_limits<double>::epsilon();
  for (const IntegratorEntry& entry : integrator_catalogue()) {
    if (!entry.declaration.lie_group) continue;
    for (const Formulation& f : accepted(entry, laws::heavy_top())) {
      Motion run(entry.declaration.name, laws::heavy_top(), f);
      run.steps(1e-3, 10000);
      EXPECT_LT(run.measure().orientation_defect, 10000 * 5 * round_off)
          << entry.declaration.name << ", " << laws::label(f);
    }
  }
}

/// The largest relative drifts of a free top over 10⁴ steps that are not small.
struct Drifts {
  double energy = 0, momentum = 0, casimir = 0;
};
Drifts free_drifts(const std::string& method, const Formulation& f) {
  Motion run(method, laws::free_top(), f);
  const double e = run.energy();
  const V3 l = run.body().angular_momentum;
  Drifts most;
  for (int k = 0; k < 20; ++k) {
    run.steps(0.05, 500);
    most.energy = std::max(most.energy, std::abs(run.energy() / e - 1));
    most.momentum = std::max(most.momentum, (run.body().angular_momentum - l).norm() / l.norm());
    most.casimir = std::max(most.casimir, std::abs(run.body_momentum().norm() / l.norm() - 1));
  }
  return most;
}

const std::vector<std::string> ours = {"lie_euler",     "crouch_grossman3", "rkmk4",      "commutator_free4",
                                       "buss2",         "lie_midpoint",     "simo_wong",  "semi_implicit_euler_exp",
                                       "heun",          "velocity_verlet",  "recipe_ode", "recipe_bullet",
                                       "recipe_simbody"};

// Declared quantities are kept to round-off in every formulation, and others are lost in one of them.
TEST(LieMethods, KeepOfFreeBodiesWhatTheyDeclare) {
  const double round_off = 5e-12, seen = 1e-9;
  for (const std::string& method : ours) {
    const IntegratorEntry& entry = *find_integrator(method);
    Drifts most;
    for (const Formulation& f : accepted(entry, laws::free_top())) {
      const Drifts d = free_drifts(method, f);
      most.energy = std::max(most.energy, d.energy);
      most.momentum = std::max(most.momentum, d.momentum);
      most.casimir = std::max(most.casimir, d.casimir);
    }
    const Declaration& d = entry.declaration;
    EXPECT_TRUE(d.conserves_energy ? most.energy < round_off : most.energy > seen) << method << ' ' << most.energy;
    EXPECT_TRUE(d.conserves_momentum ? most.momentum < round_off : most.momentum > seen)
        << method << ' ' << most.momentum;
    EXPECT_TRUE(d.conserves_casimir ? most.casimir < round_off : most.casimir > seen) << method << ' ' << most.casimir;
  }
}

// A step of h and one of −h return to the start where that is declared, and nowhere else.
TEST(LieMethods, AreSymmetricWhereTheyDeclareIt) {
  const double h = 0.05;
  for (const std::string& method : ours) {
    const IntegratorEntry& entry = *find_integrator(method);
    double most = 0;
    for (const Problem& p : {laws::free_top(), laws::box_on_spring(), laws::heavy_top(), laws::five_bodies()}) {
      for (const Formulation& f : accepted(entry, p)) {
        Motion run(method, p, f);
        const VectorX<double> start = run.state().y;
        run.steps(h);
        run.steps(-h);
        most = std::max(most, (run.state().y - start).cwiseAbs().maxCoeff());
      }
    }
    EXPECT_TRUE(entry.declaration.symmetric ? most < 1e-12 : most > 1e-9) << method << ' ' << most;
  }
}

/// The canonical two-form of T*SO(3) in the world's frame, of two variations (θ, δL) at angular momentum L.
using Six = Eigen::Matrix<long double, 6, 6>;
Six two_form(const Vector3<long double>& l) {
  Six w = Six::Zero();
  w.topRightCorner<3, 3>().setIdentity();
  w.bottomLeftCorner<3, 3>() = -Matrix3<long double>::Identity();
  w.topLeftCorner<3, 3>() = skew<long double>(l);
  return w;
}

/// The defect of a step of h on the heavy top without friction: DΦᵀ ω' DΦ − ω, by central differences.
double symplecticity_defect(const std::string& method, double h, int steps = 1) {
  using Real = long double;
  const Formulation f{Orientation::quaternion, AngularState::momentum_world};
  const auto system = make_system<Real>(laws::heavy_top(), f);
  const auto integrator = find_integrator(method)->make_long_double(*system, {});
  const State<Real> start = system->start();
  const auto flow = [&](int i, Real d) {
    State<Real> s = start;
    if (i < 3) {
      Vector3<Real> turn = Vector3<Real>::Zero();
      turn[i] = d;
      s.y.head<4>() = product<Real>(quaternion_from_rotation_vector<Real>(turn), s.y.head<4>());
    } else if (i < 6) {
      s.y[4 + i - 3] += d;
    }
    integrator->begin(s);
    EXPECT_TRUE(integrator->advance(s, h / steps, steps).ok());
    return s.y;
  };
  const VectorX<Real> centre = flow(6, 0);
  const Real d = 1e-5L;
  Six derivative;
  for (int i = 0; i < 6; ++i) {
    const VectorX<Real> up = flow(i, d), down = flow(i, -d);
    const Quaternion<Real> back = conjugate<Real>(centre.head<4>());
    derivative.col(i).head<3>() = (rotation_vector<Real>(product<Real>(up.head<4>(), back)) -
                                   rotation_vector<Real>(product<Real>(down.head<4>(), back))) /
                                  (2 * d);
    derivative.col(i).tail<3>() = (up.segment<3>(4) - down.segment<3>(4)) / (2 * d);
  }
  const Six w = derivative.transpose() * two_form(centre.segment<3>(4)) * derivative - two_form(start.y.segment<3>(4));
  return double(w.cwiseAbs().maxCoeff());
}

TEST(LieMethods, AreSymplecticWhereTheyDeclareIt) {
  EXPECT_LT(symplecticity_defect("rk4", 0.05, 2000), 1e-8) << "the exact flow keeps the two-form";
  for (const std::string& method : ours) {
    const IntegratorEntry& entry = *find_integrator(method);
    if (entry.refusal &&
        !entry.refusal(laws::heavy_top(), {Orientation::quaternion, AngularState::momentum_world}).empty())
      continue;
    const double defect = symplecticity_defect(method, 0.05);
    EXPECT_TRUE(entry.declaration.symplectic ? defect < 1e-8 : defect > 1e-7) << method << ' ' << defect;
  }
}

// Simo & Wong 1991: at h = 0.009 the energy decays by less than 0.1 %; the nutation and the symmetry axis at t = 10 are
// the exact ones to the second order.
TEST(SimoWong, HeavyTop) {
  const V3 axis(-0.047132231442, 0.026748686359, 0.998530450481);
  const double energy = 1269.975005208, low = 0.998512425506, high = 0.998750260395;
  for (const Formulation& f : {Formulation{}, Formulation{Orientation::matrix, AngularState::velocity_body}}) {
    double last = 0;
    for (const double h : {0.009, 0.003, 0.001}) {
      Motion run("simo_wong", simo_wong_top(), f);
      EXPECT_NEAR(run.energy(), energy, 1e-8);
      const auto n = std::int64_t(std::floor(10 / h + 1e-9));
      double drift = 0, least = 1, most = -1;
      for (std::int64_t k = 0; k < n; ++k) {
        run.steps(h);
        drift = std::max(drift, std::abs(run.energy() / energy - 1));
        least = std::min(least, run.body().rotation(2, 2));
        most = std::max(most, run.body().rotation(2, 2));
      }
      run.steps(10 - double(n) * h);
      EXPECT_LT(drift, 1e-3) << "the paper's claim";
      EXPECT_LT(drift, 5e-4 * h * h) << "and what it is";
      EXPECT_NEAR(least, low, 0.15 * h * h);
      EXPECT_NEAR(most, high, 0.15 * h * h);
      const double error = (run.body().rotation.col(2) - axis).norm();
      if (h == 0.001) {
        EXPECT_LT(error, 7e-5);
        EXPECT_NEAR(std::log(last / error) / std::log(3), 2, 0.1);
      }
      last = error;
    }
  }
}

// Any stiffness: the implicit methods are the midpoint rule on the oscillator, which keeps its energy.
TEST(ImplicitLieMethods, TakeStiffSteps) {
  for (const std::string method : {"lie_midpoint", "simo_wong"}) {
    for (const double product_of_step_and_rate : {0.5, 3.0, 100.0, 1e4}) {
      Motion run(method, oscillator(2), {});
      const double e = run.energy();
      run.steps(product_of_step_and_rate / 2, 1000);
      EXPECT_NEAR(run.energy() / e, 1, 1e-10) << method << ", " << product_of_step_and_rate;
    }
    // A stiff spring at a corner couples translation and rotation, hω ≈ 15: a pendulum, and its ledger.
    const V3 corner(0.1, 0.25, -0.4), anchor(0.5, 0, 2);
    Problem p = laws::box_on_spring();
    p.forces[1].values["stiffness"] = 1e6;
    p.forces[1].values["damping"] = 0.0;
    p.forces[1].values["rest_length"] = 0.0;
    p.starts[0].position = anchor - rotation_matrix<double>(p.starts[0].orientation) * corner;
    p.starts[0].velocity.setZero();
    p.starts[0].angular_velocity.setZero();
    for (const Formulation& f : laws::gyroscopic_formulations()) {
      Motion run(method, p, f);
      const double e = run.energy();
      for (int k = 0; k < 200; ++k) {
        run.steps(0.02);
        const BodySnapshot<double> now = run.body();
        EXPECT_LT((now.position + now.rotation * corner - anchor).norm(), 1e-3) << method << ", " << laws::label(f);
        EXPECT_NEAR(run.energy() - run.state().y[run.system().layout().work()], e, 0.25);
      }
    }
  }
}

// A step that has no solution in numbers fails, says why, and leaves the state as it was.
TEST(ImplicitLieMethods, ReportAStepThatDoesNotConverge) {
  for (const std::string method : {"lie_midpoint", "simo_wong"}) {
    Problem p = laws::box_on_spring();
    p.starts[0].angular_velocity = {1e200, 0, 1e200};
    const auto system = make_system<double>(p, {});
    const auto integrator = find_integrator(method)->make(*system, {});
    State<double> state = system->start();
    const State<double> before = state;
    integrator->begin(state);
    const StepResult result = integrator->step(state, 0.1);
    EXPECT_EQ(result.failure, "Newton's iteration for the implicit step did not converge");
    EXPECT_EQ(state.t, before.t);
    EXPECT_EQ(state.y, before.y);
  }
}

}  // namespace
}  // namespace polhode::by_hand::lie_group_test
