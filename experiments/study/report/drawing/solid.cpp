// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report/drawing/solid.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <span>

namespace polhode::study::inline report::inline drawing {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;  // from the first point to the second

/// The numbers of the triangles at which pieces begin: those whose points no earlier triangle has.
std::vector<std::size_t> starts_of_pieces(const Surface& surface) {
  const std::size_t n = surface.corners.size() / 3;
  std::vector<std::uint32_t> least_from(n + 1, std::numeric_limits<std::uint32_t>::max());
  const auto corners = [&](std::size_t k) { return std::span(&surface.corners[3 * k], 3); };
  for (std::size_t k = n; k-- > 0;)
    least_from[k] = std::min(least_from[k + 1], *std::min_element(corners(k).begin(), corners(k).end()));
  std::vector<std::size_t> starts;
  std::uint32_t most = 0;
  for (std::size_t k = 0; k < n; ++k) {
    if (k == 0 || least_from[k] > most) starts.push_back(k);
    most = std::max(most, *std::max_element(corners(k).begin(), corners(k).end()));
  }
  return starts;
}

std::vector<Edge> edges_of(const Piece::Triangle& t) {
  return {{t.corners[0], t.corners[1]}, {t.corners[1], t.corners[2]}, {t.corners[2], t.corners[0]}};
}

/// The closed loops along directed edges, each of which is passed once.
std::vector<std::vector<std::uint32_t>> loops_along(const std::set<Edge>& edges) {
  std::vector<std::vector<std::uint32_t>> loops;
  std::set<Edge> left = edges;
  while (!left.empty()) {
    const std::uint32_t first = left.begin()->first;
    std::vector<std::uint32_t> loop;
    for (std::uint32_t at = first;;) {
      const auto next = left.lower_bound({at, 0});
      if (next == left.end() || next->first != at) break;
      loop.push_back(at);
      at = next->second;
      left.erase(next);
      if (at == first) break;
    }
    if (loop.size() > 2) loops.push_back(std::move(loop));
  }
  return loops;
}

void add_faces(Piece& piece, double size) {
  std::map<std::pair<long, std::array<long, 3>>, std::vector<const Piece::Triangle*>> groups;
  for (const Piece::Triangle& t : piece.triangles) {
    if (!t.flat) continue;
    const Vector3<double> key = 1e4 * t.normal;
    const double offset = t.normal.dot(piece.points[t.corners[0]]);
    groups[{std::lround(1e4 * offset / size), {std::lround(key[0]), std::lround(key[1]), std::lround(key[2])}}]
        .push_back(&t);
  }
  for (const auto& [key, triangles] : groups) {
    std::set<Edge> edges;
    for (const Piece::Triangle* t : triangles) {
      for (const Edge& e : edges_of(*t)) {
        if (edges.erase({e.second, e.first}) == 0) edges.insert(e);
      }
    }
    for (auto& loop : loops_along(edges)) {
      const Vector3<double>& normal = triangles.front()->normal;
      piece.faces.push_back({normal, normal.dot(piece.points[loop.front()]), std::move(loop)});
    }
  }
}

Piece piece_of(const Surface& surface, std::size_t first, std::size_t end) {
  constexpr double along = 0.9999;  // cosine: the normals of a flat face are those of its corners
  Piece piece;
  std::map<std::array<float, 3>, std::uint32_t> numbers;  // a point is stored once for each of its normals
  double size = 0;
  for (std::size_t k = first; k < end; ++k) {
    Piece::Triangle t;
    bool flat = true;
    for (int i = 0; i < 3; ++i) {
      const Vector3<float>& x = surface.points[surface.corners[3 * k + std::size_t(i)]];
      const auto [at, added] = numbers.emplace(std::array{x[0], x[1], x[2]}, std::uint32_t(piece.points.size()));
      if (added) piece.points.push_back(x.cast<double>());
      t.corners[std::size_t(i)] = at->second;
      size = std::max(size, double(x.cwiseAbs().maxCoeff()));
    }
    const auto& p = piece.points;
    t.normal = (p[t.corners[1]] - p[t.corners[0]]).cross(p[t.corners[2]] - p[t.corners[0]]).normalized();
    for (int i = 0; i < 3; ++i) {
      const Vector3<double> normal = surface.normals[surface.corners[3 * k + std::size_t(i)]].cast<double>();
      flat = flat && normal.dot(t.normal) > along;
    }
    t.flat = flat;
    piece.triangles.push_back(t);
  }
  add_faces(piece, size);
  return piece;
}

/// The segments in which a plane x_k = height cuts the curved triangles that face the viewer, joined to lines.
std::vector<SeenPiece::Line> rings_of(const Piece& piece, const std::vector<bool>& front, int k, double height) {
  std::map<Edge, Vector3<double>> cuts;  // cuts of the edges, from < to
  std::map<Edge, std::vector<Edge>> joined;
  for (std::size_t i = 0; i < piece.triangles.size(); ++i) {
    const Piece::Triangle& t = piece.triangles[i];
    if (t.flat || !front[i]) continue;
    std::vector<Edge> crossed;
    for (const auto& [from, to] : edges_of(t)) {
      const double a = piece.points[from][k] - height, b = piece.points[to][k] - height;
      if ((a < 0) == (b < 0)) continue;
      const Edge edge(std::min(from, to), std::max(from, to));
      cuts[edge] = piece.points[from] + a / (a - b) * (piece.points[to] - piece.points[from]);
      crossed.push_back(edge);
    }
    if (crossed.size() != 2) continue;
    joined[crossed[0]].push_back(crossed[1]);
    joined[crossed[1]].push_back(crossed[0]);
  }
  std::vector<SeenPiece::Line> rings;
  std::set<Edge> passed;
  const auto follow = [&](Edge at) {
    SeenPiece::Line line;
    for (bool on = true; on;) {
      passed.insert(at);
      line.push_back(cuts.at(at));
      on = false;
      for (const Edge& next : joined.at(at)) {
        if (passed.contains(next)) continue;
        at = next;
        on = true;
        break;
      }
    }
    if (line.size() > 1) rings.push_back(std::move(line));
  };
  for (const auto& [edge, others] : joined) {
    if (others.size() == 1 && !passed.contains(edge)) follow(edge);
  }
  for (const auto& [edge, others] : joined) {  // those that are closed
    if (!passed.contains(edge)) follow(edge);
  }
  return rings;
}

/// The order of a and b: 1 if b is nearer, -1 if it is further, 0 if no face of a decides.
int side_of(const SeenPiece& a, const SeenPiece& b, const View& view, double touching) {
  for (const auto& [normal, offset] : a.planes) {
    const double facing = normal.dot(view.toward());
    if (std::abs(facing) < 1e-9) continue;
    const bool outside = std::all_of(b.points.begin(), b.points.end(),
                                     [&, n = normal, c = offset](const auto& x) { return n.dot(x) >= c - touching; });
    if (outside) return facing > 0 ? 1 : -1;
  }
  return 0;
}

}  // namespace

std::vector<Piece> pieces_of(const Surface& surface) {
  const auto starts = starts_of_pieces(surface);
  std::vector<Piece> pieces;
  for (std::size_t k = 0; k < starts.size(); ++k)
    pieces.push_back(piece_of(surface, starts[k], k + 1 < starts.size() ? starts[k + 1] : surface.corners.size() / 3));
  return pieces;
}

SeenPiece seen(const Piece& piece, const Pose& pose, const View& view, bool with_rings) {
  const Vector3<double> toward = pose.rotation.transpose() * view.toward();
  const auto line = [&](const std::vector<std::uint32_t>& corners) {
    SeenPiece::Line out;
    for (const std::uint32_t c : corners) out.push_back(pose.to_world(piece.points[c]));
    return out;
  };
  SeenPiece out;
  std::vector<bool> front(piece.triangles.size());
  std::set<Edge> border;
  for (std::size_t i = 0; i < piece.triangles.size(); ++i) {
    front[i] = piece.triangles[i].normal.dot(toward) > 1e-9;
    if (!front[i]) continue;
    for (const Edge& e : edges_of(piece.triangles[i])) {
      if (border.erase({e.second, e.first}) == 0) border.insert(e);
    }
  }
  for (const auto& loop : loops_along(border)) out.outlines.push_back(line(loop));
  for (const Piece::Face& face : piece.faces) {
    const Vector3<double> normal = pose.rotation * face.normal;
    out.planes.emplace_back(normal, face.offset + normal.dot(pose.position));
    if (face.normal.dot(toward) > 1e-9) out.faces.push_back({line(face.corners), normal});
  }
  Eigen::AlignedBox3d around;
  for (const Vector3<double>& x : piece.points) {
    around.extend(x);
    out.points.push_back(pose.to_world(x));
  }
  out.centre = pose.to_world(around.center());
  for (int k = 0; k < 3 && with_rings; ++k) {
    // A little beside the middle, so that no point is on the plane.
    const double height = around.center()[k] + 1e-6 * around.sizes()[k];
    for (SeenPiece::Line ring : rings_of(piece, front, k, height)) {
      for (Vector3<double>& x : ring) x = pose.to_world(x);
      out.rings.push_back(std::move(ring));
    }
  }
  return out;
}

std::vector<std::size_t> painting_order(const std::vector<SeenPiece>& pieces, const View& view) {
  constexpr std::size_t most_compared = 200;
  std::vector<std::size_t> by_depth(pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) by_depth[i] = i;
  std::stable_sort(by_depth.begin(), by_depth.end(), [&](std::size_t a, std::size_t b) {
    return view.depth(pieces[a].centre) < view.depth(pieces[b].centre);
  });
  if (pieces.size() > most_compared) return by_depth;
  // behind[i]: pieces that are painted before piece i.
  std::vector<std::set<std::size_t>> behind(pieces.size());
  std::vector<Eigen::AlignedBox2d> boxes(pieces.size());
  double size = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    for (const auto& x : pieces[i].points) boxes[i].extend(PagePoint(view.direction(x)));
    size = std::max(size, boxes[i].sizes().maxCoeff());
  }
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    for (std::size_t j = i + 1; j < pieces.size(); ++j) {
      if (!boxes[i].intersects(boxes[j])) continue;
      int side = side_of(pieces[i], pieces[j], view, 1e-3 * size);
      if (side == 0) side = -side_of(pieces[j], pieces[i], view, 1e-3 * size);
      if (side == 0) side = view.depth(pieces[j].centre) >= view.depth(pieces[i].centre) ? 1 : -1;
      if (side > 0) behind[j].insert(i);
      else behind[i].insert(j);
    }
  }
  std::vector<std::size_t> order;
  std::vector<bool> painted(pieces.size());
  while (order.size() < pieces.size()) {
    const auto free = [&](std::size_t i) {
      return !painted[i] && std::all_of(behind[i].begin(), behind[i].end(), [&](auto k) { return painted[k]; });
    };
    auto next = std::find_if(by_depth.begin(), by_depth.end(), free);
    if (next == by_depth.end())  // each hides another: the furthest first
      next = std::find_if(by_depth.begin(), by_depth.end(), [&](auto i) { return !painted[i]; });
    painted[*next] = true;
    order.push_back(*next);
  }
  return order;
}

}  // namespace polhode::study::report::drawing
