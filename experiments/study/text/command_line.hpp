// SPDX-License-Identifier: BSD-3-Clause
// What the command lines of all experiments share.
#pragma once

#include <optional>
#include <string>

namespace CLI {
class App;
class Option;
}

namespace polhode::study::inline text {

/// Adds --no-figures, which makes `figures` false.
CLI::Option* add_no_figures(CLI::App& app, bool& figures);

/// Fills in what the options of `app` stand for. Returns the exit status where nothing is left to do, because help was
/// asked for and printed; throws InputError, of one line, for what no option takes.
std::optional<int> parse_command_line(CLI::App& app, int argc, const char* const* argv);

/// The call, "./run PROGRAM …", quoted so that a shell takes it again.
std::string command_text(const std::string& program, int argc, const char* const* argv);

}  // namespace polhode::study
