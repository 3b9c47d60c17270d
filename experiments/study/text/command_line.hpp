// SPDX-License-Identifier: BSD-3-Clause
// Parts of the command line that all experiments have in common.
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

/// Adds --article, which makes `article` true.
CLI::Option* add_article(CLI::App& app, bool& article);

/// Parses the command line into the options of `app`. Returns the exit status if help was asked for and printed; throws
/// InputError (one line) for anything that is no option.
std::optional<int> parse_command_line(CLI::App& app, int argc, const char* const* argv);

/// The word as a shell reads it back: unchanged if no character in it has a meaning to the shell.
std::string shell_word(const std::string& word);

/// The command line, "./run PROGRAM …", quoted for a shell.
std::string command_text(const std::string& program, int argc, const char* const* argv);

}  // namespace polhode::study::text
