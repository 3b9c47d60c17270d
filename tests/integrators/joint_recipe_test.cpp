// SPDX-License-Identifier: BSD-3-Clause
// The recipes of engines for joints against their algebra along a vertical line of rods, written out here with the rows
// g_i = z_i − z_{i−1} + 1 of the joints: G is bidiagonal, and M diagonal.
#include <Eigen/Cholesky>
#include <numbers>

#include "tests/integrators/motion.hpp"

namespace polhode::by_hand::joint_recipe_test {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

const std::vector<double> masses = {1, 2.5, 0.5}, gaps = {2e-3, -1e-3, 5e-3}, speeds = {0.3, -0.2, 0.1};
constexpr double gravity = 9.81;

Vector vector(const std::vector<double>& values) {
  return Eigen::Map<const Vector>(values.data(), Eigen::Index(values.size()));
}
Matrix rows(Eigen::Index n) {
  Matrix g = Matrix::Identity(n, n);
  for (Eigen::Index i = 1; i < n; ++i) g(i, i - 1) = -1;
  return g;
}
Matrix mobility(const Vector& mass) {
  const Matrix g = rows(mass.size());
  return g * mass.cwiseInverse().asDiagonal() * g.transpose();
}

struct Rules {
  const char* method;
  double erp, cfm, cfm_share;
  int sweeps;  // 0: together
  double relaxation;
};
const Rules all_rules[] = {{"recipe_bullet_joints", 0.2, 0, 0, 10, 1},
                           {"recipe_ode_step", 0.2, 1e-10, 0, 0, 1},
                           {"recipe_ode_quickstep", 0.2, 1e-10, 0, 20, 1.3},
                           {"recipe_dart_joints", 0.01, 0, 1e-9, 0, 1}};

/// Impulses of the joints for velocities v and openings g.
Vector impulses(const Rules& r, double h, const Vector& mass, const Vector& v, const Vector& g) {
  Matrix a = mobility(mass);
  a.diagonal() += (r.cfm / h) * Vector::Ones(mass.size()) + r.cfm_share * a.diagonal();
  const Vector right = -rows(mass.size()) * v - r.erp / h * g;
  if (r.sweeps == 0) return a.llt().solve(right);
  Vector p = Vector::Zero(mass.size());
  for (int n = 0; n < r.sweeps; ++n) {
    for (Eigen::Index k = 0; k < p.size(); ++k) p[k] += r.relaxation * (right[k] - a.row(k).dot(p)) / a(k, k);
  }
  return p;
}

Vector upward_speeds(Motion& run) {
  Vector v(Eigen::Index(run.system().moving()));
  for (std::size_t i = 0; i < run.system().moving(); ++i)
    v[Eigen::Index(i)] = run.system().snapshot(run.state().y, i).velocity.z();
  return v;
}
Vector openings(Motion& run) {
  Vector g(Eigen::Index(run.system().moving()));
  double above = 0;
  for (std::size_t i = 0; i < run.system().moving(); ++i) {
    const double z = run.system().snapshot(run.state().y, i).position.z();
    g[Eigen::Index(i)] = z + 0.5 - above;
    above = z - 0.5;
  }
  return g;
}

TEST(JointRecipe, StepsAsItsAlgebraSays) {
  const double h = 0.01;
  const Vector mass = vector(masses);
  for (const Rules& r : all_rules) {
    SCOPED_TRACE(r.method);
    Motion run(r.method, laws::hanging_rods(masses, gaps, speeds), {});
    Vector v = vector(speeds), g = -vector(gaps);
    for (int k = 0; k < 3; ++k) {
      run.steps(h);
      v.array() -= h * gravity;
      v += mass.cwiseInverse().asDiagonal() * (rows(3).transpose() * impulses(r, h, mass, v, g));
      g += h * rows(3) * v;
      EXPECT_LT((upward_speeds(run) - v).norm(), 1e-13);
      EXPECT_LT((openings(run) - g).norm(), 1e-13);
    }
  }
}

TEST(JointRecipe, SoftStepIsAnImplicitSpringThatRelaxes) {
  const double step = 0.02, h = step / 4, omega = 2 * std::numbers::pi * std::min(60.0, 1 / (8 * h));
  const double a1 = 4 + h * omega, a2 = h * omega * a1, share = a2 / (1 + a2);
  const Vector mass = vector(masses), inverse = mass.cwiseInverse();
  const Matrix a = mobility(mass), lever = rows(3);
  Motion run("recipe_box2d_soft_step", laws::hanging_rods(masses, gaps, speeds), {});
  Vector v = vector(speeds), g = -vector(gaps), p = Vector::Zero(3);
  const auto sweep = [&](double rate, double s) {
    for (Eigen::Index k = 0; k < 3; ++k) {
      const double more = -s * (lever.row(k).dot(v) + rate * g[k]) / a(k, k) - (1 - s) * p[k];
      p[k] += more;
      v += inverse.asDiagonal() * (lever.row(k).transpose() * more);
    }
  };
  for (int k = 1; k <= 12; ++k) {
    v.array() -= h * gravity;
    v += inverse.asDiagonal() * (lever.transpose() * p);
    sweep(omega / a1, share);
    g += h * lever * v;
    sweep(0, 1);
    if (k % 4 != 0) continue;
    run.steps(step);
    EXPECT_LT((upward_speeds(run) - v).norm(), 1e-12);
    EXPECT_LT((openings(run) - g).norm(), 1e-12);
  }
}

/// The openings at rest: impulses h λ, λ the loads, keep the rods where they are.
TEST(JointRecipe, ChainAtRestHangsWhereItsImpulsesCarryIt) {
  const double h = 1.0 / 60;
  const Vector mass = vector({1, 1, 1, 20});
  const Vector load = gravity * vector({23, 22, 21, 20}), still = Vector::Zero(4);
  const auto ended = [&](const char* method) {
    Motion run(method, laws::hanging_rods({1, 1, 1, 20}, {0, 0, 0, 0}, {0, 0, 0, 0}), {});
    run.steps(h, 6000);
    EXPECT_LT(upward_speeds(run).norm(), 1e-12);
    return openings(run);
  };
  for (const Rules& r : all_rules) {
    if (std::string(r.method) == "recipe_dart_joints") continue;  // its matrix is not soft in SI units
    SCOPED_TRACE(r.method);
    // p is linear in g: p = p(0) + B g.
    const Vector falling = Vector::Constant(4, -h * gravity), at_zero = impulses(r, h, mass, falling, still);
    Matrix b(4, 4);
    for (Eigen::Index k = 0; k < 4; ++k) b.col(k) = impulses(r, h, mass, falling, Vector::Unit(4, k)) - at_zero;
    const Vector expected = b.fullPivLu().solve(h * load - at_zero);
    EXPECT_LT((ended(r.method) - expected).norm(), 1e-9 * expected.norm() + 1e-13);
  }
  const double omega = 2 * std::numbers::pi * std::min(60.0, 1 / (8 * h / 4));
  const Vector spring = -mobility(mass).diagonal().cwiseProduct(load) / (omega * omega);
  EXPECT_LT((ended("recipe_box2d_soft_step") - spring).norm(), 1e-9 * spring.norm());
}

TEST(JointRecipe, LedgerHoldsTheWorkOfTheImpulses) {
  // The rods fall onto joints that stand open: kinetic energy goes into the joints.
  for (const char* method : {"recipe_bullet_joints", "recipe_ode_step", "recipe_box2d_soft_step"}) {
    SCOPED_TRACE(method);
    Motion run(method, laws::hanging_rods({1, 1}, {0.1, 0.1}, {0, 0}), {});
    const double before = run.energy();
    run.steps(1e-5, 50000);
    const double in = run.state().y[run.system().layout().joint_work()];
    EXPECT_GT(std::abs(in), 0.1);
    EXPECT_NEAR(run.energy() - before, in, 2e-3);  // order 1
  }
}

TEST(JointRecipe, RecipesOfFreeBodiesNameThoseOfJoints) {
  for (const char* method : {"recipe_ode", "recipe_bullet", "recipe_simbody"}) {
    const std::string why = find_integrator(method)->refusal(laws::jointed_rods(), {});
    EXPECT_NE(why.find("recipe_ode_step"), std::string::npos) << why;
  }
}

}  // namespace
}  // namespace polhode::by_hand::joint_recipe_test
