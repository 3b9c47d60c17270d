// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/stage/show.hpp"

namespace polhode::viewer::inline stage {

void show(const Shown& shown, Stage& stage) {
  stage.look.axes = shown.axes;
  stage.look.angular_velocity = shown.angular_velocity;
  stage.look.angular_momentum = shown.angular_momentum;
  stage.look.polhode = shown.polhode || shown.poinsot;
  stage.look.poinsot = shown.poinsot;
  stage.look.contacts = shown.contacts;
  stage.look.joints = shown.joints;
  stage.look.reactions = shown.reactions;
  stage.trails = shown.trails;
  stage.cells = shown.cells;
}

}  // namespace polhode::viewer::stage
