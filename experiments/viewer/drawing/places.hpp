// SPDX-License-Identifier: BSD-3-Clause
// The places of points of a scene's bodies in a frame, world axes.
#pragma once

#include "experiments/viewer/drawing/cast.hpp"
#include "experiments/viewer/frame/frame.hpp"

namespace polhode::viewer::inline drawing {

/// Refers to its arguments, which must outlive it.
class Places {
 public:
  Places(const study::Scene& scene, const Cast& cast, const Frame& frame) : scene_(scene), cast_(cast), frame_(frame) {}

  /// A point (m) of a body, in its axes from its reference point.
  Vector3<double> point(std::size_t body, const Vector3<double>& in_body) const;
  /// A direction that is fixed to a body, given in its axes.
  Vector3<double> direction(std::size_t body, const Vector3<double>& in_body) const;

  /// The two points (m) of a link.
  Vector3<double> from(const study::SceneLink& link) const { return point(link.body, link.anchor); }
  Vector3<double> to(const study::SceneLink& link) const {
    return link.other ? point(*link.other, link.anchor_other) : link.anchor_other;
  }

 private:
  Pose pose(std::size_t body) const;

  const study::Scene& scene_;
  const Cast& cast_;
  const Frame& frame_;
};

}  // namespace polhode::viewer::drawing
