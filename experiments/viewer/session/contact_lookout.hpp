// SPDX-License-Identifier: BSD-3-Clause
// Contact detection for display only. It uses a separate contact scene, so that the data cached by the scene of the run
// stay unchanged. It distinguishes pairs that begin to touch from pairs in lasting contact.
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

  /// Contact points that overlap, or whose distance is at most 1e-6 of the largest body radius.
  std::vector<FrameContact> contacts(const System<double>& system, const VectorX<double>& y);
  /// Cells of the broad phase.
  std::vector<Bounds> cells(const System<double>& system, const VectorX<double>& y);

  /// Makes the pairs that touch in the state y the only known pairs.
  void begin(const System<double>& system, const VectorX<double>& y);
  /// The pairs that touch in the state y or collided in the step before it (`impacts`) and are not yet known. They
  /// become known. A known pair is removed when its distance exceeds 1e-3 of the largest body radius.
  std::vector<BodyPair> newly_met(const System<double>& system, const VectorX<double>& y,
                                  std::span<const Impact> impacts);

 private:
  std::span<const ImpulseContact> look(const System<double>& system, const VectorX<double>& y, double margin);

  ContactScene scene_;
  double touch_ = 0, apart_ = 0;  ///< largest distances of touching and of known pairs, m
  std::vector<BodyPair> known_;   ///< pairs in contact, sorted
  std::vector<Pose> poses_;
};

}  // namespace polhode::viewer::session
