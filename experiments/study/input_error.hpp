// SPDX-License-Identifier: BSD-3-Clause
// Bad input from the user: one line that says where it stands and what would be right.
#pragma once

#include <stdexcept>

namespace polhode::study {

/// what() is the one line, without the program's name. main() prints it on stderr and exits with 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace polhode::study
