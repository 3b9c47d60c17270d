// SPDX-License-Identifier: BSD-3-Clause
// The polygon mesh of a Wavefront OBJ file by pieces: lines v, f, o and g. Errors name their line, which lenient OBJ
// readers do not do.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/math/linear_algebra.hpp"

namespace polhode::inline collision::inline shapes {

struct ObjMesh {
  struct Face {
    std::vector<std::uint32_t> loop;  ///< vertex numbers, counter-clockwise seen from outside
    int line = 0;                     ///< line in the file
  };
  struct Piece {
    std::string name;  ///< name of the object or group; may be empty
    int line = 0;
    std::vector<Face> faces;
  };
  std::vector<Vector3<double>> vertices;  ///< m
  std::vector<Piece> pieces;              ///< the pieces that have faces
};

/// Reads a mesh. Throws std::invalid_argument: "table.obj:12: …".
ObjMesh read_obj_mesh(const std::string& path);

}  // namespace polhode::collision::shapes
