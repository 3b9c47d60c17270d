// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/session/state_conversion.hpp"

#include "core/system/orientation_chart.hpp"

namespace polhode::viewer::inline session {
namespace {

using MatrixChart = Chart<double, Orientation::matrix>;
using QuaternionChart = Chart<double, Orientation::quaternion>;

int chart_size(const System<double>& system) {
  return system.formulation().orientation == Orientation::matrix ? MatrixChart::size : QuaternionChart::size;
}

}  // namespace

void write_body(const System<double>& system, const BodySnapshot<double>& body, std::size_t i, VectorX<double>& y) {
  const Layout::Slot& slot = system.layout().slots[i];
  const Formulation& f = system.formulation();
  double* orientation = y.data() + slot.orientation;
  if (f.orientation == Orientation::matrix) MatrixChart::store(body.rotation, orientation);
  else QuaternionChart::store(body.orientation, orientation);
  switch (f.angular_state) {
    case AngularState::velocity_world: y.segment<3>(slot.angular) = body.angular_velocity; break;
    case AngularState::velocity_body:
      y.segment<3>(slot.angular) = body.rotation.transpose() * body.angular_velocity;
      break;
    default: y.segment<3>(slot.angular) = body.angular_momentum;
  }
  if (slot.position < 0) return;
  y.segment<3>(slot.position) = body.position;
  y.segment<3>(slot.velocity) = body.velocity;
}

State<double> converted(const System<double>& from, const State<double>& state, const System<double>& to) {
  const bool same_chart = from.formulation().orientation == to.formulation().orientation;
  const bool same_angular = from.formulation().angular_state == to.formulation().angular_state;
  State<double> out;
  out.t = state.t;
  out.y = VectorX<double>::Zero(to.layout().size());
  for (std::size_t i = 0; i < to.moving(); ++i) {
    write_body(to, from.snapshot(state.y, i), i, out.y);
    const Layout::Slot &a = from.layout().slots[i], &b = to.layout().slots[i];
    if (same_chart) out.y.segment(b.orientation, chart_size(to)) = state.y.segment(a.orientation, chart_size(from));
    if (same_angular) out.y.segment<3>(b.angular) = state.y.segment<3>(a.angular);
    if (a.position < 0) continue;
    out.y.segment<3>(b.position) = state.y.segment<3>(a.position);
    out.y.segment<3>(b.velocity) = state.y.segment<3>(a.velocity);
  }
  out.y.tail(to.layout().work_size) = state.y.tail(from.layout().work_size);
  return out;
}

}  // namespace polhode::viewer::session
