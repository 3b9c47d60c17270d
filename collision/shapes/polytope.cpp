// SPDX-License-Identifier: BSD-3-Clause
#include "collision/shapes/polytope.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

namespace polhode::inline collision::inline shapes {

namespace {

/// Newell's normal of a polygon, which need not be quite plane, with the offset that leaves all its corners behind.
void set_plane(Polytope::Face& face, const std::vector<Vector3<double>>& vertices,
               const std::vector<std::uint32_t>& loop) {
  Vector3<double> sum = Vector3<double>::Zero();
  const Vector3<double>& origin = vertices[loop[0]];
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    const Vector3<double> a = vertices[loop[i]] - origin, b = vertices[loop[i + 1]] - origin;
    sum += a.cross(b);
  }
  face.normal = sum.stableNormalized();
  face.offset = face.normal.dot(origin);
  for (const std::uint32_t v : loop) face.offset = std::max(face.offset, face.normal.dot(vertices[v]));
}

/// Pairs (row, entry), sorted, as rows.
void set_rows(std::vector<std::uint32_t>& first, std::vector<std::uint32_t>& entries, std::size_t rows,
              std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs) {
  std::sort(pairs.begin(), pairs.end());
  first.assign(rows + 1, 0);
  for (const auto& [row, entry] : pairs) {
    ++first[row + 1];
    entries.push_back(entry);
  }
  for (std::size_t i = 0; i < rows; ++i) first[i + 1] += first[i];
}

}  // namespace

Polytope make_polytope(std::vector<Vector3<double>> vertices, const std::vector<std::vector<std::uint32_t>>& loops) {
  Polytope p;
  p.vertices = std::move(vertices);
  std::vector<std::array<std::uint32_t, 5>> half_edges;  // smaller vertex, larger, turned round, face, corner
  std::vector<std::pair<std::uint32_t, std::uint32_t>> joined, around;
  for (const auto& loop : loops) {
    if (loop.size() < 3) throw std::invalid_argument("a face of a polytope needs 3 corners");
    Polytope::Face face;
    face.first = std::uint32_t(p.corners.size());
    face.count = std::uint32_t(loop.size());
    set_plane(face, p.vertices, loop);
    const auto number = std::uint32_t(p.faces.size());
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t from = loop[i], to = loop[(i + 1) % loop.size()];
      half_edges.push_back(
          {std::min(from, to), std::max(from, to), from > to, number, std::uint32_t(p.corners.size())});
      p.corners.push_back({from, 0});
      joined.emplace_back(from, to);
      around.emplace_back(from, number);
    }
    p.faces.push_back(face);
  }
  std::sort(half_edges.begin(), half_edges.end());
  for (std::size_t i = 0; i < half_edges.size(); i += 2) {
    const bool pair = i + 1 < half_edges.size() && half_edges[i][0] == half_edges[i + 1][0] &&
                      half_edges[i][1] == half_edges[i + 1][1] && half_edges[i][2] == 0 && half_edges[i + 1][2] == 1;
    if (!pair) throw std::invalid_argument("the faces of a polytope leave a gap, or meet more than two at an edge");
    for (const std::size_t k : {i, i + 1}) p.corners[half_edges[k][4]].edge = std::uint32_t(p.edges.size());
    p.edges.push_back({half_edges[i][0], half_edges[i][1], half_edges[i][3], half_edges[i + 1][3]});
  }
  for (std::size_t i = 1; i < p.edges.size(); ++i) {
    if (p.edges[i].from == p.edges[i - 1].from && p.edges[i].to == p.edges[i - 1].to) {
      throw std::invalid_argument("the faces of a polytope meet more than two at an edge");
    }
  }
  set_rows(p.neighbours_.first, p.neighbours_.entries, p.vertices.size(), std::move(joined));
  set_rows(p.vertex_faces_.first, p.vertex_faces_.entries, p.vertices.size(), std::move(around));
  return p;
}

}  // namespace polhode::collision::shapes
