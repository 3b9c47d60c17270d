// SPDX-License-Identifier: BSD-3-Clause
// Data of the page: the motions as JSON with numbers in base64.
#pragma once

#include <string>
#include <vector>

#include "experiments/replay/recording.hpp"

namespace polhode::study::replay {

/// Texts on the page.
struct PageWords {
  std::string scenario, title, description;
  std::vector<std::string> answer{};    ///< sentences beside the motion: results of the runs
  std::vector<std::string> paragraphs;  ///< notes at the bottom: the runs, what was left out, accuracy
  std::string made_by;                  ///< versions of the programs
};

/// Approximate size of an instant of the recording in base64, bytes.
double bytes_of_instant(const Recording& recording);
/// Approximate size of an impact in base64, bytes.
inline constexpr double bytes_of_impact = 4.0 / 3 * 10 * 4;

/// The JSON text. Positions have single precision. Components of orientations are rounded to multiples of 1/32767,
/// components of angular velocities to multiples of 1/32767 of the largest in the run. The text is escaped so that it
/// cannot end a script element.
std::string page_data(const PageWords& words, const std::vector<Recording>& recordings);

}  // namespace polhode::study::replay
