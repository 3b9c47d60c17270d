// SPDX-License-Identifier: BSD-3-Clause
// The scheme of every method: an equation in LaTeX, and sources that stand in papers/references.bib.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "integrators/catalogue.hpp"

namespace polhode::laws::integrator_source_law_test {
namespace {

class IntegratorSourceLaw : public testing::TestWithParam<std::string> {
 protected:
  const Declaration& declared() const { return find_integrator(GetParam())->declaration; }
};

std::vector<std::string> names_of_methods() {
  std::vector<std::string> names;
  for (const IntegratorEntry& entry : integrator_catalogue()) names.push_back(entry.declaration.name);
  return names;
}

/// The keys of the BibTeX file, each with a title.
std::set<std::string> known_sources() {
  std::ifstream file(std::filesystem::path(POLHODE_TESTS_DIR) / "../papers/references.bib");
  std::ostringstream text;
  text << file.rdbuf();
  const std::string all = text.str();
  const std::regex entry(R"(@[a-z]+\{([A-Za-z0-9]+),[^@]*?title\s*=)");
  std::set<std::string> keys;
  for (std::sregex_iterator it(all.begin(), all.end(), entry), end; it != end; ++it) keys.insert((*it)[1]);
  return keys;
}

/// True if braces, and \begin and \end, are balanced.
bool is_balanced(const std::string& tex) {
  int depth = 0;
  for (std::size_t i = 0; i < tex.size(); ++i) {
    if (tex[i] == '\\') ++i;  // \{ and \} are characters
    else if (tex[i] == '{') ++depth;
    else if (tex[i] == '}' && --depth < 0) return false;
  }
  const auto count = [&](const std::string& word) {
    int n = 0;
    for (std::size_t at = tex.find(word); at != std::string::npos; at = tex.find(word, at + 1)) ++n;
    return n;
  };
  return depth == 0 && count("\\begin{") == count("\\end{");
}

INSTANTIATE_TEST_SUITE_P(Catalogue, IntegratorSourceLaw, testing::ValuesIn(names_of_methods()),
                         [](const auto& param_info) { return param_info.param; });

TEST_P(IntegratorSourceLaw, HasAnEquation) {
  const std::string& tex = declared().equation;
  ASSERT_FALSE(tex.empty()) << "give Declaration::equation, the scheme in LaTeX";
  EXPECT_TRUE(is_balanced(tex)) << tex;
  EXPECT_NE(tex.find('&'), std::string::npos) << "rows of an aligned environment have a column mark";
  EXPECT_EQ(tex.find("\n\n"), std::string::npos) << "LaTeX takes no empty line in a formula";
  EXPECT_FALSE(tex.ends_with("\\\\")) << "an empty last row";
  EXPECT_TRUE(std::all_of(tex.begin(), tex.end(), [](char c) { return (c >= ' ' && c <= '~') || c == '\n'; }))
      << "plain LaTeX is ASCII";
}

TEST_P(IntegratorSourceLaw, NamesSourcesThatStandInTheBibliography) {
  static const std::set<std::string> known = known_sources();
  ASSERT_FALSE(declared().sources.empty()) << "give Declaration::sources, keys of papers/references.bib";
  for (const std::string& key : declared().sources) EXPECT_TRUE(known.contains(key)) << key;
  const std::set<std::string> once(declared().sources.begin(), declared().sources.end());
  EXPECT_EQ(once.size(), declared().sources.size()) << "a source is named twice";
}

}  // namespace
}  // namespace polhode::laws::integrator_source_law_test
