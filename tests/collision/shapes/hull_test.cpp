// SPDX-License-Identifier: BSD-3-Clause
// Hulls of points and compounds of pieces: their faces, edges and mass, and what they refuse.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "collision/shapes/box.hpp"
#include "collision/shapes/compound.hpp"
#include "tests/temporary_folder.hpp"

namespace polhode::hull_test {
namespace {

using Vector = Vector3<double>;
using Points = std::vector<Vector>;

Points on_sphere(int n, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> bell;
  Points points;
  for (int i = 0; i < n; ++i) points.push_back(Vector(bell(random), bell(random), bell(random)).normalized());
  return points;
}

Points cube(double h, const Matrix3<double>& r = Matrix3<double>::Identity(), const Vector& at = Vector::Zero()) {
  Points points;
  for (int k = 0; k < 8; ++k) points.push_back(at + h * (r * Vector(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1)));
  return points;
}

/// Euler's formula, normals outward, every edge between two faces, neighbours both ways.
void expect_sound(const Polytope& p) {
  EXPECT_EQ(p.vertices.size() + p.faces.size(), p.edges.size() + 2);
  for (const auto& face : p.faces) {
    EXPECT_NEAR(face.normal.norm(), 1, 1e-15);
    for (const Vector& v : p.vertices) EXPECT_LE(face.normal.dot(v), face.offset + 1e-13);
  }
  for (std::uint32_t e = 0; e < p.edges.size(); ++e) {
    const auto& edge = p.edges[e];
    EXPECT_LT(edge.from, edge.to);
    const auto next_of = [&](std::uint32_t face, std::uint32_t vertex) {
      const auto corners = p.corners_of(face);
      for (std::size_t i = 0; i < corners.size(); ++i) {
        if (corners[i].vertex == vertex && corners[i].edge == e) return corners[(i + 1) % corners.size()].vertex;
      }
      return std::uint32_t(-1);
    };
    EXPECT_EQ(next_of(edge.left, edge.from), edge.to);
    EXPECT_EQ(next_of(edge.right, edge.to), edge.from);
    EXPECT_THAT(p.neighbours_of(edge.from), testing::Contains(edge.to));
    EXPECT_THAT(p.neighbours_of(edge.to), testing::Contains(edge.from));
    for (const std::uint32_t v : {edge.from, edge.to}) {
      EXPECT_THAT(p.faces_of(v), testing::Contains(edge.left));
      EXPECT_THAT(p.faces_of(v), testing::Contains(edge.right));
    }
    const Vector along = p.vertices[edge.to] - p.vertices[edge.from];
    EXPECT_GE(p.faces[edge.left].normal.cross(p.faces[edge.right].normal).dot(along), -1e-12) << "bends outward";
  }
}

TEST(ConvexHull, OfACubeHasSixSquares) {
  Points points = cube(0.5, rotation_matrix(Quaternion<double>(0.3, -0.5, 0.7, 0.2)), {10, -20, 30});
  points.insert(points.begin() + 3, Vector(10, -20, 30));  // inside
  points.push_back(0.5 * (points[0] + points[1]));         // a point on an edge
  const ConvexHull hull(points);
  EXPECT_EQ(hull.polytope().vertices.size(), 8u);
  EXPECT_EQ(hull.polytope().faces.size(), 6u);
  EXPECT_EQ(hull.polytope().edges.size(), 12u);
  expect_sound(hull.polytope());
  const MassProperties m = hull.mass_properties();
  EXPECT_NEAR(m.volume, 1, 1e-13);
  EXPECT_LT((m.centroid - Vector(10, -20, 30)).norm(), 1e-13);
  EXPECT_LT((m.inertia - Matrix3<double>::Identity() / 6).norm(), 1e-13);
}

TEST(ConvexHull, IsSoundForAnyPoints) {
  for (int n = 4; n <= 128; n += 31) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      const Points points = on_sphere(n, seed);
      const ConvexHull hull(points);
      EXPECT_EQ(hull.polytope().vertices.size(), std::size_t(n)) << "all lie on the sphere";
      expect_sound(hull.polytope());
    }
  }
}

// A large hull climbs to its support; a small one visits all vertices. Both find the furthest.
TEST(ConvexHull, SupportIsFurthestHoweverMany) {
  for (const int n : {4, 9, 64, 255, 257, 3000}) {
    const Points points = on_sphere(n, 5);
    const ConvexHull hull(points);
    for (const Vector& d : on_sphere(500, 6)) {
      double most = -2;
      for (const Vector& v : points) most = std::max(most, v.dot(d));
      EXPECT_NEAR(hull.support(d).dot(d), most, 1e-15) << n;
    }
  }
}

// Mirtich's integrals are exact for polyhedra: those of a tetrahedron from its vertices (Tonon, Journal of Mathematics
// and Statistics 1, 2005: the mean of x xᵀ over a tetrahedron about its centroid is Σ v vᵀ/20).
TEST(ConvexHull, MassOfATetrahedron) {
  const Points v = {{1, 0.2, -0.4}, {-0.6, 1.1, 0.3}, {0.1, -0.7, 1.4}, {0.9, 0.8, 1.2}};
  const MassProperties m = ConvexHull(v).mass_properties();
  const double volume = std::abs((v[1] - v[0]).cross(v[2] - v[0]).dot(v[3] - v[0])) / 6;
  const Vector centroid = (v[0] + v[1] + v[2] + v[3]) / 4;
  Matrix3<double> second = Matrix3<double>::Zero();
  for (const Vector& x : v) second += volume / 20 * (x - centroid) * (x - centroid).transpose();
  EXPECT_NEAR(m.volume, volume, 1e-15);
  EXPECT_LT((m.centroid - centroid).norm(), 1e-15);
  EXPECT_LT((m.inertia - (second.trace() * Matrix3<double>::Identity() - second)).norm(), 1e-15);
}

// The same hull far away and at another scale has the same mass properties.
TEST(ConvexHull, MassScalesAndShifts) {
  const Points points = on_sphere(40, 3);
  const MassProperties m = ConvexHull(points).mass_properties();
  for (const double scale : {1e-3, 1e3}) {
    Points moved;
    for (const Vector& p : points) moved.push_back(scale * p + scale * Vector(5, -3, 8));
    const MassProperties other = ConvexHull(moved).mass_properties();
    EXPECT_NEAR(other.volume / std::pow(scale, 3), m.volume, 1e-13);
    EXPECT_LT((other.centroid / scale - Vector(5, -3, 8) - m.centroid).norm(), 1e-13);
    EXPECT_LT((other.inertia / std::pow(scale, 5) - m.inertia).norm(), 1e-13);
  }
}

TEST(ConvexHull, IsThatOfTheBox) {
  const Box box({0.3, 0.7, 1.9});
  const ConvexHull hull(box.polytope().vertices);
  expect_sound(box.polytope());
  EXPECT_NEAR(hull.mass_properties().volume, box.mass_properties().volume, 1e-14);
  EXPECT_LT((hull.mass_properties().inertia - box.mass_properties().inertia).norm(), 1e-14);
}

std::string reason(const Points& points) {
  try {
    const ConvexHull hull(points);
  } catch (const std::invalid_argument& fault) {
    return fault.what();
  }
  return "";
}

TEST(ConvexHull, RefusesWithTheReason) {
  EXPECT_THAT(reason({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), testing::HasSubstr("at least 4 points, not 3"));
  EXPECT_THAT(reason({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}), testing::HasSubstr("coplanar"));
  EXPECT_THAT(reason({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1e-12}}), testing::HasSubstr("coplanar"));
  EXPECT_THAT(reason({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}), testing::HasSubstr("on a line"));
  EXPECT_THAT(reason(Points(5, Vector(1, 2, 3))), testing::HasSubstr("all the same"));
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  EXPECT_THAT(reason({{0, 0, 0}, {1, 0, 0}, {0, nan, 0}, {0, 0, 1}}), testing::HasSubstr("point 2"));
  EXPECT_THAT(reason({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, infinity}}), testing::HasSubstr("point 3"));
  EXPECT_THAT(reason({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}), "");
  EXPECT_THAT(reason({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1e-6}}), "") << "thin is not flat";
}

std::string compound_fault(const std::string& text) {
  const TemporaryFolder folder;
  const std::string path = (folder.path() / "piece.obj").string();
  std::ofstream(path) << text;
  try {
    Compound compound(Compound::parts_of_obj(path));
  } catch (const std::invalid_argument& fault) {
    return std::string(fault.what()).substr(path.size() - std::string("piece.obj").size());
  }
  return "";
}

const std::string tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

TEST(Compound, TakesWhatObjFilesHold) {
  EXPECT_EQ(compound_fault(tetrahedron), "");
  EXPECT_EQ(
      compound_fault("# a comment\nmtllib a.mtl\ng one\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 1\nusemtl red\n"
                     "f 1//1 -2//1 2//1\nf 1/1/1 2/2/2 4/1/1\ns off\nf -3 -2 -1\nf 3 1 4 # last\n"),
      "");
}

TEST(Compound, RefusesWithFileAndLine) {
  using testing::StartsWith;
  EXPECT_THAT(compound_fault("v 0 0 zero\n"),
              StartsWith("piece.obj:1: a vertex needs three finite numbers, not 'zero'"));
  EXPECT_THAT(compound_fault("v 0 0\n"), StartsWith("piece.obj:1: "));
  EXPECT_THAT(compound_fault("v 0 0 nan\n"), StartsWith("piece.obj:1: "));
  EXPECT_THAT(compound_fault("v 0 0 0\nf 1 1 2\n"), StartsWith("piece.obj:2: vertex 2 is not among the 1 above"));
  EXPECT_THAT(compound_fault("v 0 0 0\nf 1 0 1\n"), StartsWith("piece.obj:2: "));
  EXPECT_THAT(compound_fault("v 0 0 0\nf 1 1\n"), StartsWith("piece.obj:2: a face needs at least 3 corners"));
  EXPECT_THAT(compound_fault(""), StartsWith("piece.obj: has no vertices"));
  EXPECT_THAT(compound_fault("v 0 0 0\n"), StartsWith("piece.obj: has no faces"));
  EXPECT_THAT(compound_fault("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\no thing\nf 1 3 2\nf 1 2 4\nf 2 3 4\n"),
              StartsWith("piece.obj:6: piece 'thing' is not closed"));
  EXPECT_THAT(compound_fault("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"),
              StartsWith("piece.obj:6: the piece has two faces that pass one side in the same direction"));
  // All faces inward, then a dent: the octahedron's tip pushed below its equator.
  EXPECT_THAT(compound_fault("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n"),
              StartsWith("piece.obj:5: the piece is not convex"));
  EXPECT_THAT(compound_fault("v 1 0 0\nv 0 1 0\nv -1 0 0\nv 0 -1 0\nv 0 0 -1\nv 0 0 -0.5\nf 1 2 6\nf 2 3 6\nf 3 4 6\n"
                             "f 4 1 6\nf 2 1 5\nf 3 2 5\nf 4 3 5\nf 1 4 5\n"),
              testing::HasSubstr("is not convex: a vertex lies"));
}

}  // namespace
}  // namespace polhode::hull_test
