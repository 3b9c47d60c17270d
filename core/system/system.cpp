// SPDX-License-Identifier: BSD-3-Clause
#include "core/system/system.hpp"

#include "core/forces/catalogue.hpp"
#include "core/system/constraints.hpp"

namespace polhode::inline core::inline system {

Layout layout_of(const Problem& problem, const Formulation& formulation) {
  const int chart = formulation.orientation == Orientation::quaternion ? 4 : 9;
  Layout layout;
  int q = 0, v = 0;
  for (std::size_t i = 0; i < problem.moving(); ++i) {
    Layout::Slot slot;
    if (!problem.bodies[i].pinned) {
      slot.position = q;
      slot.velocity = v;
      q += 3;
      v += 3;
    }
    slot.orientation = q;
    slot.angular = v;
    q += chart;
    v += 3;
    layout.slots.push_back(slot);
  }
  for (Layout::Slot& slot : layout.slots) {
    if (slot.velocity >= 0) slot.velocity += q;
    slot.angular += q;
  }
  layout.configuration_size = q;
  layout.velocity_size = v;
  layout.work_size = problem.joints.empty() ? 1 : 2;
  return layout;
}

template <class S>
System<S>::System(std::vector<Problem> problems, const Formulation& formulation)
    : problems_(std::move(problems)), formulation_(formulation), layout_(layout_of(problem(), formulation)) {
  for (std::size_t k = 0; k < problem().forces.size(); ++k) {
    if constexpr (is_lanes<S>) {
      add_force(make_force_in_lanes(problems_, k));
    } else {
      add_force(make_force<S>(problem().forces[k], problem().bodies));
    }
  }
  if constexpr (!is_lanes<S>) {
    if (problem().joints.empty()) return;
    constraints_ = std::make_shared<Constraints<S>>(problem(), formulation_);
    forces_exert_torques_ = forces_read_rotation_ = forces_read_velocity_ = true;
  }
}

template class System<float>;
template class System<double>;
template class System<long double>;
template class System<Lanes>;

}  // namespace polhode::core::system
