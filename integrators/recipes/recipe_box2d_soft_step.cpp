// SPDX-License-Identifier: BSD-3-Clause
// The soft step of Box2D 3.0, in space: four substeps, in each of which
//   1. the forces and the impulses of the last substep change the velocities (warm start);
//   2. one sweep over the joints changes the impulses of each by −s K⁻¹ (G v + b g) − (1 − s) p, as a spring-damper of
//      frequency f = min(60 Hz, 1/(8 h)) and damping ratio ζ = 2 would that is integrated implicitly:
//      ω = 2π f, a₁ = 2ζ + h ω, a₂ = h ω a₁, b = ω/a₁, s = a₂/(1 + a₂);
//   3. the bodies move: q' = q + h/2 ω' q, normalized;
//   4. one more sweep without spring, −K⁻¹ G v, takes out the velocity that the spring has put in ("relax").
// K is the block G M⁻¹ Gᵀ of one joint. Box2D is plane; the gyroscopic torque here is explicit.
// Source: Box2D, src/solver.c, src/joint.c and src/revolute_joint.c; Catto, Solver2D, 2024.
#include <Eigen/Cholesky>
#include <algorithm>
#include <numbers>

#include "integrators/recipes/joint_recipe.hpp"

namespace polhode::inline integrators {
namespace {

constexpr std::int64_t usual_substeps = 4;
constexpr double hertz = 60, damping_ratio = 2;

const Setting& substeps() {
  static const Setting setting = substeps_of_engine(usual_substeps);
  return setting;
}

class SoftStep final : public JointRecipe {
 public:
  SoftStep(const System<double>& system, const IntegratorSettings& settings)
      : JointRecipe(system, settings.whole(substeps())) {
    for (std::size_t j = 0; j < joints_.count(); ++j) ends_.push_back(first_row(j) + joints_.joint(j).rows());
  }

 private:
  std::size_t first_row(std::size_t joint) const { return joint == 0 ? 0 : ends_[joint - 1]; }

  void discard_history(const State<double>& state) override {
    JointRecipe::discard_history(state);
    p_.setZero(rows());
  }

  void substep(double t, double h, Flat& y) override {
    const double omega = 2 * std::numbers::pi * std::min(hertz, 0.125 / h), a1 = 2 * damping_ratio + h * omega;
    const double a2 = h * omega * a1;

    start_ = y;
    look_at(y);
    joints_.multiply(twists_, before_forces_);
    add_forces(t, h, y);
    add_spin(h, start_, y, [](const BodyConstants<double>& body, double over, Vector3<double>& m) {
      m += over * m.cross(body.inverse_moments.cwiseProduct(m));
    });
    look_at(y);
    joints_.multiply(twists_, after_forces_);
    apply(p_, y);
    sweep(omega / a1, a2 / (1 + a2), y);
    move(h, true, y);
    look_at(y);
    sweep(0, 1, y);
    // The bodies have moved by h M⁻¹ Gᵀ p further than with their last velocities, p the impulses of the last sweep,
    // and against the forces.
    y[bodies_.layout().joint_work()] += change_.dot(after_forces_ - before_forces_);
    lambda_ = p_ / h;
  }

  /// Changes the impulses of each joint in turn, and then the velocities of y.
  void sweep(double bias_rate, double scale, Flat& y) {
    const ConstraintSolver<double>& solver = joints_.solver();
    change_.setZero(rows());
    trial_ = twists_;
    const auto twist_of = [&](std::size_t i) {
      return std::pair<const Vector3<double>&, const Vector3<double>&>(trial_[i].force, trial_[i].torque);
    };
    for (std::size_t j = 0; j < joints_.count(); ++j) {
      const std::size_t from = first_row(j);
      const Eigen::Index n = Eigen::Index(ends_[j] - from), at = Eigen::Index(from);
      Block k(n, n);
      Rows open(n);
      for (Eigen::Index a = 0; a < n; ++a) {
        open[a] = solver.product(from + std::size_t(a), twist_of) + bias_rate * gap(at + a);
        for (Eigen::Index b = 0; b < n; ++b) k(a, b) = solver.coupling(from + std::size_t(a), from + std::size_t(b));
      }
      const Rows more = -scale * k.ldlt().solve(open) - (1 - scale) * p_.segment(at, n);
      p_.segment(at, n) += more;
      change_.segment(at, n) += more;
      for (Eigen::Index a = 0; a < n; ++a) solver.add_impulse(from + std::size_t(a), more[a], trial_);
    }
    apply(change_, y);
  }

  static constexpr int most_rows = 6;
  using Block = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_rows, most_rows>;
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_rows, 1>;

  std::vector<std::size_t> ends_;  ///< one past the last row of each joint
  VectorX<double> p_, change_, before_forces_, after_forces_;
  Flat start_;
  Twists trial_;
};

}  // namespace

IntegratorEntry recipe_box2d_soft_step() {
  return joint_method<SoftStep>(
      {.name = "recipe_box2d_soft_step",
       .family = "engine recipe",
       .summary = "Box2D 3.0 in space: 4 substeps, each a warm-started soft sweep, a move and a sweep that relaxes",
       .equation = R"(v^* &= v_n + h M^{-1} (f - \omega_n \times I \omega_n) + M^{-1} G_n^{\mathsf T} p_n \\
p &: \text{for each joint, } p \leftarrow (p - s\,K^{-1} (G_n v + b\,g)) - (1 - s)\,p, \quad K = G_n M^{-1} G_n^{\mathsf T} \\
b &= \omega/a_1, \quad s = a_2/(1 + a_2), \quad a_1 = 2\zeta + h\omega, \quad a_2 = h\omega a_1 \\
\omega &= 2\pi \min(60\,\mathrm{s}^{-1}, 1/(8h)), \quad \zeta = 2 \\
q_{n+1} &= q_n + h N(q_n)\,v, \text{ quaternions divided by their lengths} \\
p_{n+1} &: \text{for each joint, } p \leftarrow p - K^{-1} G_{n+1} v)",
       .sources = {"box2d", "catto2024"},
       .order = 1,  // down to the deflection of its springs under their load, which no smaller step reduces
       .multi_step = true,
       .normalizes = true,
       .joints = JointEquations::impulses,
       .settings = {substeps()}},
      joint_recipe_refusal);
}

}  // namespace polhode::integrators
