// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report/drift_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "experiments/study/drift_growth.hpp"
#include "experiments/study/report/curves.hpp"
#include "experiments/study/report/notation.hpp"

namespace polhode::study::report {
namespace {

std::string exponent(double p) { return fmt::format("{:.3f}", p); }

/// The classes at the ends of the interval, where they are not the one of the estimate.
std::vector<std::string> other_classes(const RunResult& r) {
  std::vector<std::string> others;
  if (!r.drift_exponent || r.drift_class == "round-off") return others;
  const bool secular = r.drift_class != "random walk" && r.drift_class != "bounded";
  for (const auto& end : {r.drift_exponent_low, r.drift_exponent_high}) {
    if (std::string c = growth_class(*end, secular); c != r.drift_class) others.push_back(std::move(c));
  }
  return others;
}

/// "rk4, heun and 3 more".
std::string some(const std::set<std::string>& names) {
  constexpr std::size_t most = 8;
  std::vector<std::string> items(names.begin(), names.end());
  if (items.size() > most + 1) {
    const std::size_t rest = items.size() - most;
    items.resize(most);
    items.push_back(fmt::format("{} more", rest));
  }
  return words(items);
}

}  // namespace

std::string exponent_interval(const RunResult& r) {
  if (!r.drift_exponent_low || !r.drift_exponent_high) return "";
  return fmt::format("{} … {}", exponent(*r.drift_exponent_low), exponent(*r.drift_exponent_high));
}

std::string growth_words(const RunResult& r) {
  if (r.drift_class.empty() || !r.drift_exponent) return r.drift_class;
  std::string text = fmt::format("{}: p = {}, 95 % between {} and {}", r.drift_class, exponent(*r.drift_exponent),
                                 exponent(*r.drift_exponent_low), exponent(*r.drift_exponent_high));
  if (const auto others = other_classes(r); !others.empty()) text += fmt::format(" (perhaps {})", fmt::join(others, " or "));
  return text;
}

std::vector<std::string> growth_sentences(const StudyView& study) {
  std::map<std::string, std::pair<std::size_t, std::set<std::string>>> classes;
  std::size_t unsure = 0;
  for (const RunRecord& run : study.runs) {
    const RunResult& r = run.result;
    if (r.drift_class.empty()) continue;
    auto& [n, methods] = classes[r.drift_class];
    ++n;
    methods.insert(run.config.integrator);
    unsure += other_classes(r).empty() ? 0 : 1;
  }
  std::vector<std::string> sentences;
  for (const auto& [name, phrase] : {std::pair("bounded", "The energy drift stays bounded in {}: {}."),
                                     std::pair("random walk", "It grows like a random walk, ∝ √t, in {}: {}."),
                                     std::pair("sublinear", "It grows one way, more slowly than t, in {}: {}."),
                                     std::pair("linear", "It grows linearly in {}: {}."),
                                     std::pair("quadratic", "It grows quadratically in {}: {}."),
                                     std::pair("faster", "It grows faster than that in {}: {}."),
                                     std::pair("round-off", "It never leaves round-off in {}: {}.")}) {
    const auto found = classes.find(name);
    if (found == classes.end()) continue;
    const auto& [n, methods] = found->second;
    std::string text = fmt::format(fmt::runtime(phrase), count(n, "run"), some(methods));
    if (sentences.empty() && text.starts_with("It ")) text = "The energy drift " + text.substr(3);
    sentences.push_back(std::move(text));
  }
  if (unsure > 0) {
    sentences.push_back(fmt::format("In {} the interval of the exponent reaches into another class.", count(unsure, "run")));
  }
  return sentences;
}

std::vector<std::string> polhode_sentences(const StudyView& study) {
  std::set<std::string> phase, both;
  for (const RunRecord& run : study.runs) {
    const RunResult& r = run.result;
    if (!completed(run) || !r.polhode_off_error_max_rel || !r.polhode_phase_error_max_rad) continue;
    const double level = 10 * round_off_level(run);
    if (*r.polhode_phase_error_max_rad <= level && *r.polhode_off_error_max_rel <= level) continue;
    (*r.polhode_off_error_max_rel <= level ? phase : both).insert(run.config.integrator);
  }
  for (const std::string& method : both) phase.erase(method);
  std::vector<std::string> sentences;
  if (!phase.empty()) {
    sentences.push_back(fmt::format(
        "The error of {} in the body is one of phase alone: the momentum stays on its polhode and is early or late there.",
        some(phase)));
  }
  if (!both.empty()) {
    sentences.push_back(fmt::format("{} {} the polhode too, since energy or |L| change.", some(both),
                                    both.size() == 1 ? "leaves" : "leave"));
  }
  return sentences;
}

}  // namespace polhode::study::report
