// SPDX-License-Identifier: BSD-3-Clause
// Numbers of a study as LaTeX commands, whose names do not change when runs are added to the study.
#pragma once

#include <cstddef>
#include <filesystem>
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

/// Number of runs up to which one file has the commands of all of them. TeX's memory holds some 30 000 commands.
inline constexpr std::size_t most_runs_of_a_values_file = 400;

/// Writes values.tex into the folder: \newcommand lines of these runs. For more runs than that it has the slopes of
/// the curves, and values_METHOD.tex the runs of one method each, of which a text loads those that it uses. A comment
/// at the beginning of each explains the names.
void write_tex_values(const StudyView& study, std::span<const std::size_t> shown, const std::filesystem::path& folder);

}  // namespace polhode::study::report::tables
