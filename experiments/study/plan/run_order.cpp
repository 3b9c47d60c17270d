// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plan/run_order.hpp"

#include <algorithm>
#include <bit>
#include <numeric>
#include <string_view>

namespace polhode::study::inline plan {
namespace {

constexpr std::uint64_t sign = std::uint64_t{1} << 63U;

/// Bits that are ordered like the numbers.
std::uint64_t ordered(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x + 0.0);  // -0 and 0 are equal
  return (bits & sign) != 0 ? ~bits : bits | sign;
}

}  // namespace

RunOrder::Code RunOrder::code_of(const OptionValue& value, Column& column) {
  const auto type = static_cast<std::uint8_t>(value.index());
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return {type, static_cast<std::uint64_t>(*whole) ^ sign};
  if (const auto* number = std::get_if<double>(&value)) return {type, ordered(*number)};
  if (const auto* text = std::get_if<std::string>(&value))
    return {type, column.words.try_emplace(*text, column.words.size()).first->second};
  return {type, 0};
}

void RunOrder::add(const std::vector<OptionValue>& key, const std::vector<OptionValue>& rest) {
  std::size_t k = 0;
  const auto add_value = [&](const OptionValue& value) {
    if (runs_ == 0) columns_.push_back({value, {}, {}});
    Column& column = columns_[k++];
    if (column.codes.empty()) {
      if (value == column.first) return;
      column.codes.reserve(expected_);
      column.codes.assign(runs_, code_of(column.first, column));
    }
    column.codes.push_back(code_of(value, column));
  };
  for (const OptionValue& value : key) add_value(value);
  for (const OptionValue& value : rest) add_value(value);
  ++runs_;
}

std::vector<std::uint32_t> RunOrder::sorted(const std::function<bool(std::uint32_t, std::uint32_t)>& before) const {
  struct Compared {
    const std::vector<Code>* codes;
    std::vector<std::uint64_t> places;  // places of the words, in alphabetical order
  };
  std::vector<Compared> compared;
  for (const Column& column : columns_) {
    if (column.codes.empty()) continue;
    std::vector<std::pair<std::string_view, std::uint64_t>> words(column.words.begin(), column.words.end());
    std::sort(words.begin(), words.end());
    std::vector<std::uint64_t> places(words.size());
    for (std::size_t place = 0; place < words.size(); ++place) places[words[place].second] = place;
    compared.push_back({&column.codes, std::move(places)});
  }
  const auto text = static_cast<std::uint8_t>(OptionValue(std::string()).index());
  std::vector<std::uint32_t> numbers(runs_);
  std::iota(numbers.begin(), numbers.end(), 0U);
  std::sort(numbers.begin(), numbers.end(), [&](std::uint32_t a, std::uint32_t b) {
    for (const auto& [codes, places] : compared) {
      const Code& one = (*codes)[a];
      const Code& other = (*codes)[b];
      if (one == other) continue;
      if (one.first != other.first) return one.first < other.first;
      return one.first == text ? places[one.second] < places[other.second] : one.second < other.second;
    }
    return before(a, b);
  });
  return numbers;
}

std::vector<RunOrder::Values> RunOrder::values(std::span<const std::uint32_t> runs, std::size_t most) const {
  std::vector<Values> all;
  for (const Column& column : columns_) {
    Values& values = all.emplace_back();
    if (column.codes.empty()) {
      values.count = 1;
      values.runs = {runs.front()};
      continue;
    }
    std::vector<Code> codes, first;  // the codes of all runs, and those met first
    codes.reserve(runs.size());
    for (const std::uint32_t run : runs) {
      const Code& code = column.codes[run];
      codes.push_back(code);
      if (first.size() == most || std::find(first.begin(), first.end(), code) != first.end()) continue;
      first.push_back(code);
      values.runs.push_back(run);
    }
    std::sort(codes.begin(), codes.end());
    values.count = static_cast<std::size_t>(std::unique(codes.begin(), codes.end()) - codes.begin());
  }
  return all;
}

}  // namespace polhode::study::plan
