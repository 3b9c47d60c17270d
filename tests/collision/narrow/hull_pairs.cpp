// SPDX-License-Identifier: BSD-3-Clause
// A feature of A and one of B are laid against each other, a gap between them that is often tiny or none; then both
// hulls may be moved rigidly, which rounds what was degenerate exactly.
#include "tests/collision/narrow/hull_pairs.hpp"

#include "core/math/portable_random.hpp"

namespace polhode {
namespace {

using study::Dice;
using Vector = Vector3<double>;
using Points = std::vector<Vector>;

Points on_a_sphere(Dice& dice, int n) {
  Points points;
  for (int i = 0; i < n; ++i) points.push_back(dice.direction());
  return points;
}

/// Many on a plane and on a line, some twice, and many edges parallel.
Points of_a_lattice(Dice& dice, int n) {
  const int width = 2 + dice.below(6);
  Points points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  while (int(points.size()) < n) points.emplace_back(dice.below(width), dice.below(width), dice.below(width));
  return points;
}

/// Two regular polygons, of which the upper may be smaller: a prism or a frustum.
Points of_a_prism(Dice& dice, int n) {
  const int corners = std::max(3, n / 2);
  const double taper = dice.chance(0.5) ? 1 : dice.uniform(0.1, 1), height = dice.power_of_ten(-1, 0.5);
  Points points;
  for (int side = 0; side < 2; ++side) {
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * std::numbers::pi * i / corners, radius = side == 0 ? 1 : taper;
      points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), side * height);
    }
  }
  return points;
}

Points of_a_box(Dice& dice) {
  Points points;
  const Vector half(1, dice.chance(0.5) ? 1 : dice.power_of_ten(-1, 1),
                    dice.chance(0.5) ? 1 : dice.power_of_ten(-1, 1));
  for (int k = 0; k < 8; ++k)
    points.push_back(half.cwiseProduct(Vector(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1)));
  return points;
}

Points of_an_octahedron() { return {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}; }

int any_number(Dice& dice) { return int(std::lround(std::exp2(dice.uniform(2, 7)))); }

Points of_any_kind(Dice& dice) {
  const int n = any_number(dice);
  Points points;
  switch (dice.below(7)) {
    case 0: points = of_a_lattice(dice, n); break;
    case 1: points = of_a_prism(dice, n); break;
    case 2: points = of_a_box(dice); break;
    case 3: points = of_an_octahedron(); break;
    case 4:
      points = on_a_sphere(dice, n);  // with some inside
      for (Vector& p : points) p *= dice.chance(0.5) ? 1 : dice.uniform(0.5, 1);
      break;
    default: points = on_a_sphere(dice, n); break;
  }
  if (dice.chance(0.2)) {
    const Vector sizes(1, dice.power_of_ten(-2, 0), dice.power_of_ten(-2, 0));
    for (Vector& p : points) p = p.cwiseProduct(sizes);
  }
  return points;
}

/// A vertex, an edge or a face: a point within it, the outward direction, and the direction of an edge of it.
struct Feature {
  Vector point, out, along;
};

enum class Part { vertex, edge, face };

Feature feature(Dice& dice, const Polytope& p, Part part) {
  const auto any = [&](std::size_t count) { return std::uint32_t(dice.below(int(count))); };
  const auto along = [&](const Polytope::Edge& e) -> Vector {
    return (p.vertices[e.to] - p.vertices[e.from]).normalized();
  };
  if (part == Part::face) {
    const std::uint32_t face = any(p.faces.size());
    const auto corners = p.corners_of(face);
    Vector middle = Vector::Zero();
    double weights = 0;
    for (const auto& corner : corners) {
      const double weight = dice.uniform(0, 1);
      middle += weight * p.vertices[corner.vertex];
      weights += weight;
    }
    return {dice.chance(0.3) ? p.vertices[corners[0].vertex] : Vector(middle / weights), p.faces[face].normal,
            along(p.edges[corners[0].edge])};
  }
  if (part == Part::edge) {
    const auto& e = p.edges[any(p.edges.size())];
    const double share = dice.uniform(0, 1);
    const double left = dice.uniform(0, 1);
    return {(1 - share) * p.vertices[e.from] + share * p.vertices[e.to],
            (left * p.faces[e.left].normal + (1 - left) * p.faces[e.right].normal).normalized(), along(e)};
  }
  const std::uint32_t vertex = any(p.vertices.size());
  Vector out = Vector::Zero();
  for (const std::uint32_t face : p.faces_of(vertex)) out += dice.uniform(0.1, 1) * p.faces[face].normal;
  return {p.vertices[vertex], out.normalized(),
          (p.vertices[p.neighbours_of(vertex)[0]] - p.vertices[vertex]).normalized()};
}

Quaternion<double> about(const Vector& axis, double angle) {
  return quaternion_from_rotation_vector<double>(axis * angle);
}

/// By no more than the angle of a rounding error, or by none.
Quaternion<double> almost_none(Dice& dice) {
  return dice.chance(0.5) ? Quaternion<double>(1, 0, 0, 0) : about(dice.direction(), dice.power_of_ten(-17, 0));
}

/// One of the turns that take a cube to itself, not normalised and so exact.
Quaternion<double> of_a_cube(Dice& dice) {
  Quaternion<double> q(1, 0, 0, 0);
  for (int k = 0; k < 3; ++k) {
    Quaternion<double> quarter(1, 0, 0, 0);
    quarter[1 + dice.below(3)] = dice.below(3) - 1;
    q = product(q, quarter);
  }
  return q;
}

/// The turn that faces y to x, their edges parallel or at any angle.
Quaternion<double> facing(Dice& dice, const Feature& x, const Feature& y, bool parallel) {
  const Eigen::Quaterniond there = Eigen::Quaterniond::FromTwoVectors(y.out, -x.out);
  double angle = dice.angle();
  if (parallel) {
    const Vector turned = there * y.along;
    angle = std::atan2(turned.cross(x.along).dot(x.out), turned.dot(x.along));
  }
  return product(about(x.out, angle), Quaternion<double>(there.w(), there.x(), there.y(), there.z()));
}

double half_size(const Points& points) {
  Bounds around;
  for (const Vector& p : points) around.extend(p);
  return 0.5 * around.sizes().maxCoeff();
}

}  // namespace

const std::vector<std::string>& hull_pair_classes() {
  static const std::vector<std::string> names = {"random",         "face to face",     "edge to edge", "parallel edges",
                                                 "vertex to face", "vertex to vertex", "edge to face", "shared face",
                                                 "on a lattice",   "nested",           "coincident",   "far apart"};
  return names;
}

HullPairCase hull_pair_case(std::uint64_t seed, std::uint64_t k) {
  Dice dice(seed * 0x9e3779b97f4a7c15u + k);
  const std::size_t kind = k % hull_pair_classes().size();
  HullPairCase pair;
  pair.what = hull_pair_classes()[kind];
  Quaternion<double> turn(1, 0, 0, 0);  // of B
  // Of a power of two, so that a lattice stays one.
  const double scale = std::exp2(std::round(dice.uniform(-10, 10))),
               ratio = dice.chance(0.5) ? 1 : dice.power_of_ten(-4, 0);
  pair.points_a = of_any_kind(dice);
  pair.points_b = of_any_kind(dice);
  const bool first = dice.chance(0.5);
  for (Vector& p : pair.points_a) p *= scale * (first ? ratio : 1);
  for (Vector& p : pair.points_b) p *= scale * (first ? 1 : ratio);
  if (pair.what == "shared face" || pair.what == "coincident") pair.points_b = pair.points_a;
  if (pair.what == "on a lattice") {
    pair.points_a = of_a_lattice(dice, any_number(dice));
    pair.points_b = dice.chance(0.2) ? of_an_octahedron() : of_a_lattice(dice, any_number(dice));
    for (Points* points : {&pair.points_a, &pair.points_b}) {
      for (Vector& p : *points) p *= scale;
    }
  }
  if (pair.what == "nested") {
    const double shrink = 0.1 * half_size(pair.points_a) / half_size(pair.points_b);
    for (Vector& p : pair.points_b) p *= shrink;
  }
  pair.a = std::make_shared<ConvexHull>(pair.points_a);
  pair.b = std::make_shared<ConvexHull>(pair.points_b);
  const Polytope &a = pair.a->polytope(), &b = pair.b->polytope();
  const double smaller = std::min(half_size(pair.points_a), half_size(pair.points_b));
  const double gap = dice.chance(0.2) ? 0 : (dice.chance(0.5) ? 1 : -1) * dice.power_of_ten(-16, 0) * smaller;
  const auto meet = [&](Part of_a, Part of_b, bool parallel, double distance) {
    const Feature x = feature(dice, a, of_a), y = feature(dice, b, of_b);
    turn = product(facing(dice, x, y, parallel), almost_none(dice));
    pair.at_b.position = x.point - rotation_matrix<double>(turn) * y.point + distance * x.out;
  };
  const bool aligned = dice.chance(0.3);
  switch (kind) {
    case 0:
      turn = dice.turn();
      pair.at_b.position =
          dice.uniform(0, 1.5) * (half_size(pair.points_a) + half_size(pair.points_b)) * dice.direction();
      break;
    case 1: meet(Part::face, Part::face, aligned, gap); break;
    case 2: meet(Part::edge, Part::edge, false, gap); break;
    case 3: meet(Part::edge, Part::edge, true, gap); break;
    case 4:
      dice.chance(0.5) ? meet(Part::vertex, Part::face, aligned, gap) : meet(Part::face, Part::vertex, aligned, gap);
      break;
    case 5: meet(Part::vertex, Part::vertex, aligned, gap); break;
    case 6:
      dice.chance(0.5) ? meet(Part::edge, Part::face, aligned, gap) : meet(Part::face, Part::edge, aligned, gap);
      break;
    case 7: {  // the same hull half a turn about an axis in the face, and back onto it
      const auto& face = a.faces[std::size_t(dice.below(int(a.faces.size())))];
      const Vector on_face = a.vertices[a.corners[face.first].vertex],
                   other = a.vertices[a.corners[face.first + 1].vertex];
      const Vector axis = (other - on_face).normalized();
      turn = {0, axis[0], axis[1], axis[2]};
      pair.at_b.position = on_face - rotation_matrix<double>(turn) * on_face + gap * face.normal;
      break;
    }
    case 8: {  // without a rounding, often in touch
      turn = of_a_cube(dice);
      const Vector n = Vector::Unit(dice.below(3));
      const double reach =
          n.dot(pair.a->support(n)) - n.dot(pair.b->bounds({Vector::Zero(), rotation_matrix<double>(turn)}).min());
      for (int i = 0; i < 3; ++i) pair.at_b.position[i] = scale * (dice.below(5) - 2);
      pair.at_b.position +=
          (reach + (dice.chance(0.5) ? 0 : scale * (dice.below(5) - 3)) - n.dot(pair.at_b.position)) * n;
      break;
    }
    case 9: {
      turn = dice.chance(0.3) ? of_a_cube(dice) : dice.turn();
      const Vector inside = a.vertices[0] + dice.uniform(0.3, 1) * (pair.a->mass_properties().centroid - a.vertices[0]);
      pair.at_b.position = inside - rotation_matrix<double>(turn) * pair.b->mass_properties().centroid;
      break;
    }
    case 10:
      if (dice.chance(0.5)) turn = almost_none(dice);
      if (dice.chance(0.5)) pair.at_b.position = gap * dice.direction();
      break;
    default:
      turn = dice.turn();
      pair.at_b.position =
          dice.uniform(2, 20) * (half_size(pair.points_a) + half_size(pair.points_b)) * dice.direction();
      break;
  }
  pair.at_b.rotation = rotation_matrix<double>(turn);
  if (kind == 8 || dice.chance(0.3)) return pair;
  const Quaternion<double> both = dice.chance(0.3) ? of_a_cube(dice) : dice.turn();
  pair.at_a = {2 * scale * dice.uniform(0, 1) * dice.direction(), rotation_matrix<double>(both)};
  pair.at_b = {pair.at_a.to_world(pair.at_b.position), rotation_matrix<double>(product(both, turn))};
  return pair;
}

}  // namespace polhode
