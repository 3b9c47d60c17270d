// SPDX-License-Identifier: BSD-3-Clause
// The port of integrators: the interface between the simulation loop and a numerical method. Its calls are virtual, one
// for each step or batch of steps.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "core/math/lanes.hpp"
#include "core/run/setting.hpp"
#include "core/system/system.hpp"

namespace polhode::inline core::inline run {

/// Outcome of a step. A failed step leaves the state unchanged and gives the reason.
struct StepResult {
  std::string failure;  ///< reason for the failure; empty on success
  bool ok() const { return failure.empty(); }
};

/// The equations of the joints that a method satisfies with multipliers of its own.
enum class JointEquations {
  of_formulation,  ///< none: it integrates the index-1 form, and drifts as the formulation's stabilization lets it
  acceleration,    ///< G v̇ = γ
  velocity,        ///< G v = 0
  position,        ///< g(q) = 0
  position_and_velocity,
  impulses  ///< none: its impulses bring G v near a value that closes a share of g
};

/// Declared properties of a method. The conformance tests verify each of them by measurement.
struct Declaration {
  std::string name;     ///< name in the catalogue
  std::string family;   ///< family of the method: textbook, SUNDIALS, Boost.Odeint, …
  std::string summary;  ///< formula or principle in one line
  /// The scheme as it is coded, in LaTeX with amsmath: the rows of an `aligned` environment. Its symbols are those of
  /// guide/methods/notation.md.
  std::string equation{};
  std::vector<std::string> sources{};  ///< keys of papers/references.bib, the source of the scheme first
  int order = 0;                       ///< order of the global error under forces; 0: variable
  int free_order = 0;                  ///< order for bodies without forces; exact_order: exact; 0: same as `order`
  bool adaptive = false;               ///< controls its step size by a tolerance; false: fixed step h
  bool implicit = false;               ///< solves equations in each step
  int evaluations_per_step = 0;        ///< right-hand sides per step; 0: not constant, counted by the method
  bool multi_step = false;             ///< uses past steps, which an impact or a projection invalidates
  /// The step adds an increment to the flat state, y' = y + Δ(t, h, y), so that the sum can be compensated.
  bool additive = false;
  bool lie_group = false;   ///< updates orientations by group elements, so that they stay on their manifold
  bool normalizes = false;  ///< normalizes the orientations at the end of its own step
  /// Conserves every quadratic invariant of the flat ODE, among them |q|² and RᵀR. Gauss methods do.
  bool conserves_quadratics = false;
  bool symplectic = false;  ///< preserves the canonical two-form if the forces have a potential
  bool symmetric = false;   ///< a step of −h is the inverse of a step of h
  /// Conserves the energy of free bodies, to round-off or to the tolerance of its iteration, in every formulation that
  /// the method supports. The next two properties hold for free bodies in the same sense.
  bool conserves_energy = false;
  bool conserves_momentum = false;  ///< conserves the angular momentum in world axes
  bool conserves_casimir = false;   ///< conserves |IΩ|, the length of the angular momentum in body axes
  JointEquations joints = JointEquations::of_formulation;  ///< equations of the joints that it solves itself
  int multiplier_order = 0;         ///< order of its own multipliers of the joints; 0: same as `order`
  bool refuses_joints = false;      ///< its step has no place for reactions
  std::vector<Setting> settings{};  ///< settings of its own; the method reads them from IntegratorSettings

  bool solves_joints() const { return joints != JointEquations::of_formulation; }

  static constexpr int exact_order = 1000;  ///< value of free_order of a method that is exact for free bodies
};

/// Settings of a method. Fixed-step methods read the step size, adaptive ones the tolerance.
struct IntegratorSettings {
  double dt = 1e-3;         ///< step size, s
  double tolerance = 1e-8;  ///< relative tolerance and absolute tolerance
  double t_end = 1;         ///< end time, s; only sets the sign and scale of the first step
  bool project = false;     ///< project after each step: by the method if it can, else by the loop
  SettingValues chosen{};   ///< chosen values of the method's own settings

  /// The chosen or usual value of a setting of the method. Throws std::invalid_argument if it is not allowed.
  std::int64_t whole(const Setting& setting) const { return std::get<std::int64_t>(value_of(chosen, setting)); }
  double number(const Setting& setting) const { return std::get<double>(value_of(chosen, setting)); }
  std::string text(const Setting& setting) const { return std::get<std::string>(value_of(chosen, setting)); }
};

/// Scalar function of the state whose zeros are events.
template <class S>
using EventFunction = std::function<double(const State<S>&)>;

/// Measurements of the state after a step. They suffice for every energy ledger without the state itself.
/// T: double, or Lanes in an ensemble, in which each lane has a run of its own.
template <class T>
struct SampleOf {
  T t{};                ///< time, s
  Measurement<T> seen;  ///< energies, momenta and orientation defect of the state
  T work{};             ///< work of the non-conservative forces since the start, J
  /// Energy injected by projection, J: by the projection after this step in a batch of steps, by all projections since
  /// the start in the samples that an observer gets.
  T projection{};
  /// Work of the joints since the start, J. It is not zero where drift or Baumgarte's method leaves G v ≠ 0.
  T joint_work{};

  /// Balance of the energy ledger, J: kinetic + potential − work − work of the joints + lost in contact − injected by
  /// projection. It is constant along the exact motion.
  T ledger(double lost_in_contact) const { return seen.energy() - work - joint_work - projection + T(lost_in_contact); }
};
using Sample = SampleOf<double>;
using LaneSample = SampleOf<Lanes>;

/// A batch of steps of equal size, taken in one call. Step k ends at t = t0 + (first + k) h, k = 1 … count. T: double,
/// or Lanes in an ensemble, in which each lane has a step size and a time of its own.
template <class T>
struct StepBatchOf {
  T h{};                   ///< step size, s
  std::int64_t count = 1;  ///< number of steps
  T t0{};                  ///< time origin, s
  /// Number of steps between t0 and the start of the batch; of lanes, one for each.
  std::conditional_t<is_lanes<T>, Lanes, std::int64_t> first{};
  bool project = false;            ///< project onto the manifold and discard the history after each step
  SampleOf<T>* samples = nullptr;  ///< output: one sample per step; null: none
  /// Output: the motion of the first body, one per sample; null: none. Of lanes only.
  BodyMotion<T>* motions = nullptr;

  /// Time (s) at the end of step k.
  T time(std::int64_t k) const {
    if constexpr (is_lanes<T>) return t0 + (first + Lanes(static_cast<double>(k))) * h;
    else return t0 + static_cast<double>(first + k) * h;
  }
};
using StepBatch = StepBatchOf<double>;
using LaneBatch = StepBatchOf<Lanes>;

/// Ability of a method: dense output, the state within the last step.
template <class S>
class DenseOutput {
 public:
  /// Writes the state at time t (s). Returns false if t lies outside the last step; `state` is then unchanged.
  virtual bool interpolate(double t, State<S>& state) const = 0;

  /// Multipliers of the joints at the time of the last interpolation, as Integrator::multipliers().
  virtual std::span<const S> interpolated_multipliers() const { return {}; }

 protected:
  ~DenseOutput() = default;
};

/// Ability of a method: native event location. A step ends at the root of an event function that changes sign.
template <class S>
class NativeRoots {
 public:
  /// Sets the event functions; to be called before begin(). An event function that is zero at the start of a run or
  /// step is monitored again once it is nonzero.
  virtual void set_events(std::vector<EventFunction<S>> events) = 0;
  /// Sign change of each event function at the end of the last step: 1 rising, −1 falling, 0 none.
  virtual std::span<const int> events() const = 0;

 protected:
  ~NativeRoots() = default;
};

/// Ability of a method: projection within its own steps, as requested by its settings. The loop then does not project.
class NativeProjection {
 public:
  /// Energy (J) injected by the projections since begin(): the sum over all steps of the energy after the projection at
  /// the end of the step minus the energy before it. The effect of a projection on the method's history, and so on
  /// later steps, counts as integration error of those steps.
  virtual double projection_energy() const = 0;

 protected:
  ~NativeProjection() = default;
};

/// Interface of a numerical method in the scalar S. One object serves one run.
template <class S>
class Integrator {
 public:
  using Batch = StepBatchOf<std::conditional_t<is_lanes<S>, Lanes, double>>;

  Integrator() = default;
  Integrator(const Integrator&) = delete;
  Integrator& operator=(const Integrator&) = delete;
  virtual ~Integrator() = default;

  /// Prepares a run from the initial `state`. Called once, before any step.
  virtual void begin(const State<S>& state) = 0;

  /// Advances `state` and its time by one step. The step length is exactly h (s) for fixed-step methods. For adaptive
  /// methods it is at most h and limited by their tolerance.
  virtual StepResult step(State<S>& state, double h) = 0;

  /// True for a method whose advance() projects and fills samples itself, which lets the compiler inline the whole
  /// batch. For other methods the loop does both after each step, with bitwise equal results.
  virtual bool takes_batches() const { return false; }

  /// Takes a batch of steps in one call. Fixed-step methods only.
  virtual StepResult advance(State<S>& state, const Batch& batch) {
    if constexpr (is_lanes<S>) {
      return {"a method in lanes takes batches of steps itself"};
    } else {
      StepResult result;
      for (std::int64_t k = 1; k <= batch.count && result.ok(); ++k) {
        result = step(state, batch.h);
        if (result.ok()) state.t = batch.time(k);
      }
      return result;
    }
  }

  /// Takes n steps of size h (s) without samples or projection.
  StepResult advance(State<S>& state, double h, std::int64_t n) {
    return advance(state, Batch{.h = h, .count = n, .t0 = state.t});
  }

  /// Number of right-hand side evaluations since begin().
  virtual std::int64_t evaluations() const = 0;

  /// Number of iterations since begin() in which the method has solved the equations of its steps, of all bodies
  /// together. Absent: it solves none by iteration.
  virtual std::optional<std::int64_t> iterations() const { return std::nullopt; }

  /// Discards the history of a multi-step method after the state was changed from outside, by a projection or an
  /// impact.
  virtual void discard_history(const State<S>&) {}

  /// Multipliers of the joints as the method has solved for them, at the end of the last step, in the order of the
  /// rows, N or N m. Empty: they follow from the state by the index-1 form.
  virtual std::span<const S> multipliers() const { return {}; }

  /// Abilities of the method in this run; null: the method does not have this one.
  virtual const DenseOutput<S>* dense_output() const { return nullptr; }
  virtual NativeRoots<S>* native_roots() { return nullptr; }
  virtual const NativeProjection* native_projection() const { return nullptr; }
};

}  // namespace polhode::core::run
