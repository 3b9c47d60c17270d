// SPDX-License-Identifier: BSD-3-Clause
// The conserving family against published figures and against what its methods declare: errors at the end of a run,
// first integrals over many steps, time symmetry, symplecticity, orders, stability, and steps that cannot be taken.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "integrators/catalogue.hpp"
#include "tests/laws/formulations.hpp"
#include "tests/laws/problems.hpp"
#include "tests/laws/reference_flow.hpp"

namespace polhode::conserving_test {
namespace {

using laws::force;
using laws::gyroscopic_formulations;
using laws::label;
using Real = long double;
using V3 = Vector3<double>;

constexpr Formulation body_quaternion{Orientation::quaternion, AngularState::velocity_body};
constexpr Formulation body_matrix{Orientation::matrix, AngularState::velocity_body};
constexpr Formulation momentum_quaternion{Orientation::quaternion, AngularState::momentum_world};

/// A run that a test steps by hand, in the scalar S.
template <class S = double>
class Motion {
 public:
  Motion(const std::string& method, const Problem& problem, const Formulation& formulation)
      : system_(make_system<S>(problem, formulation)),
        integrator_(find_integrator(method)->maker<S>()(*system_, {})),
        state_(system_->start()) {
    integrator_->begin(state_);
  }

  void steps(double h, std::int64_t n) {
    const double t = state_.t;
    const StepResult result = integrator_->advance(state_, h, n);
    if (!result.ok()) ADD_FAILURE() << result.failure;
    state_.t = t + double(n) * h;
  }
  StepResult try_step(double h) { return integrator_->step(state_, h); }

  State<S>& state() { return state_; }
  const System<S>& system() const { return *system_; }
  Measurement<S> measure() const { return system_->measure(state_.y); }
  Vector3<S> body_momentum() const {
    const BodySnapshot<S> b = system_->snapshot(state_.y, 0);
    return b.rotation.transpose() * b.angular_momentum;
  }

 private:
  std::unique_ptr<System<S>> system_;
  IntegratorPointer<S> integrator_;
  State<S> state_;
};

std::vector<Declaration> conserving() {
  std::vector<Declaration> all;
  for (const IntegratorEntry& e : integrator_catalogue()) {
    if (e.declaration.family == "conserving") all.push_back(e.declaration);
  }
  return all;
}

/// |Δy| of the asymmetric body of Hairer & Vilmart 2006 at t = 10 (REFERENCE_RESULTS 1.2).
double hairer_vilmart_error(const std::string& method, const Formulation& f, std::int64_t n) {
  Motion<> m(method, laws::free_top(), f);
  m.steps(10 / double(n), n);
  return (m.body_momentum() - V3(1.765962508518208, -0.695464197033089, 0.779554981481872)).norm();
}

TEST(Conserving, ErrorsOfHairerAndVilmart) {
  const struct {
    const char* method;
    double error;
  } rows[] = {{"dmv", 6.565e-2},
              {"dmv4", 1.300e-4},
              {"dmv6", 1.008e-7},
              {"implicit_midpoint", 1.835e-3},
              {"mclachlan_reich", 6.134e-3},
              {"no_squish", 1.2305e-2},  // the three rotations in the order 3 2 1 2 3
              {"symmetric_rotor2", 1.052e-4}};
  for (const auto& row : rows) {
    for (const Formulation& f : {body_quaternion, body_matrix}) {
      EXPECT_NEAR(hairer_vilmart_error(row.method, f, 200), row.error, 0.01 * row.error) << row.method << label(f);
    }
  }
}

TEST(Conserving, OrdersOfTheMoserVeselovFamily) {
  const std::pair<const char*, double> rows[] = {{"dmv", 2}, {"dmv4", 4}, {"dmv6", 6}};
  for (const auto& [method, order] : rows) {
    for (const Formulation& f : gyroscopic_formulations()) {
      const double coarse = hairer_vilmart_error(method, f, 200), fine = hairer_vilmart_error(method, f, 400);
      EXPECT_NEAR(std::log2(coarse / fine), order, 0.1) << method << ", " << label(f);
    }
  }
}

TEST(Conserving, ExactRotorIsExactInAnyNumberOfSteps) {
  for (const char* method : {"exact_rotor", "exact_rotor_yoshida4", "exact_rotor_suzuki4", "exact_rotor_kahan_li6"}) {
    for (const Formulation& f : gyroscopic_formulations()) {
      for (const std::int64_t n : {1, 7, 1000}) {
        // A composition of nine parts takes nine times the steps.
        EXPECT_LT(hairer_vilmart_error(method, f, n), 6e-13) << method << ", " << label(f) << ", " << n;
      }
    }
  }
}

// Energy, |IΩ| and the momentum in the world, of the methods that say they keep them.
void expect_conservation(const Declaration& d, std::int64_t steps) {
  for (const Formulation& f : gyroscopic_formulations()) {
    SCOPED_TRACE(d.name + ", " + label(f));
    Motion<> m(d.name, laws::free_top(), f);
    const Measurement<double> start = m.measure();
    const double casimir = m.body_momentum().norm();
    double energy_drift = 0, momentum_drift = 0, casimir_drift = 0;
    for (int part = 0; part < 20; ++part) {
      m.steps(0.05, steps / 20);
      const Measurement<double> now = m.measure();
      energy_drift = std::max(energy_drift, std::abs(now.energy() / start.energy() - 1));
      momentum_drift = std::max(momentum_drift, (now.angular_momentum - start.angular_momentum).norm() / casimir);
      casimir_drift = std::max(casimir_drift, std::abs(m.body_momentum().norm() / casimir - 1));
    }
    if (d.conserves_energy) {
      EXPECT_LT(energy_drift, 1e-12);
    }
    if (d.conserves_momentum) {
      EXPECT_LT(momentum_drift, 1e-12);
    }
    if (d.conserves_casimir) {
      EXPECT_LT(casimir_drift, 1e-12);
    }
  }
}
TEST(Conserving, MoserVeselovKeepsItsIntegralsOver100000Steps) {
  for (const char* method : {"dmv", "dmv4", "dmv6"}) {
    const Declaration& d = find_integrator(method)->declaration;
    EXPECT_TRUE(d.conserves_energy && d.conserves_momentum && d.conserves_casimir);
    expect_conservation(d, 100000);
  }
}
TEST(Conserving, KeepsWhatItDeclares) {
  for (const Declaration& d : conserving()) {
    const bool any = d.conserves_energy || d.conserves_momentum || d.conserves_casimir;
    if (any && !d.name.starts_with("dmv")) expect_conservation(d, 10000);
  }
}

// Steps of h, then as many of −h: back at the start.
TEST(Conserving, SymmetricMethodsReturn) {
  const laws::NamedProblem problems[] = {{"free_top", laws::free_top()},
                                         {"heavy_top", laws::heavy_top()},
                                         {"box_on_spring", laws::box_on_spring()},
                                         {"five_bodies", laws::five_bodies()}};
  for (const Declaration& d : conserving()) {
    if (!d.symmetric) continue;
    for (const auto& [name, problem] : problems) {
      for (const Formulation& f : gyroscopic_formulations()) {
        Motion<> m(d.name, problem, f);
        const VectorX<double> start = m.state().y;
        m.steps(0.02, 25);
        EXPECT_GT((m.state().y - start).norm(), 0.1);
        m.steps(-0.02, 25);
        EXPECT_LT((m.state().y - start).cwiseAbs().maxCoeff() / start.cwiseAbs().maxCoeff(), 1e-12)
            << d.name << ", " << name << ", " << label(f);
      }
    }
  }
}

/// The largest change of the canonical two-form λ1·ξ2 − λ2·ξ1 + L·(ξ1 × ξ2) in one step, by central differences; a
/// variation (ξ, λ) turns the body by ξ in world axes and adds λ to L. (Marsden & Ratiu, Introduction to Mechanics and
/// Symmetry, 2nd ed., section 13.1 and proposition 6.3.2, in space coordinates.)
template <class S>
S symplecticity_defect(const std::string& method, const Problem& problem, double h, S distance) {
  Motion<S> m(method, problem, momentum_quaternion);
  const Layout::Slot slot = m.system().layout().slots.front();
  const State<S> start = m.state();
  const auto at = [&](const VectorX<S>& y) { return y.template segment<4>(slot.orientation); };
  const auto momentum = [&](const VectorX<S>& y) { return y.template segment<3>(slot.angular); };
  const auto moved = [&](int k, S by) {
    m.state() = start;
    Vector3<S> d = Vector3<S>::Zero();
    d[k % 3] = by;
    VectorX<S>& y = m.state().y;
    if (k < 3) y.template segment<4>(slot.orientation) = product<S>(quaternion_from_rotation_vector<S>(d), at(start.y));
    else y.template segment<3>(slot.angular) += d;
    m.steps(h, 1);
    return y;
  };
  m.steps(h, 1);
  const Vector3<S> l0 = momentum(start.y), l1 = momentum(m.state().y);
  std::array<Vector3<S>, 6> xi, lambda;
  for (int k = 0; k < 6; ++k) {
    const VectorX<S> plus = moved(k, distance), minus = moved(k, -distance);
    xi[std::size_t(k)] = rotation_vector<S>(product<S>(at(plus), conjugate<S>(at(minus)))) / (2 * distance);
    lambda[std::size_t(k)] = (momentum(plus) - momentum(minus)) / (2 * distance);
  }
  S defect = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) {
      Vector3<S> x[2], l[2];
      const std::size_t index[] = {i, j};
      for (int k = 0; k < 2; ++k) {
        x[k] = l[k] = Vector3<S>::Zero();
        (index[k] < 3 ? x[k] : l[k])[Eigen::Index(index[k] % 3)] = 1;
      }
      const S before = l[0].dot(x[1]) - l[1].dot(x[0]) + l0.dot(x[0].cross(x[1]));
      const S after = lambda[i].dot(xi[j]) - lambda[j].dot(xi[i]) + l1.dot(xi[i].cross(xi[j]));
      defect = std::max(defect, std::abs(after - before));
    }
  }
  return defect;
}
TEST(Conserving, SymplecticMethodsKeepTheTwoForm) {
  for (const Problem& problem : {laws::free_top(), laws::heavy_top()}) {
    for (const Declaration& d : conserving()) {
      const bool extended = bool(find_integrator(d.name)->make_long_double);
      const double defect = extended ? double(symplecticity_defect<Real>(d.name, problem, 0.1, 1e-6L))
                                     : symplecticity_defect<double>(d.name, problem, 0.1, 1e-5);
      if (d.symplectic) {
        EXPECT_LT(defect, extended ? 1e-11 : 1e-8) << d.name;
      } else {
        EXPECT_GT(defect, 3e-11) << d.name << " is symplectic";
      }
    }
    EXPECT_GT(symplecticity_defect<Real>("rk4", problem, 0.1, 1e-6L), 1e-8L);
  }
}

TEST(Conserving, OrdersOfCompositionsOnTheHeavyTop) {
  for (const Declaration& d : conserving()) {
    if (d.order < 4) continue;
    const auto exact = make_system<Real>(laws::heavy_top(), body_quaternion);
    const VectorX<double> end = laws::reference_flow(*exact, exact->start().y, 0, 1).cast<double>();
    const auto error = [&](std::int64_t n) {
      Motion<> m(d.name, laws::heavy_top(), body_quaternion);
      m.steps(1 / double(n), n);
      return (m.state().y - end).norm();
    };
    EXPECT_NEAR(std::log2(error(40) / error(80)), d.order, 0.2) << d.name;
  }
}

// Bodies with a symmetry, their axes in every order: a symmetric top is its own symmetric part, a sphere turns about a
// fixed axis; and a body at rest stays there.
TEST(Conserving, SymmetricBodiesSpheresAndRest) {
  const auto moved = [](const std::string& method, const V3& moments, const V3& omega, const Formulation& f) {
    Problem p = laws::free_top();
    p.bodies[0].inertia = moments.asDiagonal();
    p.starts[0].angular_velocity = omega;
    Motion<> m(method, p, f);
    m.steps(0.1, 10);
    return m.state().y;
  };
  const V3 omega(0.7, -1.1, 0.4), rest = V3::Zero();
  for (const Formulation& f : gyroscopic_formulations()) {
    for (const V3& moments :
         {V3(1, 0.6, 0.6), V3(0.6, 1, 0.6), V3(0.6, 0.6, 1), V3(0.6, 1, 1), V3(1, 0.6, 1), V3(1, 1, 0.6)}) {
      const VectorX<double> exact = moved("exact_rotor", moments, omega, f);
      for (const char* method : {"symmetric_rotor2", "symmetric_rotor4"}) {
        EXPECT_LT((moved(method, moments, omega, f) - exact).cwiseAbs().maxCoeff(), 1e-14) << method << label(f);
      }
    }
    for (const Declaration& d : conserving()) {
      if (!d.lie_group) continue;
      SCOPED_TRACE(d.name + ", " + label(f));
      const int chart = f.orientation == Orientation::matrix ? 9 : 4;
      const VectorX<double> still = moved(d.name, {0.6, 0.8, 1}, rest, f);
      EXPECT_EQ(still.segment(3, chart), moved("rk4", {0.6, 0.8, 1}, rest, f).segment(3, chart));
      if (!d.conserves_energy) continue;
      const V3 spin = moved(d.name, {0.5, 0.5, 0.5}, omega, f).segment<3>(chart + 6);
      EXPECT_LT((spin - (f.angular_state == AngularState::momentum_world ? V3(0.5 * omega) : omega)).norm(), 1e-14);
    }
  }
}

/// A unit mass on a linear spring fixed at the origin, ω = √k.
Problem oscillator(double stiffness, double drag) {
  Problem p = laws::free_top();
  p.starts[0].position = {1, -0.5, 0.25};
  p.forces.push_back(force("spring", {0}, {{"stiffness", stiffness}}));
  if (drag > 0) p.forces.push_back(force("drag", {0}, {{"linear", drag}}));
  return p;
}

TEST(Conserving, ImplicitMidpointHasNoStabilityLimit) {
  for (const double h_omega : {1.0, 2.5, 10.0, 100.0}) {
    for (const Formulation& f : {body_quaternion, body_matrix}) {
      Motion<> m("implicit_midpoint", oscillator(1e4, 0), f);
      const double start = m.measure().energy();
      m.steps(h_omega / 100, 1000);  // the body turns by up to 3 rad in a step
      EXPECT_NEAR(m.measure().energy() / start, 1, 1e-9) << h_omega;
    }
  }
}

// With the body velocity as state energy, |IΩ| and |q| or RᵀR are quadratic; with R so is the momentum in the world.
TEST(Conserving, GaussMethodsKeepQuadraticIntegrals) {
  for (const char* method : {"implicit_midpoint", "gauss4", "gauss6"}) {
    for (const Formulation& f : {body_quaternion, body_matrix}) {
      SCOPED_TRACE(method + label(f));
      Motion<> m(method, laws::free_top(), f);
      const Measurement<double> start = m.measure();
      const double casimir = m.body_momentum().norm();
      m.steps(0.05, 10000);
      const Measurement<double> now = m.measure();
      EXPECT_NEAR(now.energy() / start.energy(), 1, 1e-12);
      EXPECT_NEAR(m.body_momentum().norm() / casimir, 1, 1e-12);
      EXPECT_LT(now.orientation_defect, 1e-12);
      if (f.orientation == Orientation::matrix) {
        EXPECT_LT((now.angular_momentum - start.angular_momentum).norm(), 1e-11);
      }
    }
  }
}

// A step that has no solution fails, says so, and leaves the state as it was.
TEST(Conserving, ImpossibleStepsFail) {
  const struct {
    const char* method;
    Problem problem;
    double h;
    const char* words;
  } rows[] = {{"dmv", laws::free_top(), 0.5, "step is too long"},
              {"dmv4", laws::free_top(), 2, "step is too long"},
              {"dmv6", laws::free_top(), 2, "step is too long"},
              {"mclachlan_reich", oscillator(1, 100), 0.1, "too long for the damping"}};
  for (const auto& row : rows) {
    Motion<> m(row.method, row.problem, body_quaternion);
    const State<double> before = m.state();
    const StepResult result = m.try_step(row.h);
    EXPECT_NE(result.failure.find(row.words), std::string::npos) << row.method << ": " << result.failure;
    EXPECT_EQ(m.state().y, before.y);
    EXPECT_EQ(m.state().t, before.t);
  }
}

TEST(Conserving, GaussMethodsRefuseALinearSystemThatFillsTheMemory) {
  Problem thousand = laws::free_top();
  thousand.bodies.resize(1000, thousand.bodies.front());
  thousand.starts.resize(1000, thousand.starts.front());
  const auto refusal = [](const char* method, const Problem& p) { return find_integrator(method)->refusal(p, {}); };
  EXPECT_EQ(refusal("gauss6", thousand),
            "its stages solve a dense linear system of 39003 unknowns, 12 GB; take a method that solves none, or fewer "
            "bodies");
  EXPECT_NE(refusal("gauss4", thousand), "");
  EXPECT_EQ(refusal("implicit_midpoint", thousand), "");  // 13001 unknowns, 1.4 GB
  thousand.bodies.resize(100);
  thousand.starts.resize(100);
  EXPECT_EQ(refusal("gauss6", thousand), "");
}

TEST(Conserving, RotorsRefuseToLeaveOutTheGyroscopicTerm) {
  Formulation off = body_quaternion;
  off.gyroscopic = false;
  for (const Declaration& d : conserving()) {
    const auto& refusal = find_integrator(d.name)->refusal;
    ASSERT_TRUE(refusal) << d.name;
    EXPECT_EQ(refusal(laws::free_top(), off).empty(), !d.lie_group) << d.name;
    EXPECT_TRUE(refusal(laws::free_top(), body_quaternion).empty()) << d.name;
  }
}

}  // namespace
}  // namespace polhode::conserving_test
