// SPDX-License-Identifier: BSD-3-Clause
// Reads and writes whole text files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace polhode::study::inline text {

constexpr std::size_t mebibyte = std::size_t{1} << 20;

/// "16 MiB"
std::string in_units(std::size_t bytes);

/// The text of a file that the user names, of `most` bytes at most; a pipe is read to its end. Throws InputError, which
/// names the file and says what is wrong with it: a folder, not there, larger, or with a zero byte, which no text has.
std::string read_text(const std::string& path, std::size_t most = 16 * mebibyte);

/// A file cannot be written: one line with its name and the system's reason.
struct WriteError : std::runtime_error {
  WriteError(const std::filesystem::path& path, int reason);  ///< `reason`: of errno
};

/// Writes a file so that a reader sees the old one or the new one, never half of it; a device or a pipe is written to
/// as it is. Throws WriteError.
void write_text(const std::filesystem::path& path, std::string_view text);

}  // namespace polhode::study
