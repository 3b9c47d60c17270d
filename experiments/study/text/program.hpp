// SPDX-License-Identifier: BSD-3-Clause
// The frame of every main(): prints errors in one line and checks that standard output was written.
#pragma once

#include <functional>
#include <string>

namespace polhode::study::inline text {

constexpr int bad_input = 2, not_carried_out = 3;  ///< exit statuses

/// Calls the program and returns its exit status. An exception is one line on stderr that begins with the program's
/// name: InputError gives `bad_input`, any other, with `afterwards` added to the line, `not_carried_out`. So does
/// standard output that could not be written to its end, as on a full disk.
int run_program(const std::string& name, const std::function<int()>& program, const std::string& afterwards = "");

}  // namespace polhode::study::text
