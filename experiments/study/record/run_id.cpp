// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/record/run_id.hpp"

#include <charconv>
#include <stdexcept>

#include "experiments/study/text/text_hash.hpp"

namespace polhode::study::inline record {

RunNumbers::RunNumbers(const RunConfig& config, int version)
    : version_(std::to_string(version)), text_(identity_text(config)) {}

std::uint64_t RunNumbers::of(const std::vector<Override>& varied, std::string_view canonical) const {
  std::string text;
  text.reserve(512 + canonical.size());
  text.append(version_).append("\n").append(canonical).append("\n").append(text_.before);
  for (const Override& o : varied) {
    if (!o.value.empty()) text.append(o.value).append("\n");
  }
  return text_number(text.append(text_.after));
}

std::uint64_t run_number(const RunConfig& config, std::string_view canonical, int version) {
  return RunNumbers(config, version).of(config.varied, canonical);
}

std::string run_id(const RunConfig& config, std::string_view canonical, int version) {
  return id_of_number(run_number(config, canonical, version));
}

std::vector<std::pair<std::string, std::string>> identity_parts(const RunConfig& config) {
  std::vector<std::pair<std::string, std::string>> parts;
  for (const RunOption* option : options_by_column()) {
    const std::string value = config_cell(*option, config);
    if (value.empty() || (option->on_demand && is_usual(*option, config))) continue;
    parts.emplace_back(option->column.empty() ? file_key(*option) : option->column, value);
  }
  for (const Override& o : config.varied) {
    if (!o.value.empty()) parts.emplace_back(o.key, o.value);
  }
  return parts;
}

std::uint64_t number_of_id(const std::string& id) {
  std::uint64_t number = 0;
  const auto read = std::from_chars(id.data(), id.data() + id.size(), number, 16);
  if (id.size() != 16 || read.ec != std::errc() || read.ptr != id.data() + id.size()) {
    throw std::logic_error("\"" + id + "\" is not the id of a run");
  }
  return number;
}

std::string id_of_number(std::uint64_t number) {
  std::string id(16, '0');
  for (std::size_t i = id.size(); number != 0; number >>= 4U) id[--i] = "0123456789abcdef"[number & 15U];
  return id;
}

}  // namespace polhode::study::record
