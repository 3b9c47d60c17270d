// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/text/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <system_error>
#include <type_traits>
#include <utility>

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

/// The fault of a number that CLI11 makes another one of: it reads -1 as the largest number. Empty: none.
std::string fault_of_count(const std::string& text) {
  std::size_t count = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), count);
  if (!text.starts_with('-') && read.ec != std::errc::result_out_of_range) return {};
  return text + " is not a whole number from 0 to " + std::to_string(std::numeric_limits<std::size_t>::max());
}

}  // namespace

CommandLineOption CommandLineOption::type_name(const std::string& name) const {
  option_->type_name(name);
  return *this;
}

CommandLineOption CommandLineOption::group(const std::string& heading) const {
  option_->group(heading);
  return *this;
}

CommandLineOption CommandLineOption::one_of(const std::vector<std::string>& values) const {
  option_->check(CLI::IsMember(values).description(""));
  return *this;
}

template <class T>
CommandLineOption CommandLineOption::range(T least, T most) const {
  option_->check(CLI::Range(least, most).description(""));
  return *this;
}
template CommandLineOption CommandLineOption::range(int, int) const;
template CommandLineOption CommandLineOption::range(double, double) const;
template CommandLineOption CommandLineOption::range(std::int64_t, std::int64_t) const;
template CommandLineOption CommandLineOption::range(std::size_t, std::size_t) const;

CommandLineOption CommandLineOption::not_empty() const {
  const auto fault = [](const std::string& text) { return std::string(text.empty() ? "the value is empty" : ""); };
  option_->check(CLI::Validator(fault, ""));
  return *this;
}

CommandLineOption CommandLineOption::one_value_each_time() const {
  option_->allow_extra_args(false);
  return *this;
}

CommandLineOption CommandLineOption::value_may_be_absent() const {
  option_->expected(0, 1);
  return *this;
}

CommandLineOption CommandLineOption::excludes(const CommandLineOption& other) const {
  option_->excludes(other.option_);
  return *this;
}

bool CommandLineOption::given() const { return option_->count() > 0; }

std::string CommandLineOption::name() const { return option_->get_name(); }

CommandLine::CommandLine(const std::string& question, const std::string& program, int help_column)
    : app_(std::make_unique<CLI::App>(question, program)) {
  app_->get_formatter()->column_width(std::size_t(help_column));
}

CommandLine::~CommandLine() = default;

template <class T>
CommandLineOption CommandLine::add(const std::string& name, T& value, const std::string& meaning) {
  CLI::Option* option = app_->add_option(name, value, meaning);
  if constexpr (std::is_same_v<T, std::size_t> || std::is_same_v<T, std::optional<std::size_t>>)
    option->check(CLI::Validator(fault_of_count, ""));
  return CommandLineOption(*option);
}
#define POLHODE_VALUE(T) template CommandLineOption CommandLine::add(const std::string&, T&, const std::string&)
POLHODE_VALUE(std::string);
POLHODE_VALUE(std::filesystem::path);
POLHODE_VALUE(std::vector<std::string>);
POLHODE_VALUE(int);
POLHODE_VALUE(std::size_t);
POLHODE_VALUE(double);
POLHODE_VALUE(std::optional<std::string>);
POLHODE_VALUE(std::optional<int>);
POLHODE_VALUE(std::optional<std::int64_t>);
POLHODE_VALUE(std::optional<std::size_t>);
POLHODE_VALUE(std::optional<double>);
#undef POLHODE_VALUE

CommandLineOption CommandLine::add_function(const std::string& name, std::function<void(const std::string&)> use,
                                            const std::string& meaning) {
  return CommandLineOption(*app_->add_option_function<std::string>(name, std::move(use), meaning));
}

CommandLineOption CommandLine::add_flag(const std::string& name, bool& flag, const std::string& meaning, bool made) {
  return CommandLineOption(*app_->add_flag_callback(
      name, [&flag, made] { flag = made; }, meaning));
}

void CommandLine::remove(const std::string& name) { app_->remove_option(app_->get_option(name)); }

std::optional<int> CommandLine::parse(int argc, const char* const* argv) {
  try {
    app_->parse(argc, argv);
  } catch (const CLI::CallForHelp& help) {
    return app_->exit(help);
  } catch (const CLI::ExtrasError&) {
    throw InputError(unknown_word(*app_, app_->remaining().front()));
  } catch (const CLI::ArgumentMismatch& error) {
    const std::string text = error.what();
    const auto repeated = text.find(": At Most 1 required");
    if (repeated == std::string::npos) throw InputError(text + "; see --help");
    throw InputError(text.substr(0, repeated) + ": it is given more than once; give it once");
  } catch (const CLI::ParseError& error) {
    const std::string text = error.what();
    throw InputError(text.substr(0, text.find('\n')) + "; see --help");
  }
  return std::nullopt;
}

CommandLineOption add_no_figures(CommandLine& line, bool& figures) {
  return line.add_flag("--no-figures", figures, "no figures", false);
}

CommandLineOption add_article(CommandLine& line, bool& article) {
  return line.add_flag(
      "--article", article,
      "an article in LaTeX and its PDF, in the folder article (needs pdflatex); of a study that is done, the same "
      "command with it carries out no run");
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
