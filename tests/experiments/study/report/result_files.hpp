// SPDX-License-Identifier: BSD-3-Clause
// A folder for the files of a report, and how tests read them: whole, as visible text, as balanced tags.
#pragma once

#include <gtest/gtest.h>

#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/temporary_folder.hpp"

namespace polhode::study::report_tests {

namespace fs = std::filesystem;

/// A folder of the test's own, gone with it; its name needs quoting wherever it is not.
struct Folder : TemporaryFolder {
  fs::path path = TemporaryFolder::path() / "it's ü \"quoted\"";
  Folder() { fs::create_directory(path); }
};

inline std::string read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file) << path;
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

inline bool gnuplot_is_installed() { return std::system("command -v gnuplot >/dev/null 2>&1") == 0; }

#define NEEDS_GNUPLOT() \
  if (!gnuplot_is_installed()) GTEST_SKIP() << "skipped, because gnuplot is not installed"

/// The text that a reader finds on a page, without tags and style.
inline std::string visible_text(const std::string& page) {
  const auto body = page.substr(page.find("<body>"));
  return std::regex_replace(std::regex_replace(body, std::regex("</?span[^>]*>"), ""), std::regex("<[^>]*>"), " ");
}

/// Empty if every tag that is opened is closed in order; otherwise what is wrong.
inline std::string unbalanced(const std::string& page) {
  static const std::set<std::string> no_end = {"meta", "img", "br", "!doctype"};
  std::vector<std::string> open;
  for (std::size_t at = page.find('<'); at != std::string::npos; at = page.find('<', at + 1)) {
    const bool closes = page[at + 1] == '/';
    std::string tag;
    for (std::size_t i = at + 1 + closes;
         i < page.size() && (std::isalnum(static_cast<unsigned char>(page[i])) || page[i] == '!'); ++i) {
      tag += static_cast<char>(std::tolower(static_cast<unsigned char>(page[i])));
    }
    if (tag.empty()) return "a stray < at " + page.substr(at, 40);
    if (no_end.contains(tag) || page[page.find('>', at) - 1] == '/') continue;  // elements of a drawing: <path/>
    if (!closes) {
      open.push_back(tag);
      if (tag == "style") at = page.find("</style>", at) - 1;
    } else if (open.empty() || open.back() != tag) {
      return "</" + tag + "> closes " + (open.empty() ? "nothing" : open.back());
    } else {
      open.pop_back();
    }
  }
  return open.empty() ? "" : open.back() + " is never closed";
}

/// NaN and infinities as C and C++ print them, as words of their own.
inline bool has_not_a_number(const std::string& text) {
  return std::regex_search(text, std::regex("(^|[^A-Za-z])-?(nan|inf|infinity)([^A-Za-z]|$)", std::regex::icase));
}

}  // namespace polhode::study::report_tests
