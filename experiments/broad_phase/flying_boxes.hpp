// SPDX-License-Identifier: BSD-3-Clause
// Boxes with edges from 0.5 to 1 m that move uniformly in a cube and bounce off its walls; deterministic for a seed.
// Their speeds are distributed uniformly from 0 to twice the mean. With the same speed for all, all boxes would leave
// their margins in the broad phase at about the same time, and its work would come in bursts.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "collision/shape.hpp"
#include "core/math/portable_random.hpp"

namespace polhode::study::broad_phase {

class FlyingBoxes {
 public:
  /// filling: volume of the boxes over that of the cube; motion: mean path of a box in a step over the mean edge.
  FlyingBoxes(std::size_t n, double filling, double motion, std::uint64_t seed) : random_(seed), bounds_(n) {
    double volume = 0;
    for (std::size_t i = 0; i < n; ++i) {
      half_.push_back(random_.uniform_vector(0.25, 0.5));
      volume += 8 * half_.back().prod();
    }
    edge_ = std::cbrt(volume / filling);
    for (std::size_t i = 0; i < n; ++i) {
      centre_.push_back(random_.uniform_vector(0, edge_));
      const Vector3<double> way = random_.uniform_vector(-1, 1);
      path_.push_back(way * (random_.uniform(0, 2) * mean_edge * motion / std::max(way.norm(), 1e-3)));
    }
    place();
  }

  void step() {
    for (std::size_t i = 0; i < centre_.size(); ++i) {
      centre_[i] += path_[i];
      for (int k = 0; k < 3; ++k) {
        const bool out = centre_[i][k] < 0 ? path_[i][k] < 0 : centre_[i][k] > edge_ && path_[i][k] > 0;
        if (out) path_[i][k] = -path_[i][k];
      }
    }
    place();
  }

  const std::vector<Bounds>& bounds() const { return bounds_; }
  const std::vector<Vector3<double>>& half() const { return half_; }
  const std::vector<Vector3<double>>& centre() const { return centre_; }

 private:
  static constexpr double mean_edge = 0.75;

  void place() {
    for (std::size_t i = 0; i < centre_.size(); ++i) bounds_[i] = Bounds(centre_[i] - half_[i], centre_[i] + half_[i]);
  }

  PortableRandom random_;
  double edge_ = 0;
  std::vector<Vector3<double>> half_, centre_, path_;
  std::vector<Bounds> bounds_;
};

}  // namespace polhode::study::broad_phase
