// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/text/program.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <new>
#include <system_error>

#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/legible.hpp"

namespace polhode::study::inline text {
namespace {

void say(const std::string& name, const std::string& message) {
  fmt::print(stderr, "{}: {}\n", name, legible(message));
}

/// True if all of standard output was written; otherwise prints an error. `reason`: errno, if it is known.
bool printed(const std::string& name, int reason = 0) {
  errno = reason;
  std::cout.flush();
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout) return true;
  say(name, fmt::format("standard output cannot be written{}{}", errno == 0 ? "" : ": ",
                        errno == 0 ? "" : std::strerror(errno)));
  return false;
}

}  // namespace

int run_program(const std::string& name, const std::function<int()>& program, const std::string& afterwards) {
  try {
    const int status = program();
    return printed(name) ? status : not_carried_out;
  } catch (const InputError& error) {
    say(name, error.what());
    return bad_input;
  } catch (const std::exception& error) {
    const auto* system = dynamic_cast<const std::system_error*>(&error);
    if (std::ferror(stdout) != 0 && !printed(name, system ? system->code().value() : 0)) return not_carried_out;
    const bool memory = dynamic_cast<const std::bad_alloc*>(&error) != nullptr;
    say(name, (memory ? std::string("out of memory") : error.what()) + afterwards);
    return not_carried_out;
  }
}

}  // namespace polhode::study::text
