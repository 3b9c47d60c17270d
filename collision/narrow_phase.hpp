// SPDX-License-Identifier: BSD-3-Clause
// The port of narrow phases: the signed distance of two shapes and their contact points.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "collision/contact.hpp"
#include "collision/shape.hpp"

namespace polhode::inline collision {

/// Data of a pair kept from one query to the next, for a warm start. Empty at first. It affects the cost of an answer,
/// not its correctness.
struct PairMemory {
  /// A closed surface of triangles around the origin, left by a query of overlapping polytopes. Its corners are
  /// vertices of the Minkowski difference A − B = {a − b}, each given by a vertex number of A and one of B.
  struct Shell {
    static constexpr std::uint8_t corner_room = 24, face_room = 2 * corner_room - 4;
    std::uint8_t corner_count = 0, face_count = 0;
    std::array<std::array<std::uint32_t, 2>, corner_room> corners;
    std::array<std::array<std::uint8_t, 3>, face_room> faces;
  };

  std::uint32_t count = 0;                               ///< number of corners of the last simplex
  bool swapped = false;                                  ///< everything here was computed with A and B exchanged
  std::array<std::array<std::uint32_t, 2>, 4> vertices;  ///< vertex numbers of A and B for each corner
  Shell shell;
  std::array<Vector3<double>, 4> corners_a,
      corners_b;           ///< points of curved surfaces, each in the axes of its shape
  std::uint32_t axis = 0;  ///< the axis or feature that decided the last query
};

/// Answers three questions about two shapes A and B at the poses `at_a` and `at_b` (world). `memory`: the data of this
/// pair, read and updated; null: none are kept.
class NarrowPhase {
 public:
  virtual ~NarrowPhase() = default;

  /// True if the shapes have a point in common.
  virtual bool overlap(const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b,
                       PairMemory* memory = nullptr) const = 0;
  /// The signed distance (m), its normal, and a witness point on each shape.
  virtual Distance distance(const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b,
                            PairMemory* memory = nullptr) const = 0;
  /// Contact points at which the surfaces are at most `margin` (m) apart. For two almost parallel faces within the
  /// margin: all points of the patch, also those where the faces are apart; the depth of these is negative.
  virtual Manifold manifold(const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b, double margin = 0,
                            PairMemory* memory = nullptr) const = 0;
};

struct NarrowPhaseEntry {
  std::string name;     ///< name in the catalogue: "sat"
  std::string summary;  ///< one line of mathematics
  std::unique_ptr<NarrowPhase> (*make)();
};

inline namespace narrow {
/// All narrow phases.
const std::vector<NarrowPhaseEntry>& narrow_phase_catalogue();
const NarrowPhaseEntry* find_narrow_phase(std::string_view name);
}  // namespace narrow

}  // namespace polhode::collision
