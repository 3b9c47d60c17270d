// SPDX-License-Identifier: BSD-3-Clause
#include "collision/shapes/compound.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

#include "collision/shapes/obj_mesh.hpp"
#include "collision/shapes/shape_catalogue.hpp"
#include "collision/shapes/size_checks.hpp"
#include "core/problem/inertia.hpp"

namespace polhode::inline collision::inline shapes {

namespace {

constexpr double slack = 1e-6;  // tolerance over the size of a piece: the digits that OBJ files are written with

/// A piece is convex if no vertex lies before a face, and every side is passed once in each direction by its faces.
Compound::Part convex_piece(const ObjMesh& mesh, const ObjMesh::Piece& piece, const std::string& path) {
  const auto refuse = [&](int line, const std::string& why) {
    const std::string name = piece.name.empty() ? "the piece" : "piece '" + piece.name + "'";
    throw std::invalid_argument(path + ":" + std::to_string(line) + ": " + name + " " + why);
  };
  std::vector<std::uint32_t> used;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;  // sides, each with the line of its face
  for (const ObjMesh::Face& face : piece.faces) {
    for (std::size_t i = 0; i < face.loop.size(); ++i) {
      const std::uint32_t from = face.loop[i], to = face.loop[(i + 1) % face.loop.size()];
      used.push_back(from);
      if (!sides.emplace(std::pair(from, to), face.line).second) {
        refuse(face.line, "has two faces that pass one side in the same direction; turn one of them");
      }
    }
  }
  for (const auto& [side, line] : sides) {
    if (!sides.contains({side.second, side.first})) {
      refuse(line, "is not closed: a side of this face has no other face; join the vertices that belong together");
    }
  }
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  std::vector<Vector3<double>> points;
  Bounds around;
  for (const std::uint32_t i : used) {
    points.push_back(mesh.vertices[i]);
    around.extend(mesh.vertices[i]);
  }
  const double size = around.sizes().maxCoeff();
  for (const ObjMesh::Face& face : piece.faces) {
    const Vector3<double>& origin = mesh.vertices[face.loop[0]];
    Vector3<double> normal = Vector3<double>::Zero();
    for (std::size_t i = 1; i + 1 < face.loop.size(); ++i) {
      normal += (mesh.vertices[face.loop[i]] - origin).cross(mesh.vertices[face.loop[i + 1]] - origin);
    }
    if (normal.norm() <= 1e-12 * size * size) continue;  // a face without area bounds nothing
    normal.normalize();
    for (const Vector3<double>& p : points) {
      const double before = normal.dot(p - origin);
      if (before <= slack * size) continue;
      refuse(face.line, "is not convex: a vertex lies " + in_words(before) +
                            " m before this face; cut the piece, or turn the face outward");
    }
  }
  try {
    return std::make_shared<ConvexHull>(points);
  } catch (const std::invalid_argument& fault) {
    refuse(piece.line, std::string("has no hull: ") + fault.what());
    throw;
  }
}

}  // namespace

Compound::Compound(std::vector<Part> parts) : Shape(ShapeTag::compound), parts_(std::move(parts)) {
  if (parts_.empty()) throw std::invalid_argument("a compound needs at least one part");
  for (const Part& part : parts_) {
    if (!part) throw std::invalid_argument("a part of a compound is missing");
    const MassProperties m = part->mass_properties();
    mass_.volume += m.volume;
    mass_.centroid += m.volume * m.centroid;
  }
  mass_.centroid /= mass_.volume;
  for (const Part& part : parts_) {
    const MassProperties m = part->mass_properties();
    mass_.inertia += inertia_about_point(m.inertia, m.volume, m.centroid - mass_.centroid);
  }
}

std::vector<Compound::Part> Compound::parts_of_obj(const std::string& path) {
  const ObjMesh mesh = read_obj_mesh(path);
  if (mesh.pieces.empty()) throw std::invalid_argument(path + ": has no faces (lines `f 1 2 3`)");
  std::vector<Part> parts;
  for (const ObjMesh::Piece& piece : mesh.pieces) parts.push_back(convex_piece(mesh, piece, path));
  return parts;
}

Vector3<double> Compound::support(const Vector3<double>& d) const {
  Vector3<double> best = parts_[0]->support(d);
  for (const Part& part : parts_) {
    const Vector3<double> x = part->support(d);
    if (x.dot(d) > best.dot(d)) best = x;
  }
  return best;
}

Bounds Compound::bounds(const Pose& pose) const {
  Bounds bounds;
  for (const Part& part : parts_) bounds.extend(part->bounds(pose));
  return bounds;
}

ShapeEntry compound() {
  return {"compound",
          "convex pieces, the objects or groups of an OBJ mesh",
          {{"file", std::string(), "", "path of the OBJ file, coordinates in m", Parameter::Need::required}},
          [](const ShapeParameters& p) -> ShapePointer {
            return std::make_shared<Compound>(Compound::parts_of_obj(p.text("file")));
          }};
}

}  // namespace polhode::collision::shapes
