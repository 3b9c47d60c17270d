// SPDX-License-Identifier: BSD-3-Clause
// Common base of the integrators of CVODE, ARKODE and IDA: single steps up to a stop time, dense output, event
// location, and failure messages. The virtual functions below call the functions of each library.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "integrators/catalogue.hpp"
#include "integrators/sundials/handles.hpp"

namespace polhode::inline integrators::sundials {

/// The order of ARKODE's table of coefficients. ARKODE would silently use order 4 in place of one that it does not
/// have.
Setting table_order(int lowest, int highest);

constexpr long max_steps = 100000000;  // limit of steps between two returns; the libraries' default is 500

/// Throws if `flag` is an error code of the named function. Used for calls that fail only if memory is exhausted.
void check(int flag, const char* function);

/// Base class of an integrator on one of the libraries.
class SundialsIntegrator : public Integrator<double>,
                           public DenseOutput<double>,
                           public NativeRoots<double>,
                           public NativeProjection {
 public:
  SundialsIntegrator(const System<double>& system, const IntegratorSettings& settings);

  void begin(const State<double>& state) final;
  StepResult step(State<double>& state, double h) final;
  std::int64_t evaluations() const final { return evaluations_; }
  std::optional<std::int64_t> iterations() const final { return iterations_; }
  void discard_history(const State<double>& state) final;
  const DenseOutput<double>* dense_output() const final { return this; }
  bool interpolate(double t, State<double>& state) const final;
  NativeRoots<double>* native_roots() final { return this; }
  void set_events(std::vector<EventFunction<double>> events) final;
  std::span<const int> events() const final { return roots_; }
  const NativeProjection* native_projection() const final { return projects_ ? this : nullptr; }
  double projection_energy() const final { return injected_; }

 protected:
  /// Creates the library's object for a run from (t, y), with tolerances, solvers and `self` as user data.
  virtual void create(double t, N_Vector y, SundialsIntegrator* self) = 0;
  /// Restarts from (t, y) without history, with the step size that was due next. The libraries' own first step is at
  /// most a tenth of the time to the stop, so that a run with a restart after every step would never end.
  virtual void restart(double t, N_Vector y) = 0;
  /// Takes one step that ends at or before the time `stop` (s). The right-hand side is not evaluated beyond it.
  virtual int evolve(double stop, N_Vector y, double* t) = 0;
  virtual int derivative(double t, N_Vector y) const = 0;  ///< dense output: derivative of order 0 at t (s)
  virtual int watch(int count) = 0;                        ///< registers find_roots with `count` event functions
  virtual int roots(int* signs) = 0;
  /// Number of nonlinear iterations since the last restart; absent: none are made.
  virtual std::optional<long> iterations_counted() const { return std::nullopt; }
  virtual std::string flag_name(int flag) const = 0;
  virtual const char* library() const = 0;
  // Callbacks of the library. A right-hand side that is not finite is reported as recoverable: the library retries with
  // a shorter step.
  static int right_hand_side(double t, N_Vector y, N_Vector dy, void* self);
  static int find_roots(double t, N_Vector y, double* values, void* self);
  static int project_step(double t, N_Vector y, void* self);  ///< ARKODE's post-processing of an accepted step

  /// Projects within the steps of the library; set by a library that can, before create().
  void project_within_steps(bool orientations) {
    projects_ = true;
    projects_orientations_ = orientations;
  }
  bool projects_within_steps() const { return projects_; }
  bool projects_joints() const { return system_.has_joints() && system_.formulation().joints.projects(); }
  /// Projects y as the run requires: the orientations, then the joints. A library may reject a step that it has
  /// projected, so that only the energy of the last projection before the end of a step counts. False: y ceased to be
  /// finite.
  bool project(VectorX<double>& y);

  void count_evaluation() { ++evaluations_; }

  SUNContext context() const { return context_.get(); }
  const System<double>& system() const { return system_; }
  double tolerance() const { return tolerance_; }

 private:
  void copy_in(const State<double>& state);

  const System<double>& system_;
  double tolerance_;
  double t_now_ = 0;
  std::int64_t evaluations_ = 0;
  std::optional<std::int64_t> iterations_;
  std::int64_t earlier_iterations_ = 0;  ///< iterations before the last restart
  bool projects_ = false, projects_orientations_ = false;
  double injected_ = 0, last_injected_ = 0;  ///< energy injected by all steps and by the last projection, J
  std::vector<EventFunction<double>> events_;
  std::vector<int> roots_;
  State<double> seen_;  ///< state that is passed to event functions
  // SUNDIALS objects in the order of their creation. The objects from create() are destroyed before these.
  Context context_;
  Vector work_;
};

}  // namespace polhode::integrators::sundials
