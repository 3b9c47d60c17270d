// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/curves/selection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "experiments/study/record/shown_runs.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::inline curves {

namespace {

constexpr std::size_t max_methods_in_panel = 10;
constexpr std::size_t max_variants = 4;

bool contains(const std::vector<std::size_t>& all, std::size_t one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

/// Too many methods for one panel stand in several, in the catalogue's order, nearly as many in each.
void split_by_method(const Grouping& grouping, const std::vector<const Curve*>& together,
                     const std::vector<std::string>& title, std::vector<Block>& found) {
  std::set<std::size_t> methods;
  for (const auto* curve : together) methods.insert(curve->method_index);
  const std::vector<std::size_t> order(methods.begin(), methods.end());
  const std::size_t panels = (order.size() + max_methods_in_panel - 1) / max_methods_in_panel;
  for (std::size_t panel = 0; panel < panels; ++panel) {
    const std::size_t first = panel * order.size() / panels, last = (panel + 1) * order.size() / panels - 1;
    Block block{.curves = {}, .title = title};
    if (panels > 1) {
      block.title.push_back("from " + grouping.methods[order[first]]);
      block.title.push_back("to " + grouping.methods[order[last]]);
    }
    for (const auto* curve : together) {
      if (curve->method_index >= order[first] && curve->method_index <= order[last]) block.curves.push_back(curve);
    }
    found.push_back(std::move(block));
  }
}

}  // namespace

Selection::Selection(const Grouping& grouping, const CurveTest& shown, Limits limits)
    : grouping_(grouping), limits_(limits) {
  std::set<std::size_t> cases, variants;
  for (const auto& curve : grouping.curves) {
    if (!shown(curve)) continue;
    curves_.push_back(&curve);
    cases.insert(curve.case_index);
    variants.insert(curve.variant_index);
  }
  cases_ = {cases.begin(), cases.end()};
  variants_ = {variants.begin(), variants.end()};
  keep_evenly("variants of the formulation", variants_, max_variants);
  keep_evenly("cases", cases_,
              std::max<std::size_t>(1, limits.rows / (variants_in_own_panels() ? variants_.size() : 1)));
}

void Selection::keep_evenly(std::string_view what, std::vector<std::size_t>& all, std::size_t limit) {
  if (all.size() <= limit) return;
  omissions_ += fmt::format(" Shown: {} of {} {}, evenly chosen; runs.csv has them all.", limit, all.size(), what);
  std::vector<std::size_t> kept;
  for (const auto i : evenly_spread(all.size(), limit)) kept.push_back(all[i]);
  all = std::move(kept);
}

bool Selection::variants_in_own_panels() const { return variants_.size() > limits_.variants_in_panel; }

std::vector<std::string> Selection::dashed_variants() const {
  if (variants_in_own_panels()) return {""};
  std::vector<std::string> labels;
  for (const auto v : variants_) labels.push_back(grouping_.variants[v]);
  return labels;
}

std::size_t Selection::dash_of(const Curve& curve) const {
  if (variants_in_own_panels()) return 0;
  return static_cast<std::size_t>(std::find(variants_.begin(), variants_.end(), curve.variant_index) -
                                  variants_.begin());
}

std::vector<Block> Selection::blocks(const CurveTest& belongs) const {
  std::vector<Block> found;
  for (const auto c : cases_) {
    for (const auto& variants : variant_groups()) {
      std::vector<const Curve*> together;
      for (const auto* curve : curves_) {
        if (curve->case_index == c && contains(variants, curve->variant_index) && belongs(*curve))
          together.push_back(curve);
      }
      split_by_method(grouping_, together, title(c, variants.front()), found);
    }
  }
  return found;
}

std::vector<std::vector<std::size_t>> Selection::variant_groups() const {
  if (!variants_in_own_panels()) return {variants_};
  std::vector<std::vector<std::size_t>> groups;
  for (const auto v : variants_) groups.push_back({v});
  return groups;
}

std::vector<std::string> Selection::title(std::size_t case_index, std::size_t first_variant) const {
  std::vector<std::string> lines;
  const auto& motion = grouping_.cases[case_index];
  if (grouping_.cases.size() > 1) {
    lines.push_back(motion.scenario);
    if (!motion.details.empty()) lines.push_back(fmt::format("{}", fmt::join(motion.details, ", ")));
  }
  if (variants_in_own_panels()) lines.push_back(grouping_.variants[first_variant]);
  return lines;
}

}  // namespace polhode::study::curves
