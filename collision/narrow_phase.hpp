// SPDX-License-Identifier: BSD-3-Clause
// The port of narrow phases: how far apart two shapes are, and where they touch. One catalogue, interchangeable by
// name.
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

/// What a pair remembers from one question to the next, to start warm; empty at first, and never needed for the answer
/// to be right.
struct PairMemory {
  /// A closed surface of triangles on corners of A − B, which overlapping polytopes leave: numbers of vertices of A and
  /// B.
  struct Shell {
    static constexpr std::uint8_t corner_room = 24, face_room = 2 * corner_room - 4;
    std::uint8_t corner_count = 0, face_count = 0;
    std::array<std::array<std::uint32_t, 2>, corner_room> corners;
    std::array<std::array<std::uint8_t, 3>, face_room> faces;
  };

  std::uint32_t count = 0;                               ///< corners of the last simplex
  bool swapped = false;                                  ///< all this was made with A and B exchanged
  std::array<std::array<std::uint32_t, 2>, 4> vertices;  ///< their numbers of vertices of A and B
  Shell shell;
  std::array<Vector3<double>, 4> corners_a, corners_b;  ///< where a surface bends: points, each in its shape's axes
  std::uint32_t axis = 0;                               ///< the axis or feature that told last
};

class NarrowPhase {
 public:
  virtual ~NarrowPhase() = default;

  virtual bool overlap(const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b,
                       PairMemory* memory = nullptr) const = 0;
  virtual Distance distance(const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b,
                            PairMemory* memory = nullptr) const = 0;
  /// Points where the surfaces are no further apart than `margin` (m). Of two faces that are almost parallel, and no
  /// further apart than that, all points that matter, also those where they are: then their depth is negative.
  virtual Manifold manifold(const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b, double margin = 0,
                            PairMemory* memory = nullptr) const = 0;
};

struct NarrowPhaseEntry {
  std::string name;     ///< as in the catalogue: "sat"
  std::string summary;  ///< one line of mathematics
  std::unique_ptr<NarrowPhase> (*make)();
};

/// Those of the catalogue, one line each.
const std::vector<NarrowPhaseEntry>& narrow_phase_catalogue();
const NarrowPhaseEntry* find_narrow_phase(std::string_view name);

}  // namespace polhode
