// SPDX-License-Identifier: BSD-3-Clause
// The narrow phase `gjk`: distance by GJK, depth by EPA, for every pair of shapes.
// A half-space has closed forms, and a compound answers with its parts: the least distance, or the deepest of the parts
// that overlap.
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>

#include "collision/narrow/box_sat.hpp"
#include "collision/narrow/contact_patch.hpp"
#include "collision/narrow/epa.hpp"
#include "collision/narrow/gjk_loop.hpp"
#include "collision/narrow/hull_sat.hpp"
#include "collision/narrow/pair_order.hpp"
#include "collision/narrow_phase.hpp"
#include "collision/shapes/box.hpp"
#include "collision/shapes/compound.hpp"
#include "collision/shapes/half_space.hpp"

namespace polhode::inline collision::inline narrow {

namespace {

/// Two of them overlap without end, but for floor and ceiling.
Distance between_half_spaces(const HalfSpace& a, const Pose& at_a, const HalfSpace& b, const Pose& at_b) {
  const Vector3<double> up = at_b.rotation * b.normal(), down = at_a.rotation * a.normal();
  const Vector3<double> on_b = at_b.position + b.offset() * up, on_a = at_a.position + a.offset() * down;
  if (!(up + down).isZero(0)) return {-std::numeric_limits<double>::infinity(), up, on_a, on_b};
  const double distance = up.dot(on_a - on_b);
  return {distance, up, on_a, on_a - distance * up};
}

void recall(const PairMemory* memory, bool swapped, const MinkowskiPair& pair, Simplex& s) {
  s.used = 0;
  if (!memory || memory->swapped != swapped) return;
  for (std::size_t i = 0; i < memory->count; ++i) {
    const auto [of_a, of_b] = memory->vertices[i];
    MinkowskiCorner& c = s.corners[i];
    if (!pair.smooth()) {
      if (of_a >= pair.a.vertex_count() || of_b >= pair.b.vertex_count()) return;
      pair.corner(of_a, of_b, c);
    } else {
      c.a = memory->corners_a[i];
      pair.complete(c, memory->corners_b[i]);
      c.vertex_a = of_a;
      c.vertex_b = of_b;
    }
  }
  s.used = (1u << memory->count) - 1;
}

void remember(PairMemory* memory, bool swapped, const MinkowskiPair& pair, const Simplex& s) {
  if (!memory) return;
  memory->swapped = swapped;
  memory->count = 0;
  for (unsigned left = s.used; left != 0; left &= left - 1) {
    const MinkowskiCorner& c = s.corners[std::size_t(std::countr_zero(left))];
    memory->vertices[memory->count] = {c.vertex_a, c.vertex_b};
    if (pair.smooth()) {
      memory->corners_a[memory->count] = c.a;
      memory->corners_b[memory->count] = pair.in_b(c.turned_b);
    }
    ++memory->count;
  }
}

void check(const MinkowskiPair& pair) {
  if (std::isfinite(pair.rotation.sum()) && pair.offset.squaredNorm() < 1e200) return;
  throw std::invalid_argument("gjk: a pose is not finite, or the shapes are more than 1e100 m apart");
}

/// The shares of a thin triangle, where rounding shows in them.
void refine(const MinkowskiPair& pair, GjkResult& r) {
  Simplex& s = r.simplex;
  if (s.count() != 3) return;
  const unsigned missing = ~s.used & 15;
  const auto at = [missing](unsigned k) { return std::size_t(k + (1u << k >= missing)); };
  const std::size_t i = at(0), j = at(1), k = at(2);
  const Vector3<double> sum =
      s.weight[i] * s.corners[i].w + s.weight[j] * s.corners[j].w + s.weight[k] * s.corners[k].w;
  const double square = std::max(r.distance * r.distance, pair.offset.squaredNorm());
  if ((sum - r.v).squaredNorm() <= stop_share * stop_share * square) return;
  std::array<double, 4> share = {s.weight[i], s.weight[j], s.weight[k], 0};
  refine(s.corners[i], s.corners[j], s.corners[k], Vector3<double>::Zero(), share);
  s.weight[i] = share[0];
  s.weight[j] = share[1];
  s.weight[k] = share[2];
}

/// The distance if v is short compared with the shapes, or if they have nearly parallel faces: rounding then rotates v
/// so far that the separation along it is less than the distance. The normal is taken from the features: those at hand,
/// or those that EPA finds after moving the shapes until they touch.
Penetration with_sure_normal(const MinkowskiPair& pair, const GjkResult& r, const Penetration& unsure) {
  std::array<MinkowskiCorner, 3> corners;
  unsigned left = r.simplex.used;
  for (MinkowskiCorner& c : corners) {
    c = r.simplex.corners[std::size_t(std::countr_zero(left))];
    if ((left & (left - 1)) != 0) left &= left - 1;
  }
  Penetration best = unsure;
  best.distance -= r.gap;
  polish(pair, corners, best);
  const double rounding = near_share * r.scale;
  const bool sure = best.distance >= r.distance - rounding && (r.v - r.distance * best.normal).norm() <= rounding;
  for (int k = 0; k < 2 && !sure; ++k) {
    MinkowskiPair touching = pair;
    touching.offset += r.distance * best.normal;
    GjkResult again;
    gjk_loop<false>(touching, again);
    if (again.state == GjkResult::State::apart) break;
    Penetration p = epa(touching, again, nullptr);
    p.distance = separation(pair, p.normal);
    p.on_b -= touching.offset - pair.offset;
    if (!(p.distance >= best.distance - rounding)) break;
    best = p;
  }
  if (best.distance < r.distance - rounding) {  // the shapes may not be apart
    const Penetration p = epa(pair, r, nullptr);
    if (p.distance >= best.distance - rounding) return p;
  }
  best.distance = r.distance;
  return best;
}

/// Absent where rounding hides which features of two polytopes are nearest.
std::optional<Penetration> signed_distance(const MinkowskiPair& pair, PairMemory* memory, bool swapped) {
  PairMemory::Shell* const shell = memory ? &memory->shell : nullptr;
  if (shell && shell->corner_count > 0) {
    if (memory->swapped == swapped) {
      if (const auto p = epa_again(pair, *shell)) return p;
    }
    shell->corner_count = 0;
  }
  GjkResult r;
  recall(memory, swapped, pair, r.simplex);
  const unsigned recalled = r.simplex.used;
  gjk_loop<false>(pair, r);
  if (r.steps > 0 || r.simplex.used != recalled) remember(memory, swapped, pair, r.simplex);
  if (r.state != GjkResult::State::apart) return epa(pair, r, shell);
  refine(pair, r);
  Penetration p;
  p.distance = r.distance;
  p.normal = r.v / r.distance;
  p.on_a = r.simplex.on_a();
  p.on_b = p.on_a - r.v;
  if (r.gap > 0 && !pair.smooth()) return std::nullopt;
  return r.gap > near_share * r.scale ? with_sure_normal(pair, r, p) : p;
}

/// The distance by all features, if rounding hides from the simplices which features are nearest.
Distance by_features(const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b) {
  if (a.tag() != ShapeTag::box || b.tag() != ShapeTag::box) return hulls_distance(a, at_a, b, at_b);
  return boxes_distance({static_cast<const Box&>(a).half_extents(), at_a},
                        {static_cast<const Box&>(b).half_extents(), at_b});
}

Distance convex_distance(const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b, PairMemory* memory,
                         bool swapped) {
  const MinkowskiPair pair(a, at_a, b, at_b);
  check(pair);
  const auto p = signed_distance(pair, memory, swapped);
  if (!p) return by_features(a, at_a, b, at_b);
  Distance d;
  d.distance = p->distance - pair.radius();
  d.normal.noalias() = at_a.rotation * p->normal;
  d.on_a.noalias() = at_a.to_world(p->on_a) - pair.a.radius * d.normal;
  d.on_b.noalias() = at_a.to_world(p->on_b) + pair.b.radius * d.normal;
  return d;
}

bool convex_overlap(const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b, PairMemory* memory,
                    bool swapped) {
  const MinkowskiPair pair(a, at_a, b, at_b);
  check(pair);
  GjkResult r;
  recall(memory, swapped, pair, r.simplex);
  gjk_loop<true>(pair, r);
  if (r.steps > 0) remember(memory, swapped, pair, r.simplex);
  if (r.state == GjkResult::State::separated) return false;
  if (r.state == GjkResult::State::inside) return true;
  return convex_distance(a, at_a, b, at_b, memory, swapped).distance <= 0;
}

std::span<const Compound::Part> parts_of(const Shape& shape) {
  if (shape.tag() != ShapeTag::compound) return {};
  return static_cast<const Compound&>(shape).parts();
}

/// The distance with the shapes in the order of `exchanged`.
Distance ordered_distance(const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b, PairMemory* memory,
                          bool swapped) {
  if (a.tag() == ShapeTag::half_space && b.tag() == ShapeTag::half_space) {
    return between_half_spaces(static_cast<const HalfSpace&>(a), at_a, static_cast<const HalfSpace&>(b), at_b);
  }
  if (b.tag() == ShapeTag::half_space) return above_half_space(a, at_a, b, at_b);
  if (a.tag() == ShapeTag::half_space) return mirrored(above_half_space(b, at_b, a, at_a));
  if (a.tag() != ShapeTag::compound && b.tag() != ShapeTag::compound) {
    return convex_distance(a, at_a, b, at_b, memory, swapped);
  }
  Distance least{std::numeric_limits<double>::infinity()};
  const auto consider = [&](const Shape& part_a, const Shape& part_b) {
    const Distance d = convex_distance(part_a, at_a, part_b, at_b, nullptr, swapped);
    if (d.distance < least.distance) least = d;
  };
  const auto against_b = [&](const Shape& part_a) {
    if (b.tag() != ShapeTag::compound) consider(part_a, b);
    for (const Compound::Part& part : parts_of(b)) consider(part_a, *part);
  };
  if (a.tag() != ShapeTag::compound) against_b(a);
  for (const Compound::Part& part : parts_of(a)) against_b(*part);
  return least;
}

/// Shapes without a core of their own; true of either.
bool special(const Shape& a, const Shape& b) {
  const auto is = [](const Shape& s) { return s.tag() == ShapeTag::half_space || s.tag() == ShapeTag::compound; };
  return is(a) || is(b);
}

void check(const Pose& at_a, const Pose& at_b) {
  for (const Pose* at : {&at_a, &at_b}) {
    if (!at->position.allFinite() || !at->rotation.allFinite())
      throw std::invalid_argument("gjk: a pose is not finite");
  }
}

class Gjk final : public NarrowPhase {
 public:
  bool overlap(const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b, PairMemory* memory) const override {
    if (special(a, b)) return distance(a, at_a, b, at_b, memory).distance <= 0;
    const bool swapped = exchanged(a, at_a, b, at_b);
    return swapped ? convex_overlap(b, at_b, a, at_a, memory, swapped)
                   : convex_overlap(a, at_a, b, at_b, memory, swapped);
  }

  Distance distance(const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b,
                    PairMemory* memory) const override {
    if (special(a, b)) check(at_a, at_b);
    const bool swapped = exchanged(a, at_a, b, at_b);
    if (swapped) return mirrored(ordered_distance(b, at_b, a, at_a, memory, swapped));
    return ordered_distance(a, at_a, b, at_b, memory, swapped);
  }

  Manifold manifold(const Shape& a, const Pose& at_a, const Shape& b, const Pose& at_b, double margin,
                    PairMemory* memory) const override {
    if (special(a, b)) check(at_a, at_b);
    if (a.tag() == ShapeTag::compound || b.tag() == ShapeTag::compound)
      return compound_patch(*this, a, at_a, b, at_b, margin);
    return contact_patch(a, at_a, b, at_b, distance(a, at_a, b, at_b, memory), margin);
  }
};

}  // namespace

NarrowPhaseEntry gjk() {
  return {"gjk", "min |a - b| over A and B by simplices of A - B; depth by EPA",
          []() -> std::unique_ptr<NarrowPhase> { return std::make_unique<Gjk>(); }};
}

}  // namespace polhode::collision::narrow
