// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/text/command_line.hpp"

#include <CLI/CLI.hpp>

#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/suggestion.hpp"

namespace polhode::study::inline text {
namespace {

/// The error for the first word that is no option; CLI11 lists all such words, the last one first.
std::string unknown_word(const CLI::App& app, const std::string& word) {
  if (word.empty() || word.front() != '-') {
    return "'" + word + "' belongs to no option; items of a list have commas between them, see --help";
  }
  const std::string name = word.substr(0, word.find('='));
  std::vector<std::string> known;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& long_name : option->get_lnames()) known.push_back(long_name);
  }
  const auto first_letter = std::min(name.find_first_not_of('-'), name.size());
  const std::string near = did_you_mean(name.substr(first_letter), {known.begin(), known.end()}, "--");
  return "there is no option '" + name + "'" + (near.empty() ? "; see" : near + " See") + " --help";
}

}  // namespace

CLI::Option* add_no_figures(CLI::App& app, bool& figures) {
  return app.add_flag_callback(
      "--no-figures", [&figures] { figures = false; }, "no figures");
}

CLI::Option* add_article(CLI::App& app, bool& article) {
  return app.add_flag_callback(
      "--article", [&article] { article = true; },
      "an article in LaTeX and its PDF, in the folder article (needs pdflatex); of a study that is done, the same "
      "command with it carries out no run");
}

std::optional<int> parse_command_line(CLI::App& app, int argc, const char* const* argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp& help) {
    return app.exit(help);
  } catch (const CLI::ExtrasError&) {
    throw InputError(unknown_word(app, app.remaining().front()));
  } catch (const CLI::ParseError& error) {
    const std::string text = error.what();
    throw InputError(text.substr(0, text.find('\n')) + "; see --help");
  }
  return std::nullopt;
}

std::string shell_word(const std::string& word) {
  if (!word.empty() &&
      word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=.,:/@%") ==
          std::string::npos) {
    return word;
  }
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

std::string command_text(const std::string& program, int argc, const char* const* argv) {
  std::string command = "./run " + program;
  for (int i = 1; i < argc; ++i) command += " " + shell_word(argv[i]);
  return command;
}

}  // namespace polhode::study::text
