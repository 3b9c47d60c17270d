// SPDX-License-Identifier: BSD-3-Clause
// Numbers of a study as LaTeX commands, whose names do not change when runs are added to the study.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "experiments/study/record/study_view.hpp"

namespace polhode::study::inline report::inline tables {

/// First part of the names of the commands of each run, without the backslash and in letters only:
/// "polhodeTumblingBoxRkFourDtOneEMinusThree". In this order: scenario, method, varied keys with their values, options
/// that are not the default, step or tolerance. Digits are spelt ("RkFour"). A number is rounded to four digits,
/// written with an exponent and spelt (0.001 = 1e-3: "OneEMinusThree"). If runs would share a name, the digits of their
/// id are appended, with 0 … f as a … p. One name for each of the runs with the indices `shown`.
std::vector<std::string> tex_names(const StudyView& study, std::span<const std::size_t> shown);

/// Text of the file of \newcommand lines for these runs. A comment at its beginning explains the names.
std::string tex_values(const StudyView& study, std::span<const std::size_t> shown);

}  // namespace polhode::study::report::tables
