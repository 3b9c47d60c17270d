// SPDX-License-Identifier: BSD-3-Clause
#include "collision/contact/flight_path.hpp"

namespace polhode::inline collision::inline contact {
namespace {

constexpr int most_inner_steps = 1'000'000;  // limit of steps of an adaptive method in one call

}  // namespace

StepResult advance(Integrator<double>& method, State<double>& state, double h) {
  const double end = state.t + h;
  StepResult result;
  int count = 0;
  do {
    if (++count > most_inner_steps) return {"the method takes a million steps in one; take a larger tolerance"};
    result = method.step(state, end - state.t);
  } while (result.ok() && end - state.t > 1e-12 * h);
  if (result.ok()) state.t = end;
  return result;
}

bool FlightPath::state_at(double s, State<double>& there) {
  there = start_;
  if (dense_) return dense_->interpolate(start_.t + s, there);
  stepped_method_ = true;
  method_.discard_history(there);
  return advance(method_, there, s).ok();
}

}  // namespace polhode::collision::contact
