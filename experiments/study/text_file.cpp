// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/text_file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>

namespace polhode::study {

void write_text(const std::filesystem::path& path, std::string_view text) {
  const std::string temporary = path.string() + ".new";
  std::FILE* file = std::fopen(temporary.c_str(), "wb");
  const bool written = file && std::fwrite(text.data(), 1, text.size(), file) == text.size();
  const int reason = errno;
  const bool closed = file && std::fclose(file) == 0;
  if (!written || !closed || std::rename(temporary.c_str(), path.c_str()) != 0) {
    const std::string why = std::strerror(file && !written ? reason : errno);
    std::remove(temporary.c_str());
    throw std::runtime_error("cannot write " + path.string() + ": " + why);
  }
}

}  // namespace polhode::study
