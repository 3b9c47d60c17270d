// SPDX-License-Identifier: BSD-3-Clause
// The judge of two boxes: their signed distance in whole numbers, so that every sign is right. Only the last division
// and root are rounded, in long double.
#pragma once

#include "experiments/narrow_phase/box_pairs.hpp"

namespace polhode {

/// A box as the numbers say it: the rotation is exactly that of q/|q|.
using ExactBox = study::narrow_phase::TurnedBox;

struct ExactDistance {
  int sign = 0;              ///< exact sign of the signed distance: −1 where the interiors overlap
  long double distance = 0;  ///< signed, to a few units of the last place of long double
};

ExactDistance exact_distance(const ExactBox& a, const ExactBox& b);

}  // namespace polhode
