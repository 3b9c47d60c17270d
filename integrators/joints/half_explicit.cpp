// SPDX-License-Identifier: BSD-3-Clause
// HEM4, the half-explicit Runge–Kutta method of order 4 with five stages for the index-2 form, G v = 0:
//
//   Y_i = y + h Σ_{j<i} a_ij F(t_j, Y_j, Λ_j),   y₊ = y + h Σ_j b_j F(t_j, Y_j, Λ_j),
//
// where F is the flat rate with the reactions Gᵀ Λ, and Λ_j is found such that the velocity of the next stage, of the
// end for the last one, satisfies G v = 0. The stages are explicit but for these equations, which are linear in Λ_j;
// Broyden's method solves them from the Cholesky factorization at the next stage. The multipliers that the method
// reports are Λ of the last stage, at the end of the step. Source: Brasey & Hairer, SIAM J. Numer. Anal. 30 (1993);
// Hairer & Wanner, Solving Ordinary Differential Equations II, section VII.6.
#include <array>
#include <cmath>

#include "integrators/joints/joint_method.hpp"
#include "integrators/joints/joint_refusal.hpp"
#include "integrators/lie_group/root.hpp"

namespace polhode::inline integrators {
namespace {

constexpr std::size_t stages = 5;

class HalfExplicit final : public JointMethod, private StepEquations<double> {
 public:
  HalfExplicit(const System<double>& system, const IntegratorSettings&) : JointMethod(system) {
    const double r = std::sqrt(6.0);
    // Rows a_2 … a_5, then b.
    rows_ = {{{0.3},
              {(1 + r) / 30, (11 - 4 * r) / 30},
              {(-79 - 31 * r) / 150, (-1 - 4 * r) / 30, (24 + 11 * r) / 25},
              {(14 + 5 * r) / 6, (-8 + 7 * r) / 6, (-9 - 7 * r) / 4, (9 - r) / 4},
              {0, 0, (16 - r) / 36, (16 + r) / 36, 1.0 / 9}}};
    nodes_ = {0, 0.3, (4 - r) / 10, (4 + r) / 10, 1};
    rates_.fill(bodies_.zero());
  }

  void begin(const State<double>& state) override {
    evaluations_ = 0;
    root_ = {};
    discard_history(state);
  }
  std::optional<std::int64_t> iterations() const override { return root_.iterations(); }
  /// The history is the guess of the multipliers.
  void discard_history(const State<double>& state) override {
    bodies_.rate(state.t, state.y, rates_[0]);
    ++evaluations_;
    lambda_ = joints_.multipliers();
  }

 private:
  const char* take(double t, double h, Flat& y) override {
    start_ = y;
    stage_ = y;
    for (std::size_t j = 0; j < stages; ++j) {
      t_ = t + nodes_[j] * h;
      h_ = h;
      of_ = j;
      x_ = lambda_ * (h * rows_[j][j] / mean_mass_);
      evaluate(stage_);
      if (const char* why = root_.solve(*this, x_, scale())) return why;
      residual(x_, unused_);
      lambda_ = x_ * (mean_mass_ / (h * rows_[j][j]));
      stage_ = next_;
    }
    y = stage_;
    return nullptr;
  }

  /// x = h a Λ / mean mass of this stage: zero where the next stage satisfies G v = 0.
  void residual(const VectorX<double>& x, VectorX<double>& f) override {
    const VectorX<double> lambda = x * (mean_mass_ / (h_ * rows_[of_][of_]));
    {
      const PrescribedMultipliers<double> prescribed(joints_, lambda);
      bodies_.rate(t_, stage_, rates_[of_]);
      ++evaluations_;
    }
    next_ = start_;
    for (std::size_t j = 0; j <= of_; ++j) next_ += h_ * rows_[of_][j] * rates_[j];
    evaluate(next_);
    twists_.resize(bodies_.moving());
    for (std::size_t i = 0; i < twists_.size(); ++i) twists_[i] = {motions_[i].velocity, motions_[i].angular_velocity};
    joints_.multiply(twists_, open_);
    joints_.solve(open_, f);
    f /= mean_mass_;
  }

  std::array<std::array<double, stages>, stages> rows_;
  std::array<double, stages> nodes_;
  std::array<Flat, stages> rates_;
  // The stage that is being solved.
  std::size_t of_ = 0;
  double t_ = 0, h_ = 0;
  Flat start_, stage_, next_;
  VectorX<double> x_, open_, unused_;
  std::vector<Wrench<double>> twists_;
  RootFinder<double> root_;
};

}  // namespace

IntegratorEntry half_explicit4() {
  return joint_method<HalfExplicit>(
      {.name = "half_explicit4",
       .family = "constrained",
       .summary = "HEM4, half-explicit Runge-Kutta of order 4 with G v = 0 at every stage",
       .equation = R"(Y_i &= y_n + h \textstyle\sum_{j<i} a_{ij}\,F(t_n + c_j h, Y_j, \Lambda_j), \quad G(Q_i)\,V_i = 0,
  \quad i = 2, \dots, 5 \\
y_{n+1} &= y_n + h \textstyle\sum_{j=1}^5 b_j\,F(t_n + c_j h, Y_j, \Lambda_j), \quad G_{n+1} v_{n+1} = 0 \\
c &= \bigl(0, \tfrac{3}{10}, \tfrac{4 - \sqrt 6}{10}, \tfrac{4 + \sqrt 6}{10}, 1\bigr), \quad
  b = \bigl(0, 0, \tfrac{16 - \sqrt 6}{36}, \tfrac{16 + \sqrt 6}{36}, \tfrac19\bigr))",
       .sources = {"braseyHairer1993", "hairerWanner1996"},
       .order = 4,
       .joints = JointEquations::velocity,
       .multiplier_order = 2},
      [](const Problem& p, const Formulation& f) { return joint_refusal(p, f, Rows::may_depend); });
}

}  // namespace polhode::integrators
