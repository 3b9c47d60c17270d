// SPDX-License-Identifier: BSD-3-Clause
// The moving bodies of a scene, in the order of the frames.
#pragma once

#include <vector>

#include "experiments/study/scene/scene.hpp"

namespace polhode::viewer::inline drawing {

struct Cast {
  std::vector<std::size_t> moving;  ///< indices into Scene::bodies, ascending
  std::vector<double> radius;       ///< m, by body: radius about the mass centre that contains its surface; never 0
  double typical_radius = 1;        ///< m, their median
  double joint_size = 1;            ///< m, that, or half the longest distance at the start between the ends of a joint
};

Cast cast_of(const study::Scene& scene);

}  // namespace polhode::viewer::drawing
