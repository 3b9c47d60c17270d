// SPDX-License-Identifier: BSD-3-Clause
// Reads a whole file if it exists.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace polhode::study::inline text {

/// The contents; absent if there is no such file or it cannot be read.
std::optional<std::string> read_file(const std::filesystem::path& path);

}  // namespace polhode::study::text
