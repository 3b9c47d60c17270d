// SPDX-License-Identifier: BSD-3-Clause
#include "tests/laws/shape_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <stdexcept>

#include "collision/shapes/box.hpp"
#include "collision/shapes/capsule.hpp"
#include "collision/shapes/compound.hpp"
#include "collision/shapes/cylinder.hpp"
#include "collision/shapes/ellipsoid.hpp"
#include "collision/shapes/half_space.hpp"
#include "collision/shapes/shape_catalogue.hpp"
#include "collision/shapes/sphere.hpp"
#include "core/math/portable_random.hpp"

namespace polhode::laws {
namespace {

using Vector = Vector3<double>;

/// A cone of a height and a radius, its tip on +z.
class Cone final : public Shape {
 public:
  Cone(double radius, double height) : radius_(radius), height_(height) {}
  std::string_view kind() const override { return "cone"; }
  Vector support(const Vector& d) const override {
    const double across = std::hypot(d[0], d[1]);
    const Vector rim = across > 0 ? Vector(radius_ * d[0] / across, radius_ * d[1] / across, 0) : Vector(radius_, 0, 0);
    const Vector tip(0, 0, height_);
    return tip.dot(d) > rim.dot(d) ? tip : rim;
  }
  Bounds bounds(const Pose& pose) const override {
    Bounds around;
    for (int i = 0; i < 3; ++i) {
      const Vector up = pose.rotation.row(i).transpose();
      around.extend(pose.to_world(support(up)));
      around.extend(pose.to_world(support(-up)));
    }
    return around;
  }
  MassProperties mass_properties() const override { return {}; }

 private:
  double radius_, height_;
};

std::shared_ptr<ConvexHull> hull(PortableRandom& random, double size, const Vector& about = Vector::Zero()) {
  std::vector<Vector> points;
  const int n = 4 + random.below(30);
  for (int i = 0; i < n; ++i) points.push_back(about + size * random.direction());
  return std::make_shared<ConvexHull>(points);
}

ShapePointer shape(PortableRandom& random, const std::string& kind, double size) {
  const Vector s = size * random.uniform_vector(0.1, 1);
  if (kind == "sphere") return std::make_shared<Sphere>(s[0]);
  if (kind == "box") return std::make_shared<Box>(s);
  if (kind == "capsule") return std::make_shared<Capsule>(s[0], random.chance(0.1) ? 0 : s[1]);
  if (kind == "cylinder") return std::make_shared<Cylinder>(s[0], s[1]);
  if (kind == "ellipsoid") return std::make_shared<Ellipsoid>(s);
  if (kind == "cone") return std::make_shared<Cone>(s[0], s[1]);
  if (kind == "convex_hull") return hull(random, size);
  if (kind == "half_space")
    return std::make_shared<HalfSpace>(random.chance(0.5) ? random.direction() : Vector::UnitZ(),
                                       size * random.uniform(-1, 1));
  if (kind == "compound") {
    std::vector<Compound::Part> parts;
    for (int i = random.below(3); i >= 0; --i)
      parts.push_back(hull(random, 0.6 * size, 0.4 * size * random.direction()));
    return std::make_shared<Compound>(parts);
  }
  throw std::logic_error("give shape() in shape_pairs.cpp a line for " + kind);
}

double off_convex_surface(const Shape& shape, const Pose& at, const Vector& x, const Vector& out) {
  const auto height = [&](const Vector& d) {
    return d.dot(at.to_world(shape.support(at.rotation.transpose() * d)) - x);
  };
  double off = std::abs(height(out));
  PortableRandom random(1);
  for (int k = 0; k < 60; ++k)
    off = std::max(off, -height(k < 6 ? Vector((k % 2 ? -1 : 1) * Vector::Unit(k / 2)) : random.direction()));
  return off;
}

}  // namespace

const std::vector<std::string>& shape_kinds() {
  static const std::vector<std::string> kinds = [] {
    std::vector<std::string> names;
    for (const ShapeEntry& entry : shape_catalogue()) names.push_back(entry.name);
    names.push_back("cone");
    return names;
  }();
  return kinds;
}

ShapePair shape_pair(const std::string& kind_a, const std::string& kind_b, std::uint64_t seed) {
  PortableRandom random(seed);
  const double ratio = random.chance(0.5) ? 1 : random.power_of_ten(-2, 0), size = random.power_of_ten(-2, 2);
  const bool first = random.chance(0.5);
  const double size_a = size * (first ? 1 : ratio), size_b = size * (first ? ratio : 1);
  ShapePair pair{kind_a, kind_b, seed,        shape(random, kind_a, size_a), shape(random, kind_b, size_b), {},
                 {},     0,      size * ratio};
  const auto either = [&](const char* kind) { return kind_a == kind || kind_b == kind; };
  pair.round = either("cylinder") || either("ellipsoid") || either("cone");
  pair.convex = !either("compound");
  pair.finite = !either("half_space");
  if (random.chance(0.7)) pair.at_a = {size * random.uniform(0, 2) * random.direction(), random.rotation()};
  pair.at_b = pair.at_a;
  if (random.chance(0.6)) pair.at_b.rotation = random.rotation();
  const int placing = random.below(6);
  if (placing > 0 && pair.finite) {
    // The place where the shadows on a line touch, and a gap of any size from there.
    const Vector along = random.chance(0.5) ? random.direction() : Vector(pair.at_a.rotation.col(random.below(3)));
    const auto reach = [&](const Shape& s, const Pose& at, const Vector& d) {
      return d.dot(at.rotation * s.support(at.rotation.transpose() * d));
    };
    const double touching = reach(*pair.a, pair.at_a, along) + reach(*pair.b, pair.at_b, -along);
    const double gap =
        random.chance(0.1) ? 0 : (random.chance(0.5) ? 1 : -1) * size * ratio * random.power_of_ten(-16, 0);
    pair.at_b.position += (placing < 3 ? touching + gap : random.uniform(0, 1.3) * touching) * along;
  } else if (placing > 0) {
    pair.at_b.position += size * random.uniform(0, 3) * random.direction();
  }
  pair.scale = size_a + size_b + pair.at_a.position.norm() + pair.at_b.position.norm();
  return pair;
}

double off_surface(const Shape& shape, const Pose& at, const Vector& x, const Vector& out) {
  if (shape.tag() == ShapeTag::half_space) {
    const auto& floor = static_cast<const HalfSpace&>(shape);
    return std::abs(floor.normal().dot(at.to_body(x)) - floor.offset());
  }
  if (shape.tag() != ShapeTag::compound) return off_convex_surface(shape, at, x, out);
  double off = std::numeric_limits<double>::infinity();
  for (const auto& part : static_cast<const Compound&>(shape).parts())
    off = std::min(off, off_convex_surface(*part, at, x, out));
  return off;
}

}  // namespace polhode::laws
