// SPDX-License-Identifier: BSD-3-Clause
// Arrows, springs, labels and the bar of lengths, drawn on top of the bodies. A label stands where no arrow
// and no other label is.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "experiments/study/report/drawing/svg.hpp"

namespace polhode::study::inline report::inline drawing {

class Marks {
 public:
  /// width, height: of the picture.
  Marks(Svg& svg, double width, double height) : svg_(svg), around_(PagePoint::Zero(), PagePoint(width, height)) {}

  /// An arrow from a point by a vector of the page. One that points nearly along the line of sight is a circle with a
  /// dot (towards the viewer) or a cross. heads: 2 for a torque. style: a class.
  void arrow(const PagePoint& from, const PagePoint& by, bool toward, std::string_view style, std::string_view label,
             int heads = 1);

  /// An axis: dashed up to the share of it that is in the body.
  void axis(const PagePoint& from, const PagePoint& by, double inside, std::string_view label);

  void spring(const PagePoint& from, const PagePoint& to);
  void damper(const PagePoint& from, const PagePoint& to);
  void anchor(const PagePoint& at, bool in_the_world);
  void pivot(const PagePoint& at);
  void joint(const PagePoint& at);

  /// A text beside a point, away from it along a direction; finish() finds its place.
  void label(const PagePoint& at, const PagePoint& away, std::string_view text, std::string_view style);

  /// Sets all labels, each where no arrow and no other label is.
  void finish();

  /// A bar for a length (m), its left end at a point, and a text that says it.
  void length_bar(const PagePoint& left, double units, std::string_view text);

 private:
  struct Label {
    PagePoint at, away;
    std::string text, style;
  };

  void head(const PagePoint& tip, const PagePoint& along, std::string_view style);
  void keep_free(const PagePoint& from, const PagePoint& to);
  void place(const Label& label);

  Svg& svg_;
  Eigen::AlignedBox2d around_;
  std::vector<Eigen::AlignedBox2d> taken_;  ///< places of the arrows and labels so far
  std::vector<Label> labels_;
};

}  // namespace polhode::study::report::drawing
