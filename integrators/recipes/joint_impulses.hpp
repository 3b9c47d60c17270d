// SPDX-License-Identifier: BSD-3-Clause
// The step that Bullet, ODE and DART have in common. From the velocities v* after the forces, impulses p of the joints
// solve
//   (G M⁻¹ Gᵀ + C) p = −G v* − (erp/h) g,   v' = v* + M⁻¹ Gᵀ p,
// all at the configuration of the start, either together, by Cholesky, or by sweeps over the rows (projected
// Gauss–Seidel, "sequential impulses", without bounds) that start from p = 0. erp is the share of an opening that a
// step is to close, C a small diagonal ("constraint force mixing").
#pragma once

#include "integrators/recipes/joint_recipe.hpp"

namespace polhode::inline integrators {

/// The actions of an engine in a step, and its numbers.
struct Engine {
  double erp = 0.2;
  double cfm = 0;            ///< C = cfm/h, in SI units
  double cfm_share = 0;      ///< C = cfm_share times the diagonal
  double relaxation = 1;     ///< relaxation of the sweeps
  bool together = false;     ///< the rows are solved by Cholesky
  bool first_order = false;  ///< q' = q + h/2 ω q, else exp(h ω) q
  /// The gyroscopic update of an angular momentum over h, in principal axes.
  void (*spin)(const BodyConstants<double>& body, double h, Vector3<double>& m) = nullptr;
};

class JointImpulses final : public JointRecipe {
 public:
  JointImpulses(const System<double>& system, const IntegratorSettings& settings, const Engine& engine,
                const Setting& substeps, const Setting& iterations)
      : JointRecipe(system, settings.whole(substeps)),
        engine_(engine),
        iterations_(engine.together ? 0 : settings.whole(iterations)) {}

 private:
  void substep(double t, double h, Flat& y) override {
    start_ = y;
    add_forces(t, h, y);
    add_spin(h, start_, y, engine_.spin);
    look_at(y);
    joints_.multiply(twists_, right_);
    for (Eigen::Index k = 0; k < rows(); ++k) right_[k] = -right_[k] - engine_.erp / h * gap(k);
    ConstraintSolver<double>& solver = joints_.solver();
    if (engine_.together) {
      solver.soften(engine_.cfm / h, engine_.cfm_share);
      solver.solve(right_, p_);
      solver.soften(0);
    } else {
      sweep(h, solver);
    }
    apply(p_, y);
    lambda_ = p_ / h;
    move(h, engine_.first_order, y);
  }

  /// Gauss–Seidel, over-relaxed, from p = 0.
  void sweep(double h, const ConstraintSolver<double>& solver) {
    const double softness = engine_.cfm / h;
    p_.setZero(rows());
    changes_.assign(twists_.size(), {});
    const auto change_of = [&](std::size_t i) {
      return std::pair<const Vector3<double>&, const Vector3<double>&>(changes_[i].force, changes_[i].torque);
    };
    for (std::int64_t n = 0; n < iterations_; ++n) {
      for (std::size_t k = 0; k < joints_.rows(); ++k) {
        double& p = p_[Eigen::Index(k)];
        const double open = right_[Eigen::Index(k)] - solver.product(k, change_of) - softness * p;
        const double more = engine_.relaxation * open / (solver.coupling(k, k) + softness);
        p += more;
        solver.add_impulse(k, more, changes_);
      }
    }
  }

  const Engine engine_;
  const std::int64_t iterations_;
  Flat start_;
  VectorX<double> right_, p_;
  Twists changes_;  ///< M⁻¹ Gᵀ p
};

/// The catalogue entry of such an engine. Without iterations the rows are solved together.
inline IntegratorEntry joint_impulses(Declaration declaration, const Engine& engine, std::int64_t iterations = 1) {
  const Setting substeps = substeps_of_engine(1), sweeps = iterations_of_engine(iterations);
  declaration.family = "engine recipe";
  declaration.order = 1;
  declaration.normalizes = true;
  declaration.lie_group = !engine.first_order;
  declaration.joints = JointEquations::impulses;
  declaration.settings = {substeps};
  if (!engine.together) declaration.settings.push_back(sweeps);
  return joint_method<JointImpulses>(std::move(declaration), joint_recipe_refusal, engine, substeps, sweeps);
}

/// The equation of such an engine, from the three parts that differ.
inline std::string impulse_equation(const std::string& spin, const std::string& impulses, const std::string& turn) {
  return spin + R"( \\
v^* &= v_n + h M^{-1} f(t_n, q_n, v_n) + (0, R_n\,\Delta\Omega) \\
)" + impulses +
         R"( \\
v_{n+1} &= v^* + M^{-1} G_n^{\mathsf T} p, \quad x_{n+1} = x_n + h\,\dot x_{n+1}, \quad \lambda = p/h \\
)" + turn +
         R"(, \text{ divided by its length})";
}
constexpr const char* exponential_turn_equation = R"(\mathsf q_{n+1} &= \exp(h\,\omega_{n+1})\,\mathsf q_n)";
constexpr const char* first_order_turn_equation =
    R"(\mathsf q_{n+1} &= \mathsf q_n + \tfrac12 h\,(0, \omega_{n+1})\,\mathsf q_n)";

}  // namespace polhode::integrators
