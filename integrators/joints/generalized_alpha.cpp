// SPDX-License-Identifier: BSD-3-Clause
// The generalized-α method on the Lie group (R³ × SO(3))ⁿ with joints, for v = (velocity, angular velocity in body
// axes):
//
//   q₊ = q ∘ exp(h v + (½ − β) h² a + β h² a₊ − ζ),   v₊ = v + (1 − γ) h a + γ h a₊,
//   (1 − α_m) a₊ + α_m a = (1 − α_f) v̇₊ + α_f v̇,    M v̇₊ = f(t₊, q₊, v₊) + Gᵀ(q₊) λ₊.
//
// index 3:             g(q₊) = 0, ζ = 0. The velocities do not satisfy G v = 0.
// stabilized index 2:  g(q₊) = 0 and G(q₊) v₊ = 0, ζ = M⁻¹ Gᵀ(q) η with a second set of multipliers η.
// An equation that is not holonomic is G v₊ = 0 in both.
//
// α_m, α_f, β and γ follow from the spectral radius at infinite frequency (Chung & Hulbert). The first a approximates
// the acceleration at α_m − α_f of a step after the start. In index 3 the multipliers then have errors of order h at
// the start, which decay with the powers of the spectral radius; the setting start_values = perturbed changes the first
// v by O(h²) so that they do not arise. It takes the first accelerations from steps of RK4 of the index-1 form.
//
// Each step solves a₊ = F(a₊), in which λ₊ is eliminated by the linearized equations of the joints, with Broyden's
// method and, if that fails, Newton's. Sources: Brüls & Cardona, J. Comput. Nonlinear Dyn. 5 (2010); Arnold, Brüls &
// Cardona, Numer. Math. 129 (2015).
#include "integrators/joints/joint_method.hpp"
#include "integrators/joints/joint_refusal.hpp"
#include "integrators/lie_group/root.hpp"

namespace polhode::inline integrators {
namespace {

enum class AlphaForm { index3, index2 };

const Setting& spectral_radius() {
  static const Setting setting{.key = "spectral_radius",
                               .usual = 0.9,
                               .meaning = "at infinite frequency of generalized-alpha methods; 1 does not damp",
                               .lowest = 1e-3,
                               .highest = 1};
  return setting;
}
const Setting& start_values() {
  static const Setting setting{.key = "start_values",
                               .usual = std::string("exact"),
                               .meaning =
                                   "of generalized-alpha methods: the state's, or perturbed by O(h^2) so that the "
                                   "multipliers of index 3 start with their order",
                               .choices = {"exact", "perturbed"}};
  return setting;
}

class GeneralizedAlpha final : public JointMethod, private StepEquations<double> {
 public:
  GeneralizedAlpha(const System<double>& system, const IntegratorSettings& settings, AlphaForm form)
      : JointMethod(system),
        form_(form),
        perturbed_(form == AlphaForm::index3 && settings.text(start_values()) == "perturbed"),
        v_(bodies_.zero_tangent()) {
    const double radius = settings.number(spectral_radius());
    alpha_m_ = (2 * radius - 1) / (radius + 1);
    alpha_f_ = radius / (radius + 1);
    gamma_ = 0.5 + alpha_f_ - alpha_m_;
    beta_ = 0.25 * (gamma_ + 0.5) * (gamma_ + 0.5);
    ratio_ = (1 - alpha_m_) / (1 - alpha_f_);
  }

  void begin(const State<double>& state) override {
    evaluations_ = 0;
    root_ = {};
    restart(state.t, state.y);
  }
  std::optional<std::int64_t> iterations() const override { return root_.iterations(); }
  void discard_history(const State<double>& state) override { restart(state.t, state.y); }

 private:
  using Vector = VectorX<double>;

  void restart(double t, const Flat& y) {
    v_dot_ = acceleration(t, y);
    lambda_ = joints_.multipliers();
    fresh_ = true;
  }

  /// The first a, and the change of the first v that perturbed start values require.
  void begin_at(double t, double h, Flat& y) {
    const double ahead = (alpha_m_ - alpha_f_) * h;
    a_ = acceleration(t + ahead, flown(t, ahead, y));
    fresh_ = false;
    if (!perturbed_) return;
    const Vector a_next = acceleration(t + h + ahead, flown(t, h + ahead, y));
    Flat there;
    Vector correction;
    for (int k = 0; k < 3; ++k) {  // Newton's method for g = 0 at the end of the step, linear up to O(h³)
      bodies_.body_twist(y, v_);
      there = y;
      bodies_.retract_in_body(there, h * v_ + h * h * ((0.5 - beta_) * a_ + beta_ * a_next));
      evaluate(there);
      const Vector open = positions();
      evaluate(y);
      joints_.solve(-open / h, correction);
      std::vector<Wrench<double>> impulses(bodies_.moving());
      joints_.add_transposed(correction, impulses);
      for (std::size_t i = 0; i < bodies_.moving(); ++i) {
        bodies_.apply_impulse(y, i, impulses[i].force, impulses[i].torque);
      }
    }
  }

  /// One step of RK4 of the index-1 form, for the accelerations near the start only.
  Flat flown(double t, double h, const Flat& y) {
    Flat k1(y.size()), k2(y.size()), k3(y.size()), k4(y.size());
    bodies_.rate(t, y, k1);
    bodies_.rate(t + h / 2, Flat(y + h / 2 * k1), k2);
    bodies_.rate(t + h / 2, Flat(y + h / 2 * k2), k3);
    bodies_.rate(t + h, Flat(y + h * k3), k4);
    evaluations_ += 4;
    return y + h / 6 * (k1 + 2 * (k2 + k3) + k4);
  }

  /// v̇ of the index-1 form, in body axes.
  Vector acceleration(double t, const Flat& y) {
    Vector w = bodies_.zero_tangent(), a = w;
    bodies_.wrench(t, y, w);
    bodies_.body_acceleration(y, w, a);
    ++evaluations_;
    return a;
  }

  const char* take(double t, double h, Flat& y) override {
    if (fresh_) begin_at(t, h, y);
    t_ = t + h;
    h_ = h;
    y_ = &y;
    bodies_.body_twist(y, v_);
    evaluate(y);
    Vector x(v_.size() + (form_ == AlphaForm::index2 ? rows() : 0));
    x.setZero();
    x.head(v_.size()) = beta_ * h * h * a_;
    along_ = (alpha_m_ * a_ - alpha_f_ * v_dot_) / (1 - alpha_f_);
    if (const char* why = root_.solve(*this, x, scale())) return why;
    residual(x, unused_);  // λ and the state of the solution
    a_ = x.head(v_.size()) / (beta_ * h * h);
    v_dot_ = ratio_ * a_ + along_;
    lambda_ = trial_lambda_;
    add_work(t, y);
    y = trial_;
    return nullptr;
  }

  /// Work by the trapezoidal rule.
  void add_work(double t, const Flat& y) {
    before_ = bodies_.zero();
    after_ = before_;
    {
      const PrescribedMultipliers<double> prescribed(joints_, lambda_);
      bodies_.configuration_rate(t, y, before_);
      bodies_.configuration_rate(t_, trial_, after_);
      evaluations_ += 2;
    }
    const Eigen::Index works = bodies_.layout().work_size;
    trial_.tail(works) = y.tail(works) + h_ / 2 * (before_.tail(works) + after_.tail(works));
  }

  /// x = (β h² a₊, η / mean mass) minus its next iterate.
  void residual(const Vector& x, Vector& f) override {
    const Eigen::Index n = v_.size();
    f.resize(x.size());
    const Vector a = x.head(n) / (beta_ * h_ * h_);
    Vector turn = h_ * v_ + (0.5 - beta_) * h_ * h_ * a_ + x.head(n);
    if (form_ == AlphaForm::index2) {
      evaluate(*y_);
      std::vector<Wrench<double>> shift(bodies_.moving());
      joints_.add_transposed(mean_mass_ * x.tail(rows()), shift);
      joints_.divide_by_masses(shift);
      turn -= in_body(shift);
    }
    trial_ = *y_;
    bodies_.retract_in_body(trial_, turn);
    bodies_.set_body_twist(v_ + (1 - gamma_) * h_ * a_ + gamma_ * h_ * a, trial_);
    // v̇ without reactions
    Vector w = bodies_.zero_tangent(), v_dot = w;
    const Vector none = Vector::Zero(rows());
    {
      const PrescribedMultipliers<double> prescribed(joints_, none);
      bodies_.wrench(t_, trial_, w);
    }
    bodies_.body_acceleration(trial_, w, v_dot);
    ++evaluations_;
    evaluate(trial_);
    Vector open = positions(), rates, of_a;
    joints_.multiply(in_world(twist_of_trial()), rates);
    if (form_ == AlphaForm::index2) {
      Vector eta;
      joints_.solve(open, eta);
      f.tail(rows()) = -eta / mean_mass_;
      open = rates / (gamma_ * h_);
    } else {
      const auto& equations = joints_.equations();
      for (Eigen::Index k = 0; k < rows(); ++k) {
        open[k] = equations[std::size_t(k)].holonomic ? open[k] / (beta_ * h_ * h_) : rates[k] / (gamma_ * h_);
      }
    }
    joints_.multiply(in_world(ratio_ * a - v_dot + along_), of_a);
    joints_.solve(of_a - ratio_ * open, trial_lambda_);
    std::vector<Wrench<double>> reactions(bodies_.moving());
    joints_.add_transposed(trial_lambda_, reactions);
    joints_.divide_by_masses(reactions);
    f.head(n) = x.head(n) - beta_ * h_ * h_ / ratio_ * (v_dot + in_body(reactions) - along_);
  }

  Vector twist_of_trial() const {
    Vector twist = bodies_.zero_tangent();
    bodies_.body_twist(trial_, twist);
    return twist;
  }

  /// g of each holonomic equation, 0 of the rest.
  Vector positions() const {
    Vector g(rows());
    for (Eigen::Index k = 0; k < rows(); ++k) g[k] = joints_.equations()[std::size_t(k)].residual;
    return g;
  }

  /// A tangent with its angular part in body axes as twists in world axes, at the last evaluation; and back.
  std::vector<Wrench<double>> in_world(const Vector& xi) const {
    std::vector<Wrench<double>> twists(bodies_.moving());
    for_each_part([&](std::size_t i, Eigen::Index linear, Eigen::Index angular) {
      if (linear >= 0) twists[i].force = xi.segment<3>(linear);
      twists[i].torque = motions_[i].rotation * xi.segment<3>(angular);
    });
    return twists;
  }
  Vector in_body(const std::vector<Wrench<double>>& twists) const {
    Vector xi = bodies_.zero_tangent();
    for_each_part([&](std::size_t i, Eigen::Index linear, Eigen::Index angular) {
      if (linear >= 0) xi.segment<3>(linear) = twists[i].force;
      xi.segment<3>(angular) = motions_[i].rotation.transpose() * twists[i].torque;
    });
    return xi;
  }
  template <class Visit>
  void for_each_part(const Visit& visit) const {
    const Layout& layout = bodies_.layout();
    for (std::size_t i = 0; i < bodies_.moving(); ++i) {
      const bool pinned = bodies_.problem().bodies[i].pinned;
      visit(i, pinned ? -1 : layout.slots[i].velocity - layout.configuration_size,
            layout.slots[i].angular - layout.configuration_size);
    }
  }

  const AlphaForm form_;
  const bool perturbed_;
  double alpha_m_, alpha_f_, beta_, gamma_;
  double ratio_;             ///< (1 − α_m)/(1 − α_f)
  bool fresh_ = true;        ///< no step yet
  Vector a_, v_dot_;         ///< history: a and v̇ at the start of the step, body axes
  double t_ = 0, h_ = 0;     ///< end and length of the step, s
  const Flat* y_ = nullptr;  ///< state at the start of the step
  Vector v_, along_;         ///< v at the start; (α_m a − α_f v̇)/(1 − α_f)
  Flat trial_, before_, after_;
  Vector trial_lambda_, unused_;
  RootFinder<double> root_;
};

Declaration declaration(std::string name, std::string summary, std::string equation, JointEquations joints,
                        std::vector<Setting> settings) {
  return {
      .name = std::move(name),
      .family = "constrained",
      .summary = std::move(summary),
      .equation =
          R"(q_{n+1} &= q_n \circ \exp\bigl(h v_n + (\tfrac12 - \beta) h^2 a_n + \beta h^2 a_{n+1} - \zeta_n\bigr), \quad
  v_{n+1} = v_n + (1 - \gamma)\,h a_n + \gamma h a_{n+1} \\
& (1 - \alpha_m)\,a_{n+1} + \alpha_m a_n = (1 - \alpha_f)\,\dot v_{n+1} + \alpha_f \dot v_n, \quad
  M \dot v_{n+1} = f_{n+1} + G_{n+1}^{\mathsf T} \lambda_{n+1} \\
& )" + std::move(equation) +
          R"( \\
& \alpha_m = \frac{2 \rho - 1}{\rho + 1}, \quad \alpha_f = \frac{\rho}{\rho + 1}, \quad
  \gamma = \tfrac12 + \alpha_f - \alpha_m, \quad \beta = \tfrac14 (\gamma + \tfrac12)^2)",
      .sources = {"brulsCardona2010", "arnoldBrulsCardona2015"},
      .order = 2,
      .implicit = true,
      .multi_step = true,
      .lie_group = true,
      .joints = joints,
      .multiplier_order = joints == JointEquations::position ? 1 : 2,
      .settings = std::move(settings)};
}

std::string refuses(const Problem& p, const Formulation& f) { return joint_refusal(p, f, Rows::may_depend); }

}  // namespace

IntegratorEntry generalized_alpha_index3() {
  return joint_method<GeneralizedAlpha>(
      declaration("generalized_alpha_index3", "generalized-alpha on the Lie group with g(q) = 0 (index 3)",
                  R"(g(q_{n+1}) = 0, \quad \zeta_n = 0)", JointEquations::position,
                  {spectral_radius(), start_values()}),
      refuses, AlphaForm::index3);
}
IntegratorEntry generalized_alpha_index2() {
  return joint_method<GeneralizedAlpha>(
      declaration("generalized_alpha_index2",
                  "generalized-alpha on the Lie group with g(q) = 0 and G v = 0 (stabilized index 2)",
                  R"(g(q_{n+1}) = 0, \quad G_{n+1} v_{n+1} = 0, \quad \zeta_n = M^{-1} G_n^{\mathsf T} \eta_n)",
                  JointEquations::position_and_velocity, {spectral_radius()}),
      refuses, AlphaForm::index2);
}

}  // namespace polhode::integrators
