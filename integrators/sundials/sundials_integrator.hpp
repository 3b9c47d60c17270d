// SPDX-License-Identifier: BSD-3-Clause
// What CVODE's and ARKODE's integrators share: one step at a time up to a stop time, dense output, root finding, and
// failures that are told. Each library's own functions are the hooks below.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "integrators/catalogue.hpp"
#include "integrators/sundials/handles.hpp"

namespace polhode::inline integrators::sundials {

constexpr long max_steps = 100000000;  // between two returns; the default of 500 is meant for users who wait for one

/// Throws what a call that cannot fail, unless memory runs out, has said.
void check(int flag, const char* function);

/// Base class of an integrator on CVODE or ARKODE.
class SundialsIntegrator : public Integrator<double>, public DenseOutput<double>, public NativeRoots<double> {
 public:
  SundialsIntegrator(const System<double>& system, const IntegratorSettings& settings);

  void begin(const State<double>& state) final;
  StepResult step(State<double>& state, double h) final;
  std::int64_t evaluations() const final { return evaluations_; }
  void discard_history(const State<double>& state) final;
  const DenseOutput<double>* dense_output() const final { return this; }
  bool interpolate(double t, State<double>& state) const final;
  NativeRoots<double>* native_roots() final { return this; }
  void set_events(std::vector<EventFunction<double>> events) final;
  std::span<const int> events() const final { return roots_; }

 protected:
  /// The library's object for a run that starts at (t, y): its tolerances and solvers, user_data `self`.
  virtual void create(double t, N_Vector y, SundialsIntegrator* self) = 0;
  /// Goes on from (t, y) without a history, with the step that was to come next: the libraries' own first step is a
  /// tenth of the way to the stop at most, and a run that restarts after every step would never end.
  virtual void restart(double t, N_Vector y) = 0;
  /// One step, at most to `stop`, which it does not look beyond.
  virtual int evolve(double stop, N_Vector y, double* t) = 0;
  virtual int derivative(double t, N_Vector y) const = 0;  ///< the zeroth: dense output
  virtual int watch(int count) = 0;                        ///< has find_roots called
  virtual int roots(int* signs) = 0;
  virtual std::string flag_name(int flag) const = 0;
  virtual const char* library() const = 0;
  virtual void step_done() {}

  // The callbacks; a right-hand side that is no number is a failure that the library meets with a shorter step.
  static int right_hand_side(double t, N_Vector y, N_Vector dy, void* self);
  static int find_roots(double t, N_Vector y, double* values, void* self);

  SUNContext context() const { return context_.get(); }
  const System<double>& system() const { return system_; }
  double tolerance() const { return tolerance_; }

 private:
  void copy_in(const State<double>& state);

  const System<double>& system_;
  double tolerance_;
  double t_now_ = 0;
  std::int64_t evaluations_ = 0;
  std::vector<EventFunction<double>> events_;
  std::vector<int> roots_;
  State<double> seen_;  ///< as the events see it
  // In the order in which SUNDIALS wants them made; what create() makes is destroyed before.
  Context context_;
  Vector work_;
};

}  // namespace polhode::sundials
