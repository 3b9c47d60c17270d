// SPDX-License-Identifier: BSD-3-Clause
// The line of report.html about the page that plays the study's motion.
#pragma once

#include <filesystem>
#include <string>

namespace polhode::study::inline report::inline page {

inline constexpr const char* replay_page = "replay.html";

/// What the report of the study in this folder says: the page, or how it is made while it is not there; empty where no
/// motion is kept as CSV.
std::string replay_line(const std::filesystem::path& folder);

/// Brings that line of the report in the folder up to date, where there is a report with one.
void update_replay_line(const std::filesystem::path& folder);

}  // namespace polhode::study::report
