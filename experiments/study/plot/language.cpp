// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plot/language.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <numeric>
#include <optional>

#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/read_file.hpp"
#include "experiments/study/text/suggestion.hpp"
#include "experiments/study/text/toml_value.hpp"

namespace polhode::study::inline plot {
namespace {

constexpr std::string_view hole = "{}";

std::vector<std::string> split(const std::string& text, std::string_view separator) {
  std::vector<std::string> parts;
  std::size_t from = 0;
  for (std::size_t at = 0; (at = text.find(separator, from)) != std::string::npos; from = at + separator.size())
    parts.push_back(text.substr(from, at - from));
  parts.push_back(text.substr(from));
  return parts;
}

std::size_t letters_of(const std::vector<std::string>& parts) {
  return std::accumulate(parts.begin(), parts.end(), std::size_t{0},
                         [](std::size_t sum, const auto& part) { return sum + part.size(); });
}

/// The texts in the holes of a phrase, none of them empty; absent if the text is not this phrase.
std::optional<std::vector<std::string>> holes_of(const std::vector<std::string>& phrase, const std::string& text) {
  if (!text.starts_with(phrase.front()) || !text.ends_with(phrase.back())) return std::nullopt;
  std::vector<std::string> found;
  std::size_t from = phrase.front().size();
  for (std::size_t i = 1; i < phrase.size(); ++i) {
    const bool last = i + 1 == phrase.size();
    if (text.size() < phrase[i].size()) return std::nullopt;
    const std::size_t to = last ? text.size() - phrase[i].size() : text.find(phrase[i], from + 1);
    if (to == std::string::npos || to <= from) return std::nullopt;
    found.push_back(text.substr(from, to - from));
    from = to + phrase[i].size();
  }
  return found;
}

/// False for numbers, symbols, and names with an underscore or a point, which every language shares.
bool is_word(const std::string& text) {
  if (text.find_first_of("_.=") != std::string::npos) return false;
  int in_a_row = 0;
  for (const char c : text) {
    in_a_row = std::isalpha(static_cast<unsigned char>(c)) ? in_a_row + 1 : 0;
    if (in_a_row == 3) return true;
  }
  return false;
}

std::string known_languages(const std::string& wanted) {
  std::vector<std::string_view> known = {"en"};
  for (const LanguageFile& file : language_files()) known.push_back(file.name);
  return suggestion(wanted, "There are", known);
}

}  // namespace

Language::Language(std::string name, std::string_view toml) : name_(std::move(name)) {
  TomlValue root;
  try {
    root = parse_toml(toml);
  } catch (const TomlSyntaxError& error) {
    throw InputError(fmt::format("{}:{}:{}: {}", name_, error.place.line, error.place.column, error.message));
  }
  for (const TomlEntry& entry : root.entries) {
    const auto wrong = [&](const char* why) {
      throw InputError(fmt::format("{}:{}: '{}' {}", name_, entry.key_place.line, entry.key, why));
    };
    if (entry.value.type != TomlValue::Type::text || entry.value.text.empty() ||
        entry.value.text.find_first_of("\n\r") != std::string::npos)
      wrong("must be a phrase of one line in quotes: \"time\" = \"Zeit\"");
    Pattern pattern{split(entry.key, hole), split(entry.value.text, hole)};
    if (pattern.english.size() != pattern.said.size()) wrong("has another number of {} than its translation");
    if (pattern.english.size() == 1) phrases_.emplace(entry.key, entry.value.text);
    else if (letters_of(pattern.english) == 0) wrong("has no words");
    else patterns_.push_back(std::move(pattern));
  }
  std::stable_sort(patterns_.begin(), patterns_.end(),
                   [](const auto& a, const auto& b) { return letters_of(a.english) > letters_of(b.english); });
}

std::string Language::of(const std::string& text, std::set<std::string>* missing) const {
  if (const auto whole = phrases_.find(text); whole != phrases_.end()) return whole->second;
  for (const Pattern& pattern : patterns_) {
    const auto holes = holes_of(pattern.english, text);
    if (!holes) continue;
    std::string said = pattern.said.front();
    for (std::size_t i = 0; i < holes->size(); ++i) said += of((*holes)[i], missing) + pattern.said[i + 1];
    return said;
  }
  if (const auto bracket = text.find(" ("); bracket != std::string::npos && text.ends_with(')')) {
    const std::string inside = text.substr(bracket + 2, text.size() - bracket - 3);
    return fmt::format("{} ({})", of(text.substr(0, bracket), missing), of(inside, nullptr));
  }
  for (const std::string separator : {", ", ": "}) {
    const auto parts = split(text, separator);
    if (parts.size() == 1) continue;
    std::string said;
    for (const std::string& part : parts) said += (said.empty() ? "" : separator) + of(part, missing);
    return said;
  }
  if (missing != nullptr && is_word(text)) missing->insert(text);
  return text;
}

std::shared_ptr<const Language> read_language(const std::string& text, const std::string& label) {
  if (text == "en") return nullptr;
  if (text.find('/') != std::string::npos || text.ends_with(".toml")) {
    const auto file = read_file(text);
    if (!file) throw InputError(fmt::format("{}: there is no file {}", label, text));
    return std::make_shared<const Language>(text, *file);
  }
  for (const LanguageFile& file : language_files()) {
    if (file.name == text) return std::make_shared<const Language>(text, file.text);
  }
  throw InputError(
      fmt::format("{}: no language '{}'{}; a file of your own ends in .toml", label, text, known_languages(text)));
}

Figure translated(Figure figure, std::set<std::string>& missing) {
  if (!figure.look.language) return figure;
  const Language& language = *figure.look.language;
  const auto words = [&](std::string& text) { text = language.of(text, &missing); };
  const auto names = [&](std::string& text) { text = language.of(text, nullptr); };
  if (figure.look.title) words(figure.title);
  std::for_each(figure.variants.begin(), figure.variants.end(), names);
  for (Shade& shade : figure.shades) words(shade.label);
  if (figure.has_envelope) words(figure.legend.envelope);
  if (figure.has_muted) words(figure.legend.muted);
  if (figure.has_zero_marks) words(figure.legend.zero);
  if (figure.has_edge_marks) words(figure.legend.edge);
  for (Panel& panel : figure.panels) {
    std::for_each(panel.title.begin(), panel.title.end(), names);
    for (Axis* axis : {&panel.x, &panel.y}) {
      words(axis->label);
      for (Tick& tick : axis->ticks) {
        if (axis->named) names(tick.label);
      }
    }
  }
  return figure;
}

SpaceFigure translated(SpaceFigure figure, std::set<std::string>& missing) {
  if (!figure.look.language) return figure;
  const Language& language = *figure.look.language;
  if (figure.look.title) figure.title = language.of(figure.title, &missing);
  for (std::string& axis : figure.axes) axis = language.of(axis, &missing);
  for (SpaceCurve& curve : figure.curves) curve.label = language.of(curve.label, nullptr);
  return figure;
}

}  // namespace polhode::study::plot
