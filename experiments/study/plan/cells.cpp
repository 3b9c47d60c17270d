// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plan/cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <set>
#include <unordered_set>

#include "experiments/study/text/notation.hpp"

namespace polhode::study::inline plan {
namespace {

bool decides(const DimensionKey& key) {
  return key.option && (key.option->decides || key.option->role == RunOption::Role::scenario);
}

/// The points of a dimension that agree in all options that decide.
struct PointClass {
  std::vector<OptionValue> values;    ///< value of each key; none for a key that does not decide
  std::vector<std::uint32_t> points;  ///< points of the class; empty: all
};

std::vector<PointClass> classes_of(const Dimension& dimension) {
  const std::size_t keys = dimension.keys.size();
  if (std::none_of(dimension.keys.begin(), dimension.keys.end(), decides))
    return {{std::vector<OptionValue>(keys), {}}};
  std::vector<PointClass> classes;
  std::map<std::vector<OptionValue>, std::size_t> known;
  for (std::size_t point = 0; point < dimension.size; ++point) {
    std::vector<OptionValue> values(keys);
    for (std::size_t k = 0; k < keys; ++k) {
      if (decides(dimension.keys[k])) values[k] = dimension.value(point, k);
    }
    const auto [found, added] = known.try_emplace(values, classes.size());
    if (added) classes.push_back({std::move(values), {}});
    classes[found->second].points.push_back(static_cast<std::uint32_t>(point));
  }
  return classes;
}

/// One class of each dimension.
using Choice = std::vector<const PointClass*>;

/// The value that the choice gives to an option that decides; none if it gives none.
OptionValue value_in(const std::vector<Dimension>& dimensions, const Choice& choice, const RunOption& option) {
  for (std::size_t d = 0; d < dimensions.size(); ++d) {
    for (std::size_t k = 0; k < dimensions[d].keys.size(); ++k) {
      if (dimensions[d].keys[k].option == &option) return choice[d]->values[k];
    }
  }
  return {};
}

/// The options that affect a run, and the values of those that decide: equal for cells of the same block.
struct Effect {
  std::set<const RunOption*> applied;
  std::vector<OptionValue> decisions;
};

Effect effect_of(const std::vector<Dimension>& dimensions, const Choice& choice, const Cells::Start& start) {
  Effect effect;
  RunConfig config = start.config;
  for (const RunOption& option : run_options()) {
    if (option.role == RunOption::Role::scenario || !option.applies_to(config)) continue;
    effect.applied.insert(&option);
    OptionValue value = option.decides ? value_in(dimensions, choice, option) : OptionValue{};
    if (option.decides) effect.decisions.push_back(value);
    if (value == OptionValue{} && option.preset) value = option.preset(*start.scenario);
    if (value != OptionValue{}) option.set(config, value);
  }
  return effect;
}

/// The points whose values of the keys that apply differ.
std::vector<std::uint32_t> distinct(const Dimension& dimension, const std::vector<bool>& applies,
                                    std::vector<std::uint32_t> points) {
  if (points.empty()) {
    points.resize(dimension.size);
    std::iota(points.begin(), points.end(), 0U);
  }
  std::unordered_set<std::string> seen;
  std::erase_if(points, [&](std::uint32_t point) {
    std::string text;
    for (std::size_t k = 0; k < applies.size(); ++k) {
      if (applies[k]) text += text_of(dimension.value(point, k)) + '\n';
    }
    return !seen.insert(text).second;
  });
  return points;
}

}  // namespace

Cells::Cells(std::vector<Dimension> given, const std::function<Start(const std::string&)>& start)
    : dimensions_(std::move(given)) {
  std::vector<std::vector<PointClass>> classes;
  for (const Dimension& dimension : dimensions_) classes.push_back(classes_of(dimension));
  const RunOption& scenario = *std::find_if(run_options().begin(), run_options().end(), [](const RunOption& option) {
    return option.role == RunOption::Role::scenario;
  });

  struct Draft {
    Effect effect;
    std::string scenario;
    std::vector<std::set<std::size_t>> classes;  // classes of each dimension
  };
  std::vector<Draft> drafts;
  std::map<std::vector<OptionValue>, std::size_t> known;
  std::vector<std::size_t> digits(dimensions_.size());
  for (bool more = true; more;) {
    Choice choice;
    for (std::size_t d = 0; d < digits.size(); ++d) choice.push_back(&classes[d][digits[d]]);
    const std::string name = text_of(value_in(dimensions_, choice, scenario));
    Effect effect = effect_of(dimensions_, choice, start(name));
    std::vector<OptionValue> signature = effect.decisions;
    signature.emplace_back(name);
    const auto [found, added] = known.try_emplace(std::move(signature), drafts.size());
    if (added) drafts.push_back({std::move(effect), name, std::vector<std::set<std::size_t>>(digits.size())});
    for (std::size_t d = 0; d < digits.size(); ++d) drafts[found->second].classes[d].insert(digits[d]);
    std::size_t d = digits.size();  // the next choice, the last dimension first
    while (d > 0 && ++digits[d - 1] == classes[d - 1].size()) digits[--d] = 0;
    more = d > 0;
  }

  for (const Draft& draft : drafts) {
    Block block;
    block.first = count_;
    block.scenario = draft.scenario;
    double cells = 1;
    for (std::size_t d = 0; d < dimensions_.size(); ++d) {
      const Dimension& dimension = dimensions_[d];
      std::vector<bool> applies;
      for (const DimensionKey& key : dimension.keys) {
        applies.push_back(!key.option || key.option == &scenario || draft.effect.applied.contains(key.option));
      }
      const bool all = std::find(applies.begin(), applies.end(), false) == applies.end();
      const bool none = std::find(applies.begin(), applies.end(), true) == applies.end();
      Points points;
      if (draft.classes[d].size() < classes[d].size()) {
        for (const std::size_t c : draft.classes[d])
          points.insert(points.end(), classes[d][c].points.begin(), classes[d][c].points.end());
      }
      if (none) points = {0};
      else if (!all) points = distinct(dimension, applies, std::move(points));
      block.sizes.push_back(points.empty() ? dimension.size : points.size());
      cells *= static_cast<double>(block.sizes.back());
      block.points.push_back(std::move(points));
      block.applies.push_back(std::move(applies));
    }
    blocks_.push_back(std::move(block));
    count_ += cells;
  }
}

std::vector<std::string> Cells::tables() const {
  constexpr std::size_t most_shown = 3;
  std::vector<std::string> all;
  for (const Dimension& dimension : dimensions_) {
    if (dimension.word.empty()) continue;
    std::string keys, points;
    for (const DimensionKey& key : dimension.keys) keys += (keys.empty() ? "" : ", ") + key.name;
    for (std::size_t point = 0; point < std::min(dimension.size, most_shown); ++point) {
      std::string values;
      for (std::size_t k = 0; k < dimension.keys.size(); ++k)
        values += (k == 0 ? "" : ", ") + rounded(text_of(dimension.value(point, k)));
      points += (points.empty() ? "(" : ", (") + values + ")";
    }
    all.push_back(fmt::format("{} of {}: {}: {}{}", dimension.word, keys, study::count(dimension.size, "point"), points,
                              dimension.size > most_shown ? ", …" : ""));
  }
  return all;
}

void Cells::find(std::size_t k, Place& place) const {
  const auto after = std::upper_bound(blocks_.begin(), blocks_.end(), static_cast<double>(k),
                                      [](double cell, const Block& block) { return cell < block.first; });
  const Block& block = *std::prev(after);
  place.block = static_cast<std::size_t>(&block - blocks_.data());
  place.points.resize(dimensions_.size());
  std::size_t rest = k - static_cast<std::size_t>(block.first);
  for (std::size_t d = dimensions_.size(); d-- > 0;) {
    const std::size_t digit = block.sizes[d] == 1 ? 0 : rest % block.sizes[d];
    rest /= block.sizes[d];
    place.points[d] = block.points[d].empty() ? digit : block.points[d][digit];
  }
}

Cell Cells::at(std::size_t k) const {
  Place place;
  find(k, place);
  return at(place);
}

Override Cells::override_at(const Place& place, std::size_t d, std::size_t i) const {
  const Dimension& dimension = dimensions_[d];
  const std::size_t point = place.points[d];
  return {dimension.keys[i].name, text_of(dimension.value(point, i)),
          dimension.place ? dimension.place(point, i) : dimension.keys[i].label};
}

Cell Cells::at(const Place& place) const {
  const Block& block = blocks_[place.block];
  Cell cell;
  cell.scenario = block.scenario;
  cell.options.reserve(dimensions_.size());
  for (std::size_t d = dimensions_.size(); d-- > 0;) {
    for (std::size_t i = 0; i < dimensions_[d].keys.size(); ++i) {
      const DimensionKey& key = dimensions_[d].keys[i];
      if (!block.applies[d][i] || (key.option && key.option->role == RunOption::Role::scenario)) continue;
      if (key.option) {
        OptionValue value = dimensions_[d].value(place.points[d], i);
        if (value != OptionValue{}) cell.options.emplace_back(key.option, std::move(value));
      } else if (Override override = override_at(place, d, i); !override.value.empty()) {
        cell.varied.push_back(std::move(override));
      }
    }
  }
  std::sort(cell.varied.begin(), cell.varied.end(), [](const Override& a, const Override& b) { return a.key < b.key; });
  return cell;
}

}  // namespace polhode::study::plan
