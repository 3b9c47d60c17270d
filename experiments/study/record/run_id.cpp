// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/record/run_id.hpp"

#include <fmt/format.h>

#include <charconv>
#include <stdexcept>

#include "experiments/study/record/run_options.hpp"
#include "experiments/study/text/text_hash.hpp"

namespace polhode::study::inline record {

std::uint64_t run_number(const RunConfig& config, std::string_view canonical, int version) {
  RunConfig said = config;
  std::erase_if(said.varied, [](const Override& o) { return o.value.empty(); });
  return text_number(fmt::format("{}\n{}\n", version, canonical) + identity_of(said));
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

std::string id_of_number(std::uint64_t number) { return fmt::format("{:016x}", number); }

}  // namespace polhode::study::record
