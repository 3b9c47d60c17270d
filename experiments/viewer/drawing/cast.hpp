// SPDX-License-Identifier: BSD-3-Clause
// The moving bodies of a scene, in the order of the frames.
#pragma once

#include <vector>

#include "experiments/study/scene/scene.hpp"

namespace polhode::viewer::inline drawing {

struct Cast {
  std::vector<std::size_t> moving;  ///< indices into Scene::bodies, ascending
  std::vector<double> radius;       ///< radius about the mass centre that contains the body's surface, never 0, m
  double typical_radius = 1;        ///< median of the radii, m
  double joint_size = 1;            ///< median, or half the longest distance at the start between a joint's ends, m
};

Cast cast_of(const study::Scene& scene);

}  // namespace polhode::viewer::drawing
