// SPDX-License-Identifier: BSD-3-Clause
// The drawing of a scenario at its start, as inline SVG: bodies to scale with their axes, ω and v, forces, springs,
// floors.
#pragma once

#include <string>

#include "experiments/study/scenario/scenario.hpp"

namespace polhode::study::inline report::inline drawing {

struct ScenarioDrawing {
  std::string svg;      ///< an element <svg>, with a text in its place for who cannot see it
  std::string reading;  ///< meaning of its arrows, numbers and lines
};

/// Empty texts for a scenario without bodies.
ScenarioDrawing drawing_of(const Scenario& scenario);

}  // namespace polhode::study::report::drawing
