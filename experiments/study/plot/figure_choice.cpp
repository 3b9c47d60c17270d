// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plot/figure_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "experiments/study/plot/figure_style.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/value_lists.hpp"

namespace polhode::study::inline plot {
namespace {

std::optional<double> number_in(const std::string& text, double low, double high) {
  const auto value = to_number(text);
  return value && *value >= low && *value <= high ? value : std::nullopt;
}

}  // namespace

double read_figure_width(const std::string& text, const std::string& label) {
  if (text == "one_column") return style::one_column;
  if (text == "two_columns") return style::two_columns;
  if (const auto width = number_in(text, 5, 60)) return *width;
  throw InputError(
      fmt::format("{}: '{}' is no width; write one_column ({} cm), two_columns ({} cm) or a number of cm from 5 to 60",
                  label, text, style::one_column, style::two_columns));
}

void read_figure_font(const std::string& text, const std::string& label, FigureLook& look) {
  const auto comma = text.rfind(',');
  const std::string family = text.substr(0, comma);
  if (family.find_first_of("'\"\\\n,") != std::string::npos || text.empty())
    throw InputError(
        fmt::format("{}: '{}' is no font; write a family, as `fc-list : family` names it, with a size in "
                    "pt or without: 'DejaVu Serif,10'",
                    label, text));
  if (!family.empty()) look.font = family;
  if (comma == std::string::npos) return;
  const auto size = number_in(text.substr(comma + 1), 4, 40);
  if (!size)
    throw InputError(
        fmt::format("{}: '{}' is no size of a font; write a number of pt from 4 to 40, as in "
                    "'DejaVu Serif,10'",
                    label, text.substr(comma + 1)));
  look.font_size = *size;
}

void choose_figures(const FigureChoice& choice, std::vector<Figure>& figures) {
  if (!choice.names.empty()) {
    std::erase_if(figures, [&](const Figure& figure) {
      return std::find(choice.names.begin(), choice.names.end(), figure.name) == choice.names.end();
    });
  }
  for (Figure& figure : figures) figure.look = choice.look;
}

Figure fitted(Figure figure) {
  const double scale = figure.look.font_size / style::font_size;
  const double gap = style::inner_margin * scale;
  const double free = figure.look.width() - (style::left_margin + style::right_margin) * scale + gap;
  const auto fit = static_cast<std::size_t>(std::max(1.0, free / (style::narrowest_panel * scale + gap)));
  if (figure.columns <= fit) return figure;
  std::size_t row = 0, column = 0, old_row = 0;
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    Panel& panel = figure.panels[i];
    if (i > 0 && (panel.row != old_row || column == fit)) ++row, column = 0;
    old_row = panel.row;
    panel.row = row;
    panel.column = column++;
    panel.y.labelled = panel.y.labelled || panel.column == 0;
  }
  figure.rows = row + 1;
  figure.columns = fit;
  return figure;
}

}  // namespace polhode::study::plot
