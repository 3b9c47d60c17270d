// SPDX-License-Identifier: BSD-3-Clause
// SHAKE and RATTLE for rigid bodies with joints: kick, free flow, kick, in which the kicks hold reactions.
//
// RATTLE:  p_½ = p + (h/2) (f(q) + Gᵀ(q) λ),   q₊ = q after the free flow of p_½ over h,   g(q₊) = 0,
//          p₊ = p_½ + (h/2) (f(q₊) + Gᵀ(q₊) μ),   G(q₊) v₊ = 0.
// SHAKE:   the same positions; p₊ = p_½ + (h/2) (f(q₊) + Gᵀ(q₊) λ₊), where λ₊ belongs to the position at the end of the
//          next step. Its velocities do not satisfy G v = 0; they differ from RATTLE's by O(h²).
//
// The free flow turns each body by one of two rotors. In `shake` and `rattle` it is the discrete Moser–Veselov
// equation, which is RATTLE for the entries of the rotation matrix with the constraints RᵀR = 1. With it SHAKE is also
// the variational integrator in maximal coordinates, whose discrete Lagrangian is the same function of two unit
// quaternions (Brüdigam & Manchester). In `shake_lie` and `rattle_lie` the rotor is variational for the exponential
// map,
//   m = dexp⁻ᵀ(h Ω) I Ω,  R₊ = R exp(h Ω),
// so that the method is RATTLie. Multipliers follow from Broyden's or Newton's method to round-off. RATTLE's own
// multiplier μ has order 1, SHAKE's λ₊ order 2.
// Sources: Ryckaert, Ciccotti & Berendsen, J. Comput. Phys. 23 (1977); Andersen, J. Comput. Phys. 52 (1983); Leimkuhler
// & Skeel, J. Comput. Phys. 112 (1994); McLachlan & Zanna, Found. Comput. Math. 5 (2005); Hante & Arnold, J. Comput.
// Appl. Math. 387 (2021); Brüdigam & Manchester, WAFR 2020.
#include <algorithm>

#include "integrators/conserving/exponential_rotor.hpp"
#include "integrators/conserving/kick.hpp"
#include "integrators/conserving/moser_veselov.hpp"
#include "integrators/joints/joint_method.hpp"
#include "integrators/joints/joint_refusal.hpp"
#include "integrators/lie_group/root.hpp"

namespace polhode::inline integrators {
namespace {

enum class Velocities { of_next_positions, projected };  // SHAKE, RATTLE
using Turn = const char* (*)(const Vector3<double>& moments, double h, Vector3<double>& m, Quaternion<double>& dq);

class Rattle final : public JointMethod, private StepEquations<double> {
 public:
  Rattle(const System<double>& system, const IntegratorSettings&, Velocities velocities, Turn turn)
      : JointMethod(system), velocities_(velocities), turn_(turn), midpoint_(bodies_) {
    for (const auto& force : system.forces()) reads_velocity_ = reads_velocity_ || force->reads_velocity();
  }

  void begin(const State<double>& state) override {
    evaluations_ = 0;
    root_ = {};
    Flat rate = bodies_.zero();
    bodies_.rate(state.t, state.y, rate);
    ++evaluations_;
    discard_history(state);
    lambda_ = multiplier_ = joints_.multipliers();
  }
  std::optional<std::int64_t> iterations() const override { return root_.iterations(); }
  void discard_history(const State<double>&) override { known_for_ = 0; }

 private:
  const char* take(double t, double h, Flat& y) override {
    if (known_for_ != h) {  // the first step, or a step of another size
      ahead_ = h / 2;
      if (const char* why = close_next_position(t, h, y)) return why;
    }
    if (const char* why = kick(t, h / 2, multiplier_, y)) return why;
    if (const char* why = flow(h, y)) return why;
    known_for_ = 0;
    if (velocities_ == Velocities::projected) {
      if (const char* why = close_velocity(t + h, h, y)) return why;
    } else {
      ahead_ = h;
      if (const char* why = close_next_position(t + h, h, y)) return why;
      known_for_ = h;
    }
    lambda_ = multiplier_;
    return kick(t + h, h / 2, multiplier_, y);
  }

  /// λ for which g = 0 after a kick of length ahead_ and a free flow of length h from y.
  const char* close_next_position(double t, double h, const Flat& y) {
    of_position_ = true;
    return close(t, h, ahead_ * h, y);
  }
  /// μ for which G v = 0 after a kick of length h/2.
  const char* close_velocity(double t, double h, const Flat& y) {
    of_position_ = false;
    ahead_ = h / 2;
    return close(t, h, ahead_, y);
  }

  /// Solves for multiplier_. A change of it by δ changes g or G v by about `gain` G M⁻¹ Gᵀ δ.
  const char* close(double t, double h, double gain, const Flat& y) {
    t_ = t;
    h_ = h;
    gain_ = gain;
    y_ = &y;
    why_ = nullptr;
    evaluate(y);
    x_ = multiplier_ * (gain / mean_mass_);
    if (const char* why = root_.solve(*this, x_, scale())) return why_ ? why_ : why;
    multiplier_ = x_ * (mean_mass_ / gain);
    return nullptr;
  }

  void residual(const VectorX<double>& x, VectorX<double>& f) override {
    trial_ = *y_;
    const VectorX<double> multiplier = x * (mean_mass_ / gain_);
    const char* why = kick(t_, ahead_, multiplier, trial_);
    if (!why && of_position_) why = flow(h_, trial_);
    if (why) {
      why_ = why;
      f.setConstant(x.size(), std::numeric_limits<double>::quiet_NaN());
      return;
    }
    evaluate(trial_);
    open_.resize(rows());
    if (of_position_) {
      for (Eigen::Index k = 0; k < rows(); ++k) open_[k] = joints_.equations()[std::size_t(k)].residual;
    } else {
      twists_.resize(bodies_.moving());
      for (std::size_t i = 0; i < twists_.size(); ++i)
        twists_[i] = {motions_[i].velocity, motions_[i].angular_velocity};
      joints_.multiply(twists_, open_);
    }
    joints_.solve(open_, correction_);
    f = correction_ / mean_mass_;
  }

  const char* kick(double t, double h, const VectorX<double>& multiplier, Flat& y) {
    const PrescribedMultipliers<double> prescribed(joints_, multiplier);
    if (reads_velocity_) {
      const std::int64_t before = midpoint_.evaluations();
      const char* why = midpoint_(bodies_, t, h, y);
      evaluations_ += midpoint_.evaluations() - before;
      return why;
    }
    bodies_.kick(t, h, y);
    ++evaluations_;
    return nullptr;
  }

  const char* flow(double h, Flat& y) {
    const char* why = nullptr;
    bodies_.free_flow(h, y, [&](const BodyConstants<double>& body, double over, Vector3<double>& m) {
      Quaternion<double> turn = identity_quaternion<double>();
      if (const char* failure = turn_(body.moments, over, m, turn)) why = failure;
      return turn;
    });
    return why;
  }

  const Velocities velocities_;
  const Turn turn_;
  Kick<ManyBodies<double>> midpoint_;
  bool reads_velocity_ = false;  ///< forces do
  VectorX<double> multiplier_;
  double known_for_ = 0;  ///< step size (s) for which multiplier_ belongs to the start of the next step; 0: unknown
  // The equations that are being solved.
  bool of_position_ = true;
  double t_ = 0, h_ = 0, ahead_ = 0, gain_ = 1;
  const Flat* y_ = nullptr;
  const char* why_ = nullptr;
  Flat trial_;
  VectorX<double> x_, open_, correction_;
  std::vector<Wrench<double>> twists_;
  RootFinder<double> root_;
};

constexpr const char* rattle_equation =
    R"(p_{n+1/2} &= p_n + \tfrac h2 \bigl(f(q_n) + G_n^{\mathsf T} \lambda_n\bigr), \quad
  q_{n+1} = \varphi_h(q_n, p_{n+1/2}), \quad g(q_{n+1}) = 0 \\
p_{n+1} &= p_{n+1/2} + \tfrac h2 \bigl(f(q_{n+1}) + G_{n+1}^{\mathsf T} \mu_{n+1}\bigr), \quad G_{n+1} v_{n+1} = 0 \\
)";
constexpr const char* shake_equation =
    R"(p_{n+1/2} &= p_n + \tfrac h2 \bigl(f(q_n) + G_n^{\mathsf T} \lambda_n\bigr), \quad
  q_{n+1} = \varphi_h(q_n, p_{n+1/2}), \quad g(q_{n+1}) = 0 \\
p_{n+1} &= p_{n+1/2} + \tfrac h2 \bigl(f(q_{n+1}) + G_{n+1}^{\mathsf T} \lambda_{n+1}\bigr) \\
)";
constexpr const char* moser_veselov_flow =
    R"(\varphi_h:\ & h\,\hat m = S D - D S^{\mathsf T}, \quad m \leftarrow S^{\mathsf T} m, \quad R \leftarrow R\,S)";
constexpr const char* exponential_flow =
    R"(\varphi_h:\ & m = \operatorname{dexp}_{-h\Omega}^{-\mathsf T} I\,\Omega, \quad
  m \leftarrow \exp(-h \hat\Omega)\,m, \quad R \leftarrow R \exp(h \hat\Omega))";

IntegratorEntry entry(std::string name, std::string summary, std::string equation, std::vector<std::string> sources,
                      Velocities velocities, Turn turn) {
  const bool projected = velocities == Velocities::projected;
  return joint_method<Rattle>(
      {.name = std::move(name),
       .family = "constrained",
       .summary = std::move(summary),
       .equation = std::move(equation),
       .sources = std::move(sources),
       .order = 2,
       .implicit = true,
       .multi_step = !projected,
       .lie_group = true,
       .symplectic = projected,
       .symmetric = projected,
       .joints = projected ? JointEquations::position_and_velocity : JointEquations::position,
       .multiplier_order = projected ? 1 : 2},
      [](const Problem& p, const Formulation& f) {
        if (std::string why = joint_refusal(p, f, Rows::may_depend); !why.empty()) return why;
        const Constraints<double> joints(p, f);
        const auto& rows = joints.equations();
        const bool holonomic = std::all_of(rows.begin(), rows.end(), [](const auto& row) { return row.holonomic; });
        return std::string(holonomic ? "" : "a joint is not holonomic, and its reactions follow from positions");
      },
      velocities, turn);
}

constexpr Turn by_moser_veselov = &moser_veselov_turn<double>;
constexpr Turn by_exponential = &exponential_turn<double>;

}  // namespace

IntegratorEntry shake() {
  return entry("shake", "kick with reactions, Moser-Veselov flow, kick; g(q) = 0; variational in maximal coordinates",
               std::string(shake_equation) + moser_veselov_flow,
               {"ryckaertCiccottiBerendsen1977", "leimkuhlerSkeel1994", "mclachlanZanna2005", "brudigamManchester2020"},
               Velocities::of_next_positions, by_moser_veselov);
}
IntegratorEntry rattle() {
  return entry("rattle", "kick with reactions, Moser-Veselov flow, kick; g(q) = 0 and G v = 0",
               std::string(rattle_equation) + moser_veselov_flow,
               {"andersen1983", "leimkuhlerSkeel1994", "mclachlanZanna2005"}, Velocities::projected, by_moser_veselov);
}
IntegratorEntry shake_lie() {
  return entry("shake_lie", "kick with reactions, variational flow by the exponential map, kick; g(q) = 0",
               std::string(shake_equation) + exponential_flow,
               {"hanteArnold2021", "ryckaertCiccottiBerendsen1977", "leimkuhlerSkeel1994"},
               Velocities::of_next_positions, by_exponential);
}
IntegratorEntry rattle_lie() {
  return entry("rattle_lie",
               "RATTLie: kick with reactions, variational flow by the exponential map, kick; g = 0, G v = 0",
               std::string(rattle_equation) + exponential_flow,
               {"hanteArnold2021", "andersen1983", "leimkuhlerSkeel1994"}, Velocities::projected, by_exponential);
}

}  // namespace polhode::integrators
