// SPDX-License-Identifier: BSD-3-Clause
// The command line of a program, and its parts that all experiments have in common. CLI11, which parses it, is slow to
// compile: it stands in the source file alone.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}

namespace polhode::study::inline text {

/// An option of a CommandLine, which owns it.
class CommandLineOption {
 public:
  explicit CommandLineOption(CLI::Option& option) : option_(&option) {}

  /// The word for the value in the help: "FILE".
  CommandLineOption type_name(const std::string& name) const;
  /// The heading under which the help lists the option.
  CommandLineOption group(const std::string& heading) const;
  /// Refuses values that are not among these.
  CommandLineOption one_of(const std::vector<std::string>& values) const;
  /// Refuses values below `least` or above `most`. T: int, std::int64_t, std::size_t, double.
  template <class T>
  CommandLineOption range(T least, T most) const;
  /// Refuses an empty value.
  CommandLineOption not_empty() const;
  /// The option takes one value each time that it is given, also if it may be given several times.
  CommandLineOption one_value_each_time() const;
  /// The value may be left out.
  CommandLineOption value_may_be_absent() const;
  /// Refuses a command line with both options.
  CommandLineOption excludes(const CommandLineOption& other) const;

  /// True if the command line that was parsed has the option.
  bool given() const;
  /// "--name".
  std::string name() const;

 private:
  CLI::Option* option_;
};

/// The options of a program, their help, and the reading of their values. Everything that is added must outlive
/// parse().
class CommandLine {
 public:
  /// question: what the help begins with. help_column: where the meanings of options begin in the help.
  CommandLine(const std::string& question, const std::string& program, int help_column = 40);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// Adds an option whose value is kept in `value`; a name without dashes is that of the words that belong to no
  /// option. T: std::string, std::vector<std::string>, std::filesystem::path, int, std::size_t, double; an optional
  /// std::string, int, std::int64_t, std::size_t or double. A std::size_t that is negative or too large is refused.
  template <class T>
  CommandLineOption add(const std::string& name, T& value, const std::string& meaning);
  /// Adds an option whose value is handed to `use`, which may throw InputError.
  CommandLineOption add_function(const std::string& name, std::function<void(const std::string&)> use,
                                 const std::string& meaning);
  /// Adds an option without a value, which makes `flag` equal to `made`.
  CommandLineOption add_flag(const std::string& name, bool& flag, const std::string& meaning, bool made = true);
  /// Removes an option that was added.
  void remove(const std::string& name);

  /// Parses the words. Returns the exit status if help was requested and printed; throws InputError (one line) for
  /// anything that is no option.
  std::optional<int> parse(int argc, const char* const* argv);

 private:
  std::unique_ptr<CLI::App> app_;
};

/// Adds --no-figures, which makes `figures` false.
CommandLineOption add_no_figures(CommandLine& line, bool& figures);

/// Adds --article, which makes `article` true.
CommandLineOption add_article(CommandLine& line, bool& article);

/// The word as a shell reads it back: unchanged if no character in it has a meaning to the shell.
std::string shell_word(const std::string& word);

/// The command line, "./run PROGRAM …", quoted for a shell.
std::string command_text(const std::string& program, int argc, const char* const* argv);

}  // namespace polhode::study::text
