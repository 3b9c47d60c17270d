// SPDX-License-Identifier: BSD-3-Clause
// Words of figures in another language, from a TOML file of phrases: languages/de.toml.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/study/plot/figure.hpp"
#include "experiments/study/plot/space_figure.hpp"

namespace polhode::study::inline plot {

struct LanguageFile {
  std::string_view name;  ///< "de"
  std::string_view text;
};

/// The files of languages/, compiled in, sorted by name.
std::span<const LanguageFile> language_files();

class Language {
 public:
  /// A file's text: a table from English phrases to phrases, in which {} stands for what a phrase is made with. Throws
  /// InputError, which begins with the name.
  Language(std::string name, std::string_view toml);

  const std::string& name() const { return name_; }

  /// A text in this language. Looked up whole; then as a phrase with {}; then in parts: a unit in brackets, and what
  /// commas and colons separate. Words that are not found stay, and are added to `missing` if it is not null.
  std::string of(const std::string& text, std::set<std::string>* missing) const;

 private:
  struct Pattern {
    std::vector<std::string> english, said;  ///< pieces before, between and after the {}
  };

  std::string name_;
  std::map<std::string, std::string> phrases_;
  std::vector<Pattern> patterns_;  ///< the one with the most letters first
};

/// The language of that name, or of that file if the text has a '/' or ends in .toml; null: English, "en". Throws
/// InputError, which begins with the label.
std::shared_ptr<const Language> read_language(const std::string& text, const std::string& label);

/// The figure in its language. Names of methods stay, those of scenarios and keys unless the file has them; words that
/// are met and have no translation are added to `missing`.
Figure translated(Figure figure, std::set<std::string>& missing);
SpaceFigure translated(SpaceFigure figure, std::set<std::string>& missing);

}  // namespace polhode::study::plot
