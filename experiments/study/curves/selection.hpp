// SPDX-License-Identifier: BSD-3-Clause
// Selects the part of a study that a figure can show: cases, variants and methods, chosen evenly, in panels.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiments/study/curves/curves.hpp"

namespace polhode::study::inline curves {

/// The curves of one panel.
struct Block {
  std::vector<const Curve*> curves;
  std::vector<std::string> title;  ///< lines; empty if nothing distinguishes the panels
};

using CurveTest = std::function<bool(const Curve&)>;

/// The capacity of a legible figure.
struct Limits {
  std::size_t rows = 4;               ///< number of cases and, if variants have their own panels, of variants
  std::size_t variants_in_panel = 2;  ///< distinguished by dashes; if there are more, each has its own panels
};

class Selection {
 public:
  /// Selects among the curves that `shown` accepts. Keeps references to the grouping.
  Selection(const Grouping& grouping, const CurveTest& shown, Limits limits);

  bool empty() const { return curves_.empty(); }

  /// Statement of what was left out, " Shown: 4 of 20 cases …"; empty if nothing was.
  const std::string& omissions() const { return omissions_; }

  /// The variants distinguished by dashes; one empty text if there is only one.
  std::vector<std::string> dashed_variants() const;
  std::size_t dash_of(const Curve& curve) const;
  std::string label(const Curve& curve) const { return grouping_.label(curve); }

  /// A block of panels for each case (and for each variant and each group of methods, if there are many), of the curves
  /// that `belongs` accepts.
  std::vector<Block> blocks(const CurveTest& belongs) const;

 private:
  void keep_evenly(std::string_view what, std::vector<std::size_t>& all, std::size_t limit);
  bool variants_in_own_panels() const;
  std::vector<std::vector<std::size_t>> variant_groups() const;
  std::vector<std::string> title(std::size_t case_index, std::size_t first_variant) const;

  const Grouping& grouping_;
  Limits limits_;
  std::vector<const Curve*> curves_;
  std::vector<std::size_t> cases_, variants_;
  std::string omissions_;
};

}  // namespace polhode::study::curves
