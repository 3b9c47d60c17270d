// SPDX-License-Identifier: BSD-3-Clause
// Where a scene is first seen from.
#pragma once

#include <span>

#include "experiments/scene/scene.hpp"
#include "experiments/viewer/drawing/camera.hpp"
#include "experiments/viewer/drawing/look.hpp"
#include "experiments/viewer/frame/frame.hpp"

namespace polhode::viewer::inline drawing {

/// Sees all moving bodies of the frames whole, with the ends of their springs and their pivots, as near as it can in a
/// picture of that shape and the arrows of `look`; half-spaces and fixed bodies do not count. A row of bodies is seen
/// from its side.
Camera default_camera(const study::Scene& scene, std::span<const Frame> frames, double width_over_height,
                      const Look& look = {});

}  // namespace polhode::viewer
