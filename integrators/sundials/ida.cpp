// SPDX-License-Identifier: BSD-3-Clause
// IDA's variable-order, variable-step backward differentiation (orders 1 to 5) for the constrained equations of motion
// in the unknowns q, v, λ and, in two forms, μ:
//
//   q̇ = N(q) (v + M⁻¹ Gᵀ μ),   M v̇ = f + Gᵀ λ,   and
//   index1   G v̇ = γ, μ = 0                  index2   G v = 0, μ = 0         index3   g(q) = 0, μ = 0
//   ggl      g(q) = 0 and G v = 0 (Gear, Gupta & Leimkuhler; index 2)
//   ah       the same with λ = Λ̇ and μ = Ṁ, the derivatives of unknowns (Anantharaman & Hiller; index 1)
//
// An equation that is not holonomic is G v = 0 in every form but index1, and its μ is 0. Tolerances of each kind of
// unknown, with the tolerance tol of the run: relative tol for all; absolute tol for q, v and work, 1e6 tol for λ and
// μ, which are left out of the error test. In index3 v is left out, too, and the absolute tolerances of v and λ are 1e4
// tol and 1e10 tol: tighter ones are below the round-off of g over h and h². Newton's iteration has a dense Jacobian:
// by forward differences for y = (q, v, work), exact for λ and μ, in which the residual is linear.
//
// Sources: Brenan,
// Campbell & Petzold (1996), chapters 2 and 6; Gear, Leimkuhler & Gupta (1985); Anantharaman & Hiller (1991); Hindmarsh
// et al. (2005); the IDA 6.4 user guide.
#include <ida/ida.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <new>

#include "core/system/constraints.hpp"
#include "core/system/joint_projection.hpp"
#include "core/system/many_bodies.hpp"
#include "integrators/joints/joint_refusal.hpp"
#include "integrators/sundials/sundials_integrator.hpp"

namespace polhode::inline integrators {
namespace {

using namespace sundials;

enum class Form { index1, index2, index3, ggl, ah };

void free_ida(void* memory) { IDAFree(&memory); }
constexpr int most_failures = 50;  // limit for one step; the defaults are 10

using IdaMemory = std::unique_ptr<void, Destroy<free_ida>>;
using Map = Eigen::Map<VectorX<double>>;

class Ida final : public SundialsIntegrator {
 public:
  Ida(const System<double>& system, const IntegratorSettings& settings, Form form)
      : SundialsIntegrator(system, settings),
        form_(form),
        bodies_(dynamic_cast<const ManyBodies<double>&>(system)),
        joints_(*system.constraints()),
        ny_(system.size()),
        m_(Eigen::Index(joints_.rows())),
        size_(ny_ + (two_multipliers() ? 2 : 1) * m_),
        y_(ny_),
        dy_(ny_),
        shifted_(ny_),
        lambda_(m_) {}

  std::span<const double> multipliers() const override { return {lambda_.data(), std::size_t(m_)}; }
  std::span<const double> interpolated_multipliers() const override {
    return {between_lambda_.data(), std::size_t(between_lambda_.size())};
  }

 private:
  bool two_multipliers() const { return form_ == Form::ggl || form_ == Form::ah; }

  void create(double t, N_Vector y, SundialsIntegrator* self) override {
    for (Vector* v : {&z_, &dz_, &between_, &tolerances_, &kinds_, &moved_}) {
      v->reset(N_VNew_Serial(size_, context()));
      if (!*v) throw std::bad_alloc();
    }
    fill_start(t, y);
    memory_.reset(IDACreate(context()));
    if (!memory_) throw std::bad_alloc();
    check(IDASetErrFile(memory_.get(), nullptr), "IDASetErrFile");
    check(IDAInit(memory_.get(), &residual_function, t, z_.get(), dz_.get()), "IDAInit");
    check(IDASetUserData(memory_.get(), self), "IDASetUserData");
    const Layout& layout = system().layout();
    const bool third = form_ == Form::index3;
    of(tolerances_).setConstant((third ? 1e10 : 1e6) * tolerance());
    of(tolerances_).head(ny_).setConstant((third ? 1e4 : 1) * tolerance());
    of(tolerances_).head(layout.configuration_size).setConstant(tolerance());
    check(IDASVtolerances(memory_.get(), tolerance(), tolerances_.get()), "IDASVtolerances");
    of(kinds_).setZero();  // out of the error test
    of(kinds_).head(ny_).setOnes();
    if (third) of(kinds_).segment(layout.configuration_size, layout.velocity_size).setZero();
    check(IDASetId(memory_.get(), kinds_.get()), "IDASetId");
    check(IDASetSuppressAlg(memory_.get(), SUNTRUE), "IDASetSuppressAlg");
    check(IDASetMaxNumSteps(memory_.get(), max_steps), "IDASetMaxNumSteps");
    check(IDASetInitStep(memory_.get(), first_step()), "IDASetInitStep");
    // After a restart at order 1 the step that was due is far too long.
    check(IDASetMaxErrTestFails(memory_.get(), most_failures), "IDASetMaxErrTestFails");
    check(IDASetMaxConvFails(memory_.get(), most_failures), "IDASetMaxConvFails");
    matrix_.reset(SUNDenseMatrix(size_, size_, context()));
    linear_.reset(SUNLinSol_Dense(z_.get(), matrix_.get(), context()));
    if (!matrix_ || !linear_) throw std::bad_alloc();
    check(IDASetLinearSolver(memory_.get(), linear_.get(), matrix_.get()), "IDASetLinearSolver");
    check(IDASetJacFn(memory_.get(), &jacobian_function), "IDASetJacFn");
  }

  /// Size (s) of the first step: IDA's own choice, a half over the norm of ẏ in the tolerances, falls with the
  /// tolerance to sizes at which the Jacobian of the higher indices is singular to round-off.
  double first_step() const {
    const auto allowed = tolerance() * of(z_).head(ny_).array().abs() + of(tolerances_).head(ny_).array();
    const double norm = std::sqrt((of(dz_).head(ny_).array() / allowed).square().mean());
    return norm > 0 ? 0.5 / (norm * std::sqrt(tolerance())) : 0;  // 0: IDA's own choice
  }

  void restart(double t, N_Vector y) override {
    double h = 0;
    check(IDAGetCurrentStep(memory_.get(), &h), "IDAGetCurrentStep");
    make_consistent(y);
    fill_start(t, y);
    check(IDAReInit(memory_.get(), t, z_.get(), dz_.get()), "IDAReInit");
    check(IDASetInitStep(memory_.get(), h), "IDASetInitStep");
  }

  /// Moves a state that was changed from outside onto the equations of the joints that the form satisfies.
  void make_consistent(N_Vector y) {
    y_ = Map(N_VGetArrayPointer(y), ny_);
    if (form_ == Form::index1) return;
    if (form_ != Form::index2) project_joint_positions(system(), y_);
    project_joint_velocities(system(), y_);
    Map(N_VGetArrayPointer(y), ny_) = y_;
  }

  /// z and ż from the state: λ of the index-1 form, μ = 0. λ̇ and μ̇ are predicted as 0.
  void fill_start(double t, N_Vector y) {
    of(z_).setZero();
    of(dz_).setZero();
    of(z_).head(ny_) = Map(N_VGetArrayPointer(y), ny_);
    system().rate(t, of(z_).data(), of(dz_).data());
    count_evaluation();
    lambda_ = joints_.multipliers();
    (form_ == Form::ah ? of(dz_) : of(z_)).segment(ny_, m_) = lambda_;
  }

  int evolve(double stop, N_Vector y, double* t) override {
    check(IDASetStopTime(memory_.get(), stop), "IDASetStopTime");
    const int flag = IDASolve(memory_.get(), stop, t, z_.get(), dz_.get(), IDA_ONE_STEP);
    Map(N_VGetArrayPointer(y), ny_) = of(z_).head(ny_);
    lambda_ = of(form_ == Form::ah ? dz_ : z_).segment(ny_, m_);
    return flag;
  }

  int derivative(double t, N_Vector y) const override {
    if (const int flag = IDAGetDky(memory_.get(), t, form_ == Form::ah ? 1 : 0, between_.get()); flag != 0) return flag;
    between_lambda_ = of(between_).segment(ny_, m_);
    if (form_ == Form::ah) {
      if (const int flag = IDAGetDky(memory_.get(), t, 0, between_.get()); flag != 0) return flag;
    }
    Map(N_VGetArrayPointer(y), ny_) = of(between_).head(ny_);
    return 0;
  }

  int watch(int count) override { return IDARootInit(memory_.get(), count, &root_function); }
  int roots(int* signs) override { return IDAGetRootInfo(memory_.get(), signs); }
  std::optional<long> iterations_counted() const override {
    long count = 0;
    check(IDAGetNumNonlinSolvIters(memory_.get(), &count), "IDAGetNumNonlinSolvIters");
    return count;
  }
  std::string flag_name(int flag) const override {
    const std::unique_ptr<char, decltype(&std::free)> name(IDAGetReturnFlagName(flag), &std::free);
    return name.get();
  }
  const char* library() const override { return "IDA"; }

  /// F(t, z, ż): ẏ − f(t, y, λ, μ), then the equations of the joints.
  void residual(double t, const double* z, const double* dz, double* f) {
    count_evaluation();
    const double* multipliers = (form_ == Form::ah ? dz : z) + ny_;
    trial_lambda_ = Eigen::Map<const VectorX<double>>(multipliers, m_);
    const PrescribedMultipliers<double> prescribed(joints_, trial_lambda_);
    y_ = Eigen::Map<const VectorX<double>>(z, ny_);
    bodies_.rate(t, y_, dy_);
    Map equations(f + ny_, m_);
    switch (form_) {
      case Form::index1: equations = joints_.acceleration_defects(); break;
      case Form::index3: positions(equations, joints_.rates()); break;
      default: equations = joints_.rates();
    }
    if (two_multipliers()) {
      const Eigen::Map<const VectorX<double>> mu(multipliers + m_, m_);
      positions(Map(f + ny_ + m_, m_), mu);
      shift(t, mu);
    }
    Map(f, ny_) = Eigen::Map<const VectorX<double>>(dz, ny_) - dy_;
  }

  /// g of each holonomic equation, and `other` of the rest.
  template <class To, class Other>
  void positions(To&& to, const Other& other) const {
    const auto& rows = joints_.equations();
    for (Eigen::Index k = 0; k < m_; ++k) {
      const auto& row = rows[std::size_t(k)];
      to[k] = row.holonomic ? row.residual : other[k];
    }
  }

  /// q̇ at the velocity v + M⁻¹ Gᵀ μ.
  template <class Multipliers>
  void shift(double t, const Multipliers& mu) {
    impulses_.assign(system().moving(), Wrench<double>{});
    joints_.add_transposed(mu, impulses_);
    shifted_ = y_;
    for (std::size_t i = 0; i < system().moving(); ++i) {
      system().apply_impulse(shifted_, i, impulses_[i].force, impulses_[i].torque);
    }
    rate_of_shifted_ = dy_;
    bodies_.configuration_rate(t, shifted_, rate_of_shifted_);
    count_evaluation();
    bodies_.configuration_part(dy_) = bodies_.configuration_part(rate_of_shifted_);
  }

  /// ∂F/∂z + c ∂F/∂ż.
  void jacobian(double t, double c, double* z, double* dz, const double* f, SUNMatrix to) {
    const double increment = std::sqrt(std::numeric_limits<double>::epsilon());
    double* moved = N_VGetArrayPointer(moved_.get());
    for (Eigen::Index j = 0; j < size_; ++j) {
      double* column = SUNDenseMatrix_Column(to, j);
      const bool multiplier = j >= ny_;
      double& unknown = multiplier && form_ == Form::ah ? dz[j] : z[j];
      const double kept = unknown;
      unknown += (multiplier ? 1 : increment) * std::max(1.0, std::abs(kept));
      const double change = unknown - kept;
      residual(t, z, dz, moved);
      unknown = kept;
      const double scale = (multiplier && form_ == Form::ah ? c : 1) / change;
      for (Eigen::Index i = 0; i < size_; ++i) column[i] = (moved[i] - f[i]) * scale;
      if (!multiplier) column[j] += c;
    }
  }

  static bool finite(const double* f, Eigen::Index n) { return Eigen::Map<const VectorX<double>>(f, n).allFinite(); }
  static Ida& self_of(void* user_data) { return static_cast<Ida&>(*static_cast<SundialsIntegrator*>(user_data)); }

  static int residual_function(double t, N_Vector z, N_Vector dz, N_Vector f, void* user_data) {
    Ida& self = self_of(user_data);
    self.residual(t, N_VGetArrayPointer(z), N_VGetArrayPointer(dz), N_VGetArrayPointer(f));
    return finite(N_VGetArrayPointer(f), self.size_) ? 0 : 1;
  }
  static int jacobian_function(double t, double c, N_Vector z, N_Vector dz, N_Vector f, SUNMatrix to, void* user_data,
                               N_Vector, N_Vector, N_Vector) {
    Ida& self = self_of(user_data);
    self.jacobian(t, c, N_VGetArrayPointer(z), N_VGetArrayPointer(dz), N_VGetArrayPointer(f), to);
    return finite(SUNDenseMatrix_Data(to), self.size_ * self.size_) ? 0 : 1;
  }
  static int root_function(double t, N_Vector z, N_Vector, double* values, void* user_data) {
    return find_roots(t, z, values, user_data);  // reads the state at the head of z
  }

  static Map of(const Vector& v) { return {N_VGetArrayPointer(v.get()), N_VGetLength(v.get())}; }

  const Form form_;
  const ManyBodies<double>& bodies_;
  const Constraints<double>& joints_;
  const Eigen::Index ny_, m_, size_;  ///< numbers of the state, of equations and of unknowns
  VectorX<double> y_, dy_, shifted_, rate_of_shifted_, trial_lambda_;
  VectorX<double> lambda_;                  ///< multipliers at the end of the last step
  mutable VectorX<double> between_lambda_;  ///< multipliers at the last interpolation
  std::vector<Wrench<double>> impulses_;
  Vector z_, dz_, between_, tolerances_, kinds_, moved_;
  Matrix matrix_;
  LinearSolver linear_;
  IdaMemory memory_;
};

constexpr const char* tolerances =
    R"(q, v: \mathrm{tol}, \quad \lambda, \mu: 10^6\,\mathrm{tol}, \text{ out of the error test})";
constexpr const char* third_tolerances =
    R"(q: \mathrm{tol}, \quad v: 10^4\,\mathrm{tol}, \quad \lambda: 10^{10}\,\mathrm{tol}, \text{ both out of the error test})";

IntegratorEntry entry(std::string name, std::string summary, std::string equation, std::vector<std::string> sources,
                      Form form, JointEquations joints) {
  sources.insert(sources.begin() + (sources.size() > 1 ? 1 : 0), "hindmarsh2005");
  return {.declaration = {.name = std::move(name),
                          .family = "SUNDIALS",
                          .summary = "IDA, backward differentiation of orders 1 to 5 for " + std::move(summary),
                          .equation = R"(\dot q &= N(q)\,(v + M^{-1} G^T \mu), \quad M \dot v = f + G^T \lambda, \\
)" + std::move(equation) + R"( \\
\text{absolute tolerances}\quad & )" + std::string(form == Form::index3 ? third_tolerances : tolerances),
                          .sources = std::move(sources),
                          .adaptive = true,
                          .implicit = true,
                          .multi_step = true,
                          .joints = joints},
          .make = [form](const System<double>& system, const IntegratorSettings& settings)
              -> IntegratorPointer<double> { return std::make_unique<Ida>(system, settings, form); },
          .refusal = [](const Problem& p, const Formulation& f) { return joint_refusal(p, f, Rows::independent); }};
}

}  // namespace

IntegratorEntry ida_index1() {
  return entry("ida_index1", "G v' = gamma (index 1)", R"(G \dot v &= \gamma, \quad \mu = 0)", {"brenan1996"},
               Form::index1, JointEquations::acceleration);
}
IntegratorEntry ida_index2() {
  return entry("ida_index2", "G v = 0 (index 2)", R"(G v &= 0, \quad \mu = 0)", {"brenan1996"}, Form::index2,
               JointEquations::velocity);
}
IntegratorEntry ida_index3() {
  return entry("ida_index3", "g(q) = 0 (index 3), v out of the error test", R"(g(q) &= 0, \quad \mu = 0)",
               {"brenan1996"}, Form::index3, JointEquations::position);
}
IntegratorEntry ida_ggl() {
  return entry("ida_ggl", "g(q) = 0 and G v = 0 of Gear, Gupta and Leimkuhler (index 2)", R"(g(q) &= 0, \quad G v = 0)",
               {"gearLeimkuhlerGupta1985", "brenan1996"}, Form::ggl, JointEquations::position_and_velocity);
}
IntegratorEntry ida_ah() {
  return entry("ida_ah", "g(q) = 0 and G v = 0 of Anantharaman and Hiller (index 1)",
               R"(g(q) &= 0, \quad G v = 0, \quad \lambda = \dot\Lambda, \quad \mu = \dot{\mathrm M})",
               {"anantharamanHiller1991", "gearLeimkuhlerGupta1985"}, Form::ah, JointEquations::position_and_velocity);
}

}  // namespace polhode::integrators
