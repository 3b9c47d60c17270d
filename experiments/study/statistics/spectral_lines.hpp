// SPDX-License-Identifier: BSD-3-Clause
// Lines of a cosine spectrum: oscillations that the blocks of a series resolve.
#pragma once

#include <optional>

#include "experiments/study/statistics/cosine_spectrum.hpp"

namespace polhode::study::inline statistics::spectral {

constexpr Index fewest_cosines = 9;
/// Least number of half periods of a line in the run; a line with fewer would not differ from a trend.
constexpr Index lowest_line = 8;

/// A line among the first cosines, that is, an oscillation that the blocks resolve: a square 25 times the mean of those
/// below it, or of the noise there. `rest`: of a fit by t and t², which takes the first cosines.
std::optional<Index> line_in(const Cosines& cosines, const Numbers& rest);

/// Number of the first cosines that lie well below every line.
Index below_lines(const Cosines& cosines, const Numbers& rest);

constexpr int trends = 3;  ///< number of the polynomials of a trend: 1, t, t²

/// The oscillation of the best frequency near the k-th cosine, by a least-squares fit of it and of the `trends` columns
/// of `trend`, which are orthonormal.
Vector fitted_oscillation(const Vector& series, const Matrix& trend, Index k);

}  // namespace polhode::study::statistics::spectral
