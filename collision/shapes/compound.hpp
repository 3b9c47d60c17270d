// SPDX-License-Identifier: BSD-3-Clause
// Several convex hulls as one solid. Mass counts twice in regions where they overlap.
#pragma once

#include <string>
#include <vector>

#include "collision/shapes/convex_hull.hpp"

namespace polhode::inline collision::inline shapes {

class Compound final : public Shape {
 public:
  using Part = std::shared_ptr<const ConvexHull>;

  explicit Compound(std::vector<Part> parts);  ///< `parts`: one or more, each in the axes of the compound

  /// Builds a compound from the pieces (lines `o` or `g`) of an OBJ mesh, coordinates in m. Throws, with file and line,
  /// for a piece that is not closed or not convex.
  static std::vector<Part> parts_of_obj(const std::string& path);

  const std::vector<Part>& parts() const { return parts_; }

  std::string_view kind() const override { return "compound"; }
  Vector3<double> support(const Vector3<double>& d) const override;
  Bounds bounds(const Pose& pose) const override;
  MassProperties mass_properties() const override { return mass_; }

 private:
  std::vector<Part> parts_;
  MassProperties mass_;
};

}  // namespace polhode::collision::shapes
