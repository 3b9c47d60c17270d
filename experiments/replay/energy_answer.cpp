// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/replay/energy_answer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/study/text/notation.hpp"

namespace polhode::study::replay {
namespace {

double largest_drift(const Recording& r) {
  double most = 0;
  for (const double drift : r.energy_drift) most = std::max(most, std::abs(drift));
  return most;
}

std::string drift_words(double drift) {
  return drift > 0 ? fmt::format("by up to {} of its scale", number(drift)) : "not at all";
}

}  // namespace

std::vector<std::string> energy_answer(const std::vector<Recording>& recordings) {
  std::vector<const Recording*> ended;
  std::vector<std::string> others;
  for (const Recording& r : recordings) {
    if (r.status == "ok" && !r.energy_drift.empty() && std::isfinite(largest_drift(r))) ended.push_back(&r);
    else others.push_back(label_of(r));
  }
  std::vector<std::string> sentences;
  if (!ended.empty()) {
    const auto [least, most] = std::minmax_element(
        ended.begin(), ended.end(),
        [](const Recording* a, const Recording* b) { return largest_drift(*a) < largest_drift(*b); });
    sentences.push_back(
        ended.size() == 1
            ? fmt::format("The energy drifts {} with {}.", drift_words(largest_drift(**least)), label_of(**least))
            : fmt::format("The energy drifts the least with {} ({}) and the most with {} ({}).", label_of(**least),
                          drift_words(largest_drift(**least)), label_of(**most), drift_words(largest_drift(**most))));
  }
  if (!others.empty())
    sentences.push_back(fmt::format("{} did not come to the end.", words(first_items(std::move(others), 4))));
  sentences.emplace_back("How far a run is from the exact motion, a study tells: ./run energy_drift.");
  return sentences;
}

}  // namespace polhode::study::replay
