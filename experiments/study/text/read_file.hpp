// SPDX-License-Identifier: BSD-3-Clause
// A whole file as it is, if it is there.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace polhode::study::inline text {

/// Absent: there is no such file, or it cannot be read.
std::optional<std::string> read_file(const std::filesystem::path& path);

}  // namespace polhode::study::report
