// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/text/text_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <utility>
#include <vector>

#include "experiments/study/text/input_error.hpp"

namespace polhode::study::inline text {
namespace {

namespace fs = std::filesystem;

/// True if the path is a device or a pipe, which is written directly.
bool is_special(const fs::path& path) {
  std::error_code ignored;
  const auto kind = fs::status(path, ignored).type();
  return kind != fs::file_type::regular && kind != fs::file_type::not_found;
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

TextFile::TextFile(fs::path path) : path_(std::move(path)), at_(path_) {
  std::error_code ignored;
  if (!is_special(path_)) {
    target_ = fs::is_symlink(path_, ignored) ? fs::weakly_canonical(path_) : path_;  // the link stays
    at_ = target_.string() + ".new";
  }
  file_ = std::fopen(at_.c_str(), "wb");
  if (!file_) fail(errno);
}

TextFile::~TextFile() { abandon(); }

void TextFile::abandon() {
  if (!file_) return;
  std::fclose(file_);
  file_ = nullptr;
  std::error_code ignored;
  if (!target_.empty()) fs::remove(at_, ignored);
}

void TextFile::fail(int reason) {
  abandon();
  throw WriteError(path_, reason);
}

void TextFile::add(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) fail(errno);
}

void TextFile::finish() {
  if (std::fflush(file_) != 0) fail(errno);
  std::FILE* closing = std::exchange(file_, nullptr);
  int reason = std::fclose(closing) == 0 ? 0 : errno;
  if (reason == 0 && !target_.empty() && std::rename(at_.c_str(), target_.c_str()) != 0) reason = errno;
  if (reason == 0) return;
  std::error_code ignored;
  if (!target_.empty()) fs::remove(at_, ignored);
  throw WriteError(path_, reason);
}

void write_text(const fs::path& path, std::string_view text) {
  TextFile file(path);
  file.add(text);
  file.finish();
}

}  // namespace polhode::study::text
