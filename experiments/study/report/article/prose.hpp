// SPDX-License-Identifier: BSD-3-Clause
// Sentences of a study in LaTeX, in which every number is a command that a file of its own defines: a text that is
// written around them keeps up with the data when the study is made again.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace polhode::study::inline report::inline article {

class Prose {
 public:
  /// `names`: words that are names although they have neither a digit nor an underscore: "dmv".
  explicit Prose(std::set<std::string, std::less<>> names = {}) : names_(std::move(names)) {}

  /// The sentence in LaTeX. Its numbers become \polhode<Place>A, B, … Z, AA …, counted on over all sentences of a
  /// place; names with digits or underscores become \name{…}. `place`: letters, "Answer".
  std::string operator()(std::string_view place, std::string_view sentence);

  /// A value that is no part of a sentence, as a command of this name behind \polhode: "Version".
  std::string value(std::string_view name, std::string_view text);

  /// The file that defines the commands, each sentence as a comment above those of its numbers.
  const std::string& definitions() const { return definitions_; }

 private:
  std::string command(std::string_view place);

  std::set<std::string, std::less<>> names_;
  std::map<std::string, std::size_t, std::less<>> used_;  // numbers of each place
  std::string definitions_;
};

}  // namespace polhode::study::report::article
