// SPDX-License-Identifier: BSD-3-Clause
#include "core/system/joint_projection.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "core/system/constraints.hpp"

namespace polhode::inline core::inline system {
namespace {

constexpr int most_iterations = 12;

/// Length to which the round-off of positions is proportional, m.
template <class S>
S size_of(std::span<const BodyMotion<S>> motions) {
  S size(0);
  for (const BodyMotion<S>& m : motions) size = std::max(size, m.position.norm());
  return size;
}

}  // namespace

template <class S>
std::vector<BodyMotion<S>> motions_of(const System<S>& system, const VectorX<S>& y) {
  std::vector<BodyMotion<S>> motions;
  for (std::size_t i = 0; i < system.problem().bodies.size(); ++i) motions.push_back(system.motion_of(y, i));
  return motions;
}

template <class S>
void project_joint_positions(const System<S>& system, VectorX<S>& y) {
  const Constraints<S>& constraints = *system.constraints();
  std::vector<Wrench<S>> displacements(system.problem().bodies.size());
  S last = std::numeric_limits<S>::infinity();
  for (int k = 0; k < most_iterations; ++k) {
    const std::vector<BodyMotion<S>> motions = motions_of(system, y);
    std::fill(displacements.begin(), displacements.end(), Wrench<S>{});
    const S worst = constraints.position_correction(motions, displacements);
    // Newton's method converges quadratically until round-off is reached.
    const S floor = std::numeric_limits<S>::epsilon() * (S(1) + size_of<S>(motions)) / S(4);
    if (!(worst > floor) || (k > 1 && worst > last / S(2))) return;
    last = worst;
    for (std::size_t i = 0; i < system.moving(); ++i) {
      system.displace(y, i, displacements[i].force, displacements[i].torque);
    }
  }
}

template <class S>
void project_joint_velocities(const System<S>& system, VectorX<S>& y) {
  std::vector<Wrench<S>> impulses(system.problem().bodies.size());
  for (int k = 0; k < 2; ++k) {  // the second removes the round-off of the first
    const std::vector<BodyMotion<S>> motions = motions_of(system, y);
    std::fill(impulses.begin(), impulses.end(), Wrench<S>{});
    system.constraints()->velocity_correction(motions, impulses);
    for (std::size_t i = 0; i < system.moving(); ++i) {
      system.apply_impulse(y, i, impulses[i].force, impulses[i].torque);
    }
  }
}

template <class S>
void project_joints(const System<S>& system, VectorX<S>& y) {
  if (!system.has_joints()) return;
  const JointTreatment& treatment = system.formulation().joints;
  if (treatment.projects_position()) project_joint_positions(system, y);
  if (treatment.projects_velocity()) project_joint_velocities(system, y);
}

#define POLHODE_INSTANTIATE(S) \
  template std::vector<BodyMotion<S>> motions_of(const System<S>&, const VectorX<S>&); \
  template void project_joint_positions(const System<S>&, VectorX<S>&); \
  template void project_joint_velocities(const System<S>&, VectorX<S>&); \
  template void project_joints(const System<S>&, VectorX<S>&)
POLHODE_INSTANTIATE(float);
POLHODE_INSTANTIATE(double);
POLHODE_INSTANTIATE(long double);
#undef POLHODE_INSTANTIATE

}  // namespace polhode::core::system
