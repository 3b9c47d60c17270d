// SPDX-License-Identifier: BSD-3-Clause
// A value of a column of the store, and the checksum of a row: XXH3 (64 bits) of the id and of all values in a byte
// form that does not depend on how SQLite keeps them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <variant>

namespace polhode::study::inline store {

using Blob = std::span<const std::byte>;

/// std::monostate: NULL. Texts and blobs are views; their bytes must outlive the value.
using Value = std::variant<std::monostate, std::int64_t, double, std::string_view, Blob>;

/// The value as SQLite gives it back: NULL for NaN, 0 for −0.
Value as_kept(double x);

/// True if the value is this integer.
bool is_integer(const Value& value, std::int64_t number);

/// Checksum of a row. Each value is hashed as a letter for its type, and 8 bytes of a number, or the length and the
/// bytes of a text or a blob; numbers have the least significant byte first.
std::int64_t checksum_of(std::int64_t id, std::span<const Value> values);

}  // namespace polhode::study::store
