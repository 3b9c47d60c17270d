// SPDX-License-Identifier: BSD-3-Clause
// The port of integrators: what the driver asks of a method, with the type of the method erased per step.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/system/system.hpp"

namespace polhode {

/// The outcome of a step. A failed step leaves the state as it was and says why.
struct StepResult {
  std::string failure;  ///< empty: done
  bool ok() const { return failure.empty(); }
};

/// What a method says of itself; the conformance tests measure each line.
struct Declaration {
  std::string name;     ///< as in the catalogue
  std::string family;   ///< textbook, SUNDIALS, Boost.Odeint, …
  std::string summary;  ///< one line of mathematics
  int order = 0;        ///< of the global error under forces; 0: variable
  int free_order = 0;   ///< of bodies without forces where it is another one: exact_order means exact; 0: the same
  int lowest_order = 0, highest_order = 0;  ///< where IntegratorSettings::order chooses among several; 0: it does not
  bool adaptive = false;                    ///< takes a tolerance and chooses its steps; otherwise it takes a step h
  bool implicit = false;
  int evaluations_per_step = 0;  ///< right-hand sides; 0: not constant, the method counts them
  bool multi_step = false;       ///< has a history, which an impact or a projection makes worthless
  /// Its step adds an increment to the flat state, y' = y + Δ(t, h, y), so that these sums can be compensated.
  bool additive = false;
  bool lie_group = false;   ///< moves orientations by group steps: they stay on their manifold without projection
  bool normalises = false;  ///< ends its own step with a normalisation
  /// Conserves every quadratic invariant of the flat ODE, as Gauss's methods do: |q|² and RᵀR among them.
  bool conserves_quadratics = false;
  bool symplectic = false;  ///< its map keeps the canonical two-form where forces have a potential
  bool symmetric = false;   ///< a step of −h undoes one of h
  /// Of free bodies, to round-off or to the tolerance of its iteration, in every formulation that it takes.
  bool conserves_energy = false;
  bool conserves_momentum = false;  ///< the angular momentum in the world
  bool conserves_casimir = false;   ///< |IΩ|, the length of the angular momentum in the body

  static constexpr int exact_order = 1000;
};

/// The settings that a method may read: h belongs to fixed-step methods, the tolerance to adaptive ones.
struct IntegratorSettings {
  double dt = 1e-3;         ///< s
  double tolerance = 1e-8;  ///< relative and absolute alike
  double t_end = 1;         ///< s; sets the sign and scale of a first step, nothing else
  bool project = false;     ///< each step ends in a projection: within it by methods that can, else by the driver
  int order = 0;            ///< of methods that offer several; 0: their own choice
};

/// A function of the state whose zeros are events.
template <class S>
using EventFunction = std::function<double(const State<S>&)>;

/// What is seen of a state after a step: enough for every ledger, without the state itself.
struct Sample {
  double t = 0;  ///< s
  Measurement<double> seen;
  double work = 0;        ///< J, done by non-conservative forces since the start
  double projection = 0;  ///< J, that the projection after this step injected

  /// J, what a ledger without errors keeps: kinetic + potential − work + lost in contact − injected by projection.
  double ledger(double lost_in_contact) const { return seen.energy() - work - projection + lost_in_contact; }
};

/// A batch of steps of equal size, taken in one call. Step k ends at t = t0 + (first + k) h, k = 1 … count.
struct StepBatch {
  double h = 0;                  ///< step size, s
  std::int64_t count = 1;        ///< number of steps
  double t0 = 0;                 ///< time origin, s
  std::int64_t first = 0;        ///< number of steps between t0 and the start of the batch
  bool project = false;          ///< project onto the manifold and discard the history after each step
  Sample* samples = nullptr;     ///< output: one sample per step; null: none
  int lanes = 0;                 ///< ensembles only: number of leading lanes that are sampled
  std::int64_t lane_stride = 0;  ///< ensembles only: the samples of lane i start at samples + i · lane_stride

  double time(std::int64_t k) const { return t0 + static_cast<double>(first + k) * h; }
};

/// Ability of a method: dense output, the state within the last step.
template <class S>
class DenseOutput {
 public:
  /// Writes the state at time t (s). Returns false if t lies outside the last step; `state` is then unchanged.
  virtual bool interpolate(double t, State<S>& state) const = 0;

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
  Integrator() = default;
  Integrator(const Integrator&) = delete;
  Integrator& operator=(const Integrator&) = delete;
  virtual ~Integrator() = default;

  /// Prepares a run that starts at this state; called once, before any step.
  virtual void begin(const State<S>& state) = 0;

  /// Fixed-step methods advance by exactly h; adaptive ones by at most h, as far as their tolerance lets them.
  /// state.t is advanced alike.
  virtual StepResult step(State<S>& state, double h) = 0;

  /// True for a method whose advance() projects and fills samples itself, which lets the compiler inline the whole
  /// batch. For other methods the loop does both after each step, with bitwise equal results.
  virtual bool takes_batches() const { return false; }

  /// Takes a batch of steps in one call. Fixed-step methods only.
  virtual StepResult advance(State<S>& state, const StepBatch& batch) {
    StepResult result;
    for (std::int64_t k = 1; k <= batch.count && result.ok(); ++k) {
      result = step(state, batch.h);
      if (result.ok()) state.t = batch.time(k);
    }
    return result;
  }

  /// n steps of h, without looking at the state between them.
  StepResult advance(State<S>& state, double h, std::int64_t n) {
    return advance(state, StepBatch{.h = h, .count = n, .t0 = state.t});
  }

  /// Right-hand sides evaluated since begin().
  virtual std::int64_t evaluations() const = 0;

  /// The state was changed from outside (projection, impact): forget what was remembered of its past.
  virtual void discard_history(const State<S>&) {}

  /// Abilities of the method in this run; null: the method does not have this one.
  virtual const DenseOutput<S>* dense_output() const { return nullptr; }
  virtual NativeRoots<S>* native_roots() { return nullptr; }
  virtual const NativeProjection* native_projection() const { return nullptr; }
};

}  // namespace polhode
