// SPDX-License-Identifier: BSD-3-Clause
// Every face that is looked at gives an upper bound of the depth, the support along its normal, and the smallest one
// met is what is reported: a bad normal of a sliver can cost time but never truth. Each pass adds a corner or retires a
// face, so the search ends; when its room is full it reports the best bound.
#include "collision/narrow/epa.hpp"

#include <algorithm>

#include "collision/narrow/epa_polytope.hpp"
#include "collision/narrow/face_normals.hpp"

namespace polhode::inline collision::inline narrow {

namespace {

constexpr double flat_share = 1e-13;
constexpr int descent_limit = 50;

class Expansion {
 public:
  using Index = EpaPolytope::Index;

  explicit Expansion(const MinkowskiPair& pair) : pair_(pair) { polytope_.met(pair.offset.norm()); }

  Penetration run(const Simplex& start, bool certain, PairMemory::Shell* shell) {
    if (!span_space(start, certain)) {
      if (shell) shell->corner_count = 0;
      return {separation(pair_, flat_normal_), flat_normal_, start.on_a(), start.turned_on_b() + pair_.offset};
    }
    polytope_.close_tetrahedron();
    expand(-std::numeric_limits<double>::infinity());
    const Penetration result = finish();
    if (shell && !pair_.smooth()) polytope_.save(*shell);
    return result;
  }

  std::optional<Penetration> run(PairMemory::Shell& shell) {
    if (!polytope_.load(pair_, shell)) return std::nullopt;
    const int corners = polytope_.corner_count();
    if (!expand(0)) return std::nullopt;
    if (polytope_.corner_count() > corners) polytope_.save(shell);
    return finish();
  }

 private:
  /// A tetrahedron with room inside, from the simplex and, where it is not known to be one, from other corners. Where
  /// there is none, false, and `flat_normal_` is perpendicular to the whole difference.
  bool span_space(const Simplex& start, bool certain) {
    std::array<MinkowskiCorner, 4> given, found;
    std::size_t count = 0;
    for (unsigned left = start.used; left != 0; left &= left - 1)
      given[count++] = start.corners[std::size_t(std::countr_zero(left))];
    if (certain) {
      for (const MinkowskiCorner& c : given) polytope_.add_corner(c);
      return true;
    }
    found[0] = count > 0 ? given[0] : pair_.support(Vector3<double>::UnitX());

    // Chooses, among the simplex's own corners and the corners furthest along some directions, the one furthest off.
    const auto choose = [&](const auto& directions, MinkowskiCorner& best, const auto& off) {
      double most = -1;
      const auto consider = [&](const MinkowskiCorner& c) {
        polytope_.met(c.w.norm());
        const double here = off(c);
        if (here > most) {
          most = here;
          best = c;
        }
      };
      for (std::size_t i = 0; i < count; ++i) consider(given[i]);
      if (most > 1e-3 * polytope_.scale()) return most;
      for (const Vector3<double>& d : directions) {
        consider(pair_.support(d));
        consider(pair_.support(-d));
      }
      return most;
    };

    const std::array<Vector3<double>, 3> axes = {Vector3<double>::UnitX(), Vector3<double>::UnitY(),
                                                 Vector3<double>::UnitZ()};
    const double length = choose(axes, found[1], [&](const MinkowskiCorner& c) { return edge(found[0], c).norm(); });
    if (length <= flat_share * polytope_.scale()) {
      // Two points that are apart give the normal; if they are together, any normal will do.
      flat_normal_ = found[0].w.norm() > 0 ? found[0].w.stableNormalized() : Vector3<double>::UnitZ();
      return false;
    }
    const Vector3<double> along = edge(found[0], found[1]).stableNormalized();
    const Vector3<double> side = along.unitOrthogonal(), other = along.cross(side);
    const std::array<Vector3<double>, 4> sides = {side, other, side + other, side - other};
    const double width =
        choose(sides, found[2], [&](const MinkowskiCorner& c) { return edge(found[0], c).cross(along).norm(); });
    if (width <= flat_share * polytope_.scale()) {
      flat_normal_ = side;
      return false;
    }
    const Vector3<double> normal = along.cross(edge(found[0], found[2])).stableNormalized();
    const std::array<Vector3<double>, 1> up = {normal};
    const double height =
        choose(up, found[3], [&](const MinkowskiCorner& c) { return std::abs(edge(found[0], c).dot(normal)); });
    if (height <= flat_share * polytope_.scale()) {
      flat_normal_ = separation(pair_, normal) >= separation(pair_, -normal) ? normal : Vector3<double>(-normal);
      return false;
    }
    for (const MinkowskiCorner& c : found) polytope_.add_corner(c);
    return true;
  }

  /// False where a face comes up that is nearer than `least`.
  bool expand(double least) {
    while (const auto at = polytope_.nearest_face()) {
      const EpaPolytope::Face& face = polytope_.face(*at);
      const double offset = face.offset, rounding = stop_share * polytope_.scale();
      if (offset < least) return false;
      if (offset >= best_reach_ - rounding) return true;
      const MinkowskiCorner next = pair_.support(face.normal);
      const double reach = face.normal.dot(next.w);
      if (reach < best_reach_) {
        best_reach_ = reach;
        best_normal_ = face.normal;
        for (std::size_t k = 0; k < 3; ++k) best_face_[k] = polytope_.corner(face.corner[k]);
      }
      const bool met = polytope_.has_corner(next);
      if (reach - offset <= rounding || (met && least < 0)) {
        polytope_.retire(*at);
        continue;
      }
      if (met) return false;  // the polytope of the last query is not convex here any more
      if (polytope_.full() || !polytope_.grow(*at, next)) return least < 0;
    }
    return true;
  }

  Penetration finish() {
    Penetration result;
    result.normal = -best_normal_;
    result.distance = -best_reach_;
    polish(pair_, best_face_, result);
    witness(result);
    if (pair_.smooth()) descend(result);
    return result;
  }

  /// Improves the normal on a curved surface, which an inscribed polytope approaches only slowly. The point slightly
  /// further out than the depth projects onto the surface; the normal there is better, by the ratio of depth and radius
  /// of curvature.
  void descend(Penetration& result) const {
    MinkowskiPair shifted = pair_;
    const double scale = polytope_.scale(), further = 0.1 * scale;
    for (int k = 0; k < descent_limit; ++k) {
      shifted.offset = pair_.offset + result.normal * (result.distance - further);
      GjkResult r;
      gjk_loop<false>(shifted, r);
      if (r.state != GjkResult::State::apart) return;
      result.on_a = r.simplex.on_a();
      result.on_b = r.simplex.turned_on_b() + pair_.offset;
      const Vector3<double> step = r.v / r.distance - result.normal;
      const double before = result.distance;
      // Steps are short if depth and radius are nearly equal; they are lengthened as long as that improves the result.
      const Vector3<double> from = result.normal;
      for (double stretch = 1; stretch < 1e6; stretch *= 2) {
        const Vector3<double> n = (from + stretch * step).normalized();
        const double here = separation(pair_, n);
        if (!(here > result.distance)) break;
        result.distance = here;
        result.normal = n;
      }
      if (!(result.distance > before)) return;
    }
  }

  /// The face that holds the point which the depth's end leaves on the surface, or comes nearest to it: of faces in one
  /// plane the best one need not be it.
  void witness(Penetration& result) const {
    const Vector3<double> x = result.normal * result.distance;
    double least = std::numeric_limits<double>::infinity();
    NearestPoint nearest;
    std::array<double, 4> weight{}, share{};
    std::array<MinkowskiCorner, 3> holder;
    const auto consider = [&](const MinkowskiCorner& c0, const MinkowskiCorner& c1, const MinkowskiCorner& c2) {
      SignedVolumes(nearest, weight).triangle(c0.w - x, c1.w - x, c2.w - x, 0, 1, 2);
      if (nearest.square >= least) return;
      least = nearest.square;
      holder = {c0, c1, c2};
      share = {nearest.used & 1 ? weight[0] : 0, nearest.used & 2 ? weight[1] : 0, nearest.used & 4 ? weight[2] : 0, 0};
    };
    consider(best_face_[0], best_face_[1], best_face_[2]);
    const double there = 4 * std::numeric_limits<double>::epsilon() * polytope_.scale();
    for (int i = 0; i < polytope_.face_count() && least > there * there; ++i) {
      const EpaPolytope::Face& f = polytope_.face(Index(i));
      const double off_plane = f.normal.dot(x) - f.offset;
      if (polytope_.gone(Index(i)) || off_plane * off_plane >= least) continue;
      consider(polytope_.corner(f.corner[0]), polytope_.corner(f.corner[1]), polytope_.corner(f.corner[2]));
    }
    refine(holder[0], holder[1], holder[2], x, share);
    Vector3<double> turned = Vector3<double>::Zero();
    for (std::size_t i = 0; i < 3; ++i) {
      result.on_a += share[i] * holder[i].a;
      turned += share[i] * holder[i].turned_b;
    }
    result.on_b = turned + pair_.offset;
  }

  const MinkowskiPair& pair_;
  EpaPolytope polytope_;
  Vector3<double> flat_normal_, best_normal_;
  double best_reach_ = std::numeric_limits<double>::infinity();
  std::array<MinkowskiCorner, 3> best_face_;
};

}  // namespace

double separation(const MinkowskiPair& pair, const Vector3<double>& n) {
  MinkowskiCorner c;
  pair.support_against(n, c);
  return n.dot(c.w);
}

void polish(const MinkowskiPair& pair, const std::array<MinkowskiCorner, 3>& corners, Penetration& p) {
  const auto consider = [&](const Vector3<double>& n) {
    if (n.isZero(0)) return;
    const double here = separation(pair, n);
    if (here > p.distance) {
      p.distance = here;
      p.normal = n;
    }
  };
  const Vector3<double> n = p.normal;
  if (pair.a.has_faces()) consider(-nearest_face_normal(pair.a, -n));
  if (pair.b.has_faces()) consider(pair.rotation * nearest_face_normal(pair.b, pair.in_b(n)));
  consider(nearest_edge_product(corners[0], corners[1], corners[2], n));
}

Penetration epa(const MinkowskiPair& pair, const GjkResult& start, PairMemory::Shell* shell) {
  Expansion expansion(pair);
  return expansion.run(start.simplex, start.state == GjkResult::State::inside, shell);
}

std::optional<Penetration> epa_again(const MinkowskiPair& pair, PairMemory::Shell& shell) {
  Expansion expansion(pair);
  return expansion.run(shell);
}

}  // namespace polhode::collision::narrow
