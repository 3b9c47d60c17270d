// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/scenario/narrow_phase_choice.hpp"

#include <set>
#include <stdexcept>

#include "collision/narrow_phase.hpp"

namespace polhode::study::inline scenario {

std::string narrow_phase_refusal(std::string_view narrow_phase, const Scenario& scenario) {
  const auto narrow = find_narrow_phase(narrow_phase)->make();
  const Pose here, above{{0, 0, 1000}, Matrix3<double>::Identity()};
  std::set<std::string_view> kinds;  // the first body of a kind meets all that later ones meet
  for (std::size_t a = 0; a < scenario.problem.moving(); ++a) {
    const ShapePointer& of_a = scenario.colliders[a].shape;
    if (!of_a || !kinds.insert(of_a->kind()).second) continue;
    std::set<std::string_view> asked;
    for (std::size_t b = a + 1; b < scenario.colliders.size(); ++b) {
      const ShapePointer& of_b = scenario.colliders[b].shape;
      if (!of_b || !asked.insert(of_b->kind()).second) continue;
      try {
        narrow->distance(*of_a, above, *of_b, here);
      } catch (const std::invalid_argument& error) {
        return error.what();
      }
    }
  }
  return {};
}

std::string narrow_phase_for(const Scenario& scenario) {
  return narrow_phase_refusal("sat", scenario).empty() ? "sat" : "gjk";
}

}  // namespace polhode::study::scenario
