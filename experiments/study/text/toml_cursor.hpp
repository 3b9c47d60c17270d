// SPDX-License-Identifier: BSD-3-Clause
// Checked reading of a TOML tree. A cursor is a value with the keys that led to it, so that every error names its place
// and its path, "body.0.shape.size.1".
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/problem/force_kind.hpp"
#include "experiments/study/text/toml_value.hpp"

namespace polhode::study::inline text {

/// An error in the input, without the name of the file, which the caller adds.
struct Fault {
  TomlPlace place;
  std::string path;     ///< "body.0.mass"
  std::string message;  ///< "-1 is not a valid mass; it must be a positive number of kg"
};

class TomlCursor {
 public:
  using Range = Parameter::Range;

  explicit TomlCursor(const TomlValue& root) : value_(&root) {}

  const TomlValue& value() const { return *value_; }
  std::string path() const;

  // Steps down. The cursor above must outlive the one below, hence no steps from a temporary.

  bool has(std::string_view key) const { return value_->find(key) != nullptr; }
  /// The value of a required key. Throws a Fault that says what the key `must_be` if it is missing.
  TomlCursor at(std::string_view key, std::string_view must_be) const&;
  TomlCursor at(std::string_view key, const TomlValue& otherwise) const&;
  TomlCursor item(std::size_t i) const&;
  TomlCursor at(std::string_view key, std::string_view must_be) const&& = delete;
  TomlCursor at(std::string_view key, const TomlValue& otherwise) const&& = delete;
  TomlCursor item(std::size_t i) const&& = delete;

  // Checked reading: each function throws a Fault that says what the value must be.

  /// A finite number in that range.
  double number(std::string_view unit, Range range = Range::any) const;
  Vector3<double> vector(std::string_view unit, Range range = Range::any) const;
  bool boolean() const;
  /// A text of one line.
  const std::string& text(std::string_view must_be) const;
  /// The number of items of a list that is not empty.
  std::size_t list(std::string_view must_be) const;
  /// Checks that a table has no other keys; `introduction` is "A body has".
  void table(std::string_view introduction, const std::vector<std::string_view>& keys) const;

  // Errors.

  [[noreturn]] void fail(std::string message) const;
  /// "-1 is not a valid mass; it must be …", named after the key.
  [[noreturn]] void refuse(std::string_view must_be) const;
  /// "no force is called 'sprong'; did you mean 'spring'? …"
  [[noreturn]] void unknown(std::string_view what, std::string_view introduction,
                            const std::vector<std::string_view>& known) const;

 private:
  TomlCursor(const TomlValue& value, const TomlCursor& above, std::string_view key, std::size_t index)
      : value_(&value), above_(&above), key_(key), index_(index) {}

  const TomlValue* value_;
  const TomlCursor* above_ = nullptr;
  std::string_view key_;  // key; empty for an item of a list
  std::size_t index_ = 0;
};

}  // namespace polhode::study::text
