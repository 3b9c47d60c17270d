// SPDX-License-Identifier: BSD-3-Clause
// Bad input from the user: one line that gives the place and the remedy.
#pragma once

#include <stdexcept>
#include <string_view>

#include "experiments/study/text/legible.hpp"

namespace polhode::study::inline text {

/// what() is that line, without the program's name and with all control characters escaped. main() prints it on stderr
/// and exits with 2.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::string_view message) : std::runtime_error(legible(message)) {}
};

}  // namespace polhode::study::text
