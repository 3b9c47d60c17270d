// SPDX-License-Identifier: BSD-3-Clause
// A figure as data: panels of curves with their axes already laid out. gnuplot and PGFPlots draw the same figure.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace polhode::study::inline plot {

class Language;

enum class Scale {
  linear,
  logarithmic,
  symlog  ///< sgn(y) asinh(|y|/threshold)/ln 10: logarithmic on both sides of zero, linear below the threshold
};

struct Tick {
  double at = 0;
  std::string label;  ///< plain, or with an exponent: "10^{-4}", "−10^{-4}"
};

struct Axis {
  std::string label{};  ///< label with its unit
  Scale scale = Scale::linear;
  double low = 0, high = 1;
  double threshold = 1e-16;  ///< used by symlog only
  std::vector<Tick> ticks{};
  bool labelled = true;  ///< false: the panel to the left shows the same axis
  bool named = false;    ///< the labels of the ticks are names, not numbers

  /// Position of a value on the axis; in decades if it is logarithmic.
  double place(double value) const;
  double value_at(double place) const;
};

/// Position of a point on its panel.
enum class Mark {
  value,  ///< a point at its value
  zero,   ///< exactly zero on a logarithmic axis: at the bottom
  edge    ///< diverged, failed or off the scale: a cross at the edge of the panel
};
constexpr const char* name(Mark m) { return m == Mark::value ? "value" : m == Mark::zero ? "zero" : "edge"; }

/// Relative drifts above this are drawn at the edge: the motion is lost.
constexpr double off_scale_above = 1000;

struct Point {
  double x = 0;
  double value = 0;  ///< value as measured; not finite if there is none
  double drawn = 0;  ///< position on the y axis
  Mark mark = Mark::value;
};

struct PlottedCurve {
  std::string label{};
  std::size_t method = 0;   ///< index in the figure's methods; its name determines colour, marker and dash
  std::size_t variant = 0;  ///< index in the figure's variants; with several of them it determines the dash
  std::vector<Point> points{};
  bool muted = false;  ///< one of many "other methods": a thin grey line without a name
};

/// A point of the lower envelope of the curves, with the name of the method that begins there; empty: the same method.
struct EnvelopeMark {
  double x = 0, y = 0;
  std::string label{};
};

/// A method's name beside a point, in its colour: whose a cross is, or a curve.
struct NameMark {
  double x = 0, y = 0;
  std::string name{};
  std::size_t method = 0;
  bool left = true;     ///< the name is left of the point; false: right of it
  bool above = false;   ///< a little above the point
  bool opaque = false;  ///< the name covers other marks, on a white ground
};

/// A straight line in log–log that shows a slope.
struct Guide {
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  std::string label;   ///< "h^{2}"; right of the second end
  double label_y = 0;  ///< height of the label: the second end, or slightly above it to avoid another label
};

/// A rectangle of a map, in the units of the axes.
struct MapCell {
  double x_low = 0, x_high = 0, y_low = 0, y_high = 0;
  std::size_t shade = 0;  ///< index in the figure's shades
};

/// Colour and meaning of a kind of cells.
struct Shade {
  std::string label;
  std::string colour;  ///< "0072B2"
};

struct Panel {
  std::size_t row = 0, column = 0;
  std::vector<std::string> title{};  ///< lines
  Axis x{}, y{};
  std::string x_column{}, y_column{};  ///< names in the data file, with units
  std::vector<PlottedCurve> curves{};
  std::vector<Guide> guides{};
  std::vector<EnvelopeMark> envelope{};  ///< drawn as a broad pale line behind the curves
  std::vector<NameMark> names{};
  std::vector<MapCell> cells{};  ///< drawn behind everything
};

/// Size, letters and language of a figure.
struct FigureLook {
  std::optional<double> width_cm{};  ///< width; absent: 17 for pictures, the line of an article on A4 for PGFPlots
  std::string font = "sans-serif";   ///< family, of pictures; PGFPlots takes that of the document
  double font_size = 9;              ///< pt
  bool title = false;                ///< the figure has its title above it
  std::shared_ptr<const Language> language{};  ///< language of its words; null: English

  /// Width of pictures in pixels; 96 are an inch.
  double width() const { return width_cm.value_or(17) * 96 / 2.54; }
};

/// Words of a legend besides names.
struct LegendWords {
  std::string envelope = "lower envelope", muted = "other methods", zero = "exactly zero",
              edge = "diverged or off scale";
};

struct Figure {
  std::string name;  ///< base name of its files
  std::string title;
  std::string caption{};  ///< contents of the figure, what was left out, meaning of the marks
  std::size_t rows = 1, columns = 1;
  std::vector<Panel> panels{};
  std::vector<std::string> methods{};  ///< methods of the study
  std::vector<std::size_t> used_methods{};
  std::vector<std::string> variants{};  ///< distinguished by dashes; one entry if there is only one
  std::vector<Shade> shades{};          ///< kinds of the cells
  LegendWords legend{};
  FigureLook look{};
  double panel_height = 0;  ///< pixels; 0: by the number of panels in a row
  bool has_zero_marks = false, has_edge_marks = false, has_envelope = false, has_muted = false;
};

/// All figures of a study, and the reasons why others were not made.
struct FigureSet {
  struct Absent {
    std::string name, title, reason;
  };
  std::vector<Figure> figures;
  std::vector<Absent> absent;
};

}  // namespace polhode::study::plot
