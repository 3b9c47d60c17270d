// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report/findings/drift_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "experiments/study/curves/curves.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::inline report::inline findings {
namespace {

std::string exponent(double p) { return fmt::format("{:.3f}", p); }

/// List of names, shortened if there are many: "rk4, heun and 3 more".
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

std::string growth_words(const RunResult& r) {
  if (r.drift_decided_after)
    return fmt::format("{}, which some {} s would decide", r.drift_class, number(*r.drift_decided_after, 2));
  if (r.drift_class.empty() || !r.drift_exponent || r.drift_class == "bounded") return r.drift_class;
  return fmt::format("{}: p = {}, 95 % between {} and {}", r.drift_class, exponent(*r.drift_exponent),
                     exponent(*r.drift_exponent_low), exponent(*r.drift_exponent_high));
}

std::vector<std::string> growth_sentences(const StudyView& study) {
  struct Found {
    std::size_t runs = 0;
    std::set<std::string> methods;
  };
  std::map<std::string, Found> classes;
  std::vector<double> durations;  // durations that would decide undecided classes, s
  for (const RunRecord& run : study.runs) {
    const RunResult& r = run.result;
    if (r.drift_class.empty()) continue;
    Found& found = classes[r.drift_class];
    ++found.runs;
    found.methods.insert(run.config.integrator);
    if (r.drift_decided_after) durations.push_back(*r.drift_decided_after);
  }
  std::vector<std::string> sentences;
  for (const auto& [name, phrase] :
       {std::pair("bounded", "The energy drift stays bounded in {}: {}."),
        std::pair("random walk", "It grows like a random walk, ∝ √t, in {}: {}."),
        std::pair("sublinear", "It grows one way, more slowly than t, in {}: {}."),
        std::pair("linear", "It grows linearly in {}: {}."),
        std::pair("quadratic", "It grows quadratically in {}: {}."),
        std::pair("faster", "It grows faster than that in {}: {}."),
        std::pair("saturated", "It has come to rest, or is as large as the energy that moves, in {}: {}."),
        std::pair("jumps", "It changes at impacts, and not between them, in {}: {}."),
        std::pair("round-off", "It never leaves round-off in {}: {}."),
        std::pair("undecided", "How it grows cannot be told from {}: {}.")}) {
    const auto found = classes.find(name);
    if (found == classes.end()) continue;
    std::string text = fmt::format(fmt::runtime(phrase), count(found->second.runs, "run"), some(found->second.methods));
    if (sentences.empty()) {
      constexpr std::string_view it = "It ", how = "How it ", drift = "he energy drift ";
      if (text.starts_with(it)) text = fmt::format("T{}{}", drift, text.substr(it.size()));
      if (text.starts_with(how)) text = fmt::format("How t{}{}", drift, text.substr(how.size()));
    }
    sentences.push_back(std::move(text));
  }
  if (durations.empty()) return sentences;
  std::sort(durations.begin(), durations.end());
  const std::string least = number(durations.front(), 2), most = number(durations.back(), 2);
  sentences.push_back(fmt::format(
      "{} would decide {}, by estimate.",
      least == most ? fmt::format("Some {} s", least) : fmt::format("Between {} and {} s", least, most),
      durations.size() == classes["undecided"].runs ? (durations.size() == 1 ? std::string("it") : std::string("them"))
                                                    : fmt::format("{} of them", durations.size())));
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
    sentences.push_back(
        fmt::format("The error of {} in the body is one of phase alone: the momentum stays on its polhode and is early "
                    "or late there.",
                    some(phase)));
  }
  if (!both.empty()) {
    sentences.push_back(fmt::format("{} {} the polhode too, since energy or |L| change.", some(both),
                                    both.size() == 1 ? "leaves" : "leave"));
  }
  return sentences;
}

}  // namespace polhode::study::report::findings
