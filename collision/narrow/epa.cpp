// SPDX-License-Identifier: BSD-3-Clause
// Every face that is looked at gives an upper bound of the depth, the support along its normal, and the smallest one
// met is what is reported: a bad normal of a sliver can cost time but never truth. Each pass adds a corner or retires a
// face, so the search ends; when its room is full it reports the best bound.
#include "collision/narrow/epa.hpp"

#include <algorithm>

#include "collision/narrow/face_normals.hpp"

namespace polhode {

namespace {

constexpr std::uint16_t none = 0xffff;
constexpr int corner_room = 512, face_room = 4 * corner_room;

struct Face {
  Vector3<double> normal;                  ///< unit, outward
  double offset;                           ///< normal·x on the face
  std::array<std::uint16_t, 3> corner;     ///< counter-clockwise seen from outside
  std::array<std::uint16_t, 3> neighbour;  ///< across the side from corner i to corner i + 1
  bool gone;
};

/// A perpendicular unit vector.
Vector3<double> across(const Vector3<double>& d) { return d.unitOrthogonal(); }

class Expansion {
 public:
  explicit Expansion(const MinkowskiPair& pair) : pair_(pair) {}

  Penetration run(const Simplex& start) {
    for (int i = 0; i < start.count; ++i) add_corner(start.corners[std::size_t(i)]);
    const int dimension = span_space();
    Penetration result;
    if (dimension < 3) {
      result.normal = flat_normal_;
      result.distance = separation(pair_, flat_normal_);
      result.on_a = start.on_a();
      result.on_b = start.on_b();
      return result;
    }
    first_tetrahedron();
    expand();
    result.normal = -best_normal_;
    result.distance = -best_reach_;
    polish(result);
    witness(result);
    return result;
  }

 private:
  const Vector3<double>& w(std::uint16_t i) const { return corners_[i].w; }

  std::uint16_t add_corner(const MinkowskiCorner& c) {
    scale_ = std::max(scale_, c.w.norm());
    corners_[std::size_t(corner_count_)] = c;
    return std::uint16_t(corner_count_++);
  }

  /// Extends the corners to a tetrahedron with room inside; the dimension reached. Below 3, `flat_normal_` is
  /// perpendicular to the whole difference.
  int span_space() {
    std::array<MinkowskiCorner, 4> found{};
    const int given = corner_count_;
    std::array<MinkowskiCorner, 4> start{};
    for (int i = 0; i < given; ++i) start[std::size_t(i)] = corners_[std::size_t(i)];
    corner_count_ = 0;
    found[0] = given > 0 ? start[0] : pair_.support(Vector3<double>::UnitX());

    // Of the simplex's own corners and of those furthest along some directions, the one that is furthest off.
    const auto choose = [&](const auto& directions, const auto& off) {
      double most = -1;
      MinkowskiCorner best = found[0];
      const auto consider = [&](const MinkowskiCorner& c) {
        scale_ = std::max(scale_, c.w.norm());
        const double here = off(c);
        if (here > most) {
          most = here;
          best = c;
        }
      };
      for (int i = 0; i < given; ++i) consider(start[std::size_t(i)]);
      if (most > 1e-3 * scale_) return std::pair(most, best);
      for (const Vector3<double>& d : directions) {
        consider(pair_.support(d));
        consider(pair_.support(-d));
      }
      return std::pair(most, best);
    };

    const std::array<Vector3<double>, 3> axes = {Vector3<double>::UnitX(), Vector3<double>::UnitY(), Vector3<double>::UnitZ()};
    const auto [length, second] = choose(axes, [&](const MinkowskiCorner& c) { return pair_.edge(found[0], c).norm(); });
    scale_ = std::max(scale_, pair_.offset.norm());
    if (length <= flat_share * scale_) {
      // Two points: apart they tell the normal, together any will do.
      flat_normal_ = found[0].w.norm() > 0 ? found[0].w.stableNormalized() : Vector3<double>::UnitZ();
      return 0;
    }
    found[1] = second;
    const Vector3<double> along = pair_.edge(found[0], found[1]).stableNormalized();
    const Vector3<double> side = across(along), other = along.cross(side);
    const std::array<Vector3<double>, 4> sides = {side, other, side + other, side - other};
    const auto [width, third] =
        choose(sides, [&](const MinkowskiCorner& c) { return pair_.edge(found[0], c).cross(along).norm(); });
    if (width <= flat_share * scale_) {
      flat_normal_ = side;
      return 1;
    }
    found[2] = third;
    const Vector3<double> normal = along.cross(pair_.edge(found[0], found[2])).stableNormalized();
    const std::array<Vector3<double>, 1> up = {normal};
    const auto [height, fourth] =
        choose(up, [&](const MinkowskiCorner& c) { return std::abs(pair_.edge(found[0], c).dot(normal)); });
    if (height <= flat_share * scale_) {
      flat_normal_ = separation(pair_, normal) >= separation(pair_, -normal) ? normal : Vector3<double>(-normal);
      return 2;
    }
    found[3] = fourth;
    for (const MinkowskiCorner& c : found) add_corner(c);
    return 3;
  }

  void set_plane(Face& f) {
    const MinkowskiCorner&a = corners_[f.corner[0]], &b = corners_[f.corner[1]], &c = corners_[f.corner[2]];
    const Vector3<double> u = pair_.edge(a, b), v = pair_.edge(a, c), x = pair_.edge(b, c);
    const Vector3<double> n = accurate_cross(u, v);
    const double size = n.norm(), longest = std::max({u.squaredNorm(), v.squaredNorm(), x.squaredNorm()});
    f.gone = false;
    if (size > 1e-15 * longest) {
      f.normal = n / size;
      f.offset = std::max({f.normal.dot(a.w), f.normal.dot(b.w), f.normal.dot(c.w)});
    } else {  // no area: never expanded, and hidden by no corner but its neighbours' loss
      f.normal.setZero();
      f.offset = 0;
    }
  }

  std::uint16_t add_face(std::uint16_t a, std::uint16_t b, std::uint16_t c) {
    const auto i = std::uint16_t(face_count_++);
    Face& f = faces_[i];
    f.corner = {a, b, c};
    f.neighbour = {none, none, none};
    set_plane(f);
    if (!f.normal.isZero(0)) push(i);
    return i;
  }

  void push(std::uint16_t i) {
    heap_[std::size_t(heap_size_++)] = {faces_[i].offset, i};
    std::push_heap(heap_.begin(), heap_.begin() + heap_size_, later);
  }

  void first_tetrahedron() {
    const Vector3<double> u = pair_.edge(corners_[0], corners_[1]), v = pair_.edge(corners_[0], corners_[2]),
                          x = pair_.edge(corners_[0], corners_[3]);
    if (u.cross(v).dot(x) > 0) std::swap(corners_[0], corners_[1]);  // corner 3 behind the face 0 1 2
    add_face(0, 1, 2);
    add_face(0, 3, 1);
    add_face(1, 3, 2);
    add_face(2, 3, 0);
    faces_[0].neighbour = {1, 2, 3};
    faces_[1].neighbour = {3, 2, 0};
    faces_[2].neighbour = {1, 3, 0};
    faces_[3].neighbour = {2, 1, 0};
  }

  void expand() {
    while (heap_size_ > 0) {
      const auto [offset, at] = heap_[0];
      std::pop_heap(heap_.begin(), heap_.begin() + heap_size_, later);
      --heap_size_;
      const Face& face = faces_[at];
      if (face.gone) continue;
      if (offset >= best_reach_ - stop_share * scale_) return;
      const MinkowskiCorner next = pair_.support(face.normal);
      const double reach = face.normal.dot(next.w);
      if (reach < best_reach_) {
        best_reach_ = reach;
        best_normal_ = face.normal;
        best_face_ = face.corner;
      }
      if (reach - offset <= stop_share * scale_) continue;
      bool met = false;
      for (int i = 0; i < corner_count_; ++i) met = met || corners_[std::size_t(i)].w == next.w;
      if (met) continue;
      if (corner_count_ == corner_room) return;
      if (!grow(at, next)) return;
    }
  }

  /// Puts a cone from the new corner in the place of all faces that it sees. False where the rim is no simple loop or
  /// the room is full.
  bool grow(std::uint16_t seen, const MinkowskiCorner& next) {
    rim_count_ = 0;
    faces_[seen].gone = true;
    for (int side = 0; side < 3; ++side) {
      if (!walk(faces_[seen].neighbour[std::size_t(side)], seen, next.w)) return false;
    }
    if (rim_count_ < 3 || face_count_ + rim_count_ > face_room) return false;
    const std::uint16_t top = add_corner(next);
    const int first = face_count_;
    for (int i = 0; i < rim_count_; ++i) {
      const Rim& r = rim_[std::size_t(i)];
      const std::uint16_t f = add_face(r.from, r.to, top);
      faces_[f].neighbour[0] = r.outer;
      Face& outer = faces_[r.outer];
      for (std::size_t k = 0; k < 3; ++k) {
        if (outer.corner[k] == r.to && outer.corner[(k + 1) % 3] == r.from) outer.neighbour[k] = f;
      }
      const int before = first + (i + rim_count_ - 1) % rim_count_, after = first + (i + 1) % rim_count_;
      faces_[f].neighbour[1] = std::uint16_t(after);
      faces_[f].neighbour[2] = std::uint16_t(before);
      if (rim_[std::size_t((i + 1) % rim_count_)].from != r.to) return false;
    }
    return true;
  }

  struct Step {
    std::uint16_t face, from;
    int next;
  };

  /// Depth first round the faces that the corner sees, so that the rim comes out in order.
  bool walk(std::uint16_t start, std::uint16_t from, const Vector3<double>& x) {
    int depth = 0;
    const auto enter = [&](std::uint16_t face, std::uint16_t previous) {
      Face& f = faces_[face];
      if (f.gone) return true;
      std::size_t side = 0;
      while (side < 3 && f.neighbour[side] != previous) ++side;
      if (side == 3) return false;
      // A face whose plane holds the corner goes too, so that no sliver is left beside it.
      const bool visible = f.normal.isZero(0) || f.normal.dot(x) - f.offset > -2 * std::numeric_limits<double>::epsilon() * scale_;
      if (!visible) {
        if (rim_count_ == corner_room) return false;
        rim_[std::size_t(rim_count_++)] = {f.corner[(side + 1) % 3], f.corner[side], face};
        return true;
      }
      f.gone = true;
      if (depth == corner_room) return false;
      steps_[std::size_t(depth++)] = {face, std::uint16_t(side), 1};
      return true;
    };
    if (!enter(start, from)) return false;
    while (depth > 0) {
      Step& s = steps_[std::size_t(depth - 1)];
      if (s.next > 2) {
        --depth;
        continue;
      }
      const std::size_t side = (s.from + std::size_t(s.next)) % 3;
      ++s.next;
      const std::uint16_t face = s.face;
      if (!enter(faces_[face].neighbour[side], face)) return false;
    }
    return true;
  }

  /// The best face found is that of a feature of the shapes, whose normal they know to the last digit: a face of either,
  /// or the product of two edges.
  void polish(Penetration& result) const {
    const auto consider = [&](const Vector3<double>& n) {
      if (n.isZero(0)) return;
      const double here = separation(pair_, n);
      if (here > result.distance) {
        result.distance = here;
        result.normal = n;
      }
    };
    const Vector3<double> n = result.normal;
    if (pair_.a.has_faces()) consider(-nearest_face_normal(pair_.a, -n));
    if (pair_.b.has_faces()) consider(pair_.rotation * nearest_face_normal(pair_.b, pair_.rotation.transpose() * n));
    consider(nearest_edge_product(pair_, corners_[best_face_[0]], corners_[best_face_[1]], corners_[best_face_[2]], n));
  }

  /// The face that holds the point which the depth's end leaves on the surface, or comes nearest to it: of faces in one
  /// plane the best one need not be it.
  void witness(Penetration& result) const {
    const Vector3<double> x = result.normal * result.distance;
    NearestPoint nearest;
    nearest.square = std::numeric_limits<double>::infinity();
    const Face* holder = nullptr;
    for (int i = 0; i < face_count_; ++i) {
      const Face& f = faces_[std::size_t(i)];
      if (f.gone || f.normal.dot(result.normal) > -0.5) continue;
      const NearestPoint p =
          SignedVolumes::triangle(w(f.corner[0]) - x, w(f.corner[1]) - x, w(f.corner[2]) - x, 0, 1, 2);
      if (p.square >= nearest.square) continue;
      nearest = p;
      holder = &f;
    }
    if (!holder) return;
    for (int i = 0; i < nearest.count; ++i) {
      const double share = nearest.weight[std::size_t(i)];
      const MinkowskiCorner& corner = corners_[holder->corner[std::size_t(nearest.kept[std::size_t(i)])]];
      result.on_a += share * corner.a;
      result.on_b += share * corner.b;
    }
  }

  static constexpr double flat_share = 1e-13;
  struct Rim {
    std::uint16_t from, to, outer;
  };
  struct Queued {
    double offset;
    std::uint16_t face;
  };
  static bool later(const Queued& x, const Queued& y) {
    return x.offset > y.offset || (x.offset == y.offset && x.face > y.face);
  }

  const MinkowskiPair& pair_;
  double scale_ = 0;
  int corner_count_ = 0, face_count_ = 0, heap_size_ = 0, rim_count_ = 0;
  Vector3<double> flat_normal_, best_normal_;
  double best_reach_ = std::numeric_limits<double>::infinity();
  std::array<std::uint16_t, 3> best_face_{};
  std::array<MinkowskiCorner, corner_room> corners_;
  std::array<Face, face_room> faces_;
  std::array<Queued, face_room> heap_;
  std::array<Rim, corner_room> rim_;
  std::array<Step, corner_room> steps_;
};

}  // namespace

double separation(const MinkowskiPair& pair, const Vector3<double>& n) { return n.dot(pair.support(-n).w); }

Penetration epa(const MinkowskiPair& pair, const Simplex& start) {
  Expansion expansion(pair);
  return expansion.run(start);
}

}  // namespace polhode
