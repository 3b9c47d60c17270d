// SPDX-License-Identifier: BSD-3-Clause
// The two ways to see a stage: in a window, or as pictures without one.
#pragma once

#include <optional>

#include "experiments/viewer/stage/stage.hpp"

namespace polhode::viewer::inline stage {

/// What is shown at first.
struct Shown {
  bool axes = false, angular_velocity = false, angular_momentum = false, trails = true, polhode = false,
       poinsot = false, contacts = true, cells = false;
  std::optional<double> azimuth, elevation;  ///< rad; absent: as the scene asks for
  double zoom = 1;                           ///< so many times as near
};
void show(const Shown& shown, Stage& stage);

}  // namespace polhode::viewer::stage
