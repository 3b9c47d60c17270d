// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plot/language.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "experiments/study/plot/figure_layout.hpp"
#include "experiments/study/plot/gnuplot_figure.hpp"
#include "experiments/study/plot/pgfplots_figure.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/toml_value.hpp"

namespace polhode::study::language_test {
namespace {

constexpr const char* words_of_a_test = R"(
"energy drift" = "Energiedrift"
"relative" = "relativ"
"time" = "Zeit"
"{} or {}" = "{} oder {}"
"from {}" = "von {}"
"{} impacts" = "{} Stöße"
"diverged or off scale" = "divergiert"
)";

std::string in_german(const std::string& text) { return Language("test", words_of_a_test).of(text, nullptr); }

std::set<std::string> phrases_of(const LanguageFile& file) {
  const TomlValue root = parse_toml(file.text);  // holds the entries that are read
  std::set<std::string> phrases;
  for (const TomlEntry& entry : root.entries) phrases.insert(entry.key);
  return phrases;
}

TEST(Language, FindsAPhraseWholeWithAHoleOrInParts) {
  EXPECT_EQ(in_german("energy drift"), "Energiedrift");
  EXPECT_EQ(in_german("energy drift (relative)"), "Energiedrift (relativ)");
  EXPECT_EQ(in_german("time (s)"), "Zeit (s)");
  EXPECT_EQ(in_german("energy drift (relative) or time (s)"), "Energiedrift (relativ) oder Zeit (s)");
  EXPECT_EQ(in_german("from rk4"), "von rk4");
  EXPECT_EQ(in_german("rk4, dt = 0.1 s: 12 impacts"), "rk4, dt = 0.1 s: 12 Stöße");
  EXPECT_EQ(in_german("diverged or off scale"), "divergiert");  // the whole comes before "{} or {}"
  EXPECT_EQ(in_german(""), "");
}

TEST(Language, NamesTheWordsThatItDoesNotHaveAndNoSymbols) {
  const Language german("test", words_of_a_test);
  std::set<std::string> missing;
  for (const char* text : {"largest speed (m/s)", "energy drift (relative)", "ω₁ (rad/s)", "h |ω|", "x (m)",
                           "body.0.mass", "sat_course_report", "1e-3"})
    german.of(text, &missing);
  EXPECT_EQ(missing, std::set<std::string>{"largest speed"});
}

TEST(Language, RefusesAFileThatIsNotATableOfPhrases) {
  for (const char* wrong : {"\"time\" = 3", "\"time\" = \"\"", "\"from {}\" = \"von\"", "\"{}\" = \"{}\"", "[time]",
                            "time = \"\"\"a\nb\"\"\"", "time ="})
    EXPECT_THROW(Language("test", wrong), InputError) << wrong;
}

TEST(Language, IsANameOrAFile) {
  EXPECT_EQ(read_language("en", "--figure-language"), nullptr);
  ASSERT_NE(read_language("de", "--figure-language"), nullptr);
  EXPECT_EQ(read_language("de", "--figure-language")->of("time (s)", nullptr), "Zeit (s)");
  for (const char* wrong : {"", "german", "none.toml", "./de"})
    EXPECT_THROW(read_language(wrong, "--figure-language"), InputError) << wrong;
}

TEST(Language, AllFilesHaveTheSamePhrases) {
  ASSERT_GE(language_files().size(), 3u);
  for (const LanguageFile& file : language_files()) {
    EXPECT_NO_THROW(Language(std::string(file.name), file.text));
    EXPECT_EQ(phrases_of(file), phrases_of(language_files().front())) << file.name;
  }
}

TEST(Language, ReplacesTheWordsOfAFigureAndNoNames) {
  Figure figure{.name = "f", .title = "Untitled", .methods = {"rk4", "heun"}, .variants = {""}};
  figure.look.language = read_language("de", "");
  Panel panel{.title = {"from rk4"}, .x = {.label = "time (s)"}, .y = {.label = "largest speed (m/s)"}};
  panel.curves = {{.label = "rk4", .points = {{0, 1, 1, Mark::edge}}}};
  add_rows(figure, {panel}, 1);
  note_marks(figure);
  std::set<std::string> missing;
  const Figure german = translated(figure, missing);
  EXPECT_EQ(missing, std::set<std::string>{"largest speed"});  // the title is not drawn
  EXPECT_EQ(german.methods, figure.methods);
  for (const std::string& text : {gnuplot_script(german), pgfplots(german).front()}) {
    EXPECT_NE(text.find("Zeit (s)"), std::string::npos);
    EXPECT_NE(text.find("divergiert oder außerhalb der Skala"), std::string::npos);
    EXPECT_EQ(text.find("diverged"), std::string::npos);
  }
}

}  // namespace
}  // namespace polhode::study::language_test
