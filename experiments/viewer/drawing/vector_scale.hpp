// SPDX-License-Identifier: BSD-3-Clause
// The scale of arrows: one for all bodies, constant as long as possible.
#pragma once

#include <cmath>

namespace polhode::viewer::inline drawing {

/// The unit is the first length; it doubles when a length exceeds 1.5 units.
class VectorScale {
 public:
  void see(double length) {
    if (!std::isfinite(length)) return;
    if (unit_ == 0) unit_ = length;
    while (length > 1.5 * unit_) unit_ *= 2;
  }
  /// A length in units; 0 before the first length.
  double share(double length) const { return unit_ > 0 ? length / unit_ : 0; }

 private:
  double unit_ = 0;
};

}  // namespace polhode::viewer::drawing
