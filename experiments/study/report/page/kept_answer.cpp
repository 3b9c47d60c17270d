// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report/page/kept_answer.hpp"

#include <string_view>
#include <utility>

#include "experiments/study/text/read_file.hpp"

namespace polhode::study::inline report::inline page {
namespace {

/// The text of a piece of the page: without tags, its entities replaced.
std::string plain(std::string_view piece) {
  std::string text;
  bool in_tag = false;
  for (const char c : piece) {
    if (c == '<') in_tag = true;
    if (!in_tag) text += c;
    if (c == '>') in_tag = false;
  }
  for (const auto& [entity, sign] : {std::pair("&lt;", "<"), std::pair("&gt;", ">"), std::pair("&quot;", "\""),
                                     std::pair("&#39;", "'"), std::pair("&amp;", "&")}) {
    for (std::size_t at = 0; (at = text.find(entity, at)) != std::string::npos; ++at)
      text.replace(at, std::string_view(entity).size(), sign);
  }
  return text;
}

}  // namespace

std::vector<std::string> kept_answer(const std::filesystem::path& folder) {
  constexpr std::string_view opening = "<p class=\"answer", end = "</p>";
  const auto page = read_file(folder / "report.html");
  if (!page) return {};
  const std::size_t section = page->find("<section id=\"answer\">");
  if (section == std::string::npos) return {};
  const std::size_t section_end = page->find("</section>", section);
  std::vector<std::string> sentences;
  for (std::size_t at = page->find(opening, section); at < section_end; at = page->find(opening, at + 1)) {
    const std::size_t from = page->find('>', at), to = page->find(end, at);
    if (from == std::string::npos || to == std::string::npos) break;
    sentences.push_back(plain(std::string_view(*page).substr(from + 1, to - from - 1)));
  }
  return sentences;
}

}  // namespace polhode::study::report::page
