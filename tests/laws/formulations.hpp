// SPDX-License-Identifier: BSD-3-Clause
// Every formulation of the mechanics, with a name, for laws that must hold in each of them.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "core/system/formulation.hpp"

namespace polhode::laws {

/// The formulations that make sense: 2 charts × 3 angular states × gyroscopic on/off (always on with the momentum) ×
/// rotation_from (read by the quaternion chart only). Fifteen in all.
inline std::vector<Formulation> all_formulations() {
  using enum Orientation;
  using enum AngularState;
  std::vector<Formulation> all;
  for (const Orientation orientation : {quaternion, matrix}) {
    for (const AngularState angular_state : {velocity_world, velocity_body, momentum_world}) {
      for (const bool gyroscopic : {true, false}) {
        if (!gyroscopic && angular_state == momentum_world) continue;
        for (const RotationFrom from : {RotationFrom::normalized, RotationFrom::stored}) {
          if (orientation == matrix && from == RotationFrom::stored) continue;
          all.push_back({orientation, angular_state, gyroscopic, from});
        }
      }
    }
  }
  return all;
}

/// Those that give the true motion of a body that is not isotropic: nine.
inline std::vector<Formulation> gyroscopic_formulations() {
  std::vector<Formulation> all = all_formulations();
  std::erase_if(all, [](const Formulation& f) { return !f.gyroscopic; });
  return all;
}

/// "quaternion_velocity_world_stored_no_gyroscopic": letters and underscores, as GoogleTest requires of names.
inline std::string label(const Formulation& f) {
  std::string text = std::string(name(f.orientation)) + '_' + std::string(name(f.angular_state));
  if (f.rotation_from == RotationFrom::stored) text += "_stored";
  if (!f.gyroscopic) text += "_no_gyroscopic";
  return text;
}

}  // namespace polhode::laws

namespace polhode {

/// The form in which GoogleTest prints one.
inline void PrintTo(const Formulation& f, std::ostream* out) { *out << laws::label(f); }

}  // namespace polhode
