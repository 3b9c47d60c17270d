// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/drawing/polhode_pass.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/problem/inertia.hpp"

namespace polhode::viewer::inline drawing {

namespace {

constexpr const char* panel_vertex = R"(
out vec2 place;
void main() {
  place = vec2((gl_VertexID & 1) * 2 - 1, (gl_VertexID & 2) - 1);
  gl_Position = vec4(place, 1, 1);
}
)";

constexpr const char* panel_fragment = R"(
in vec2 place;
uniform vec2 half_size;
out vec4 seen;
void main() {
  vec2 inside = half_size - abs(place) * half_size;
  float rim = min(inside.x, inside.y) < 1.5 ? 1.0 : 0.0;
  seen = mix(vec4(0.985, 0.988, 0.992, 0.9), vec4(0.55, 0.60, 0.66, 1), rim);
}
)";

constexpr const char* surface_vertex = R"(
layout(location = 0) in vec3 on_sphere;
uniform mat4 to_clip;
uniform vec3 middle, semi_axes;
uniform mat3 axes;
out vec3 place, normal;
void main() {
  place = on_sphere;
  normal = axes * (on_sphere / semi_axes);
  gl_Position = to_clip * vec4(middle + axes * (semi_axes * on_sphere), 1);
}
)";

// With ω = Σ sqrt(2T/I_i) s_i e_i on the unit sphere, L²/2T = Σ I_i s_i²: its levels are the polhodes.
constexpr const char* surface_fragment = R"(
in vec3 place, normal;
uniform vec3 forward, base, level_of_axis;  // 0, that of the middle moment, 1
uniform float level, curves;
out vec4 seen;
float line(float value, float wide, float half_width) { return clamp(half_width + 0.5 - abs(value) / wide, 0.0, 1.0); }
void main() {
  vec3 s = normalize(place), n = normalize(normal);
  float here = dot(level_of_axis, s * s);
  float wide = max(fwidth(here), 1e-7);
  float shade = 0.58 + 0.12 * n.z + 0.34 * max(-dot(n, forward), 0.0);
  vec3 colour = base * min(shade, 1.0);
  float family = line(fract(here * 8.0 - 0.5) - 0.5, wide * 8.0, 0.25) * smoothstep(0.4, 0.15, wide * 8.0);
  colour = mix(colour, vec3(0.36, 0.45, 0.57), 0.6 * curves * family);
  colour = mix(colour, vec3(0.16, 0.22, 0.32), 0.8 * curves * line(here - level_of_axis.y, wide, 0.4));
  colour = mix(colour, vec3(0.0, 0.28, 0.55), curves * line(here - level, wide, 0.8));
  seen = vec4(colour, 1);
}
)";

constexpr double axis_reach = 1.2;
constexpr int around = 48, down = 24;

/// A grid on the tangent plane of the ellipsoid at ω.
void add_plane(const InertiaEllipsoid& e, const ViewState& view, std::vector<LineInstance>& lines) {
  const Vector3<double>& up = e.momentum;
  const Vector3<double> rough = std::abs(up[2]) < 0.8 ? Vector3<double>::UnitZ() : Vector3<double>::UnitX();
  const Vector3<double> foot = up * up.dot(e.omega), aside = rough.cross(up).normalized(), across = up.cross(aside);
  constexpr int cells = 8;
  for (int i = 0; i <= cells; ++i) {
    const double at = 2.0 * i / cells - 1;
    const Colour colour = with_alpha(colours::angular_momentum, i == 0 || i == cells ? 0.9 : 0.4);
    for (const auto& [shift, along] : {std::pair{aside, across}, std::pair{across, aside}}) {
      const Vector3<double> middle = foot + at * shift;
      lines.push_back({view.from_eye(middle - along), view.from_eye(middle + along), colour, colour, 1.2f, 0});
    }
  }
}

}  // namespace

std::optional<InertiaEllipsoid> InertiaEllipsoid::of(const Matrix3<double>& inertia,
                                                     const Vector3<double>& omega_in_body,
                                                     const Matrix3<double>& body) {
  const double twice_energy = omega_in_body.dot(inertia * omega_in_body);
  if (!(twice_energy > 0) || !std::isfinite(twice_energy)) return std::nullopt;
  const PrincipalAxes principal = principal_axes(inertia);
  InertiaEllipsoid e;
  e.body = body;
  e.axes = body * principal.axes;
  e.moments = principal.moments;
  e.unit = std::sqrt(twice_energy / principal.moments.minCoeff());
  e.semi_axes = (twice_energy * principal.moments.cwiseInverse()).cwiseSqrt() / e.unit;
  e.omega = body * omega_in_body / e.unit;
  e.momentum = body * (inertia * omega_in_body).normalized();
  return e;
}

PolhodePass::PolhodePass() : panel_(panel_vertex, panel_fragment), surface_(surface_vertex, surface_fragment) {
  std::vector<Vector3<float>> points;
  std::vector<std::uint32_t> corners;
  for (int i = 0; i <= down; ++i) {
    const double polar = std::numbers::pi * i / down;
    for (int k = 0; k <= around; ++k) {
      const double turn = 2 * std::numbers::pi * k / around;
      points.push_back(
          Vector3<double>(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar))
              .cast<float>());
      if (i == down || k == around) continue;
      const auto a = std::uint32_t(i * (around + 1) + k), below = a + around + 1;
      corners.insert(corners.end(), {a, below, a + 1, a + 1, below, below + 1});
    }
  }
  sphere_.vertices(std::span(points));
  sphere_.corners(corners);
  sphere_.floats(VertexArray::Per::vertex, 0, 3, sizeof(Vector3<float>), 0);
}

Rectangle PolhodePass::area(const Rectangle& whole, Corner corner) {
  const int shorter = std::min(whole.width, whole.height), side = std::max(shorter * 2 / 5, 1), margin = shorter / 50;
  const bool left = corner == Corner::upper_left || corner == Corner::lower_left;
  const bool low = corner == Corner::lower_left || corner == Corner::lower_right;
  return {left ? whole.left + margin : whole.left + whole.width - margin - side,
          low ? whole.bottom + margin : whole.bottom + whole.height - margin - side, side, side};
}

Camera PolhodePass::camera(const Camera& main, double reach) {
  Camera camera = main;
  camera.field_of_view = 0.3;
  camera.look_at(Vector3<double>::Zero(), std::max(1.3, 1.05 * reach));
  return camera;
}

std::array<Vector3<double>, 4> PolhodePass::label_points(const InertiaEllipsoid& e) {
  const double reach = axis_reach + 0.06;
  return {reach * e.body.col(0), reach * e.body.col(1), reach * e.body.col(2), 1.12 * e.omega};
}

void PolhodePass::draw(const ViewState& view, const InertiaEllipsoid& e, std::span<const Vector3<double>> past,
                       bool plane, LinePass& lines, ArrowPass& arrows) {
  glDisable(GL_DEPTH_TEST);
  panel_.use();
  panel_.set("half_size", view.half_size);
  nothing_.draw(GL_TRIANGLE_STRIP, 4, 1);
  glEnable(GL_DEPTH_TEST);
  glClear(GL_DEPTH_BUFFER_BIT);

  const double least = e.moments[0], spread = e.moments[2] - least;
  const bool round = !(spread > 1e-9 * e.moments[2]);
  const Vector3<double> shares = e.axes.transpose() * e.omega;  // components of ω along the principal axes
  double level = 0;
  for (int i = 0; i < 3 && !round; ++i)
    level += (e.moments[i] - least) / spread * std::pow(shares[i] / e.semi_axes[i], 2);
  surface_.use();
  surface_.set("to_clip", view.to_clip);
  surface_.set("middle", view.from_eye(Vector3<double>::Zero()));
  surface_.set("semi_axes", Eigen::Vector3f(e.semi_axes.cast<float>()));
  surface_.set("axes", Matrix3<float>(e.axes.cast<float>()));
  surface_.set("forward", view.forward);
  const Colour base = colours::inset;
  surface_.set("base", Eigen::Vector3f(float(base.red) / 255, float(base.green) / 255, float(base.blue) / 255));
  surface_.set("level_of_axis", Eigen::Vector3f(0, round ? 0 : float((e.moments[1] - least) / spread), 1));
  surface_.set("level", float(level));
  surface_.set("curves", round ? 0.0f : 1.0f);
  sphere_.draw_corners(1);

  const Vector3<double> middle = Vector3<double>::Zero();
  vectors_.clear();
  for (int k = 0; k < 3; ++k) {
    vectors_.push_back(
        {view.from_eye(middle), (axis_reach * e.body.col(k)).cast<float>(), 0.012f, colours::axes[std::size_t(k)]});
  }
  vectors_.push_back({view.from_eye(middle), e.omega.cast<float>(), 0.018f, colours::angular_velocity});
  vectors_.push_back({view.from_eye(e.omega), (0.35 * e.momentum).cast<float>(), 0.018f, colours::angular_momentum});
  arrows.draw(view, vectors_, 0.35);

  curve_.clear();
  if (plane) add_plane(e, view, curve_);
  const Matrix3<double> to_inset = e.body / e.unit;
  for (std::size_t i = 1; i < past.size(); ++i) {
    const Vector3<float> from = view.from_eye(to_inset * past[i - 1]), to = view.from_eye(to_inset * past[i]);
    curve_.push_back({from, to, colours::polhode, colours::polhode, 2.2f, 0});
  }
  const Vector3<float> now = view.from_eye(e.omega);
  curve_.push_back({now, now, colours::ink, colours::ink, 9, 1});
  curve_.push_back({now, now, colours::angular_velocity, colours::angular_velocity, 6, 1});
  lines.draw(view, curve_, 0.3, 0.03);
}

}  // namespace polhode::viewer::drawing
