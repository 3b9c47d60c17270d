// SPDX-License-Identifier: BSD-3-Clause
// Every number of a study as a LaTeX command, under a name that stays the same when the study grows.
#pragma once

#include <string>
#include <vector>

#include "experiments/study/record/study_view.hpp"

namespace polhode::study::inline report::inline tables {

/// What the commands of a run begin with, without the backslash and in letters only:
/// "polhodeTumblingBoxRkFourDtOneEMinusThree". In this order: scenario, method, varied keys with their values, options
/// that are not the default, step or tolerance. Digits are spelt ("RkFour"), a number is written with an exponent and
/// spelt (0.001 = 1e-3: "OneEMinusThree"), rounded to four digits. Runs that would share a name get the digits of their
/// id behind it, 0 … f as a … p.
std::vector<std::string> tex_names(const StudyView& study);

/// The file of \newcommand lines, with the scheme explained at its head.
std::string tex_values(const StudyView& study);

}  // namespace polhode::study::report
