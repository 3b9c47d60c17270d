// SPDX-License-Identifier: BSD-3-Clause
// The port of broad phases: finds which of many boxes overlap. All entries of the catalogue give the same answer.
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

  /// Sets the bounds of all bodies, by number, at this step. Another number of bodies starts a new scene. Bounds may be
  /// infinite (a half-space). Throws std::invalid_argument on NaN.
  virtual void update(std::span<const Bounds> bounds) = 0;

  /// All pairs whose closed bounds overlap, sorted, each once; valid until the next update().
  virtual std::span<const BodyPair> pairs() = 0;

  /// Appends the cells of the structure (boxes of a grid, nodes of a tree) for drawing. Call after pairs(). The cells
  /// are finite and together contain every finite box of the last update(). A broad phase without cells appends
  /// nothing.
  virtual void cells(std::vector<Bounds>&) const {}
};

struct BroadPhaseEntry {
  std::string name;     ///< name in the catalogue: "sweep_and_prune"
  std::string summary;  ///< one line on the algorithm
  std::unique_ptr<BroadPhase> (*make)();
};

inline namespace broad {
/// All broad phases.
const std::vector<BroadPhaseEntry>& broad_phase_catalogue();
const BroadPhaseEntry* find_broad_phase(std::string_view name);
}  // namespace broad

}  // namespace polhode::collision
