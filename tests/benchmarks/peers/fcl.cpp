// SPDX-License-Identifier: BSD-3-Clause
#include "tests/benchmarks/peers/fcl.hpp"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/narrowphase/distance.h>

namespace polhode::peers {

namespace {

fcl::CollisionObjectd object(const FclShape& shape) {
  std::shared_ptr<fcl::CollisionGeometryd> geometry;
  if (!shape.half_extents.empty()) {
    const auto& h = shape.half_extents;
    geometry = std::make_shared<fcl::Boxd>(2 * h[0], 2 * h[1], 2 * h[2]);
  } else {
    auto vertices = std::make_shared<std::vector<fcl::Vector3d>>();
    for (std::size_t i = 0; i + 2 < shape.vertices.size(); i += 3) {
      vertices->emplace_back(shape.vertices[i], shape.vertices[i + 1], shape.vertices[i + 2]);
    }
    geometry =
        std::make_shared<fcl::Convexd>(vertices, shape.face_count, std::make_shared<std::vector<int>>(shape.faces));
  }
  fcl::Transform3d at = fcl::Transform3d::Identity();
  for (int i = 0; i < 3; ++i) {
    at.translation()[i] = shape.position[i];
    for (int j = 0; j < 3; ++j) at.linear()(i, j) = shape.rotation[3 * i + j];
  }
  return {geometry, at};
}

}  // namespace

struct FclPairs::Impl {
  std::vector<std::pair<fcl::CollisionObjectd, fcl::CollisionObjectd>> pairs;
};

FclPairs::FclPairs() : impl_(std::make_unique<Impl>()) {}
FclPairs::~FclPairs() = default;

void FclPairs::add(const FclShape& a, const FclShape& b) { impl_->pairs.emplace_back(object(a), object(b)); }

double FclPairs::distances() const {
  fcl::DistanceRequestd request(true, true);
  request.gjk_solver_type = fcl::GST_LIBCCD;
  double sum = 0;
  for (const auto& [a, b] : impl_->pairs) {
    fcl::DistanceResultd result;
    fcl::distance(&a, &b, request, result);
    sum += result.min_distance;
  }
  return sum;
}

}  // namespace polhode::peers
