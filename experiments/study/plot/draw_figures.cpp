// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plot/draw_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <deque>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "experiments/study/plot/gnuplot_figure.hpp"
#include "experiments/study/plot/language.hpp"
#include "experiments/study/plot/pgfplots_figure.hpp"
#include "experiments/study/text/child_process.hpp"
#include "experiments/study/text/notation.hpp"
#include "experiments/study/text/read_file.hpp"
#include "experiments/study/text/text_file.hpp"

namespace polhode::study::inline plot {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t children = 2;

/// A picture of an earlier study must not stand among those of this one.
void remove_old_figures(const fs::path& folder) {
  for (const auto& name : figures_in(folder)) {
    for (const auto* ending : {".gp", ".dat", ".svg", ".pdf", ".tex"}) fs::remove(folder / (name + ending));
    for (std::size_t page = 1; fs::remove(folder / pgfplots_file(name, page)); ++page) {
    }
  }
}

/// The data are in English whatever the language of the figure. Words without a translation are added to `missing`.
void write_sources(const FigureSet& set, const fs::path& folder, std::set<std::string>& missing) {
  write_text(folder / style_file, gnuplot_style(set));
  const std::vector<std::size_t> first = first_styles(set);
  for (std::size_t f = 0; f < set.figures.size(); ++f) {
    const Figure& given = set.figures[f];
    write_text(folder / (given.name + ".dat"), gnuplot_data(given));
    const Figure figure = translated(given, missing);
    write_text(folder / (figure.name + ".gp"), gnuplot_script(figure, first[f]));
    const auto pages = pgfplots(figure);
    for (std::size_t page = 0; page < pages.size(); ++page)
      write_text(folder / pgfplots_file(figure.name, page), pages[page]);
  }
}

/// Cairo writes the time of day into a PDF, and not every version lets SOURCE_DATE_EPOCH change that. Digits are
/// replaced one for one, so that the offsets in the file stay right.
void fix_date(const fs::path& pdf) {
  auto text = read_file(pdf);
  if (!text) return;
  const std::string_view key = "/CreationDate (D:", date = "19700101000000";
  const auto at = text->find(key);
  if (at == std::string::npos || at + key.size() + date.size() > text->size()) return;
  text->replace(at + key.size(), date.size(), date);
  write_text(pdf, *text);
}

std::optional<ChildProcess> start_gnuplot(const std::string& name, const fs::path& folder) {
  // -d: no start-up files, which would change what is drawn. TZ: Cairo writes the time zone as well.
  return ChildProcess::start({"gnuplot", "-d", name + ".gp"}, folder,
                             {{"SOURCE_DATE_EPOCH", "0"}, {"TZ", "UTC0"}, {"LC_ALL", "C.UTF-8"}});
}

/// True if the file has all of a picture, up to the words that end its format. On a full disk gnuplot cuts its output
/// off and reports no error.
bool is_whole(const fs::path& picture, std::string_view end) {
  const std::string text = read_file(picture).value_or("");
  return std::string_view(text).substr(0, text.find_last_not_of("\r\n") + 1).ends_with(end);
}

void finish_gnuplot(ChildProcess& child, const std::string& name, const fs::path& folder) {
  const auto outcome = child.wait();
  const auto file = folder / name;
  if (outcome.exit_status != 0) {
    throw std::runtime_error(fmt::format("gnuplot failed on {}.gp with exit status {}: {}", file.string(),
                                         outcome.exit_status, one_line(outcome.printed)));
  }
  for (const auto& [ending, end] : {std::pair{".svg", "</svg>"}, {".pdf", "%%EOF"}}) {
    const fs::path made = file.string() + ending;
    if (!is_whole(made, end)) {
      throw std::runtime_error(fmt::format("gnuplot did not write {} to its end; is the disk full?{}{}", made.string(),
                                           outcome.printed.empty() ? "" : " ", one_line(outcome.printed)));
    }
  }
  fix_date(file.string() + ".pdf");
}

std::string untranslated(const FigureLook& look, const std::set<std::string>& missing) {
  if (missing.empty()) return "";
  std::vector<std::string> quoted;
  for (const std::string& phrase : missing) quoted.push_back("'" + phrase + "'");
  return fmt::format("{} has no words for {}: they stay in English", look.language->name(), words(quoted));
}

std::string joined(const std::string& one, const std::string& other) {
  return one + (one.empty() || other.empty() ? "" : "; ") + other;
}

std::string not_installed(const std::vector<std::string>& figures, const std::string& where) {
  std::vector<std::string> names;
  for (const auto& figure : figures) names.push_back(figure + ".gp");
  return fmt::format(
      "gnuplot is not installed: {0}/ has scripts, data and LaTeX, but no SVG and PDF. Install it (Debian: apt-get "
      "install gnuplot-nox) and repeat the command, or run gnuplot in {0}/ on {1}.",
      where, words(names));
}

/// Lets gnuplot draw the scripts of these figures. Returns a message if it is not installed.
std::string draw_scripts(const std::vector<std::string>& figures, const fs::path& folder, const std::string& where) {
  std::deque<std::pair<std::string, ChildProcess>> running;
  const auto finish_oldest = [&] {
    auto [name, child] = std::move(running.front());
    running.pop_front();
    finish_gnuplot(child, name, folder);
  };
  for (const auto& figure : figures) {
    if (running.size() == children) finish_oldest();
    auto child = start_gnuplot(figure, folder);
    if (!child) return not_installed(figures, where);
    running.emplace_back(figure, std::move(*child));
  }
  while (!running.empty()) finish_oldest();
  return "";
}

}  // namespace

std::vector<std::string> figures_in(const fs::path& folder) {
  std::vector<std::string> names;
  if (!fs::exists(folder)) return names;
  for (const auto& file : fs::directory_iterator(folder)) {
    const std::string name = file.path().stem().string();
    if (file.path().extension() != ".gp") continue;  // ours are known by their script, which begins with its name
    if (read_file(file.path()).value_or("").starts_with(fmt::format("# {}: ", name))) names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string draw_figures(const FigureSet& set, const fs::path& study_folder, const std::string& where, Others others) {
  const auto folder = study_folder / where;
  if (others == Others::remove) remove_old_figures(folder);
  if (set.figures.empty()) return "";
  fs::create_directories(folder);
  std::set<std::string> missing;
  write_sources(set, folder, missing);
  std::vector<std::string> names;
  for (const auto& figure : set.figures) names.push_back(figure.name);
  return joined(draw_scripts(names, folder, where), untranslated(set.figures.front().look, missing));
}

std::string draw_space_figures(const std::vector<SpaceFigure>& figures, const fs::path& study_folder,
                               const std::string& where) {
  const auto folder = study_folder / where;
  if (figures.empty()) return "";
  fs::create_directories(folder);
  std::set<std::string> missing;
  std::vector<std::string> names;
  for (const auto& figure : figures) {
    write_text(folder / (figure.name + ".gp"), space_script(translated(figure, missing)));
    write_text(folder / (figure.name + ".dat"), space_data(figure));
    names.push_back(figure.name);
  }
  return joined(draw_scripts(names, folder, where), untranslated(figures.front().look, missing));
}

std::optional<double> time_of_gnuplot() {
  std::array<double, 5> seconds{};
  for (double& of_trial : seconds) {
    const auto start = std::chrono::steady_clock::now();
    auto child = ChildProcess::start({"gnuplot", "-d", "--version"}, ".", {});
    if (!child) return std::nullopt;
    child->wait();
    of_trial = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  std::nth_element(seconds.begin(), seconds.begin() + 2, seconds.end());
  return seconds[2];
}

}  // namespace polhode::study::plot
