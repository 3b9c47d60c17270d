// SPDX-License-Identifier: BSD-3-Clause
// The motion as the page reads it: JSON, with numbers in base64.
#pragma once

#include <string>
#include <vector>

#include "experiments/replay/recording.hpp"

namespace polhode::study::replay {

/// What the page says of itself.
struct PageWords {
  std::string scenario, title, description;
  std::vector<std::string> paragraphs;  ///< at the bottom: what was run, what was left out, how exact it is
  std::string made_by;                  ///< versions
};

/// About how large base64 is: bytes that an instant of the recording takes, and an impact.
double bytes_of_instant(const Recording& recording);
inline constexpr double bytes_of_impact = 4.0 / 3 * 10 * 4;

/// Positions are single precision; a component of an orientation is one of 32767 steps, and of an angular velocity one
/// of 32767 of the largest of its run. Nothing in it ends a script element.
std::string page_data(const PageWords& words, const std::vector<Recording>& recordings);

}  // namespace polhode::study
