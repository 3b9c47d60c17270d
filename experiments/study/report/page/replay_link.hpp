// SPDX-License-Identifier: BSD-3-Clause
// Line of report.html about replay.html, the page that plays the motions of the study.
#pragma once

#include <filesystem>
#include <string>

namespace polhode::study::inline report::inline page {

inline constexpr const char* replay_page = "replay.html";

/// The line in the report of the study in this folder: a link to replay.html or, if that page does not exist, the
/// command that makes it. Empty if no trajectory is stored as CSV.
std::string replay_line(const std::filesystem::path& folder);

/// Updates the line in the report of the folder, if there is a report that contains it.
void update_replay_line(const std::filesystem::path& folder);

}  // namespace polhode::study::report::page
