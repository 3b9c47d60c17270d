// SPDX-License-Identifier: BSD-3-Clause
// The answer of a study that was carried out before, for pages that show its motion.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace polhode::study::inline report::inline page {

/// The sentences of the answer in the folder's report.html, as plain text; empty if there is no report, or none in it.
std::vector<std::string> kept_answer(const std::filesystem::path& folder);

}  // namespace polhode::study::report::page
