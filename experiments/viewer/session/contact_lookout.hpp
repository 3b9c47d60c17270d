// SPDX-License-Identifier: BSD-3-Clause
// Looks where bodies touch, for the eye alone: with a scene of its own, so that what the running one remembers is left
// as it is. It tells a pair that has newly met from one that goes on touching.
#pragma once

#include <span>
#include <vector>

#include "collision/contact/contact_scene.hpp"
#include "core/run/contact_model.hpp"
#include "experiments/study/record/run_record.hpp"
#include "experiments/viewer/frame/frame.hpp"

namespace polhode::viewer::inline session {

class ContactLookout {
 public:
  ContactLookout(const study::Scenario& scenario, const study::ContactConfig& config);

  /// Points that overlap, or are apart by 1e-6 of the largest body at most.
  std::vector<FrameContact> contacts(const System<double>& system, const VectorX<double>& y);
  /// Of the broad phase.
  std::vector<Bounds> cells(const System<double>& system, const VectorX<double>& y);

  /// What touches here is known, and no more.
  void begin(const System<double>& system, const VectorX<double>& y);
  /// The pairs that touch here or have met in the step before, and did not when it was asked last. A pair is forgotten
  /// once it is apart by 1e-3 of the largest body.
  std::vector<BodyPair> newly_met(const System<double>& system, const VectorX<double>& y,
                                  std::span<const Impact> impacts);

 private:
  std::span<const ImpulseContact> look(const System<double>& system, const VectorX<double>& y, double margin);

  ContactScene scene_;
  double touch_ = 0, apart_ = 0;  ///< m
  std::vector<BodyPair> known_;   ///< sorted
  std::vector<Pose> poses_;
};

}  // namespace polhode::viewer
