// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/text/read_file.hpp"

#include <fstream>
#include <iterator>

namespace polhode::study::inline text {

std::optional<std::string> read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  std::string text{std::istreambuf_iterator<char>(file), {}};
  return file.bad() ? std::nullopt : std::optional(std::move(text));
}

}  // namespace polhode::study::text
