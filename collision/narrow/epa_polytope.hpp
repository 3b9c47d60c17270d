// SPDX-License-Identifier: BSD-3-Clause
// The polytope that EPA expands: triangles whose corners are points of the difference, with their adjacency.
//
// If the triangles form a closed surface, and the origin is behind each of them, the polytope contains the ball about
// the origin that reaches to the nearest of their planes: the winding number about every point of that ball is not
// zero. The polytope need not be convex for that, so a polytope kept from an earlier query proves as much after the
// shapes have moved.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>

#include "collision/narrow/simplex.hpp"
#include "collision/narrow_phase.hpp"

namespace polhode::inline collision::inline narrow {

class EpaPolytope {
 public:
  using Index = std::uint16_t;
  static constexpr int corner_room = 512, face_room = 2 * corner_room;  // Euler: n corners have 2n − 4 triangles

  struct Face {
    Vector3<double> normal;       ///< outward unit normal; zero: the face has no area
    double offset;                ///< normal·x on the face
    std::array<Index, 3> corner;  ///< counter-clockwise seen from outside
    std::array<Index, 3> across;  ///< number of side i, from corner i to corner i + 1, in the adjacent face
  };

  int corner_count() const { return corner_count_; }
  int face_count() const { return face_count_; }
  const MinkowskiCorner& corner(Index i) const { return corners_[i]; }
  bool gone(Index i) const { return gone_[i]; }  ///< the face was removed, and its slot is free
  const Face& face(Index i) const { return faces_[i]; }
  double scale() const { return scale_; }  ///< the largest |w| so far, to which round-off is relative, m

  void met(double size) { scale_ = std::max(scale_, size); }
  void clear() { corner_count_ = face_count_ = free_count_ = 0; }
  Index add_corner(const MinkowskiCorner& c);
  bool has_corner(const MinkowskiCorner& c) const;
  bool full() const { return corner_count_ == corner_room; }

  /// Makes a tetrahedron of the first four corners.
  void close_tetrahedron();

  /// The face nearest to the origin among those that are not retired.
  std::optional<Index> nearest_face() const;
  void retire(Index face) { key_[face] = std::numeric_limits<double>::infinity(); }

  /// Replaces all faces visible from the new corner by a cone from it. Returns false if their rim is no simple loop, or
  /// if there is no room left.
  bool grow(Index seen, const MinkowskiCorner& next);

  /// Copies the polytope to the shell. Returns false if it has too many corners or faces.
  bool save(PairMemory::Shell& shell) const;
  /// Restores the polytope. Returns false if the origin is not behind all faces.
  bool load(const MinkowskiPair& pair, const PairMemory::Shell& shell);

 private:
  /// Side k of face f.
  static Index side_of(int f, int k) { return Index(4 * f + k); }
  void put_face(int f, Index a, Index b, Index c);
  bool sees(const Face& f, const Vector3<double>& x) const;

  double scale_ = 0;
  int corner_count_ = 0, face_count_ = 0, free_count_ = 0;
  std::array<double, face_room + 8> key_;  ///< offset; +inf for a face that is retired or has no area
  std::array<bool, face_room> gone_;
  std::array<Face, face_room> faces_;
  std::array<MinkowskiCorner, corner_room> corners_;
  std::array<Index, face_room> rim_, gone_list_, free_;
  std::array<Index, 3 * face_room> open_;
};

}  // namespace polhode::collision::narrow
