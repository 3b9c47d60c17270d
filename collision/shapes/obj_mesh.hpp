// SPDX-License-Identifier: BSD-3-Clause
// The polygon mesh of a Wavefront OBJ file, in its pieces: the lines v, f, o and g. Every fault is named with its line,
// which readers that are made to forgive do not do.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/math/linear_algebra.hpp"

namespace polhode::inline collision {

struct ObjMesh {
  struct Face {
    std::vector<std::uint32_t> loop;  ///< of vertices, counter-clockwise seen from outside
    int line = 0;                     ///< of the file
  };
  struct Piece {
    std::string name;  ///< of the object or group; may be empty
    int line = 0;
    std::vector<Face> faces;
  };
  std::vector<Vector3<double>> vertices;  ///< m
  std::vector<Piece> pieces;              ///< those with faces
};

/// Throws std::invalid_argument, "table.obj:12: …".
ObjMesh read_obj_mesh(const std::string& path);

}  // namespace polhode
