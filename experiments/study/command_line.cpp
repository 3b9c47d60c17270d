// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/command_line.hpp"

#include <CLI/CLI.hpp>

#include "experiments/study/input_error.hpp"

namespace polhode::study {
namespace {

std::string quoted(const std::string& word) {
  if (!word.empty() && word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=.,:/@%") ==
                           std::string::npos) {
    return word;
  }
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

}  // namespace

CLI::Option* add_no_figures(CLI::App& app, bool& figures) {
  return app.add_flag_callback("--no-figures", [&figures] { figures = false; }, "no figures");
}

std::optional<int> parse_command_line(CLI::App& app, int argc, const char* const* argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    const std::string text = error.what();
    throw InputError(text.substr(0, text.find('\n')) + "; see --help");
  }
  return std::nullopt;
}

std::string command_text(const std::string& program, int argc, const char* const* argv) {
  std::string command = program;
  for (int i = 1; i < argc; ++i) command += " " + quoted(argv[i]);
  return command;
}

}  // namespace polhode::study
