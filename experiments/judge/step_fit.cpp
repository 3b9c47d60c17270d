// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/judge/step_fit.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "experiments/study/text/notation.hpp"
#include "integrators/catalogue.hpp"

namespace polhode::study::judge {
namespace {

constexpr std::size_t spans_for_steps = 6;  ///< a few spans are enough to choose among steps

int most_steps_per_row(const RowStates& rows) {
  constexpr double finest = 1e-3;  // smallest rotation in a step, rad
  return static_cast<int>(std::clamp(rows.spacing / finest, 1.0, 4096.0));
}

/// All first-order methods, each with the number of steps between rows, a power of two, that fits best.
std::vector<Hypothesis> coarsely_fitted(const RowStates& rows, const Hypothesis& base) {
  using Step = FirstOrderStep;
  const int most = most_steps_per_row(rows);
  const std::size_t stride = rows.stride_for(spans_for_steps);
  std::vector<Hypothesis> fits;
  for (const auto order : {Step::Order::together, Step::Order::velocity_first, Step::Order::attitude_first}) {
    for (const auto state : {Step::State::velocity_world, Step::State::velocity_body, Step::State::momentum_world}) {
      if (state == Step::State::momentum_world && base.equations.gyroscopic != 1) continue;
      for (const auto turn : {Step::Turn::quaternion, Step::Turn::exponential, Step::Turn::matrix}) {
        Hypothesis best = base;
        best.miss = unknown_miss;
        for (int n = 1; n <= most; n *= 2) {
          Hypothesis h = base;
          h.steps = {{state, order, turn}, n};
          h.miss = miss_of(rows, h, stride);
          if (h.miss < best.miss) best = h;
        }
        fits.push_back(std::move(best));
      }
    }
  }
  return fits;
}

/// Finds the best number of steps near a coarse one. The miss falls to one side of the best number and rises on the
/// other.
void refine(const RowStates& rows, Hypothesis& h) {
  const std::size_t stride = rows.stride_for(spans_for_steps);
  int low = std::max(1, h.steps.per_row / 2), high = std::min(most_steps_per_row(rows), 2 * h.steps.per_row);
  Hypothesis trial = h;
  const auto at = [&](int n) {
    trial.steps.per_row = n;
    trial.miss = miss_of(rows, trial, stride);
    if (trial.miss < h.miss) h = trial;
    return trial.miss;
  };
  while (high - low > 6) {
    const int third = (high - low) / 3;
    if (at(low + third) < at(high - third)) high -= third;
    else low += third;
  }
  for (int n = low; n <= high; ++n) at(n);
}

/// The state in a row, with the matrix as stored, even if it is not a rotation.
VectorX<double> state_as_stored(const RowStates& rows, const System<double>& system, std::size_t row) {
  VectorX<double> y = system.start().y;
  const VectorX<double> plain = rows.state(row, {});
  for (std::size_t i = 0; i < rows.trajectory.moving; ++i) {
    const BodySnapshot<double>& body = rows.trajectory.bodies[row * rows.trajectory.moving + i];
    const Layout::Slot s = system.layout().slots[i], from = rows.right.system().layout().slots[i];
    Eigen::Map<Matrix3<double>>{y.data() + s.orientation} = body.rotation;
    Vector3<double> angular = plain.segment<3>(from.angular);
    const AngularState kind = system.formulation().angular_state;
    if (kind != AngularState::velocity_world) angular = (body.rotation.inverse() * angular).eval();
    if (kind == AngularState::momentum_world) {
      angular = (body.rotation.transpose().inverse() * (system.problem().bodies[i].inertia * angular)).eval();
    }
    y.segment<3>(s.angular) = angular;
    if (s.position < 0) continue;
    y.segment<3>(s.position) = plain.segment<3>(from.position);
    y.segment<3>(s.velocity) = plain.segment<3>(from.velocity);
  }
  return y;
}

/// Miss over spans of rows whose matrices need not be rotations, rad.
double miss_as_stored(const RowStates& rows, const System<double>& system, Integrator<double>& integrator,
                      int per_row) {
  const auto& t = rows.trajectory.times;
  const std::size_t moving = rows.trajectory.moving, stride = rows.stride_for(spans_for_steps);
  std::vector<double> misses;
  for (std::size_t k = 0; k < rows.spans.size(); k += stride) {
    const auto [from, to] = rows.spans[k];
    State<double> state{t[from], state_as_stored(rows, system, from)};
    bool followed = true;
    for (std::size_t j = from; j < to && followed; ++j) {
      integrator.begin(state);
      followed = integrator.advance(state, (t[j + 1] - t[j]) / per_row, per_row).ok();
      state.t = t[j + 1];
    }
    double sum = 0;
    for (std::size_t i = 0; i < moving; ++i) {
      const BodySnapshot<double> now = system.snapshot(state.y, i);
      const BodySnapshot<double>& row = rows.trajectory.bodies[to * moving + i];
      const double size = std::sqrt(2.0 / 3) * row.rotation.norm();  // √2 for a rotation
      sum += (now.rotation - row.rotation).squaredNorm() / (size * size) +
             (now.angular_velocity - row.angular_velocity).squaredNorm() / (rows.rate * rows.rate);
    }
    const double d = std::sqrt(sum / static_cast<double>(moving));
    misses.push_back(followed && d < std::numbers::pi ? d : std::numbers::pi);
  }
  return typical(std::move(misses));
}

}  // namespace

Hypothesis fitted_steps(const RowStates& rows, const Hypothesis& base) {
  constexpr std::size_t refined = 6;
  std::vector<Hypothesis> fits = coarsely_fitted(rows, base);
  std::vector<double> misses;
  for (const Hypothesis& h : fits) misses.push_back(h.miss);
  std::nth_element(misses.begin(), misses.begin() + refined - 1, misses.end());
  double least = unknown_miss;
  for (Hypothesis& h : fits) {
    if (h.miss <= misses[refined - 1]) refine(rows, h);
    least = std::min(least, h.miss);
  }
  // Several methods give the same free motion. The first in the list is the simplest.
  const auto best = std::find_if(fits.begin(), fits.end(), [&](const auto& h) { return h.miss <= 2 * least + 1e-9; });
  const double size = rows.spacing / rows.rate / best->steps.per_row;
  Hypothesis h = with_cause(
      *best, "first_order_step",
      fmt::format("its steps are those of a first-order method, {}, with {} s", best->steps.by.words(), number(size)),
      Part::steps);
  h.miss = miss_of(rows, h);
  return h;
}

std::optional<Hypothesis> fitted_steps_without_projection(const RowStates& rows, const Hypothesis& plain) {
  if (!rows.trajectory.has_matrix || !rows.trajectory.has_angular_velocity) return std::nullopt;
  const int most = most_steps_per_row(rows);
  Hypothesis best = plain;
  best.miss = unknown_miss;
  std::string words;
  for (const auto state : {AngularState::velocity_world, AngularState::velocity_body, AngularState::momentum_world}) {
    for (const char* method : {"explicit_euler", "semi_implicit_euler"}) {
      const auto system = make_system<double>(rows.scenario.problem, {Orientation::matrix, state, true});
      const auto integrator = find_integrator(method)->make(*system, {});
      for (int n = 1; n <= most; n = n < 16 ? n + 1 : n + n / 8) {
        const double here = miss_as_stored(rows, *system, *integrator, n);
        if (here >= best.miss) continue;
        best.miss = here;
        best.steps.per_row = n;
        words = fmt::format(
            "its steps are those of a first-order method, {} Euler on {} and a rotation matrix that is never "
            "brought back to a rotation, with {} s",
            method[0] == 'e' ? "explicit" : "semi-implicit",
            state == AngularState::velocity_world  ? "ω in world axes"
            : state == AngularState::velocity_body ? "ω in body axes"
                                                   : "L",
            number(rows.spacing / rows.rate / n));
      }
    }
  }
  return with_cause(std::move(best), "first_order_step", std::move(words), Part::steps);
}

}  // namespace polhode::study::judge
