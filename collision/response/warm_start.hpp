// SPDX-License-Identifier: BSD-3-Clause
// The forces of the step before, found again: of the same two bodies by the feature; of corners that lie on each other,
// whose features change with every rounding, by the place. A merge of two sorted lists.
#pragma once

#include <span>
#include <vector>

#include "collision/response.hpp"

namespace polhode::inline collision {

class WarmStart {
 public:
  /// Gives each contact that there was a step ago the force that it had, as an impulse of this step; others none.
  void recall(std::span<const ImpulseBody> bodies, std::span<ImpulseContact> contacts, double step);
  /// Remembers the impulses of contacts that rest. Those of an impact do not come again.
  void remember(std::span<const ImpulseBody> bodies, std::span<const ImpulseContact> contacts, double step);
  void forget() { known_.clear(); }

 private:
  struct Known {
    std::uint32_t a, b;
    Feature feature;
    Vector3<double> place;  ///< m, from A's position
    Vector3<double> force;  ///< N
    bool taken = false;
  };

  std::vector<Known> known_;
  std::vector<std::uint32_t> new_;  ///< contacts of a pair with features that were not there
};

}  // namespace polhode
