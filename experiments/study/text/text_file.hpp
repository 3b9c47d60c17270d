// SPDX-License-Identifier: BSD-3-Clause
// Reads whole text files; writes text files, whole or in parts.
#pragma once

#include <cstddef>
#include <cstdio>
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

/// A text file that is written in parts and atomically: a reader finds the old or the new contents, never a part. The
/// parts stand in NAME.new until finish(); without finish() they are removed. A device or a pipe is written directly.
class TextFile {
 public:
  /// Throws WriteError.
  explicit TextFile(std::filesystem::path path);
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;
  ~TextFile();

  /// Appends the text. Throws WriteError.
  void add(std::string_view text);
  /// Gives the file its name. Throws WriteError.
  void finish();

 private:
  void abandon();
  [[noreturn]] void fail(int reason);

  std::filesystem::path path_, target_, at_;  ///< given name; file behind links (empty: written directly); open file
  std::FILE* file_ = nullptr;
};

/// Writes a whole file as TextFile does. Throws WriteError.
void write_text(const std::filesystem::path& path, std::string_view text);

}  // namespace polhode::study::text
