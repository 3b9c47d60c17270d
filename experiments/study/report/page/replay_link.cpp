// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report/page/replay_link.hpp"

#include <fmt/format.h>

#include "experiments/study/text/notation.hpp"
#include "experiments/study/text/read_file.hpp"
#include "experiments/study/text/text_file.hpp"

namespace polhode::study::inline report::inline page {
namespace {

constexpr std::string_view opening = "<p id=\"replay\">", closing = "</p>\n";

bool keeps_motion(const std::filesystem::path& folder) {
  std::error_code error;
  if (std::filesystem::exists(folder / "trajectory.csv", error)) return true;
  for (const auto& run : std::filesystem::directory_iterator(folder / "trajectories", error)) {
    if (std::filesystem::exists(run.path() / "trajectory.csv", error)) return true;
  }
  return false;
}

}  // namespace

std::string replay_line(const std::filesystem::path& folder) {
  if (!keeps_motion(folder)) return {};
  std::error_code error;
  if (std::filesystem::exists(folder / replay_page, error)) {
    return fmt::format("{}Watch it move: <a href=\"{}\">{}</a>.{}", opening, replay_page, replay_page, closing);
  }
  return fmt::format("{}To watch it move: <code>./run replay --results {}</code> makes a page that plays anywhere.{}",
                     opening, html(folder.string()), closing);
}

void update_replay_line(const std::filesystem::path& folder) {
  const auto page = read_file(folder / "report.html");
  if (!page) return;
  const auto from = page->find(opening);
  const auto to = from == std::string::npos ? from : page->find(closing, from);
  if (to == std::string::npos) return;
  const std::string updated = page->substr(0, from) + replay_line(folder) + page->substr(to + closing.size());
  if (updated != *page) write_text(folder / "report.html", updated);
}

}  // namespace polhode::study::report::page
