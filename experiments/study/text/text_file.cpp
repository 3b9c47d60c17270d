// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/text/text_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <vector>

#include "experiments/study/text/input_error.hpp"

namespace polhode::study::inline text {
namespace {

namespace fs = std::filesystem;

/// 0, or the system's reason.
int written(const fs::path& path, std::string_view text) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (!file) return errno;
  const int reason = std::fwrite(text.data(), 1, text.size(), file) == text.size() ? 0 : errno;
  return std::fclose(file) == 0 ? reason : reason != 0 ? reason : errno;
}

}  // namespace

WriteError::WriteError(const fs::path& path, int reason)
    : std::runtime_error("cannot write " + path.string() + ": " + std::strerror(reason)) {}

std::string in_units(std::size_t bytes) {
  return bytes % mebibyte == 0 ? fmt::format("{} MiB", bytes / mebibyte) : fmt::format("{} bytes", bytes);
}

std::string read_text(const std::string& path, std::size_t most) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) throw InputError(path + ": is a folder; name a file in it");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path + ": no such file, or it cannot be read");
  std::string text;
  std::vector<char> part(1 << 16);
  while (file.read(part.data(), static_cast<std::streamsize>(part.size())), file.gcount() > 0) {
    const auto count = static_cast<std::size_t>(file.gcount());
    if (const void* zero = std::memchr(part.data(), 0, count)) {
      const auto at = text.size() + static_cast<std::size_t>(static_cast<const char*>(zero) - part.data());
      throw InputError(fmt::format("{}: byte {} is zero, so it is no text file; name one in UTF-8", path, at + 1));
    }
    text.append(part.data(), count);
    if (text.size() > most) throw InputError(fmt::format("{}: is larger than {}; give less", path, in_units(most)));
  }
  if (file.bad()) throw InputError(path + ": it cannot be read to its end");
  return text;
}

void write_text(const fs::path& path, std::string_view text) {
  std::error_code ignored;
  if (const auto kind = fs::status(path, ignored).type();
      kind != fs::file_type::regular && kind != fs::file_type::not_found) {
    if (const int reason = written(path, text)) throw WriteError(path, reason);
    return;
  }
  const fs::path target = fs::is_symlink(path, ignored) ? fs::weakly_canonical(path) : path;  // the link stays
  const fs::path temporary = target.string() + ".new";
  int reason = written(temporary, text);
  if (reason == 0 && std::rename(temporary.c_str(), target.c_str()) != 0) reason = errno;
  if (reason == 0) return;
  fs::remove(temporary, ignored);
  throw WriteError(path, reason);
}

}  // namespace polhode::study::text
