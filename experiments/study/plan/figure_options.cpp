// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plan/figure_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/study/plot/figure_style.hpp"
#include "experiments/study/plot/language.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/suggestion.hpp"
#include "experiments/study/text/value_lists.hpp"

namespace polhode::study::inline plan {
namespace {

constexpr std::array figure_table = {
    FigureName{"drift_against_time", "energy drift against time, at up to three steps or tolerances"},
    FigureName{"drift_against_step", "largest energy drift of each run against its step or tolerance"},
    FigureName{"momentum", "largest drift of the momenta that are conserved"},
    FigureName{"orientation_defect", "distance of the stored orientation from a rotation"},
    FigureName{"invariants", "drift of the further invariants that the scenarios declare"},
    FigureName{"error_against_step", "distance from the exact motion against the step or tolerance"},
    FigureName{"error_against_cost", "error against right-hand sides; in experiments without an analysis of their own"},
};

void choose(const std::string& text, bool closed, FigureChoice& choice) {
  if (text == "all") return choice.names.clear();
  if (text == "none") throw InputError("--figure: for no figures write --no-figures");
  choice.names = split_list(text, ',', "--figure");
  std::vector<std::string_view> known = {"all"};
  for (const FigureName& figure : figure_table) known.push_back(figure.name);
  for (const std::string& name : choice.names) {
    if (closed && std::find(known.begin() + 1, known.end(), name) == known.end())
      throw InputError(fmt::format("--figure: no figure '{}'{}", name, suggestion(name, "There are", known)));
  }
}

}  // namespace

std::span<const FigureName> figure_names() { return figure_table; }

void add_look_options(CommandLine& line, FigureLook& look) {
  const auto add = [&](const char* name, std::function<void(const std::string&)> use, const std::string& meaning,
                       const char* type) {
    return line.add_function(name, std::move(use), meaning).type_name(type).group("Figures");
  };
  add(
      "--figure-width", [&look](const std::string& text) { look.width_cm = read_figure_width(text, "--figure-width"); },
      fmt::format("width of figures: {} cm, {} cm or a number of cm (default: 17; of PGFPlots 12.5)", style::one_column,
                  style::two_columns),
      "one_column|two_columns|CM");
  add(
      "--figure-font", [&look](const std::string& text) { read_figure_font(text, "--figure-font", look); },
      "letters of SVG and PDF: a family, and their size in pt (default: sans-serif,9)", "FAMILY,SIZE");
  add(
      "--figure-title", [&look](const std::string& text) { look.title = text == "on"; },
      "write the title of each figure above it (default: off)", "on|off")
      .one_of({"on", "off"});
  std::string names = "en";
  for (const LanguageFile& file : language_files()) names += fmt::format("|{}", file.name);
  add(
      "--figure-language",
      [&look](const std::string& text) { look.language = read_language(text, "--figure-language"); },
      "language of the words in figures, or a file of phrases, such as mine.toml (default: en)",
      (names + "|FILE").c_str());
}

void add_figure_options(CommandLine& line, FigureChoice& choice, bool closed, const CommandLineOption* excludes) {
  const CommandLineOption figure =
      line.add_function(
              "--figure", [&choice, closed](const std::string& text) { choose(text, closed, choice); },
              fmt::format("figures that are drawn, of --list figures{} (default: all)",
                          closed ? "" : " or of the experiment's own"))
          .type_name("NAME,…|all")
          .group("Figures");
  if (excludes != nullptr) figure.excludes(*excludes);
  add_look_options(line, choice.look);
}

}  // namespace polhode::study::plan
