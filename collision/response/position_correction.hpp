// SPDX-License-Identifier: BSD-3-Clause
// How bodies that overlap are moved apart: by displacements that know nothing of the velocities ("split impulses";
// after the pseudo-velocities of Guendelman, Bridson & Fedkiw, "Nonconvex rigid bodies with stacking", 2003). No
// velocity changes.
#pragma once

#include <span>
#include <vector>

#include "collision/response/conjugate_course.hpp"
#include "collision/response/contact_batches.hpp"

namespace polhode::inline collision {

struct PositionCorrectionSettings {
  double slop = 1e-3;       ///< m, depth that is left, so that resting contacts persist
  double share = 0.5;       ///< share of the depth beyond `slop` that one step undoes
  int iterations = 20;      ///< limit
  double tolerance = 1e-2;  ///< relative to the largest displacement: the iteration stops below it
};

class PositionCorrection {
 public:
  explicit PositionCorrection(const PositionCorrectionSettings& settings = {}) : settings_(settings) {}

  /// Sets shift and turn of all bodies.
  void undo(std::span<ImpulseBody> bodies, std::span<const ImpulseContact> contacts);
  /// The same, with the batches of these contacts.
  void undo(std::span<ImpulseBody> bodies, std::span<const ImpulseContact> contacts, const ContactBatches& batches);

 private:
  bool too_deep(std::span<ImpulseBody> bodies, std::span<const ImpulseContact> contacts) const;
  void solve(std::span<ImpulseBody> bodies, std::span<const ImpulseContact> contacts, const ContactBatches& batches);
  /// All points of a batch of patches, from the first to the last or back.
  template <bool back>
  void visit(const ContactBatches& batches, std::size_t number);

  struct Point {
    Lanes wanted;          ///< m that the two are to move apart
    Lanes impulse;         ///< kg m
    Lanes change, course;  ///< of a sweep, and conjugate
  };

  PositionCorrectionSettings settings_;
  ContactBatches own_;
  std::vector<Point> points_;
  std::vector<ImpulseMotion> motions_;
  ConjugateCourse course_;
};

}  // namespace polhode
