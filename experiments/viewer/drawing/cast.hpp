// SPDX-License-Identifier: BSD-3-Clause
// The moving bodies of a scene, in the order in which frames have them.
#pragma once

#include <vector>

#include "experiments/scene/scene.hpp"

namespace polhode::viewer::inline drawing {

struct Cast {
  std::vector<std::size_t> moving;  ///< among Scene::bodies, ascending
  std::vector<double> radius;       ///< m, of each: of the ball about the mass centre that holds its surface; never 0
  double typical_radius = 1;        ///< m, their median
};

Cast cast_of(const study::Scene& scene);

}  // namespace polhode::viewer
