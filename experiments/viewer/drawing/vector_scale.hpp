// SPDX-License-Identifier: BSD-3-Clause
// How long arrows are drawn: one scale for all bodies, which stays as it is while it can.
#pragma once

#include <cmath>

namespace polhode::viewer::inline drawing {

/// The first length seen is the unit; it doubles when one more than half as long again comes.
class VectorScale {
 public:
  void see(double length) {
    if (!std::isfinite(length)) return;
    if (unit_ == 0) unit_ = length;
    while (length > 1.5 * unit_) unit_ *= 2;
  }
  /// In units; 0 before anything was seen.
  double share(double length) const { return unit_ > 0 ? length / unit_ : 0; }

 private:
  double unit_ = 0;
};

}  // namespace polhode::viewer
