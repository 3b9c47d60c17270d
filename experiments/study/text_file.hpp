// SPDX-License-Identifier: BSD-3-Clause
// Writes a whole text file so that a reader sees the old one or the new one, never half of it.
#pragma once

#include <filesystem>
#include <string_view>

namespace polhode::study {

/// Throws std::runtime_error, naming the file and the system's reason.
void write_text(const std::filesystem::path& path, std::string_view text);

}  // namespace polhode::study
