// SPDX-License-Identifier: BSD-3-Clause
// It needs the points alone, no faces, and is right by certificate.
// Apart: GJK (Gilbert, Johnson & Keerthi, 1988) in whole numbers ends at a point v of the difference A ⊖ B and a plane
// across v that leaves all of the difference behind it: none is nearer, and none as near as the plane.
// Overlapping: EPA (van den Bergh, 2001) in whole numbers grows a closed convex polytope of points of the difference
// around the origin, until no point of the difference lies beyond its nearest facet. The polytope proves that no
// shorter translation separates, the facet that this one does. Long double says where to begin, and decides where its
// error bound is sure; else whole numbers do.
#include "tests/collision/narrow/exact_hulls.hpp"

#include <limits>
#include <span>
#include <stdexcept>

#include "tests/collision/narrow/whole_numbers.hpp"

namespace polhode {
namespace exact_hulls {
namespace {

using Real = long double;
using Real3 = Three<Real>;

/// Products of three sums, each rounded: well below this share.
constexpr Real uncertain = 64 * std::numeric_limits<Real>::epsilon();

Real length(const Real3& x) { return std::sqrt(dot(x, x)); }

/// Vertices in the world as whole numbers of a unit, and the same rounded.
struct Solid {
  std::vector<Whole3> exact;
  std::vector<Real3> real;
};

/// A point of each, whose difference is meant.
struct Corner {
  std::size_t a = 0, b = 0;
  bool operator==(const Corner&) const = default;
};

class Difference {
 public:
  Difference(const ExactHull& a, const ExactHull& b) {
    int turn = no_bits, size = no_bits, place = no_bits;
    for (const ExactHull* hull : {&a, &b}) {
      for (int k = 0; k < 3; ++k) turn = last_bit_of_all(hull->pose.rotation.col(k), turn);
      for (const auto& p : hull->points) size = last_bit_of_all(p, size);
      place = last_bit_of_all(hull->pose.position, place);
    }
    exponent_ = std::min(turn + size, place);
    fill(a_, a, turn, size);
    fill(b_, b, turn, size);
  }

  Real unit() const { return std::ldexp(Real(1), exponent_); }  ///< m
  Whole3 exact(const Corner& c) const { return a_.exact[c.a] - b_.exact[c.b]; }
  Real3 real(const Corner& c) const { return a_.real[c.a] - b_.real[c.b]; }
  Real reach() const { return reach_; }  ///< reach of the rounded vertices: a bound on their error when times epsilon

  Corner support(const Real3& d) const { return {furthest(a_, d), furthest(b_, -d)}; }
  Corner support(const Whole3& d) const { return {furthest(a_, d), furthest(b_, -d)}; }

 private:
  void fill(Solid& solid, const ExactHull& hull, int turn, int size) {
    Three<Whole3> column;
    Whole3 position;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) column[j][i] = whole(hull.pose.rotation(int(i), int(j)), turn);
      position[i] = whole(hull.pose.position[int(i)], exponent_);
    }
    const unsigned shift = unsigned(turn + size - exponent_);
    for (const auto& p : hull.points) {
      Whole3 x = column[0] * whole(p[0], size) + column[1] * whole(p[1], size) + column[2] * whole(p[2], size);
      for (std::size_t i = 0; i < 3; ++i) x[i] = (x[i] << shift) + position[i];
      solid.exact.push_back(x);
      solid.real.push_back(rounded(x));
      reach_ = std::max(reach_, 2 * length(solid.real.back()));
    }
  }

  static std::size_t furthest(const Solid& solid, const Real3& d) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < solid.real.size(); ++i) {
      if (dot(solid.real[i], d) > dot(solid.real[best], d)) best = i;
    }
    return best;
  }

  std::size_t furthest(const Solid& solid, const Whole3& d) const {
    const Real3 near = rounded(d);
    std::size_t best = furthest(solid, near);
    const Real sure = dot(solid.real[best], near) - uncertain * length(near) * reach_;
    Whole most;
    bool known = false;
    for (std::size_t i = 0; i < solid.real.size(); ++i) {
      if (i == best || dot(solid.real[i], near) < sure) continue;
      if (!known) most = dot(solid.exact[best], d);
      known = true;
      const Whole along = dot(solid.exact[i], d);
      if (along > most) {
        most = along;
        best = i;
      }
    }
    return best;
  }

  Solid a_, b_;
  int exponent_ = 0;
  Real reach_ = 0;
};

/// The point nearest to the origin of the hull of up to four points.
template <class T>
struct Nearest {
  unsigned of = 0;           ///< bits: the points that it lies between
  Three<T> towards;          ///< a positive multiple of it, but zero where it is the origin
  T numerator, denominator;  ///< its squared distance
};

/// All faces of the simplex whose plane has its nearest point within them. The nearest of all is one of those.
template <class T>
Nearest<T> nearest(std::span<const Three<T>> w) {
  Nearest<T> best{};
  const auto take = [&](unsigned of, const Three<T>& towards, const T& numerator, const T& denominator) {
    if (best.of == 0 || numerator * best.denominator < best.numerator * denominator)
      best = {of, towards, numerator, denominator};
  };
  for (unsigned of = 1; of < 1u << w.size(); ++of) {
    std::array<std::size_t, 4> at{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < w.size(); ++i) {
      if (of >> i & 1) at[count++] = i;
    }
    const Three<T>& p = w[at[0]];
    if (count == 1) {
      take(of, p, dot(p, p), 1);
      continue;
    }
    const Three<T>& q = w[at[1]];
    const Three<T> side = q - p;
    if (count == 2) {
      const T of_p = dot(q, side), of_q = -dot(p, side);
      if (!(of_p > 0 && of_q > 0)) continue;
      const Three<T> area = cross(p, q);
      take(of, p * of_p + q * of_q, dot(area, area), dot(side, side));
      continue;
    }
    const Three<T>& r = w[at[2]];
    if (count == 3) {
      const Three<T> normal = cross(side, r - p);
      if (!(dot(cross(q, r), normal) > 0 && dot(cross(r, p), normal) > 0 && dot(cross(p, q), normal) > 0)) continue;
      const T volume = dot(p, normal);
      const Three<T> zero{};
      take(of, volume > 0 ? normal : volume < 0 ? -normal : zero, volume * volume, dot(normal, normal));
      continue;
    }
    const Three<T>& s = w[at[3]];
    const T of_p = dot(q, cross(r, s)), of_q = -dot(p, cross(r, s)), of_r = dot(s, cross(p, q)),
            of_s = -dot(r, cross(p, q));
    const bool inside =
        (of_p > 0 && of_q > 0 && of_r > 0 && of_s > 0) || (of_p < 0 && of_q < 0 && of_r < 0 && of_s < 0);
    if (inside) take(of, Three<T>{}, 0, 1);
  }
  return best;
}

template <class T>
Three<T> corner(const Difference& difference, const Corner& c) {
  if constexpr (std::is_same_v<T, Real>) {
    return difference.real(c);
  } else {
    return difference.exact(c);
  }
}

/// Goes from `simplex`, which may be flat, to the simplex that holds the point nearest to the origin. Each turn in
/// whole numbers brings it nearer, and the end is proven; rounding may end it early in long double.
template <class T>
Nearest<T> gjk(const Difference& difference, std::vector<Corner>& simplex) {
  for (int turn = 0;; ++turn) {
    std::array<Three<T>, 4> w;
    for (std::size_t i = 0; i < simplex.size(); ++i) w[i] = corner<T>(difference, simplex[i]);
    const Nearest<T> v = nearest<T>({w.data(), simplex.size()});
    std::vector<Corner> kept;
    for (std::size_t i = 0; i < simplex.size(); ++i) {
      if (v.of >> i & 1) kept.push_back(simplex[i]);
    }
    simplex = kept;
    if (v.numerator == 0 || (std::is_same_v<T, Real> && turn >= 60)) return v;
    const Corner next = difference.support(-v.towards);
    if (std::find(simplex.begin(), simplex.end(), next) != simplex.end()) return v;
    if (!(dot(corner<T>(difference, next), v.towards) < dot(corner<T>(difference, simplex[0]), v.towards))) return v;
    simplex.push_back(next);
  }
}

/// Four points of the difference that hold a volume.
std::array<Corner, 4> tetrahedron(const Difference& difference) {
  const auto beyond = [&](const Whole3& normal, const Whole3& plane) {
    Corner c = difference.support(normal);
    if (dot(difference.exact(c) - plane, normal) == 0) c = difference.support(-normal);
    return c;
  };
  const Whole3 along_x{1, 0, 0};
  const Corner first = difference.support(along_x);
  const Whole3 p = difference.exact(first);
  const Corner second = beyond(along_x, p);
  const Whole3 side = difference.exact(second) - p;
  const Corner third = beyond(side[0] == 0 && side[1] == 0 ? along_x : Whole3{-side[1], side[0], 0}, p);
  const Corner fourth = beyond(cross(side, difference.exact(third) - p), p);
  return {first, second, third, fourth};
}

/// A polytope of points of the difference that grows point by point. A facet is seen from a point that is strictly
/// beyond its plane; what is coplanar stays.
class Polytope3 {
 public:
  explicit Polytope3(const Difference& difference) : difference_(difference) {
    for (const Corner& c : tetrahedron(difference)) vertices_.push_back(difference.exact(c));
    const Whole volume =
        dot(cross(vertices_[1] - vertices_[0], vertices_[2] - vertices_[0]), vertices_[3] - vertices_[0]);
    if (volume == 0) throw std::invalid_argument("exact_distance: a hull has no volume");
    if (volume > 0) std::swap(vertices_[1], vertices_[2]);
    add_facet(0, 1, 2);
    add_facet(0, 2, 3);
    add_facet(0, 3, 1);
    add_facet(3, 2, 1);
  }

  /// The depth of the origin, times −1 (m), in an overlap that is known.
  ExactDistance depth() {
    for (;;) {
      std::size_t least = 0;
      for (std::size_t i = 1; i < facets_.size(); ++i) {
        if (facets_[i].distance < facets_[least].distance) least = i;
      }
      const Facet facet = facets_[least];
      const Whole3 next = difference_.exact(difference_.support(facet.normal));
      if (dot(next, facet.normal) > facet.offset) {
        grow(next);
        continue;
      }
      if (facet.offset < 0) throw std::logic_error("exact_distance: an overlap with a separating plane");
      return {facet.offset == 0 ? 0 : -1, -facet.distance * difference_.unit()};
    }
  }

 private:
  struct Facet {
    std::array<std::size_t, 3> of;
    Whole3 normal;  ///< outward
    Whole offset;
    Real3 real_normal;
    Real real_offset, distance;
  };

  void add_facet(std::size_t i, std::size_t j, std::size_t k) {
    Facet f{{i, j, k}, cross(vertices_[j] - vertices_[i], vertices_[k] - vertices_[i]), 0, {}, 0, 0};
    f.offset = dot(f.normal, vertices_[i]);
    f.real_normal = rounded(f.normal);
    f.real_offset = rounded(f.offset);
    f.distance = f.real_offset / length(f.real_normal);
    facets_.push_back(f);
  }

  bool sees(const Whole3& exact, const Real3& real, const Facet& f) const {
    const Real height = dot(real, f.real_normal) - f.real_offset;
    if (std::abs(height) > uncertain * length(f.real_normal) * difference_.reach()) return height > 0;
    return dot(exact, f.normal) > f.offset;
  }

  void grow(const Whole3& next) {
    const Real3 real = rounded(next);
    std::vector<std::array<std::size_t, 2>> sides;
    std::vector<Facet> kept;
    for (Facet& f : facets_) {
      if (sees(next, real, f)) {
        for (std::size_t i = 0; i < 3; ++i) sides.push_back({f.of[i], f.of[(i + 1) % 3]});
      } else {
        kept.push_back(std::move(f));
      }
    }
    facets_ = std::move(kept);
    vertices_.push_back(next);
    for (const auto& [from, to] : sides) {
      if (std::find(sides.begin(), sides.end(), std::array{to, from}) == sides.end())
        add_facet(from, to, vertices_.size() - 1);
    }
  }

  const Difference& difference_;
  std::vector<Whole3> vertices_;
  std::vector<Facet> facets_;
};

}  // namespace
}  // namespace exact_hulls

ExactDistance exact_distance(const ExactHull& a, const ExactHull& b) {
  using namespace exact_hulls;
  const Difference difference(a, b);
  std::vector<Corner> simplex = {{0, 0}};
  gjk<Real>(difference, simplex);
  const Nearest<Whole> v = gjk<Whole>(difference, simplex);
  if (v.numerator == 0) return Polytope3(difference).depth();
  return {1, std::sqrt(rounded(v.numerator) / rounded(v.denominator)) * difference.unit()};
}

}  // namespace polhode
