// SPDX-License-Identifier: BSD-3-Clause
// Finds the contact forces of the previous step again: contacts of the same two bodies by their feature; coinciding
// corners, whose features change with every rounding, by their position. A merge of two sorted lists.
#pragma once

#include <span>
#include <vector>

#include "collision/response.hpp"

namespace polhode::inline collision::inline response {

class WarmStart {
 public:
  /// Sets the impulse of each contact that existed in the previous step from its force then; of all others to zero.
  void recall(std::span<const ImpulseBody> bodies, std::span<ImpulseContact> contacts, double step);
  /// Stores the impulses of resting contacts. Those of impacts are not reused.
  void remember(std::span<const ImpulseBody> bodies, std::span<const ImpulseContact> contacts, double step);
  void forget() { known_.clear(); }

 private:
  struct Known {
    std::uint32_t a, b;
    Feature feature;
    Vector3<double> place;  ///< place relative to A's position, m
    Vector3<double> force;  ///< N
    bool taken = false;
  };

  std::vector<Known> known_;
  std::vector<std::uint32_t> new_;  ///< contacts of a pair whose features are new
};

}  // namespace polhode::collision::response
