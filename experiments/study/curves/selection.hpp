// SPDX-License-Identifier: BSD-3-Clause
// What a figure shows of a study: as many cases, variants and methods as can be read, chosen evenly, in panels.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiments/study/curves/curves.hpp"

namespace polhode::study::inline curves {

/// The curves of one panel.
struct Block {
  std::vector<const Curve*> curves;
  std::vector<std::string> title;  ///< lines; empty where there is nothing to tell apart
};

using CurveTest = std::function<bool(const Curve&)>;

/// How much one figure can hold and still be read.
struct Limits {
  std::size_t rows = 4;               ///< of cases and, where they have panels of their own, variants
  std::size_t variants_in_panel = 2;  ///< told apart by dashes; of more, each has its own panels
};

class Selection {
 public:
  /// Of the curves that `shown` accepts. Keeps references to the grouping.
  Selection(const Grouping& grouping, const CurveTest& shown, Limits limits);

  bool empty() const { return curves_.empty(); }

  /// " Shown: 4 of 20 cases …"; empty where nothing was left out.
  const std::string& omissions() const { return omissions_; }

  /// The variants that dashes tell apart; one empty text where nothing is to be told apart.
  std::vector<std::string> dashed_variants() const;
  std::size_t dash_of(const Curve& curve) const;
  std::string label(const Curve& curve) const { return grouping_.label(curve); }

  /// A block for each case (each variant where there are many, each handful of methods), of the curves that `belongs`
  /// accepts.
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

}  // namespace polhode::study::report
