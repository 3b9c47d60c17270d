// SPDX-License-Identifier: BSD-3-Clause
// The port of broad phases: which of many boxes may touch. One catalogue, interchangeable by name, all with the same
// answer.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "collision/shape.hpp"

namespace polhode::inline collision {

struct BodyPair {
  std::uint32_t a = 0, b = 0;  ///< a < b
  auto operator<=>(const BodyPair&) const = default;
};

class BroadPhase {
 public:
  virtual ~BroadPhase() = default;

  /// The bounds of all bodies at this step, by number; the same number of bodies as before, or a new scene. Bounds may
  /// be infinite (a half-space); a NaN is refused by std::invalid_argument.
  virtual void update(std::span<const Bounds> bounds) = 0;

  /// All pairs whose closed bounds overlap, sorted, none twice; valid until the next update().
  virtual std::span<const BodyPair> pairs() = 0;

  /// Appends the boxes into which it divides space, or the nodes of its tree, for drawing: finite ones, which hold
  /// every finite box of the last update(); after pairs(). None where it divides nothing.
  virtual void cells(std::vector<Bounds>&) const {}
};

struct BroadPhaseEntry {
  std::string name;     ///< as in the catalogue: "sweep_and_prune"
  std::string summary;  ///< one line of how it works
  std::unique_ptr<BroadPhase> (*make)();
};

/// Those of the catalogue, one line each.
const std::vector<BroadPhaseEntry>& broad_phase_catalogue();
const BroadPhaseEntry* find_broad_phase(std::string_view name);

}  // namespace polhode
