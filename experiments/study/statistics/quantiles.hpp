// SPDX-License-Identifier: BSD-3-Clause
// Quantiles of the distributions of confidence intervals and tests.
#pragma once

namespace polhode::study::inline statistics {

/// Two-sided 95 % quantile of Student's t: half the width of a 95 % interval in units of the standard error.
double students_t_95(double degrees);

/// Quantile of Fisher's F with (numerator, denominator) degrees of freedom that is exceeded with probability
/// `significance`.
double fisher_f_exceeded(double numerator, double denominator, double significance);

}  // namespace polhode::study::statistics
