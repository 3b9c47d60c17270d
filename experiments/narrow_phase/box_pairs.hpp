// SPDX-License-Identifier: BSD-3-Clause
// Random and degenerate pairs of boxes, deterministic for a seed: size ratios up to 1e4, scales from 1e-3 to 1e3 m.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "collision/narrow/box_sat.hpp"
#include "core/math/portable_random.hpp"

namespace polhode::study::narrow_phase {

/// A box as given by a user.
struct TurnedBox {
  Vector3<double> half, position;  ///< m
  Quaternion<double> orientation;  ///< any length

  PosedBox posed() const { return {half, {position, rotation_matrix<double>(orientation)}}; }
};

inline const std::vector<std::string>& box_pair_classes() {
  static const std::vector<std::string> names = {"random",           "face to face",   "edge to edge", "parallel edges",
                                                 "vertex to vertex", "vertex to face", "nested",       "far apart"};
  return names;
}

struct BoxPairCase {
  std::string what;
  TurnedBox a, b;
};

/// Makes pair number k of a sequence; its class is k modulo the number of classes.
class BoxPairs {
 public:
  explicit BoxPairs(std::uint64_t seed) : seed_(seed) {}

  BoxPairCase operator()(std::uint64_t k) {
    random_ = PortableRandom(seed_ * 0x9e3779b97f4a7c15u + k);
    const std::size_t kind = k % box_pair_classes().size();
    const double scale = random_.power_of_ten(-3, 3);
    Vector3<double> half_a = scale * sides(),
                    half_b = scale * sides() * (chance(0.5) ? 1 : random_.power_of_ten(-4, 0));
    if (chance(0.5)) std::swap(half_a, half_b);
    Quaternion<double> turn = random_.turn();
    Vector3<double> offset = Vector3<double>::Zero();
    const double gap = tiny() * std::min(half_a.minCoeff(), half_b.minCoeff());
    switch (kind) {
      case 0: offset = along_a_line(half_a, half_b, turn, random_.direction(), 0) * uniform(0, 1.5); break;
      case 1: {
        turn = product(about(0, chance(0.3) ? 0 : random_.angle()), cube_turn());
        if (chance(0.3)) turn = product(almost_none(), turn);
        offset = along_a_line(half_a, half_b, turn, Vector3<double>::UnitX(), gap);
        for (int i = 1; i < 3; ++i) offset[i] = uniform(-1, 1) * std::max(half_a[i], half_b.maxCoeff());
        break;
      }
      case 2: {
        const Matrix3<double> r = rotation_matrix<double>(turn);
        const int i = random_.below(3), j = random_.below(3);
        Vector3<double> n = Vector3<double>::Unit(i).cross(r.col(j)).normalized();
        if (chance(0.5)) n = -n;
        Vector3<double> a = furthest(half_a, n), b = furthest(half_b, -(r.transpose() * n));
        a[i] *= uniform(-1, 1);
        b[j] *= uniform(-1, 1);
        offset = a - r * b + gap * n;
        break;
      }
      case 3: {
        turn = product(almost_none(), product(about(2, random_.angle()), cube_turn()));
        Vector3<double> n = random_.direction();
        n[2] = 0;
        n.normalize();
        const Matrix3<double> r = rotation_matrix<double>(turn);
        offset = furthest(half_a, n) - r * furthest(half_b, -(r.transpose() * n)) + gap * n;
        if (chance(0.7)) offset[2] = uniform(-1, 1) * (half_a[2] + half_b.maxCoeff());
        break;
      }
      case 4: {
        if (chance(0.3)) turn = product(almost_none(), cube_turn());
        const Vector3<double> n = random_.direction();
        const Matrix3<double> r = rotation_matrix<double>(turn);
        offset = furthest(half_a, n) - r * furthest(half_b, -(r.transpose() * n)) + gap * n;
        break;
      }
      case 5: {
        const Matrix3<double> r = rotation_matrix<double>(turn);
        const Vector3<double> n = Vector3<double>::Unit(random_.below(3));
        Vector3<double> on_face = half_a.cwiseProduct(random_.uniform_vector(-1, 1));
        on_face = on_face - on_face.dot(n) * n + half_a.dot(n) * n;
        offset = on_face - r * furthest(half_b, -(r.transpose() * n)) + gap * n;
        break;
      }
      case 6:
        half_b = half_b.cwiseMin(0.5 * half_a.minCoeff());
        if (chance(0.3)) turn = cube_turn();
        if (chance(0.7)) offset = 0.4 * half_a.cwiseProduct(random_.direction());
        break;
      default: offset = along_a_line(half_a, half_b, turn, random_.direction(), 0) * uniform(1, 10); break;
    }
    return posed(box_pair_classes()[kind], half_a, half_b, turn, offset, scale);
  }

 private:
  double uniform(double low, double high) { return random_.uniform(low, high); }
  bool chance(double p) { return random_.chance(p); }
  double tiny() { return chance(0.2) ? 0 : (chance(0.5) ? 1 : -1) * random_.power_of_ten(-16, 0); }
  Vector3<double> sides() {
    if (chance(0.3)) return Vector3<double>::Ones();
    const double x = random_.power_of_ten(-0.5, 0.5), y = random_.power_of_ten(-0.5, 0.5);
    return {x, y, random_.power_of_ten(-0.5, 0.5)};
  }
  static Quaternion<double> about(int axis, double angle) {
    Quaternion<double> q(std::cos(angle / 2), 0, 0, 0);
    q[axis + 1] = std::sin(angle / 2);
    return q;
  }
  /// A random rotation of the symmetry group of the cube, as an exact quaternion, not normalized.
  Quaternion<double> cube_turn() {
    Quaternion<double> q(1, 0, 0, 0);
    for (int k = 0; k < 3; ++k) {
      Quaternion<double> quarter(1, 0, 0, 0);
      quarter[1 + random_.below(3)] = chance(0.5) ? 1 : chance(0.5) ? -1 : 0;
      q = product(q, quarter);
    }
    return q;
  }
  Quaternion<double> almost_none() {
    return quaternion_from_rotation_vector<double>(random_.direction() *
                                                   (chance(0.3) ? 0 : random_.power_of_ten(-17, 0)));
  }
  static Vector3<double> furthest(const Vector3<double>& half, const Vector3<double>& n) {
    return {std::copysign(half[0], n[0]), std::copysign(half[1], n[1]), std::copysign(half[2], n[2])};
  }
  /// Offset along n at which the projections of the boxes on n are a distance `gap` apart.
  static Vector3<double> along_a_line(const Vector3<double>& half_a, const Vector3<double>& half_b,
                                      const Quaternion<double>& turn, const Vector3<double>& n, double gap) {
    const Vector3<double> in_b = rotation_matrix<double>(turn).transpose() * n;
    return n * (half_a.dot(n.cwiseAbs()) + half_b.dot(in_b.cwiseAbs()) + gap);
  }
  /// The pair in the world frame. A third of the pairs stay in A's frame, in which degenerate positions are exact.
  BoxPairCase posed(const std::string& what, const Vector3<double>& half_a, const Vector3<double>& half_b,
                    const Quaternion<double>& turn, const Vector3<double>& offset, double scale) {
    if (chance(0.33)) return {what, {half_a, Vector3<double>::Zero(), {1, 0, 0, 0}}, {half_b, offset, turn}};
    const Quaternion<double> q = chance(0.3) ? cube_turn() : random_.turn();
    const Vector3<double> p = scale * uniform(0, 2) * random_.direction();
    return {what, {half_a, p, q}, {half_b, p + rotation_matrix<double>(q) * offset, product(q, turn)}};
  }

  std::uint64_t seed_;
  PortableRandom random_{0};
};

}  // namespace polhode::study::narrow_phase
