// SPDX-License-Identifier: BSD-3-Clause
// The surface of a convex polytope: vertices, polygonal faces, edges with their two faces, and adjacency.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/math/linear_algebra.hpp"

namespace polhode::inline collision::inline shapes {

struct Polytope {
  struct Face {
    Vector3<double> normal = Vector3<double>::Zero();  ///< outward unit normal
    double offset = 0;                                 ///< normal·x ≤ offset for all points of the polytope, m
    std::uint32_t first = 0, count = 0;                ///< its corners in `corners`: the first, and how many
  };
  /// An edge; from < to. Seen from outside, face `left` passes it from `from` to `to`, face `right` in the opposite
  /// direction.
  struct Edge {
    std::uint32_t from = 0, to = 0, left = 0, right = 0;
  };
  /// A corner of a face is a half-edge: it starts at `vertex` and lies on `edge`.
  struct Corner {
    std::uint32_t vertex = 0, edge = 0;
  };

  std::vector<Vector3<double>> vertices;
  std::vector<Face> faces;
  std::vector<Corner> corners;  ///< corners of all faces, face after face, counter-clockwise seen from outside
  std::vector<Edge> edges;      ///< sorted by from, then to

  std::span<const Corner> corners_of(std::uint32_t face) const {
    return {&corners[faces[face].first], faces[face].count};
  }
  /// The neighbours of a vertex, which are the other ends of its edges, and its faces, both sorted.
  std::span<const std::uint32_t> neighbours_of(std::uint32_t vertex) const { return row(neighbours_, vertex); }
  std::span<const std::uint32_t> faces_of(std::uint32_t vertex) const { return row(vertex_faces_, vertex); }

 private:
  friend Polytope make_polytope(std::vector<Vector3<double>>, const std::vector<std::vector<std::uint32_t>>&);
  struct Rows {
    std::vector<std::uint32_t> first, entries;
  };
  static std::span<const std::uint32_t> row(const Rows& rows, std::uint32_t i) {
    return {rows.entries.data() + rows.first[i], rows.first[i + 1] - rows.first[i]};
  }
  Rows neighbours_, vertex_faces_;
};

/// Builds the surface from faces as loops of vertex numbers, counter-clockwise seen from outside. Throws
/// std::invalid_argument unless every edge has exactly two faces that pass it in opposite directions.
Polytope make_polytope(std::vector<Vector3<double>> vertices, const std::vector<std::vector<std::uint32_t>>& loops);

}  // namespace polhode::collision::shapes
