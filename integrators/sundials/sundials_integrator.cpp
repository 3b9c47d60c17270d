// SPDX-License-Identifier: BSD-3-Clause
#include "integrators/sundials/sundials_integrator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>

#include "core/system/joint_projection.hpp"

namespace polhode::inline integrators::sundials {
namespace {

constexpr int root_return = 2;  // CV_ROOT_RETURN and ARK_ROOT_RETURN

bool is_finite(const double* x, sunindextype n) {
  bool finite = true;
  for (sunindextype i = 0; i < n; ++i) finite &= std::abs(x[i]) <= std::numeric_limits<double>::max();
  return finite;
}

}  // namespace

void check(int flag, const char* function) {
  if (flag != 0) throw std::runtime_error(std::string(function) + " failed with " + std::to_string(flag));
}

Setting table_order(int lowest, int highest) {
  return {.key = "order",
          .usual = 4,
          .meaning = "of methods that offer several",
          .lowest = double(lowest),
          .highest = double(highest)};
}

SundialsIntegrator::SundialsIntegrator(const System<double>& system, const IntegratorSettings& settings)
    : system_(system), tolerance_(settings.tolerance) {
  SUNContext context = nullptr;
  if (SUNContext_Create(nullptr, &context) != 0) throw std::bad_alloc();
  context_.reset(context);
}

void SundialsIntegrator::begin(const State<double>& state) {
  work_.reset(N_VNew_Serial(state.y.size(), context_.get()));
  if (!work_) throw std::bad_alloc();
  evaluations_ = earlier_iterations_ = 0;
  injected_ = last_injected_ = 0;
  seen_ = state;
  copy_in(state);
  create(state.t, work_.get(), this);
  iterations_ = iterations_counted();
  if (!events_.empty()) check(watch(int(events_.size())), "RootInit");
}

StepResult SundialsIntegrator::step(State<double>& state, double h) {
  double t = state.t;
  const int flag = evolve(state.t + h, work_.get(), &t);
  if (const auto counted = iterations_counted()) iterations_ = earlier_iterations_ + *counted;
  if (flag < 0) return {std::string(library()) + " gave up (" + flag_name(flag) + ")"};
  if (!(t > state.t)) return {std::string(library()) + "'s step size fell to nothing"};
  const double* y = N_VGetArrayPointer(work_.get());
  if (!is_finite(y, state.y.size())) return {std::string(library()) + "'s step ended in no number"};
  std::fill(roots_.begin(), roots_.end(), 0);
  if (flag == root_return) check(roots(roots_.data()), "GetRootInfo");
  injected_ += last_injected_;
  last_injected_ = 0;
  state.t = t_now_ = t;
  state.y = Eigen::Map<const VectorX<double>>(y, state.y.size());
  return {};
}

bool SundialsIntegrator::project(VectorX<double>& y) {
  const bool account = projects_joints() || system_.projection_changes_energy();
  const double before = account ? system_.measure(y).energy() : 0;
  if (projects_orientations_) system_.project(y);
  if (projects_joints()) project_joints(system_, y);
  if (!y.allFinite()) return false;
  if (account) last_injected_ = system_.measure(y).energy() - before;
  return true;
}

void SundialsIntegrator::discard_history(const State<double>& state) {
  copy_in(state);
  restart(state.t, work_.get());
  // The library counts from 0 again, at once or in its next step.
  if (iterations_) earlier_iterations_ = *iterations_;
}

bool SundialsIntegrator::interpolate(double t, State<double>& state) const {
  // After an event the internal step of the library extends beyond the end of this step.
  if (t > t_now_) return false;
  State<double> there = state;
  const Vector y(N_VMake_Serial(there.y.size(), there.y.data(), context_.get()));
  if (!y || derivative(t, y.get()) != 0) return false;
  state.t = t;
  state.y.swap(there.y);
  return true;
}

void SundialsIntegrator::set_events(std::vector<EventFunction<double>> events) {
  events_ = std::move(events);
  roots_.assign(events_.size(), 0);
}

void SundialsIntegrator::copy_in(const State<double>& state) {
  t_now_ = state.t;
  Eigen::Map<VectorX<double>>(N_VGetArrayPointer(work_.get()), state.y.size()) = state.y;
}

int SundialsIntegrator::right_hand_side(double t, N_Vector y, N_Vector dy, void* user_data) {
  auto& self = *static_cast<SundialsIntegrator*>(user_data);
  ++self.evaluations_;
  double* rate = N_VGetArrayPointer(dy);
  self.system_.rate(t, N_VGetArrayPointer(y), rate);
  return is_finite(rate, self.seen_.y.size()) ? 0 : 1;
}

int SundialsIntegrator::project_step(double, N_Vector y, void* user_data) {
  auto& self = *static_cast<SundialsIntegrator*>(user_data);
  Eigen::Map<VectorX<double>> values(N_VGetArrayPointer(y), N_VGetLength(y));
  VectorX<double> projected = values;
  if (!self.project(projected)) return 1;
  values = projected;
  return 0;
}

int SundialsIntegrator::find_roots(double t, N_Vector y, double* values, void* user_data) {
  auto& self = *static_cast<SundialsIntegrator*>(user_data);
  self.seen_.t = t;
  self.seen_.y = Eigen::Map<const VectorX<double>>(N_VGetArrayPointer(y), self.seen_.y.size());
  for (std::size_t i = 0; i < self.events_.size(); ++i) values[i] = self.events_[i](self.seen_);
  return 0;
}

}  // namespace polhode::integrators::sundials
