// SPDX-License-Identifier: BSD-3-Clause
// The marks that a stage shows at first.
#pragma once

#include <optional>

#include "experiments/viewer/stage/stage.hpp"

namespace polhode::viewer::inline stage {

/// Initial choices of the view.
struct Shown {
  bool axes = false, angular_velocity = false, angular_momentum = false, trails = true, polhode = false,
       poinsot = false, contacts = true, cells = false, joints = true, reactions = true;
  std::optional<double> azimuth, elevation;  ///< angles of the camera, rad; absent: those of the scene
  double zoom = 1;                           ///< factor by which the camera is nearer
};
void show(const Shown& shown, Stage& stage);

}  // namespace polhode::viewer::stage
