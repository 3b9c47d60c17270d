// SPDX-License-Identifier: BSD-3-Clause
#include "collision/narrow/epa_polytope.hpp"

#include <algorithm>

#include "collision/narrow/gjk_loop.hpp"

namespace polhode::inline collision::inline narrow {

EpaPolytope::Index EpaPolytope::add_corner(const MinkowskiCorner& c) {
  met(c.w.norm());
  corners_[std::size_t(corner_count_)] = c;
  return Index(corner_count_++);
}

bool EpaPolytope::has_corner(const MinkowskiCorner& c) const {
  bool found = false;
  for (int i = 0; i < corner_count_; ++i) found |= corners_[std::size_t(i)] == c;
  return found;
}

void EpaPolytope::put_face(int i, Index a, Index b, Index c) {
  Face& f = faces_[std::size_t(i)];
  f.corner = {a, b, c};
  gone_[std::size_t(i)] = false;
  const MinkowskiCorner &p = corners_[a], &q = corners_[b], &r = corners_[c];
  const Vector3<double> u = edge(p, q), v = edge(p, r), n = u.cross(v);
  const double square = n.squaredNorm(), longest = std::max(u.squaredNorm(), v.squaredNorm());
  if (square > 1e-30 * longest * longest) {
    const double size = std::sqrt(square);
    f.normal = n / size;
    f.offset = std::max({f.normal.dot(p.w), f.normal.dot(q.w), f.normal.dot(r.w)});
    key_[std::size_t(i)] = f.offset;
  } else {  // never expanded, and hidden by no corner but its neighbours' loss
    f.normal.setZero();
    f.offset = 0;
    key_[std::size_t(i)] = std::numeric_limits<double>::infinity();
  }
}

void EpaPolytope::close_tetrahedron() {
  const Vector3<double> u = edge(corners_[0], corners_[1]), v = edge(corners_[0], corners_[2]),
                        x = edge(corners_[0], corners_[3]);
  if (u.cross(v).dot(x) > 0) std::swap(corners_[0], corners_[1]);  // corner 3 must be behind the face 0 1 2
  put_face(0, 0, 1, 2);
  put_face(1, 0, 3, 1);
  put_face(2, 1, 3, 2);
  put_face(3, 2, 3, 0);
  face_count_ = 4;
  faces_[0].across = {side_of(1, 2), side_of(2, 2), side_of(3, 2)};
  faces_[1].across = {side_of(3, 1), side_of(2, 0), side_of(0, 0)};
  faces_[2].across = {side_of(1, 1), side_of(3, 0), side_of(0, 1)};
  faces_[3].across = {side_of(2, 1), side_of(1, 0), side_of(0, 2)};
}

std::optional<EpaPolytope::Index> EpaPolytope::nearest_face() const {
  double least = std::numeric_limits<double>::infinity();
  int best = -1;
  for (int i = 0; i < face_count_; ++i) {
    const double here = key_[std::size_t(i)];
    best = here < least ? i : best;
    least = here < least ? here : least;
  }
  if (best < 0) return std::nullopt;
  return Index(best);
}

/// A face whose plane holds the corner goes too, so that no sliver is left beside it.
bool EpaPolytope::sees(const Face& f, const Vector3<double>& x) const {
  return f.normal.dot(x) - f.offset > -2 * std::numeric_limits<double>::epsilon() * scale_ || f.normal.isZero(0);
}

bool EpaPolytope::grow(Index seen, const MinkowskiCorner& next) {
  int open = 0, rim = 0, gone = 0;
  const auto enter = [&](Index face, int first) {
    gone_[face] = true;
    gone_list_[std::size_t(gone++)] = face;
    for (int k = 2; k >= first; --k) {
      open_[std::size_t(open++)] = faces_[face].across[std::size_t(k)];
    }
  };
  // The faces that are visible from the corner are visited depth first, so that the rim comes out in order.
  enter(seen, 0);
  while (open > 0) {
    const Index side = open_[std::size_t(--open)];
    const Index face = side / 4;
    if (gone_[face]) continue;
    if (!sees(faces_[face], next.w)) {
      rim_[std::size_t(rim++)] = side;
      continue;
    }
    gone_[face] = true;
    gone_list_[std::size_t(gone++)] = face;
    const unsigned k = side % 4u;
    open_[std::size_t(open++)] = faces_[face].across[k == 0 ? 2 : k - 1];
    open_[std::size_t(open++)] = faces_[face].across[k == 2 ? 0 : k + 1];
  }
  const auto from = [&](Index side) { return faces_[side / 4].corner[side % 4 == 2 ? 0 : side % 4 + 1]; };
  const auto to = [&](Index side) { return faces_[side / 4].corner[side % 4]; };
  bool loop = rim >= 3 && face_count_ + std::max(rim - gone - free_count_, 0) <= face_room;
  for (int i = 0; i < rim && loop; ++i)
    loop = from(rim_[std::size_t(i + 1 == rim ? 0 : i + 1)]) == to(rim_[std::size_t(i)]);
  if (!loop) {
    while (gone > 0) gone_[gone_list_[std::size_t(--gone)]] = false;
    return false;
  }
  // Places for the new faces: those of the old ones, left ones, new ones.
  while (gone > rim) {
    retire(gone_list_[std::size_t(--gone)]);
    free_[std::size_t(free_count_++)] = gone_list_[std::size_t(gone)];
  }
  while (gone < rim)
    gone_list_[std::size_t(gone++)] = free_count_ > 0 ? free_[std::size_t(--free_count_)] : Index(face_count_++);
  const Index top = add_corner(next);
  for (int i = 0; i < rim; ++i) {
    const Index made = gone_list_[std::size_t(i)], outer = rim_[std::size_t(i)];
    put_face(made, from(outer), to(outer), top);
    Face& f = faces_[made];
    f.across = {outer, side_of(gone_list_[std::size_t(i + 1 == rim ? 0 : i + 1)], 2),
                side_of(gone_list_[std::size_t(i == 0 ? rim - 1 : i - 1)], 1)};
    faces_[outer / 4].across[outer % 4] = side_of(made, 0);
  }
  return true;
}

bool EpaPolytope::save(PairMemory::Shell& shell) const {
  shell.corner_count = shell.face_count = 0;
  if (corner_count_ > PairMemory::Shell::corner_room) return false;
  for (int i = 0; i < corner_count_; ++i) {
    const MinkowskiCorner& c = corners_[std::size_t(i)];
    shell.corners[std::size_t(i)] = {c.vertex_a, c.vertex_b};
  }
  for (int i = 0; i < face_count_; ++i) {
    if (gone_[std::size_t(i)]) continue;
    const auto& corner = faces_[std::size_t(i)].corner;
    shell.faces[shell.face_count++] = {std::uint8_t(corner[0]), std::uint8_t(corner[1]), std::uint8_t(corner[2])};
  }
  shell.corner_count = std::uint8_t(corner_count_);
  return true;
}

bool EpaPolytope::load(const MinkowskiPair& pair, const PairMemory::Shell& shell) {
  clear();
  double square = 0;
  for (int i = 0; i < shell.corner_count; ++i) {
    const auto [of_a, of_b] = shell.corners[std::size_t(i)];
    if (of_a >= pair.a.vertex_count() || of_b >= pair.b.vertex_count()) return false;
    MinkowskiCorner& c = corners_[std::size_t(i)];
    pair.corner(of_a, of_b, c);
    square = std::max(square, c.w.squaredNorm());
  }
  met(std::sqrt(square));
  corner_count_ = shell.corner_count;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < shell.face_count; ++i) {
    const auto& corner = shell.faces[std::size_t(i)];
    put_face(i, corner[0], corner[1], corner[2]);
    least = std::min(least, faces_[std::size_t(i)].offset);
  }
  face_count_ = shell.face_count;
  if (!(least > near_share * scale_)) return false;
  // Two faces that share a side name its ends in opposite order.
  constexpr int room = PairMemory::Shell::corner_room;
  std::array<Index, room * room> side;
  for (int i = 0; i < face_count_; ++i) {
    const auto& c = shell.faces[std::size_t(i)];
    for (int k = 0; k < 3; ++k)
      side[std::size_t(room * c[std::size_t(k)] + c[std::size_t((k + 1) % 3)])] = side_of(i, k);
  }
  for (int i = 0; i < face_count_; ++i) {
    const auto& c = shell.faces[std::size_t(i)];
    for (int k = 0; k < 3; ++k) {
      faces_[std::size_t(i)].across[std::size_t(k)] =
          side[std::size_t(room * c[std::size_t((k + 1) % 3)] + c[std::size_t(k)])];
    }
  }
  return true;
}

}  // namespace polhode::collision::narrow
