// SPDX-License-Identifier: BSD-3-Clause
// The initial camera of a scene.
#pragma once

#include <span>

#include "experiments/study/scene/scene.hpp"
#include "experiments/viewer/drawing/camera.hpp"
#include "experiments/viewer/drawing/look.hpp"
#include "experiments/viewer/frame/frame.hpp"

namespace polhode::viewer::inline drawing {

/// The nearest camera from which all moving bodies of the frames are completely visible, with the ends of their
/// springs, their pivots and the arrows of `look`, in a picture of that shape. Half-spaces and fixed bodies do not
/// count. A row of bodies is seen from its side.
Camera default_camera(const study::Scene& scene, std::span<const Frame> frames, double width_over_height,
                      const Look& look = {});

}  // namespace polhode::viewer::drawing
