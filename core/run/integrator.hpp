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

/// A stretch of steps of one size, taken in one call: the k-th ends at t = t0 + (first + k) h, k from 1 to count.
struct Stretch {
  double h = 0;  ///< s
  std::int64_t count = 1;
  double t0 = 0;  ///< s
  std::int64_t first = 0;
  bool project = false;          ///< back to the manifold after each step, and forget the history
  Sample* samples = nullptr;     ///< one for each step to fill in, or null
  int lanes = 0;                 ///< of an ensemble: the first so many lanes have samples
  std::int64_t lane_stride = 0;  ///< the samples of lane i start at samples + i · lane_stride

  double time(std::int64_t k) const { return t0 + static_cast<double>(first + k) * h; }
};

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

  /// True for a method that projects and measures within advance(), where it all inlines; the driver does it for the
  /// others, step by step, with the same digits.
  virtual bool takes_stretches() const { return false; }

  /// A stretch of steps in one call; fixed-step methods only.
  virtual StepResult advance(State<S>& state, const Stretch& stretch) {
    StepResult result;
    for (std::int64_t k = 1; k <= stretch.count && result.ok(); ++k) {
      result = step(state, stretch.h);
      if (result.ok()) state.t = stretch.time(k);
    }
    return result;
  }

  /// n steps of h, without looking at the state between them.
  StepResult advance(State<S>& state, double h, std::int64_t n) {
    return advance(state, Stretch{.h = h, .count = n, .t0 = state.t});
  }

  /// Right-hand sides evaluated since begin().
  virtual std::int64_t evaluations() const = 0;

  /// The state was changed from outside (projection, impact): forget what was remembered of its past.
  virtual void discard_history(const State<S>&) {}

  /// True where the method projects within its steps, since the settings ask for it; then the driver does not.
  virtual bool projects_natively() const { return false; }
  /// J, that these projections injected since begin(): the sum over the steps of the energy after the projection that a
  /// step ended with minus that before it. What it does to the method's history, and so to later steps, is their error.
  virtual double projection_energy() const { return 0; }

  /// Native roots: a step ends where one of the events changes its sign. set_events() before begin(); an event that is
  /// zero where a run or a step begins is looked at again when it has left zero.
  virtual bool has_native_roots() const { return false; }
  virtual void set_events(std::vector<EventFunction<S>>) {}
  /// For each event: 1 where it rose through zero at the end of the last step, −1 where it fell, 0 where it did
  /// neither.
  virtual std::span<const int> events() const { return {}; }

  /// Dense output: the state at t within the last step. False where t is outside it, or the method has none.
  virtual bool has_dense_output() const { return false; }
  virtual bool interpolate(double, State<S>&) const { return false; }
};

}  // namespace polhode
