// SPDX-License-Identifier: BSD-3-Clause
// Moves overlapping bodies apart by displacements that are independent of the velocities ("split impulses"; after the
// pseudo-velocities of Guendelman, Bridson & Fedkiw, "Nonconvex rigid bodies with stacking", 2003). Velocities do not
// change.
#pragma once

#include <span>
#include <vector>

#include "collision/response/conjugate_course.hpp"
#include "collision/response/contact_batches.hpp"

namespace polhode::inline collision::inline response {

struct PositionCorrectionSettings {
  double slop = 1e-3;       ///< depth that is left, so that resting contacts persist, m
  double share = 0.5;       ///< share of the depth beyond `slop` that one step undoes
  int iterations = 20;      ///< limit
  double tolerance = 1e-2;  ///< change, over the largest displacement, below which the iteration stops
};

class PositionCorrection {
 public:
  explicit PositionCorrection(const PositionCorrectionSettings& settings = {}) : settings_(settings) {}

  /// Sets shift and turn of all bodies.
  void undo(std::span<ImpulseBody> bodies, std::span<const ImpulseContact> contacts);
  /// The same with existing batches of these contacts.
  void undo(std::span<ImpulseBody> bodies, std::span<const ImpulseContact> contacts, const ContactBatches& batches);

 private:
  bool too_deep(std::span<ImpulseBody> bodies, std::span<const ImpulseContact> contacts) const;
  void solve(std::span<ImpulseBody> bodies, std::span<const ImpulseContact> contacts, const ContactBatches& batches);
  /// Visits all points of a batch of patches, forwards or backwards.
  template <bool back>
  void visit(const ContactBatches& batches, std::size_t number);

  struct Point {
    Lanes wanted;          ///< distance that the two bodies are to move apart, m
    Lanes impulse;         ///< kg m
    Lanes change, course;  ///< change by a sweep, and conjugate direction
  };

  PositionCorrectionSettings settings_;
  ContactBatches own_;
  std::vector<Point> points_;
  std::vector<ImpulseMotion> motions_;
  ConjugateCourse course_;
};

}  // namespace polhode::collision::response
