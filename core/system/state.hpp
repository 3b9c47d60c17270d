// SPDX-License-Identifier: BSD-3-Clause
// The state of a system: the time and one contiguous vector y = (q, v, work) of configuration, velocity and work.
#pragma once

#include <vector>

#include "core/math/linear_algebra.hpp"

namespace polhode::inline core::inline system {

/// State of a system. The flat vector y holds the configurations of all bodies, then their velocities, then the work of
/// the joints (J) if there are joints, and last the work of the non-conservative forces (J). The method integrates the
/// works together with the motion.
template <class S>
struct State {
  double t = 0;  ///< time, s
  VectorX<S> y;
};

/// Indices in y of the variables of each moving body. A free body has a position (3) and an orientation (4 or 9) in q,
/// and a linear (3) and an angular part (3) in v. A pinned body has only an orientation and an angular part.
struct Layout {
  struct Slot {
    int position = -1;    ///< index of the position p; −1 if pinned
    int orientation = 0;  ///< index of the orientation
    int velocity = -1;    ///< index of the linear velocity; −1 if pinned
    int angular = 0;      ///< index of the angular state
  };
  std::vector<Slot> slots;  ///< one for each moving body
  int configuration_size = 0;
  int velocity_size = 0;
  int work_size = 1;  ///< number of works: 2 with joints
  /// Number of entries of y.
  int size() const { return configuration_size + velocity_size + work_size; }
  /// Index in y of the work of the forces.
  int work() const { return size() - 1; }
  /// Index in y of the work of the joints; only if there are joints.
  int joint_work() const { return size() - 2; }
};

}  // namespace polhode::core::system
