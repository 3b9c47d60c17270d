// SPDX-License-Identifier: BSD-3-Clause
// The laws of a shape, for every entry of the catalogue: a new shape needs a line in samples() below and nothing else.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>

#include "collision/shapes/compound.hpp"
#include "collision/shapes/half_space.hpp"
#include "collision/shapes/shape_catalogue.hpp"
#include "core/problem/inertia.hpp"
#include "tests/collision/shapes/corner_obj.hpp"
#include "tests/temporary_folder.hpp"

namespace polhode::laws::shape_law_test {
namespace {

using Vector = Vector3<double>;
using Values = std::map<std::string, ParameterValue>;

/// The sizes of one shape, and whether a point is in it, which is all that a law compares with.
struct Sample {
  std::string kind;
  Values sizes;
  bool (*holds)(const Vector&, double slack);
};

/// The file of a pyramid, or of the L of write_corner_obj().
std::string obj_file(bool pyramid) {
  static const TemporaryFolder folder;
  const std::string path = (folder.path() / (pyramid ? "pyramid.obj" : "corner.obj")).string();
  if (pyramid) {
    std::ofstream(path) << "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nv 0 0 3\nv 0 0 1 # inside\n";
  } else {
    write_corner_obj(path);
  }
  return path;
}

bool within(const Vector& x, const Vector& low, const Vector& high, double slack) {
  return ((x - low).array() >= -slack).all() && ((high - x).array() >= -slack).all();
}

std::vector<Sample> samples() {
  return {
      {"sphere", {{"radius", 0.7}}, [](const Vector& x, double slack) { return x.norm() <= 0.7 + slack; }},
      {"box",
       {{"size", Vector(0.4, 1.2, 2.0)}},
       [](const Vector& x, double slack) { return within(x, Vector(-0.2, -0.6, -1), Vector(0.2, 0.6, 1), slack); }},
      {"capsule",
       {{"radius", 0.4}, {"length", 1.5}},
       [](const Vector& x, double slack) {
         return (x - Vector(0, 0, std::clamp(x[2], -0.75, 0.75))).norm() <= 0.4 + slack;
       }},
      {"cylinder",
       {{"radius", 0.5}, {"length", 1.4}},
       [](const Vector& x, double slack) {
         return std::hypot(x[0], x[1]) <= 0.5 + slack && std::abs(x[2]) <= 0.7 + slack;
       }},
      {"ellipsoid",
       {{"semi_axes", Vector(0.3, 0.9, 1.4)}},
       [](const Vector& x, double slack) { return x.cwiseQuotient(Vector(0.3, 0.9, 1.4)).norm() <= 1 + 4 * slack; }},
      {"convex_hull",
       {{"file", obj_file(true)}},
       [](const Vector& x, double slack) {
         return x[2] >= -slack && x.head<2>().cwiseAbs().maxCoeff() <= 1 - x[2] / 3 + slack;
       }},
      {"compound",
       {{"file", obj_file(false)}},
       [](const Vector& x, double slack) {
         return within(x, {0, 0, 0}, {3, 1, 1}, slack) || within(x, {2, 0, 1}, {3, 1, 3}, slack);
       }},
      {"half_space",
       {{"normal", Vector(1, 2, -2)}, {"offset", 0.5}},
       [](const Vector& x, double slack) { return x.dot(Vector(1, 2, -2)) <= 0.5 + 3 * slack; }},
  };
}

const Sample& sample(const std::string& kind) {
  static const std::vector<Sample> all = samples();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Sample& s) { return s.kind == kind; });
  if (found == all.end()) throw std::logic_error("give samples() in shape_law_test.cpp a line for " + kind);
  return *found;
}

std::vector<std::string> kinds() {
  std::vector<std::string> names;
  for (const ShapeEntry& e : shape_catalogue()) names.push_back(e.name);
  return names;
}

class ShapeLaw : public testing::TestWithParam<std::string> {
 protected:
  const ShapeEntry& entry() const { return *find_shape(GetParam()); }
  const Sample& given() const { return sample(GetParam()); }
  ShapePointer shape() const { return entry().make({given().sizes}); }

  Vector direction() {
    std::normal_distribution<double> bell;
    return Vector(bell(random), bell(random), bell(random));
  }
  Pose pose() {
    std::normal_distribution<double> bell;
    return {3 * direction(),
            rotation_matrix(Quaternion<double>(bell(random), bell(random), bell(random), bell(random)))};
  }

  std::mt19937_64 random{11};
};

INSTANTIATE_TEST_SUITE_P(Catalogue, ShapeLaw, testing::ValuesIn(kinds()),
                         [](const auto& param_info) { return param_info.param; });

TEST_P(ShapeLaw, SaysWhatItIs) {
  EXPECT_EQ(shape()->kind(), GetParam());
  EXPECT_FALSE(entry().summary.empty());
  EXPECT_FALSE(entry().parameters.empty());
  for (const Parameter& p : entry().parameters) EXPECT_TRUE(given().sizes.contains(p.key)) << p.key;
}

// No point that the shape holds is further along d than its support, which it holds too.
TEST_P(ShapeLaw, SupportIsFurthest) {
  const ShapePointer s = shape();
  if (!s->finite()) {
    const auto& floor = static_cast<const HalfSpace&>(*s);
    EXPECT_TRUE(given().holds(s->support(floor.normal()), 1e-14));
    EXPECT_FALSE(given().holds(s->support(floor.normal()) + 1e-9 * floor.normal(), 1e-14));
    EXPECT_THROW((void)s->support(Vector(1, 0, 0)), std::invalid_argument);
    return;
  }
  std::vector<Vector> inside;
  const Bounds around = s->bounds({});
  std::uniform_real_distribution<double> uniform;
  while (inside.size() < 2000) {
    const Vector x =
        around.min() + around.sizes().cwiseProduct(Vector(uniform(random), uniform(random), uniform(random)));
    if (given().holds(x, 0)) inside.push_back(x);
  }
  for (int k = 0; k < 300; ++k) {
    const Vector d = k < 6 ? Vector((k % 2 ? -1 : 1) * Vector::Unit(k / 2)) : direction();
    const Vector furthest = s->support(d);
    EXPECT_TRUE(given().holds(furthest, 1e-14)) << furthest.transpose();
    for (const Vector& x : inside) ASSERT_LE(x.dot(d), furthest.dot(d) + 1e-14) << d.transpose();
    EXPECT_TRUE(!given().holds(furthest + 1e-6 * d, 1e-12)) << "there is more of it along " << d.transpose();
    EXPECT_NEAR(s->support(1e-120 * d).dot(d), furthest.dot(d), 1e-13) << "the length of d does not matter";
    EXPECT_NEAR(s->support(1e120 * d).dot(d), furthest.dot(d), 1e-13);
  }
}

// Each side of the bounds is as far as the support reaches along it.
TEST_P(ShapeLaw, BoundsContainAndTouch) {
  const ShapePointer s = shape();
  for (int k = 0; k < 200; ++k) {
    const Pose at = pose();
    const Bounds bounds = s->bounds(at);
    for (int axis = 0; axis < 3; ++axis) {
      if (!s->finite()) {
        EXPECT_EQ(bounds.max()[axis], std::numeric_limits<double>::infinity());
        EXPECT_EQ(bounds.min()[axis], -std::numeric_limits<double>::infinity());
        continue;
      }
      const Vector up = at.rotation.transpose() * Vector::Unit(axis);
      EXPECT_NEAR(bounds.max()[axis], at.to_world(s->support(up))[axis], 1e-14 * (1 + at.position.norm()));
      EXPECT_NEAR(bounds.min()[axis], at.to_world(s->support(-up))[axis], 1e-14 * (1 + at.position.norm()));
    }
  }
}

// Against the sums of the engine slides over the points of a fine grid, whose error falls as its spacing; the sums of
// grid points in a body that bends do so unevenly, hence the slack.
TEST_P(ShapeLaw, MassIsThatOfItsPoints) {
  const ShapePointer s = shape();
  if (!s->finite()) {
    EXPECT_THROW((void)s->mass_properties(), std::logic_error);
    return;
  }
  const MassProperties m = s->mass_properties();
  const Bounds around = s->bounds({});
  constexpr int n = 96;
  const Vector cell = around.sizes() / n;
  std::vector<PointMass> points;
  for (int i = 0; i < n * n * n; ++i) {
    const Vector x = around.min() + cell.cwiseProduct(Vector(i % n + 0.5, i / n % n + 0.5, i / n / n + 0.5));
    if (given().holds(x, 0)) points.push_back({cell.prod(), x});
  }
  const double size = around.sizes().maxCoeff();
  EXPECT_NEAR(total_mass(points), m.volume, 2e-3 * m.volume);
  EXPECT_LT((mass_center(points) - m.centroid).norm(), 1e-3 * size);
  const Matrix3<double> inertia = inertia_about_center(inertia_of(points), total_mass(points), m.centroid);
  EXPECT_LT((inertia - m.inertia).norm(), 4e-3 * m.inertia.norm());
  EXPECT_EQ(inertia_fault(m.inertia), "");
}

// A body is placed by its mass centre. Vertices of a file stand where the file has them, and a scenario checks them.
TEST_P(ShapeLaw, HasItsMassCentreAtItsOrigin) {
  if (!shape()->finite() || given().sizes.contains("file")) return;
  EXPECT_LT(shape()->mass_properties().centroid.norm(), 1e-15);
}

TEST_P(ShapeLaw, RefusesBadSizes) {
  const double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [&](const std::string& key, const ParameterValue& value) {
    Values sizes = given().sizes;
    sizes[key] = value;
    try {
      entry().make({sizes});
      ADD_FAILURE() << GetParam() << " takes a bad " << key;
    } catch (const std::invalid_argument& fault) {
      EXPECT_NE(std::string(fault.what()), "");
    }
  };
  for (const Parameter& p : entry().parameters) {
    if (std::holds_alternative<std::string>(p.value)) {
      refused(p.key, std::string("no_such_file.obj"));
      continue;
    }
    for (const double bad : {0.0, -1.0, infinity, -infinity, nan, 1e-200, 1e200}) {
      if (std::isfinite(bad) && p.range == Parameter::Range::any) continue;
      if (bad >= 0 && bad < 1 && p.range == Parameter::Range::non_negative) continue;
      if (std::holds_alternative<double>(p.value)) {
        refused(p.key, bad);
      } else {
        for (int axis = 0; axis < 3; ++axis) {
          Vector v = std::get<Vector>(given().sizes.at(p.key));
          v[axis] = bad;
          refused(p.key, v);
        }
      }
    }
  }
}

}  // namespace
}  // namespace polhode::laws::shape_law_test
