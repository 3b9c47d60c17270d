// SPDX-License-Identifier: BSD-3-Clause
#include "collision/shapes/convex_hull.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "collision/shapes/obj_mesh.hpp"
#include "collision/shapes/polyhedron_mass.hpp"
#include "collision/shapes/qhull_faces.hpp"
#include "collision/shapes/shape_catalogue.hpp"
#include "collision/shapes/size_checks.hpp"

namespace polhode::inline collision::inline shapes {

namespace {

constexpr double flat = 1e-10;           // thickness of a flat hull, over the spread
constexpr std::size_t scan_limit = 256;  // vertices; with more of them climbing is faster than visiting all

/// f over all lanes, halves against halves.
template <class F>
double tree(const Lanes& lanes, const F& f) {
  std::array<double, lane_count> x;
  for (int i = 0; i < lane_count; ++i) x[std::size_t(i)] = lanes[i];
  for (std::size_t half = lane_count / 2; half > 0; half /= 2) {
    for (std::size_t i = 0; i < half; ++i) x[i] = f(x[i], x[i + half]);
  }
  return x[0];
}

Lanes lane_numbers() {
  Lanes numbers;
  for (int i = 0; i < lane_count; ++i) numbers.set(i, i);
  return numbers;
}

/// The number of the point for which f is largest, the first of equals.
template <class F>
std::size_t furthest(std::span<const Vector3<double>> points, const F& f) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (f(points[i]) > f(points[best])) best = i;
  }
  return best;
}

/// The points about the middle of their bounds, in units of their largest size; refuses what has no hull.
std::vector<Vector3<double>> normalized(std::span<const Vector3<double>> points) {
  if (points.size() < 4) {
    throw std::invalid_argument("a convex_hull needs at least 4 points, not " + std::to_string(points.size()));
  }
  Bounds around;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite())
      throw std::invalid_argument("point " + std::to_string(i) + " of a convex_hull is not finite");
    around.extend(points[i]);
  }
  const Vector3<double> middle = around.min() + 0.5 * around.sizes();
  const double unit = around.sizes().maxCoeff();
  if (unit > largest_size || middle.cwiseAbs().maxCoeff() > largest_size) {
    throw std::invalid_argument("the points of a convex_hull are further than 1e50 m apart or from the origin");
  }
  if (unit < smallest_size) throw std::invalid_argument("the points of a convex_hull are all the same, to 1e-50 m");
  std::vector<Vector3<double>> x;
  for (const Vector3<double>& p : points) x.push_back((p - middle) / unit);

  const Vector3<double> a = x[furthest(x, [](const auto& p) { return p.squaredNorm(); })];
  const Vector3<double> b = x[furthest(x, [&](const auto& p) { return (p - a).squaredNorm(); })];
  const Vector3<double> along = (b - a).normalized();
  const auto off_line = [&](const Vector3<double>& p) { return (p - a).cross(along).norm(); };
  const Vector3<double> c = x[furthest(x, off_line)];
  const char* const remedy = "; give points that enclose a volume";
  if (off_line(c) <= flat)
    throw std::invalid_argument(std::string("the points of a convex_hull lie on a line") + remedy);
  const Vector3<double> normal = along.cross(c - a).normalized();
  const auto off_plane = [&](const Vector3<double>& p) { return std::abs((p - a).dot(normal)); };
  const double height = off_plane(x[furthest(x, off_plane)]);
  if (height <= flat) {
    throw std::invalid_argument("the points of a convex_hull are coplanar: none is more than " +
                                in_words(height * unit) + " m off their plane" + remedy);
  }
  return x;
}

/// The hull's faces on its own vertices, which keep the order of the points.
Polytope hull_polytope(std::span<const Vector3<double>> points, std::vector<std::vector<std::uint32_t>> loops) {
  std::vector<std::uint32_t> used;
  for (const auto& loop : loops) used.insert(used.end(), loop.begin(), loop.end());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  std::vector<Vector3<double>> vertices;
  for (const std::uint32_t i : used) vertices.push_back(points[i]);
  for (auto& loop : loops) {
    for (std::uint32_t& i : loop) i = std::uint32_t(std::lower_bound(used.begin(), used.end(), i) - used.begin());
  }
  return make_polytope(std::move(vertices), loops);
}

Polytope hull_of(std::span<const Vector3<double>> points) {
  const auto x = normalized(points);
  try {
    return hull_polytope(points, qhull_faces(x, false));
  } catch (const std::invalid_argument&) {
    return hull_polytope(points, qhull_faces(x, true));  // facets that were merged too far, as triangles
  }
}

}  // namespace

ConvexHull::ConvexHull(std::span<const Vector3<double>> points)
    : Shape(ShapeTag::convex_hull), polytope_(hull_of(points)), mass_(polyhedron_mass(polytope_)) {
  const auto& v = polytope_.vertices;
  for (std::size_t i = 0; i < v.size(); i += std::size_t(lane_count)) {
    Vector3<Lanes> pack;
    for (int lane = 0; lane < lane_count; ++lane) {
      const std::size_t k = i + std::size_t(lane) < v.size() ? i + std::size_t(lane) : 0;
      for (int axis = 0; axis < 3; ++axis) pack[axis].set(lane, v[k][axis]);
    }
    packs_.push_back(pack);
  }
  for (int axis = 0; axis < 3; ++axis) {
    extreme_[std::size_t(2 * axis)] = std::uint32_t(furthest(v, [&](const auto& p) { return -p[axis]; }));
    extreme_[std::size_t(2 * axis + 1)] = std::uint32_t(furthest(v, [&](const auto& p) { return p[axis]; }));
  }
}

// Among equally high vertices, the one with the smallest number, for every width of registers.
std::uint32_t ConvexHull::support_vertex(const Vector3<double>& d) const {
  if (polytope_.vertices.size() > scan_limit) return climb(d);
  const Lanes x = d[0], y = d[1], z = d[2];
  Lanes best = -std::numeric_limits<double>::infinity(), where = 0.0;
  for (std::size_t k = 0; k < packs_.size(); ++k) {
    const Vector3<Lanes>& p = packs_[k];
    const Lanes along = p[0] * x + p[1] * y + p[2] * z;
    const auto further = along > best;
    best = select(further, along, best);
    where = select(further, Lanes(double(k)), where);
  }
  // The largest of the lanes, then the smallest number of those that reach it.
  const Lanes none = std::numeric_limits<double>::infinity();
  const double most = tree(best, [](double a, double b) { return a < b ? b : a; });
  const Lanes number = select(best >= Lanes(most), where * Lanes(lane_count) + lane_numbers(), none);
  const auto vertex = std::uint32_t(tree(number, [](double a, double b) { return b < a ? b : a; }));
  return vertex < polytope_.vertices.size() ? vertex : 0;  // a repeated vertex 0 in the last pack
}

// A vertex of a convex polytope is furthest along d if none of its neighbours is further.
std::uint32_t ConvexHull::climb(const Vector3<double>& d) const {
  const auto along = [&](std::uint32_t i) { return polytope_.vertices[i].dot(d); };
  std::uint32_t at = extreme_[0];
  for (const std::uint32_t i : extreme_) {
    if (along(i) > along(at)) at = i;
  }
  for (;;) {
    std::uint32_t next = at;
    for (const std::uint32_t i : polytope_.neighbours_of(at)) {
      if (along(i) > along(next)) next = i;
    }
    if (next == at) return at;
    at = next;
  }
}

Bounds ConvexHull::bounds(const Pose& pose) const {
  Bounds bounds;
  for (const Vector3<double>& v : polytope_.vertices) bounds.extend(pose.to_world(v));
  return bounds;
}

ShapeEntry convex_hull() {
  return {"convex_hull",
          "the convex hull of the vertices of an OBJ file",
          {{"file", std::string(), "", "path of the OBJ file, coordinates in m", Parameter::Need::required}},
          [](const ShapeParameters& p) -> ShapePointer {
            return std::make_shared<ConvexHull>(read_obj_mesh(p.text("file")).vertices);
          }};
}

}  // namespace polhode::collision::shapes
