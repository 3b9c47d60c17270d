// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/drawing/marks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "experiments/viewer/drawing/places.hpp"

namespace polhode::viewer::inline drawing {

namespace {

/// A dot with a rim.
void add_dot(std::vector<LineInstance>& lines, const Vector3<float>& at, float width, Colour rim, Colour inside) {
  lines.push_back({at, at, rim, rim, width, 1});
  lines.push_back({at, at, inside, inside, width - 3, 1});
}

void add_line(std::vector<LineInstance>& lines, const Vector3<float>& from, const Vector3<float>& to, Colour colour,
              float width) {
  lines.push_back({from, to, colour, colour, width, 0});
}

Vector3<double> arrow(const BodySnapshot<double>& body, const Vector3<double>& vector, const VectorScale& scale,
                      double reach, const Cast& cast) {
  const double length = vector.norm();
  if (!(body.angular_velocity.norm() > least_angular_velocity) || !(length > 0)) return Vector3<double>::Zero();
  return vector * (reach * cast.typical_radius * scale.share(length) / length);
}

/// The helix of a spring between its ends: straight at both ends, with a pitch proportional to its length.
class Coil {
 public:
  Coil(const Vector3<double>& from, const Vector3<double>& to, double radius) : from_(from), way_(to - from) {
    const Vector3<double> along = way_.normalized();
    const Vector3<double> rough = std::abs(along[2]) < 0.8 ? Vector3<double>::UnitZ() : Vector3<double>::UnitX();
    radius_ = std::min(radius, 0.15 * way_.norm());
    aside_ = rough.cross(along).normalized();
    up_ = along.cross(aside_);
  }
  static constexpr int turns = 11, points_a_turn = 16, points = turns * points_a_turn;

  /// Point i, from 0 to `points`.
  Vector3<double> point(int i) const {
    return from_ + way_ * (lead + (1 - 2 * lead) * i / points) + radius_ * taper(i) * outward(i);
  }
  Vector3<double> outward(int i) const {
    const double angle = 2 * std::numbers::pi * i / points_a_turn;
    return std::cos(angle) * aside_ + std::sin(angle) * up_;
  }

 private:
  static constexpr double lead = 0.08;
  /// In the first and the last half turn the radius grows from 0.
  static double taper(int i) { return std::min({1.0, 2.0 * i / points_a_turn, 2.0 * (points - i) / points_a_turn}); }
  Vector3<double> from_, way_, aside_, up_;
  double radius_;
};

}  // namespace

void VectorScales::see(const Frame& frame) {
  double fastest = 0, most = 0;
  for (const BodySnapshot<double>& body : frame.bodies) {
    if (!(body.angular_velocity.norm() > least_angular_velocity)) continue;
    fastest = std::max(fastest, body.angular_velocity.norm());
    most = std::max(most, body.angular_momentum.norm());
  }
  double strongest = 0;
  for (const FrameReaction& reaction : frame.reactions) strongest = std::max(strongest, reaction.force.norm());
  if (strongest > 0) force.see(strongest);
  angular_velocity.see(fastest);
  angular_momentum.see(most);
}

Vector3<double> angular_velocity_arrow(const BodySnapshot<double>& body, const Cast& cast, const VectorScales& scales) {
  return arrow(body, body.angular_velocity, scales.angular_velocity, longest_angular_velocity, cast);
}

Vector3<double> angular_momentum_arrow(const BodySnapshot<double>& body, const Cast& cast, const VectorScales& scales) {
  return arrow(body, body.angular_momentum, scales.angular_momentum, longest_angular_momentum, cast);
}

Vector3<double> reaction_arrow(const FrameReaction& reaction, const Cast& cast, const VectorScales& scales) {
  constexpr double least = 0.02;  // share of the scale; shorter arrows are dots
  const double force = reaction.force.norm(), share = scales.force.share(force);
  if (!(share > least)) return Vector3<double>::Zero();
  return reaction.force * (longest_reaction * cast.joint_size * share / force);
}

void Marks::clear() {
  lines.clear();
  trails.clear();
  over.clear();
  arrows.clear();
}

void Marks::add_arrow(const Vector3<double>& from, const Vector3<double>& way, double radius, Colour colour,
                      const ViewState& view) {
  if (!(way.squaredNorm() > 0)) return;
  constexpr double least_pixels = 1.3, most_pixels = 4.5;
  const double pixel = double(view.line_scale) / view.pixels_per_metre(from);
  arrows.push_back({view.from_eye(from), way.cast<float>(),
                    float(std::clamp(radius, least_pixels * pixel, most_pixels * pixel)), colour});
}

void Marks::add_springs(const study::Scene& scene, const Cast& cast, const Frame& frame, const ViewState& view) {
  const Places places(scene, cast, frame);
  for (const study::SceneLink& spring : scene.springs) {
    const Vector3<double> from = places.to(spring), to = places.from(spring);
    if (!((to - from).squaredNorm() > 0)) continue;
    const double radius = 0.13 * cast.typical_radius;
    const auto width =
        float(std::clamp(0.22 * radius * view.pixels_per_metre((from + to) / 2) / double(view.line_scale), 1.4, 6.0));
    const Coil coil(from, to, radius);
    Vector3<float> last = view.from_eye(from);
    for (int i = 0; i <= Coil::points; ++i) {
      const Vector3<float> next = view.from_eye(coil.point(i));
      const double towards_eye = -coil.outward(i).dot(view.forward.cast<double>());
      const Colour colour = mix(colours::spring, {172, 180, 190}, 0.5 + 0.5 * towards_eye);
      lines.push_back({last, next, colour, colour, width, 1});
      last = next;
    }
    add_line(lines, last, view.from_eye(to), colours::spring, width);
    for (const Vector3<double>& end : {from, to})
      add_dot(over, view.from_eye(end), width + 6, colours::ink, {255, 255, 255});
  }
}

void Marks::add_pivots(const study::Scene& scene, const Cast& cast, const Frame& frame, const ViewState& view) {
  for (std::size_t i = 0; i < frame.bodies.size(); ++i) {
    const Vector3<double>& center = scene.bodies[cast.moving[i]].center_of_mass;
    if (center.isZero()) continue;
    const BodySnapshot<double>& body = frame.bodies[i];
    const Vector3<double> pivot = body.position - rotation_matrix(body.orientation) * center;
    const Vector3<float> foot = view.from_eye(pivot);
    add_line(over, foot, view.from_eye(body.position), colours::ink, 2.5f);
    add_dot(over, foot, 11, colours::ink, {255, 255, 255});
  }
}

void Marks::add_contacts(const Frame& frame, const Cast& cast, double depth_scale, const ViewState& view) {
  const double length = 0.75 * cast.typical_radius;
  for (const FrameContact& contact : frame.contacts) {
    const Vector3<double> half_depth = contact.normal * (depth_scale * contact.depth / 2);
    const Vector3<float> low = view.from_eye(contact.point - half_depth),
                         high = view.from_eye(contact.point + half_depth);
    over.push_back({low, high, colours::depth, colours::depth, 5, 0});
    add_dot(over, view.from_eye(contact.point), 8, colours::contact, {255, 255, 255});
    add_arrow(contact.point, length * contact.normal, 0.022 * cast.typical_radius, colours::normal, view);
  }
}

void Marks::add_joints(const study::Scene& scene, const Cast& cast, const Frame& frame, const ViewState& view) {
  const Places places(scene, cast, frame);
  const double half_axis = 0.3 * cast.joint_size;
  const auto dot = [&](const Vector3<double>& at) {
    add_dot(over, view.from_eye(at), 9, colours::ink, {255, 255, 255});
  };
  const auto axis = [&](const Vector3<double>& at, const Vector3<double>& along) {
    if (along.isZero()) return;
    add_line(over, view.from_eye(at - half_axis * along), view.from_eye(at + half_axis * along), colours::ink, 2.5f);
  };
  for (std::size_t i = 0; i < scene.joints.size(); ++i) {
    const study::SceneJoint& joint = scene.joints[i];
    if (joint.radius > 0) {
      if (i < frame.reactions.size()) dot(frame.reactions[i].point);
      continue;
    }
    const Vector3<double> from = places.from(joint.ends), to = joint.on_plane ? from : places.to(joint.ends);
    const auto& other = joint.ends.other;
    axis(from, places.direction(joint.ends.body, joint.axis));
    axis(from, other ? places.direction(*other, joint.axis_other) : joint.axis_other);
    add_line(over, view.from_eye(from), view.from_eye(to), colours::ink, 2.5f);
    dot(to);
    dot(from);
  }
}

void Marks::add_reactions(const Frame& frame, const Cast& cast, const VectorScales& scales, const ViewState& view) {
  for (const FrameReaction& reaction : frame.reactions) {
    const Vector3<double> way = reaction_arrow(reaction, cast, scales);
    add_arrow(reaction.point, way, 0.022 * cast.joint_size, colours::reaction, view);
  }
}

void Marks::add_cells(const Frame& frame, const ViewState& view) {
  const Colour colour = with_alpha(colours::cell, 0.45);
  for (const Bounds& cell : frame.cells) {
    std::array<Vector3<float>, 8> corner;
    for (unsigned i = 0; i < 8; ++i) {
      corner[i] = view.from_eye({i & 1 ? cell.max()[0] : cell.min()[0], i & 2 ? cell.max()[1] : cell.min()[1],
                                 i & 4 ? cell.max()[2] : cell.min()[2]});
    }
    for (unsigned i = 0; i < 8; ++i) {
      for (unsigned axis = 1; axis < 8; axis *= 2) {
        if ((i & axis) == 0) add_line(lines, corner[i], corner[i | axis], colour, 1);
      }
    }
  }
}

void Marks::add_trails(std::span<const Trail> given, const ViewState& view) {
  for (const Trail& trail : given) {
    const Colour dark = mix(body_colour(trail.body), colours::ink, 0.35);
    const auto colour = [&](std::size_t i) {
      return with_alpha(dark, 0.05 + 0.9 * double(i) / double(trail.points.size() - 1));
    };
    constexpr double least_pixels = 3;  // shortest segment; shorter ones are joined
    for (std::size_t i = 1, last = 0; i < trail.points.size(); ++i) {
      const Vector3<double>&from = trail.points[last], &to = trail.points[i];
      const bool short_yet = (to - from).norm() * view.pixels_per_metre(to) < least_pixels;
      if (short_yet && i + 1 < trail.points.size()) continue;
      trails.push_back({view.from_eye(from), view.from_eye(to), colour(last), colour(i), 2.8f, 0});
      last = i;
    }
  }
}

void Marks::add_axes(const Frame& frame, const Cast& cast, const ViewState& view) {
  for (std::size_t i = 0; i < frame.bodies.size(); ++i) {
    const Matrix3<double> axes = rotation_matrix(frame.bodies[i].orientation);
    for (int k = 0; k < 3; ++k) {
      add_arrow(frame.bodies[i].position, axis_length(cast.radius[i]) * axes.col(k), 0.022 * cast.radius[i],
                colours::axes[std::size_t(k)], view);
    }
  }
}

}  // namespace polhode::viewer::drawing
