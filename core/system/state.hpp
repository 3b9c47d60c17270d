// SPDX-License-Identifier: BSD-3-Clause
// The state of a system: time, configuration q and velocity v, one contiguous vector y = (q, v, work).
#pragma once

#include <vector>

#include "core/math/linear_algebra.hpp"

namespace polhode {

/// The flat vector y of a system holds the configurations of all bodies, then their velocities, then one number: the
/// work in J that non-conservative forces have done, integrated by the method itself like everything else.
template <class S>
struct State {
  double t = 0;  ///< s
  VectorX<S> y;
};

/// Where the numbers of each moving body stand in y. A free body has a position (3) and an orientation (4 or 9) in q,
/// a linear (3) and an angular part (3) in v; a pinned body has its orientation and angular part only.
struct Layout {
  struct Slot {
    int position = -1;    ///< index in y of p, −1 when pinned
    int orientation = 0;  ///< index in y of the chart
    int velocity = -1;    ///< index in y of the linear velocity, −1 when pinned
    int angular = 0;      ///< index in y of the angular state
  };
  std::vector<Slot> slots;
  int configuration_size = 0;
  int velocity_size = 0;
  int size() const { return configuration_size + velocity_size + 1; }
  int work() const { return configuration_size + velocity_size; }
};

}  // namespace polhode
