// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/curves/reference_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "experiments/study/text/notation.hpp"

namespace polhode::study::inline curves {
namespace {

/// The uncertainties of references over the runs of a scenario.
struct Uncertain {
  std::optional<double> position, attitude, angular_velocity;
  std::size_t runs = 0, unjudged = 0;
};

void raise(std::optional<double>& worst, const std::optional<double>& x) {
  if (x && !(worst && *worst >= *x)) worst = x;
}

}  // namespace

bool used_reference(const RunRecord& run) {
  const RunResult& r = run.result;
  return r.position_reference || r.attitude_reference || r.angular_velocity_reference_rel;
}

std::vector<std::string> reference_sentences(const StudyView& study) {
  std::map<std::string, Uncertain> scenarios;
  for (const RunRecord& run : study.runs) {
    if (!used_reference(run)) continue;
    const RunResult& r = run.result;
    Uncertain& u = scenarios[run.config.scenario];
    raise(u.position, r.position_reference);
    raise(u.attitude, r.attitude_reference);
    raise(u.angular_velocity, r.angular_velocity_reference_rel);
    ++u.runs;
    const bool judged = (!r.position_reference || r.position_error_max) &&
                        (!r.attitude_reference || r.attitude_error_max) &&
                        (!r.angular_velocity_reference_rel || r.angular_velocity_error_max_rel);
    if (!judged) ++u.unjudged;
  }
  std::vector<std::string> sentences;
  for (const auto& [scenario, u] : scenarios) {
    std::vector<std::string> sizes;
    bool known = true;
    const auto add = [&](const std::optional<double>& x, const char* what) {
      if (!x) return;
      known = known && std::isfinite(*x);
      sizes.push_back(fmt::format("{}{}", number(*x), what));
    };
    add(u.position, " m");
    add(u.attitude, " rad");
    add(u.angular_velocity, " of the angular velocity");
    std::string text = fmt::format(
        "{}: no exact solution is known; in its place stands a reference in extended precision, ", scenario);
    text += known ? fmt::format("which halving its step changed by at most {}", words(sizes))
                  : std::string("which could not follow the motion");
    if (u.unjudged > 0) {
      text += fmt::format(
          "; in {} of {} runs it could not prove digits enough (an error must be 100 times larger), and "
          "errors are left out",
          u.unjudged, u.runs);
    }
    sentences.push_back(text + ".");
  }
  return sentences;
}

}  // namespace polhode::study::curves
