// SPDX-License-Identifier: BSD-3-Clause
// Hash of a text, for names of contents.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

struct XXH3_state_s;

namespace polhode::study::inline text {

/// XXH3 (64 bits) of the bytes, as 16 hexadecimal digits.
std::string text_hash(std::string_view text);
/// The same as a number.
std::uint64_t text_number(std::string_view text);

/// The hash of a text that is given in parts, and never held as a whole.
class TextHash {
 public:
  TextHash();
  void add(std::string_view part);
  /// text_hash() of all parts together.
  std::string text() const;

 private:
  struct Free {
    void operator()(XXH3_state_s* state) const;
  };
  std::unique_ptr<XXH3_state_s, Free> state_;
};

}  // namespace polhode::study::text
