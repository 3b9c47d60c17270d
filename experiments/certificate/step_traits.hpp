// SPDX-License-Identifier: BSD-3-Clause
// Traits of the step itself, measured on test cases in addition to the runs of the study: reversibility in time,
// symplecticity, the Casimir, the order under time-dependent forces, and the cost of a step.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/exact/reference_motion.hpp"
#include "experiments/certificate/finding.hpp"
#include "experiments/certificate/test_case.hpp"

namespace polhode::study::certificate {

/// Largest drift of a conserved number, relative: due to round-off, or to the tolerance to which a step is iterated.
inline constexpr double kept_limit = 1e-11;
inline constexpr double return_limit = 1e-12;       ///< largest error of one step forth and back
inline constexpr double many_return_limit = 1e-10;  ///< largest error of many steps, which magnify round-off

/// Reversibility in time: ‖Φ₋ₕ Φₕ y − y‖/(1 + ‖y‖) in the maximum norm, from a generic point of each test case, with
/// `steps` steps forth and as many back. h: step, s.
Finding time_reversibility(const Subject& subject, std::span<const TestCase> test_cases, double h, int steps = 1);

/// Symplecticity: the largest defect over the free and conservative test cases at the step h (s). The note contains the
/// power of h, from defects at h, h/2, h/4 and h/8. Measured in long double if the method supports it. The trait holds
/// if all defects are below differentiation_floor.
Finding symplecticity(const Subject& subject, std::span<const TestCase> test_cases, double h);

/// Settings of a run: its duration, the step of a fixed-step method, and the tolerance of an adaptive one.
struct Course {
  double step = 0.05;  ///< s
  double tolerance = 1e-8;
  double t_end = 200;  ///< s
};
/// Casimir: the largest drift of |I Rᵀω|, relative to its value at the start, over the free test cases.
Finding casimir(const Subject& subject, std::span<const TestCase> test_cases, const Course& course);

/// Order under time-dependent forces. The error of a run is the largest against a reference at eight instants of one
/// second on the shaken test cases: of the attitude in rad, of the position in m, or of ω relative to the largest |ω|,
/// whichever is largest. It is measured for a ladder of steps (s) or tolerances.
class ShakenMotions {
 public:
  explicit ShakenMotions(std::span<const TestCase> test_cases);
  Finding order(const Subject& subject, std::span<const double> steps, std::span<const double> tolerances) const;

 private:
  struct Motion {
    const TestCase* test_case;
    std::shared_ptr<const ReferenceMotion> reference;
  };
  std::vector<Motion> motions_;
};

/// Mean number of force evaluations per step, after the starting phase of a multistep method.
Finding evaluations_per_step(const Subject& subject, std::span<const TestCase> test_cases, const Course& course);

/// Least wall time per step, ns, over several batches of steps on the first test case that the method supports.
double nanoseconds_per_step(const Subject& subject, std::span<const TestCase> test_cases, const Course& course);

}  // namespace polhode::study::certificate
