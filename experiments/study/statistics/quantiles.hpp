// SPDX-License-Identifier: BSD-3-Clause
// Quantiles of the distributions that confidence intervals and tests are made from.
#pragma once

namespace polhode::study::inline statistics {

/// Student's t that is exceeded, on either side, with probability 0.05: half the width of a 95 % interval in units of
/// the standard error.
double students_t_95(double degrees);

/// Fisher's F with (numerator, denominator) degrees of freedom that is exceeded with probability `significance`.
double fisher_f_exceeded(double numerator, double denominator, double significance);

}  // namespace polhode::study
