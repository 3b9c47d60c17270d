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

/// A size in words: "16 MiB".
std::string in_units(std::size_t bytes);

/// The text of a file named by the user, of at most `most` bytes; a pipe is read to its end. Throws InputError with the
/// file's name and the reason: a folder, missing, too large, or with a zero byte.
std::string read_text(const std::string& path, std::size_t most = 16 * mebibyte);

/// A file cannot be written. what() is one line with its name and the system's reason.
struct WriteError : std::runtime_error {
  WriteError(const std::filesystem::path& path, int reason);  ///< `reason`: errno
};

/// Writes a file atomically: a reader finds the old or the new contents, never a part. A device or a pipe is written
/// directly. Throws WriteError.
void write_text(const std::filesystem::path& path, std::string_view text);

}  // namespace polhode::study::text
