// SPDX-License-Identifier: BSD-3-Clause
// Traits of the step itself, measured on stages without a run of the study: reversibility in time, symplecticity, the
// Casimir, the order under forces that depend on time, and what a step asks for.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/exact/reference_motion.hpp"
#include "experiments/certificate/finding.hpp"
#include "experiments/certificate/stage.hpp"

namespace polhode::study::certificate {

/// A number that is conserved may be off by round-off, or by the tolerance to which a step is iterated.
inline constexpr double kept_limit = 1e-11;
inline constexpr double return_limit = 1e-12;       ///< of one step there and back
inline constexpr double many_return_limit = 1e-10;  ///< of many: what is between them magnifies round-off

/// ‖Φ₋ₕ Φₕ y − y‖/(1 + ‖y‖) in the largest norm, from a generic point of each stage; `steps` there and as many back.
Finding time_reversibility(const Subject& subject, std::span<const Stage> stages, double h, int steps = 1);

/// Over the stages without friction, at h, h/2, h/4 and h/8: measured is the largest at h, the note has the power of h.
/// In long double where the method works in it. It holds where all are below differentiation_floor.
Finding symplecticity(const Subject& subject, std::span<const Stage> stages, double h);

/// How far a run goes: fixed steps of `step`, or as far as `tolerance` lets an adaptive method.
struct Course {
  double step = 0.05;  ///< s
  double tolerance = 1e-8;
  double t_end = 200;  ///< s
};
/// The largest drift of |I Rᵀω|, relative to the start, over the free stages.
Finding casimir(const Subject& subject, std::span<const Stage> stages, const Course& course);

/// The largest error at eight instants of one second on each shaken stage against its reference, in radians, metres or
/// relative to the largest |ω|, whichever is most, down a ladder of steps or tolerances.
class ShakenMotions {
 public:
  explicit ShakenMotions(std::span<const Stage> stages);
  Finding order(const Subject& subject, std::span<const double> steps, std::span<const double> tolerances) const;

 private:
  struct Motion {
    const Stage* stage;
    std::shared_ptr<const ReferenceMotion> reference;
  };
  std::vector<Motion> motions_;
};

/// The mean over some steps of how often the force is asked for, once a method of several steps has started.
Finding evaluations_per_step(const Subject& subject, std::span<const Stage> stages, const Course& course);

/// The least time of a step in ns, over some stretches of it on the first stage that the method takes.
double nanoseconds_per_step(const Subject& subject, std::span<const Stage> stages, const Course& course);

}  // namespace polhode::study
