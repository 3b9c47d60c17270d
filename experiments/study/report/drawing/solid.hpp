// SPDX-License-Identifier: BSD-3-Clause
// A surface of triangles as closed pieces with flat faces: from it follow the outline of a piece, the faces and the
// lines that a viewer sees.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "collision/pose.hpp"
#include "experiments/study/report/drawing/view.hpp"
#include "experiments/study/scene/surface.hpp"

namespace polhode::study::inline report::inline drawing {

/// A closed piece of a surface, in the axes of the shape. Each convex piece of a compound is a piece.
struct Piece {
  struct Face {
    Vector3<double> normal = Vector3<double>::Zero();  ///< outward unit normal
    double offset = 0;                                 ///< value of normal·x on the face, m
    std::vector<std::uint32_t> corners;                ///< points, counter-clockwise seen from outside
  };
  struct Triangle {
    std::array<std::uint32_t, 3> corners{};  ///< points, counter-clockwise seen from outside
    Vector3<double> normal = Vector3<double>::Zero();
    bool flat = false;  ///< it is part of a face
  };
  std::vector<Vector3<double>> points;  ///< m
  std::vector<Triangle> triangles;
  std::vector<Face> faces;
};

std::vector<Piece> pieces_of(const Surface& surface);

/// A piece as the viewer sees it, in world axes (m).
struct SeenPiece {
  using Line = std::vector<Vector3<double>>;
  struct Face {
    Line corners;
    Vector3<double> normal = Vector3<double>::Zero();
  };
  std::vector<Line> outlines;  ///< closed
  std::vector<Face> faces;     ///< flat faces towards the viewer
  std::vector<Line> rings;     ///< curves on the rest of the surface, in planes through the middle along the body axes
  std::vector<Vector3<double>> points;
  std::vector<std::pair<Vector3<double>, double>> planes;  ///< outward normal and offset (m) of each flat face
  Vector3<double> centre = Vector3<double>::Zero();
};

/// `with_rings`: false leaves the rings out.
SeenPiece seen(const Piece& piece, const Pose& pose, const View& view, bool with_rings);

/// The pieces in the order in which they are painted, the furthest first. Of two convex pieces that a face of either
/// separates, the one on the viewer's side of it comes later.
std::vector<std::size_t> painting_order(const std::vector<SeenPiece>& pieces, const View& view);

}  // namespace polhode::study::report::drawing
