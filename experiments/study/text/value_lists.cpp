// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/text/value_lists.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/trimmed.hpp"

namespace polhode::study::inline text {
namespace {

constexpr double longest_range = 1e6;  // values

std::vector<std::string> cut(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (;;) {
    const auto at = text.find(separator);
    parts.emplace_back(trimmed(text.substr(0, at)));
    if (at == std::string_view::npos) return parts;
    text.remove_prefix(at + 1);
  }
}

double number(const std::string& text, const std::string& option) {
  if (const auto x = to_number(text)) return *x;
  throw InputError(option + ": '" + text + "' is not a finite number; it takes numbers as 0.1,0.2 or 1e-4:1e-1:10:log");
}

bool is_list_of_toml(std::string_view text) { return text.find_first_of("[;") != std::string_view::npos; }

std::vector<double> range(const std::string& item, const std::string& option) {
  const auto parts = cut(item, ':');
  const bool logarithmic = parts.size() == 4 && parts[3] == "log";
  if (parts.size() != 3 && !logarithmic) {
    throw InputError(option + ": '" + item + "' is not a range; it is first:last:count or first:last:count:log");
  }
  const double first = number(parts[0], option), last = number(parts[1], option), count = number(parts[2], option);
  if (count != std::floor(count) || count < 2 || count > longest_range) {
    throw InputError(option + ": the count of the range '" + item + "' must be a whole number from 2 to 1000000");
  }
  if (logarithmic && !(first > 0 && last > 0)) {
    throw InputError(option + ": the ends of the logarithmic range '" + item + "' must be positive");
  }
  const int n = static_cast<int>(count);
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    const double s = static_cast<double>(i) / (n - 1);
    if (i == 0) values.push_back(first);
    else if (i == n - 1) values.push_back(last);
    else values.push_back(logarithmic ? first * std::pow(last / first, s) : first + (last - first) * s);
  }
  return values;
}

}  // namespace

std::vector<std::string> split_list(std::string_view text, char separator, const std::string& option) {
  std::vector<std::string> items = cut(text, separator);
  for (const std::string& item : items) {
    if (item.empty()) throw InputError(option + ": an empty list or item in '" + std::string(text) + "'");
  }
  return items;
}

std::vector<double> numbers(std::string_view text, const std::string& option) {
  std::vector<double> values;
  for (const std::string& item : split_list(text, ',', option)) {
    if (item.find(':') == std::string::npos) {
      values.push_back(number(item, option));
    } else {
      for (const double x : range(item, option)) values.push_back(x);
    }
  }
  return values;
}

std::vector<std::string> toml_values(std::string_view text, const std::string& option) {
  if (is_list_of_toml(text)) return split_list(text, ';', option);
  std::vector<std::string> values;
  for (const std::string& item : split_list(text, ',', option)) {
    if (item.find(':') != std::string::npos) {
      for (const double x : range(item, option)) values.push_back(exact(x));
    } else if (const auto x = to_number(item)) {
      values.push_back(exact(*x));
    } else if (item == "true" || item == "false" || item.front() == '"' || item.front() == '\'') {
      values.push_back(item);
    } else {
      values.push_back('"' + item + '"');  // a bare word is a TOML string
    }
  }
  return values;
}

std::optional<std::vector<double>> toml_numbers(std::string_view text, const std::string& option) {
  if (is_list_of_toml(text)) return std::nullopt;
  std::vector<double> values;
  for (const std::string& item : split_list(text, ',', option)) {
    if (item.find(':') != std::string::npos) {
      std::vector<double> of_range = range(item, option);
      if (values.empty()) values = std::move(of_range);
      else values.insert(values.end(), of_range.begin(), of_range.end());
    } else if (const auto x = to_number(item)) {
      values.push_back(*x);
    } else {
      return std::nullopt;
    }
  }
  return values;
}

std::size_t count_values(std::string_view text) {
  const auto items = [&](char separator) {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), separator)) + 1;
  };
  if (is_list_of_toml(text)) return items(';');
  std::size_t values = items(',');
  while (!text.empty()) {
    const std::string_view item = text.substr(0, text.find(','));
    text.remove_prefix(std::min(item.size() + 1, text.size()));
    const auto parts = item.find(':') == std::string_view::npos ? std::vector<std::string>{} : cut(item, ':');
    const auto n = parts.size() > 2 ? to_number(parts[2]) : std::nullopt;
    if (n && *n >= 2 && *n <= longest_range) values += static_cast<std::size_t>(*n) - 1;
  }
  return values;
}

std::optional<double> to_number(std::string_view text) {
  double x = 0;
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(x)) return std::nullopt;
  return x;
}

std::string exact(double x) {
  std::string text;
  add_exact(text, x);
  return text;
}

void add_exact(std::string& out, double x) {
  char text[32];
  // Most numbers of a scenario are small whole ones, whose shortest text is that of the integer and made faster.
  const bool whole = std::abs(x) < 1e5 && x == std::trunc(x) && !(x == 0 && std::signbit(x));
  const auto end = whole ? std::to_chars(text, text + sizeof text, static_cast<int>(x)).ptr
                         : std::to_chars(text, text + sizeof text, x).ptr;
  out.append(text, end);
}

}  // namespace polhode::study::text
