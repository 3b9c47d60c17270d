// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/store/value.hpp"

#include <xxhash.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <type_traits>
#include <vector>

namespace polhode::study::inline store {
namespace {

/// Each function below writes to `to`, and returns the end of what it wrote.

char* write_number(char* to, std::uint64_t number) {
  for (std::size_t k = 0; k < 8; ++k) to[k] = static_cast<char>(number >> 8 * k);
  return to + 8;
}

char* write_value(char* to, const Value& value) {
  const auto write = [&]<class T>(const T& v) {
    if constexpr (std::is_same_v<T, std::monostate>) {
      *to = 'n';
      return to + 1;
    } else if constexpr (std::is_same_v<T, std::int64_t>) {
      *to = 'i';
      return write_number(to + 1, static_cast<std::uint64_t>(v));
    } else if constexpr (std::is_same_v<T, double>) {
      *to = 'r';
      return write_number(to + 1, std::bit_cast<std::uint64_t>(v));
    } else {
      *to = std::is_same_v<T, Blob> ? 'b' : 't';
      const auto* bytes = reinterpret_cast<const char*>(v.data());
      return std::copy(bytes, bytes + v.size(), write_number(to + 1, v.size()));
    }
  };
  return std::visit(write, value);
}

/// Not less than the number of bytes that write_value() writes.
std::size_t room_for(const Value& value) {
  const auto* text = std::get_if<std::string_view>(&value);
  const auto* blob = std::get_if<Blob>(&value);
  return 9 + (text ? text->size() : blob ? blob->size() : 0);
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
  thread_local std::vector<char> bytes;
  std::size_t room = 8;
  for (const Value& value : values) room += room_for(value);
  if (bytes.size() < room) bytes.resize(room);
  char* end = write_number(bytes.data(), static_cast<std::uint64_t>(id));
  for (const Value& value : values) end = write_value(end, value);
  return static_cast<std::int64_t>(XXH3_64bits(bytes.data(), static_cast<std::size_t>(end - bytes.data())));
}

}  // namespace polhode::study::store
