// SPDX-License-Identifier: BSD-3-Clause
// A feature of A and one of B are laid against each other, a gap between them that is often tiny or none; then both
// hulls may be moved rigidly, which rounds what was degenerate exactly.
#include "tests/collision/narrow/hull_pairs.hpp"

#include "core/math/portable_random.hpp"

namespace polhode {
namespace hull_pairs {
namespace {

using Vector = Vector3<double>;
using Points = std::vector<Vector>;

Points on_a_sphere(PortableRandom& random, int n) {
  Points points;
  for (int i = 0; i < n; ++i) points.push_back(random.direction());
  return points;
}

/// Many on a plane and on a line, some twice, and many edges parallel.
Points of_a_lattice(PortableRandom& random, int n) {
  const int width = 2 + random.below(6);
  Points points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  while (int(points.size()) < n) points.emplace_back(random.below(width), random.below(width), random.below(width));
  return points;
}

/// Two regular polygons, of which the upper may be smaller: a prism or a frustum.
Points of_a_prism(PortableRandom& random, int n) {
  const int corners = std::max(3, n / 2);
  const double taper = random.chance(0.5) ? 1 : random.uniform(0.1, 1), height = random.power_of_ten(-1, 0.5);
  Points points;
  for (int side = 0; side < 2; ++side) {
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * std::numbers::pi * i / corners, radius = side == 0 ? 1 : taper;
      points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), side * height);
    }
  }
  return points;
}

Points of_a_box(PortableRandom& random) {
  Points points;
  const Vector half(1, random.chance(0.5) ? 1 : random.power_of_ten(-1, 1),
                    random.chance(0.5) ? 1 : random.power_of_ten(-1, 1));
  for (int k = 0; k < 8; ++k)
    points.push_back(half.cwiseProduct(Vector(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1)));
  return points;
}

Points of_an_octahedron() { return {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}; }

int any_number(PortableRandom& random) { return int(std::lround(std::exp2(random.uniform(2, 7)))); }

Points of_any_kind(PortableRandom& random) {
  const int n = any_number(random);
  Points points;
  switch (random.below(7)) {
    case 0: points = of_a_lattice(random, n); break;
    case 1: points = of_a_prism(random, n); break;
    case 2: points = of_a_box(random); break;
    case 3: points = of_an_octahedron(); break;
    case 4:
      points = on_a_sphere(random, n);  // some are moved inside
      for (Vector& p : points) p *= random.chance(0.5) ? 1 : random.uniform(0.5, 1);
      break;
    default: points = on_a_sphere(random, n); break;
  }
  if (random.chance(0.2)) {
    const Vector sizes(1, random.power_of_ten(-2, 0), random.power_of_ten(-2, 0));
    for (Vector& p : points) p = p.cwiseProduct(sizes);
  }
  return points;
}

/// A vertex, an edge or a face: a point within it, the outward direction, and the direction of an edge of it.
struct Feature {
  Vector point, out, along;
};

enum class Part { vertex, edge, face };

Feature feature(PortableRandom& random, const Polytope& p, Part part) {
  const auto any = [&](std::size_t count) { return std::uint32_t(random.below(int(count))); };
  const auto along = [&](const Polytope::Edge& e) -> Vector {
    return (p.vertices[e.to] - p.vertices[e.from]).normalized();
  };
  if (part == Part::face) {
    const std::uint32_t face = any(p.faces.size());
    const auto corners = p.corners_of(face);
    Vector middle = Vector::Zero();
    double weights = 0;
    for (const auto& corner : corners) {
      const double weight = random.uniform(0, 1);
      middle += weight * p.vertices[corner.vertex];
      weights += weight;
    }
    return {random.chance(0.3) ? p.vertices[corners[0].vertex] : Vector(middle / weights), p.faces[face].normal,
            along(p.edges[corners[0].edge])};
  }
  if (part == Part::edge) {
    const auto& e = p.edges[any(p.edges.size())];
    const double share = random.uniform(0, 1);
    const double left = random.uniform(0, 1);
    return {(1 - share) * p.vertices[e.from] + share * p.vertices[e.to],
            (left * p.faces[e.left].normal + (1 - left) * p.faces[e.right].normal).normalized(), along(e)};
  }
  const std::uint32_t vertex = any(p.vertices.size());
  Vector out = Vector::Zero();
  for (const std::uint32_t face : p.faces_of(vertex)) out += random.uniform(0.1, 1) * p.faces[face].normal;
  return {p.vertices[vertex], out.normalized(),
          (p.vertices[p.neighbours_of(vertex)[0]] - p.vertices[vertex]).normalized()};
}

Quaternion<double> about(const Vector& axis, double angle) {
  return quaternion_from_rotation_vector<double>(axis * angle);
}

/// A turn by no more than the angle of a rounding error, or none.
Quaternion<double> almost_none(PortableRandom& random) {
  return random.chance(0.5) ? Quaternion<double>(1, 0, 0, 0) : about(random.direction(), random.power_of_ten(-17, 0));
}

/// One of the turns that take a cube to itself, not normalized and so exact.
Quaternion<double> of_a_cube(PortableRandom& random) {
  Quaternion<double> q(1, 0, 0, 0);
  for (int k = 0; k < 3; ++k) {
    Quaternion<double> quarter(1, 0, 0, 0);
    quarter[1 + random.below(3)] = random.below(3) - 1;
    q = product(q, quarter);
  }
  return q;
}

/// The turn that faces y to x, their edges parallel or at any angle.
Quaternion<double> facing(PortableRandom& random, const Feature& x, const Feature& y, bool parallel) {
  const Eigen::Quaterniond there = Eigen::Quaterniond::FromTwoVectors(y.out, -x.out);
  double angle = random.angle();
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

HullPairCase pair_of(std::uint64_t seed, std::uint64_t k) {
  PortableRandom random(seed * 0x9e3779b97f4a7c15u + k);
  const std::size_t kind = k % hull_pair_classes().size();
  HullPairCase pair;
  pair.what = hull_pair_classes()[kind];
  Quaternion<double> turn(1, 0, 0, 0);  // turn of B
  // The scale is a power of two, so that a lattice stays one.
  const double scale = std::exp2(std::round(random.uniform(-10, 10))),
               ratio = random.chance(0.5) ? 1 : random.power_of_ten(-4, 0);
  pair.points_a = of_any_kind(random);
  pair.points_b = of_any_kind(random);
  const bool first = random.chance(0.5);
  for (Vector& p : pair.points_a) p *= scale * (first ? ratio : 1);
  for (Vector& p : pair.points_b) p *= scale * (first ? 1 : ratio);
  if (pair.what == "shared face" || pair.what == "coincident") pair.points_b = pair.points_a;
  if (pair.what == "on a lattice") {
    pair.points_a = of_a_lattice(random, any_number(random));
    pair.points_b = random.chance(0.2) ? of_an_octahedron() : of_a_lattice(random, any_number(random));
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
  const double gap = random.chance(0.2) ? 0 : (random.chance(0.5) ? 1 : -1) * random.power_of_ten(-16, 0) * smaller;
  const auto meet = [&](Part of_a, Part of_b, bool parallel, double distance) {
    const Feature x = feature(random, a, of_a), y = feature(random, b, of_b);
    turn = product(facing(random, x, y, parallel), almost_none(random));
    pair.at_b.position = x.point - rotation_matrix<double>(turn) * y.point + distance * x.out;
  };
  const bool aligned = random.chance(0.3);
  switch (kind) {
    case 0:
      turn = random.turn();
      pair.at_b.position =
          random.uniform(0, 1.5) * (half_size(pair.points_a) + half_size(pair.points_b)) * random.direction();
      break;
    case 1: meet(Part::face, Part::face, aligned, gap); break;
    case 2: meet(Part::edge, Part::edge, false, gap); break;
    case 3: meet(Part::edge, Part::edge, true, gap); break;
    case 4:
      random.chance(0.5) ? meet(Part::vertex, Part::face, aligned, gap) : meet(Part::face, Part::vertex, aligned, gap);
      break;
    case 5: meet(Part::vertex, Part::vertex, aligned, gap); break;
    case 6:
      random.chance(0.5) ? meet(Part::edge, Part::face, aligned, gap) : meet(Part::face, Part::edge, aligned, gap);
      break;
    case 7: {  // the same hull half a turn about an axis in the face, and back onto it
      const auto& face = a.faces[std::size_t(random.below(int(a.faces.size())))];
      const Vector on_face = a.vertices[a.corners[face.first].vertex],
                   other = a.vertices[a.corners[face.first + 1].vertex];
      const Vector axis = (other - on_face).normalized();
      turn = {0, axis[0], axis[1], axis[2]};
      pair.at_b.position = on_face - rotation_matrix<double>(turn) * on_face + gap * face.normal;
      break;
    }
    case 8: {  // without a rounding, often in touch
      turn = of_a_cube(random);
      const Vector n = Vector::Unit(random.below(3));
      const double reach =
          n.dot(pair.a->support(n)) - n.dot(pair.b->bounds({Vector::Zero(), rotation_matrix<double>(turn)}).min());
      for (int i = 0; i < 3; ++i) pair.at_b.position[i] = scale * (random.below(5) - 2);
      pair.at_b.position +=
          (reach + (random.chance(0.5) ? 0 : scale * (random.below(5) - 3)) - n.dot(pair.at_b.position)) * n;
      break;
    }
    case 9: {
      turn = random.chance(0.3) ? of_a_cube(random) : random.turn();
      const Vector inside =
          a.vertices[0] + random.uniform(0.3, 1) * (pair.a->mass_properties().centroid - a.vertices[0]);
      pair.at_b.position = inside - rotation_matrix<double>(turn) * pair.b->mass_properties().centroid;
      break;
    }
    case 10:
      if (random.chance(0.5)) turn = almost_none(random);
      if (random.chance(0.5)) pair.at_b.position = gap * random.direction();
      break;
    default:
      turn = random.turn();
      pair.at_b.position =
          random.uniform(2, 20) * (half_size(pair.points_a) + half_size(pair.points_b)) * random.direction();
      break;
  }
  pair.at_b.rotation = rotation_matrix<double>(turn);
  if (kind == 8 || random.chance(0.3)) return pair;
  const Quaternion<double> both = random.chance(0.3) ? of_a_cube(random) : random.turn();
  pair.at_a = {2 * scale * random.uniform(0, 1) * random.direction(), rotation_matrix<double>(both)};
  pair.at_b = {pair.at_a.to_world(pair.at_b.position), rotation_matrix<double>(product(both, turn))};
  return pair;
}

}  // namespace
}  // namespace hull_pairs

const std::vector<std::string>& hull_pair_classes() {
  static const std::vector<std::string> names = {"random",         "face to face",     "edge to edge", "parallel edges",
                                                 "vertex to face", "vertex to vertex", "edge to face", "shared face",
                                                 "on a lattice",   "nested",           "coincident",   "far apart"};
  return names;
}

HullPairCase hull_pair_case(std::uint64_t seed, std::uint64_t k) { return hull_pairs::pair_of(seed, k); }

}  // namespace polhode
