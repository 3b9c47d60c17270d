// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/narrow_phase/random_pairs.hpp"

#include <cmath>

namespace polhode::study {
namespace {

enum Class : std::size_t { random, face_to_face, edge_to_edge, parallel_edges, vertex_to_vertex, nested, size_ratio };

Vector3<double> furthest(const Vector3<double>& half, const Vector3<double>& n) {
  return {std::copysign(half[0], n[0]), std::copysign(half[1], n[1]), std::copysign(half[2], n[2])};
}

}  // namespace

const std::vector<std::string>& pair_classes() {
  static const std::vector<std::string> names = {"random",           "face to face", "edge to edge",        "parallel edges",
                                                 "vertex to vertex", "nested",       "size ratios to 1e4"};
  return names;
}

Vector3<double> RandomPairs::direction() {
  std::normal_distribution<double> normal;
  const double x = normal(dice_), y = normal(dice_), z = normal(dice_);
  return Vector3<double>(x, y, z).normalized();
}

Matrix3<double> RandomPairs::rotation() {
  std::normal_distribution<double> normal;
  const double w = normal(dice_), x = normal(dice_), y = normal(dice_), z = normal(dice_);
  return rotation_matrix<double>({w, x, y, z});
}

/// B is set so that its shadow on a line touches A's, a gap of some size between; then both are moved rigidly.
RandomPairs::Pair RandomPairs::of_class(std::size_t k) {
  const auto sides = [this] { return Vector3<double>(uniform(0.5, 1.5), uniform(0.5, 1.5), uniform(0.5, 1.5)); };
  Vector3<double> half_a = sides(), half_b = sides();
  Matrix3<double> turn = rotation();
  Vector3<double> n = direction();
  const double gap = (uniform(0, 1) < 0.5 ? -1 : 1) * std::pow(10.0, uniform(-15, -1));
  const auto about_z = [this] {
    const double angle = uniform(-3.2, 3.2);
    return rotation_matrix<double>({std::cos(angle / 2), 0, 0, std::sin(angle / 2)});
  };
  Vector3<double> offset = Vector3<double>::Zero();
  const auto touching = [&]() -> Vector3<double> { return furthest(half_a, n) - turn * furthest(half_b, -(turn.transpose() * n)) + gap * n; };
  switch (k) {
    case random: offset = touching() * uniform(0.2, 1.3); break;
    case face_to_face: {
      turn = about_z();
      n = Vector3<double>::UnitZ();
      offset = Vector3<double>(uniform(-1, 1), uniform(-1, 1), half_a[2] + half_b[2] + gap);
      break;
    }
    case edge_to_edge: {
      n = Vector3<double>::UnitX().cross(turn.col(1)).normalized();
      Vector3<double> a = furthest(half_a, n), b = furthest(half_b, -(turn.transpose() * n));
      a[0] *= uniform(-1, 1);
      b[1] *= uniform(-1, 1);
      offset = a - turn * b + gap * n;
      break;
    }
    case parallel_edges:
      turn = rotation_matrix<double>(quaternion_from_rotation_vector<double>(direction() * std::pow(10.0, uniform(-16, -2)))) * about_z();
      n[2] = 0;
      n.normalize();
      offset = touching();
      break;
    case vertex_to_vertex: offset = touching(); break;
    case nested:
      half_b *= 0.2;
      offset = 0.2 * half_a.cwiseProduct(direction());
      break;
    default:
      half_b *= std::pow(10.0, -uniform(0, 4));
      offset = touching();
      break;
  }
  const Pose motion{2 * direction(), rotation()};
  return {{half_a, motion}, {half_b, {motion.to_world(offset), motion.rotation * turn}}};
}

}  // namespace polhode::study
