// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/drawing/renderer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "experiments/viewer/drawing/cast.hpp"

namespace polhode::viewer::inline drawing {

namespace {

void clip_to(const Rectangle& area) {
  glViewport(area.left, area.bottom, area.width, area.height);
  glScissor(area.left, area.bottom, area.width, area.height);
}

/// Opacity of marks that are hidden by bodies: smaller for more marks, 0 for very many.
double through(std::size_t marks) {
  constexpr double most = 0.45, in_all = 30, least = 0.05;
  const double share = std::min(most, in_all / double(std::max<std::size_t>(marks, 1)));
  return share < least ? 0 : share;
}

void usual_state() {
  glEnable(GL_SCISSOR_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_STENCIL_TEST);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LEQUAL);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

}  // namespace

Renderer::Renderer(const study::Scene& scene)
    : scene_(scene), cast_(cast_of(scene)), bodies_(scene.surfaces), instances_(scene.surfaces.size()) {
  for (const study::SceneBody& body : scene_.bodies) {
    if (!body.surface) planes_.push_back({body.floor_normal, body.floor_offset});
  }
}

void Renderer::place_bodies(const Frame& frame, const ViewState& view, const Look& look) {
  for (auto& list : instances_) list.clear();
  std::size_t moving = 0;
  for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
    const study::SceneBody& body = scene_.bodies[i];
    const std::size_t number = moving;
    if (!body.fixed) ++moving;
    if (!body.surface) continue;
    if (body.fixed) {
      instances_[*body.surface].push_back(
          {body.start.rotation.cast<float>(), view.from_eye(body.start.position), colours::fixed, 0});
    } else {
      const BodySnapshot<double>& now = frame.bodies[number];
      if (!now.position.allFinite() || !now.orientation.allFinite()) continue;  // the run has diverged
      instances_[*body.surface].push_back({rotation_matrix(now.orientation).cast<float>(), view.from_eye(now.position),
                                           body_colour(number), look.selected == number ? 1.0f : 0.0f});
    }
  }
  bodies_.place(instances_);
}

void Renderer::draw(const Frame& frame, const Camera& camera, const Look& look, const Rectangle& area,
                    const Past& past) {
  if (frame.bodies.size() != cast_.moving.size()) {
    throw std::invalid_argument(
        fmt::format("a frame of {} moving bodies for a scene of {}", frame.bodies.size(), cast_.moving.size()));
  }
  if (area.width < 1 || area.height < 1) return;
  const ViewState view(camera, area, look.line_scale);
  scales_.see(frame);
  usual_state();
  clip_to(area);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  floor_.draw_background();
  glEnable(GL_DEPTH_TEST);
  glClearDepth(1);
  glClearStencil(0);
  glClear(GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);

  place_bodies(frame, view, look);
  bodies_.draw(view, look.edges);

  glEnable(GL_BLEND);
  glDepthMask(GL_FALSE);
  for (std::size_t i = 0; i < planes_.size() && look.floor; ++i) {
    const Plane& plane = planes_[i];
    if (plane.normal.dot(view.eye) <= plane.offset)
      continue;  // the eye is inside, where the plane would hide everything
    floor_.draw_floor(view, planes_, i);
    if (look.shadows) bodies_.draw_shadows(view, plane.normal, plane.offset, 6 * cast_.typical_radius);
  }
  glDepthMask(GL_TRUE);

  marks_.clear();
  if (look.springs) marks_.add_springs(scene_, cast_, frame, view);
  if (look.springs) marks_.add_pivots(scene_, cast_, frame, view);
  if (look.joints) marks_.add_joints(scene_, cast_, frame, view);
  if (look.reactions) marks_.add_reactions(frame, cast_, scales_, view);
  if (look.contacts) marks_.add_contacts(frame, cast_, look.depth_scale, view);
  if (look.cells) marks_.add_cells(frame, view);
  if (look.trails) marks_.add_trails(past.trails, view);
  if (look.axes) marks_.add_axes(frame, cast_, view);
  const double thick = 0.032 * cast_.typical_radius,
               thin = 0.7 * thick;  // both are visible if one lies within the other
  for (const BodySnapshot<double>& body : frame.bodies) {
    if (look.angular_velocity) {
      const Vector3<double> way = angular_velocity_arrow(body, cast_, scales_);
      marks_.add_arrow(body.position, way, thick, colours::angular_velocity, view);
    }
    if (look.angular_momentum) {
      const Vector3<double> way = angular_momentum_arrow(body, cast_, scales_);
      marks_.add_arrow(body.position, way, thin, colours::angular_momentum, view);
    }
  }
  const double lift = 0.05 * cast_.typical_radius;
  arrows_.draw(view, marks_.arrows, through(marks_.arrows.size()));
  glDepthMask(GL_FALSE);
  lines_.draw(view, marks_.lines, 0, 0);
  lines_.draw(view, marks_.trails, through(past.trails.size()), 0);
  lines_.draw(view, marks_.over, through(marks_.over.size() / 3), lift);
  glDepthMask(GL_TRUE);

  if (look.polhode) draw_polhode(frame, camera, look, area, past);
  glDisable(GL_BLEND);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_SCISSOR_TEST);
  glBindVertexArray(0);
  glUseProgram(0);
}

std::optional<InertiaEllipsoid> Renderer::ellipsoid(const Frame& frame, const Look& look) const {
  const std::size_t body = look.selected.value_or(0);
  if (!look.polhode || body >= frame.bodies.size()) return std::nullopt;
  const BodySnapshot<double>& b = frame.bodies[body];
  const Matrix3<double> rotation = rotation_matrix(b.orientation);
  return InertiaEllipsoid::of(scene_.bodies[cast_.moving[body]].inertia, rotation.transpose() * b.angular_velocity,
                              look.poinsot ? rotation : Matrix3<double>::Identity());
}

void Renderer::draw_polhode(const Frame& frame, const Camera& camera, const Look& look, const Rectangle& area,
                            const Past& past) {
  const auto shown = ellipsoid(frame, look);
  if (!shown) return;
  const Rectangle inset = polhode_area(area, look);
  clip_to(inset);
  double reach = look.poinsot ? 1.55 : 1;  // includes the corners of the plane
  for (const Vector3<double>& omega : past.polhode) reach = std::max(reach, omega.norm() / shown->unit);
  polhode_reach_ = std::isfinite(reach) ? reach : 1;
  const ViewState view(PolhodePass::camera(camera, polhode_reach_), inset, look.line_scale);
  polhode_.draw(view, *shown, past.polhode, look.poinsot, lines_, arrows_);
}

std::vector<Label> Renderer::labels(const Frame& frame, const Camera& camera, const Look& look,
                                    const Rectangle& area) const {
  std::vector<Label> all;
  bool of_bodies = true;
  const bool has_inset = ellipsoid(frame, look).has_value();
  const auto hidden = [&](double right, double down) {  // behind the inset
    const Rectangle inset = polhode_area(area, look);
    const double left = inset.left - area.left, top = area.bottom + area.height - inset.bottom - inset.height;
    return has_inset && right >= left && right <= left + inset.width && down >= top && down <= top + inset.height;
  };
  const auto add = [&](const char* text, Colour colour, const Vector3<double>& point, const Camera& seen_by,
                       const Rectangle& part) {
    const auto at = seen_by.pixel(point, part.width, part.height);
    if (!at) return;
    const double top = area.bottom + area.height - part.bottom - part.height;
    const double right = (*at)[0] + part.left - area.left, down = (*at)[1] + top;
    if (of_bodies && hidden(right, down)) return;
    all.push_back({text, right, down, colour});
  };
  const auto at_tip = [](const Vector3<double>& from, const Vector3<double>& way) {
    return Vector3<double>(from + 1.08 * way);
  };
  constexpr std::array<const char*, 3> axis_names = {"x", "y", "z"};
  for (std::size_t i = 0; i < frame.bodies.size(); ++i) {
    const BodySnapshot<double>& body = frame.bodies[i];
    if (look.axes) {
      const Matrix3<double> axes = rotation_matrix(body.orientation) * axis_length(cast_.radius[i]);
      for (std::size_t k = 0; k < 3; ++k) {
        add(axis_names[k], colours::axes[k], at_tip(body.position, axes.col(Eigen::Index(k))), camera, area);
      }
    }
    const auto vector = [&](bool shown, const char* name, Colour colour, const Vector3<double>& way) {
      if (shown && !way.isZero()) add(name, colour, at_tip(body.position, way), camera, area);
    };
    vector(look.angular_velocity, "ω", colours::angular_velocity, angular_velocity_arrow(body, cast_, scales_));
    vector(look.angular_momentum, "L", colours::angular_momentum, angular_momentum_arrow(body, cast_, scales_));
  }
  constexpr std::size_t few_joints = 8;  // more labels would hide the bodies
  for (const FrameReaction& reaction : frame.reactions) {
    const Vector3<double> way = reaction_arrow(reaction, cast_, scales_);
    if (!look.reactions || way.isZero() || frame.reactions.size() > few_joints) continue;
    const std::string text = fmt::format("{:.3g} N", reaction.force.norm());
    add(text.c_str(), colours::reaction, at_tip(reaction.point, way), camera, area);
  }
  if (const auto shown = ellipsoid(frame, look)) {
    of_bodies = false;
    const Rectangle inset = polhode_area(area, look);
    const Camera inset_camera = PolhodePass::camera(camera, polhode_reach_);
    const auto points = PolhodePass::label_points(*shown);
    for (std::size_t k = 0; k < 3; ++k) add(axis_names[k], colours::axes[k], points[k], inset_camera, inset);
    add("ω", colours::angular_velocity, points[3], inset_camera, inset);
  }
  return all;
}

}  // namespace polhode::viewer::drawing
