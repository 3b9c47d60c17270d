// SPDX-License-Identifier: BSD-3-Clause
// Random pairs of boxes of one class, the same for a seed.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "collision/narrow/box_sat.hpp"

namespace polhode::study {

/// "random", "face to face", …
const std::vector<std::string>& pair_classes();

class RandomPairs {
 public:
  explicit RandomPairs(std::uint64_t seed) : dice_(seed) {}

  struct Pair {
    PosedBox a, b;
  };
  Pair of_class(std::size_t k);

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(dice_); }
  Vector3<double> direction();
  Matrix3<double> rotation();

 private:
  std::mt19937_64 dice_;
};

}  // namespace polhode::study
