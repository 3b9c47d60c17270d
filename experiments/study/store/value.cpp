// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/store/value.hpp"

#include <xxhash.h>

#include <bit>
#include <cmath>
#include <string>
#include <type_traits>

namespace polhode::study::inline store {
namespace {

void add_number(std::string& bytes, std::uint64_t number) {
  char parts[8];
  for (std::size_t k = 0; k < 8; ++k) parts[k] = static_cast<char>(number >> 8 * k);
  bytes.append(parts, sizeof parts);
}

void add_value(std::string& bytes, const Value& value) {
  const auto add = [&]<class T>(const T& v) {
    if constexpr (std::is_same_v<T, std::monostate>) {
      bytes += 'n';
    } else if constexpr (std::is_same_v<T, std::int64_t>) {
      bytes += 'i';
      add_number(bytes, static_cast<std::uint64_t>(v));
    } else if constexpr (std::is_same_v<T, double>) {
      bytes += 'r';
      add_number(bytes, std::bit_cast<std::uint64_t>(v));
    } else {
      bytes += std::is_same_v<T, Blob> ? 'b' : 't';
      add_number(bytes, v.size());
      bytes.append(reinterpret_cast<const char*>(v.data()), v.size());
    }
  };
  std::visit(add, value);
}

}  // namespace

Value as_kept(double x) {
  if (std::isnan(x)) return std::monostate();
  return x + 0.0;  // −0 + 0 = 0
}

bool is_integer(const Value& value, std::int64_t number) {
  const auto* integer = std::get_if<std::int64_t>(&value);
  return integer && *integer == number;
}

std::int64_t checksum_of(std::int64_t id, std::span<const Value> values) {
  thread_local std::string bytes;
  bytes.clear();
  add_number(bytes, static_cast<std::uint64_t>(id));
  for (const Value& value : values) add_value(bytes, value);
  return static_cast<std::int64_t>(XXH3_64bits(bytes.data(), bytes.size()));
}

}  // namespace polhode::study::store
