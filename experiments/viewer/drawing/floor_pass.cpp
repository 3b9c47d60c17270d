// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/drawing/floor_pass.hpp"

#include <cmath>
#include <vector>

namespace polhode::viewer::inline drawing {

namespace {

constexpr const char* background_vertex = R"(
out float height;
void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1);
  height = corner.y * 0.5 + 0.5;
  gl_Position = vec4(corner, 1, 1);
}
)";

constexpr const char* background_fragment = R"(
in float height;
out vec4 seen;
void main() { seen = vec4(mix(vec3(0.965, 0.970, 0.976), vec3(0.800, 0.850, 0.906), height), 1); }
)";

constexpr const char* floor_vertex = R"(
uniform mat4 to_clip;
uniform vec3 middle, along, across;  // m, from the eye
uniform vec2 middle_in_cells;
uniform float cell, reach;
layout(location = 0) in vec2 corner;
out vec2 place, from_middle;
void main() {
  from_middle = corner;
  place = middle_in_cells + corner * (reach / cell);
  gl_Position = to_clip * vec4(middle + reach * (corner.x * along + corner.y * across), 1);
}
)";

constexpr const char* floor_fragment = R"(
in vec2 place, from_middle;
uniform float fine, strength;
out vec4 seen;
float lines(vec2 x, vec2 wide) {
  vec2 pixels = abs(fract(x - 0.5) - 0.5) / wide;
  vec2 drawn = clamp(1.2 - pixels, 0.0, 1.0) * smoothstep(0.4, 0.08, wide);
  return max(drawn.x, drawn.y);
}
void main() {
  vec2 wide = max(fwidth(place), 1e-6);
  float line = max(fine * lines(place, wide), lines(place * 0.1, wide * 0.1));
  float near = max(1.0 - dot(from_middle, from_middle), 0.0);
  float share = strength * near * near * near;
  seen = vec4(mix(vec3(0.905, 0.914, 0.925), vec3(0.62, 0.66, 0.71), line), share * mix(0.8, 1.0, line));
}
)";

using Corner2 = Eigen::Vector2f;

/// The part of a polygon with x · normal >= offset (Sutherland and Hodgman 1974).
std::vector<Corner2> cut(const std::vector<Corner2>& polygon, const Corner2& normal, float offset) {
  std::vector<Corner2> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Corner2& here = polygon[i];
    const Corner2& next = polygon[(i + 1) % polygon.size()];
    const float inside = normal.dot(here) - offset, inside_next = normal.dot(next) - offset;
    if (inside >= 0) kept.push_back(here);
    if ((inside >= 0) != (inside_next >= 0)) kept.push_back(here + (next - here) * (inside / (inside - inside_next)));
  }
  return kept;
}

}  // namespace

FloorPass::FloorPass() : background_(background_vertex, background_fragment), floor_(floor_vertex, floor_fragment) {
  polygon_.floats(VertexArray::Per::vertex, 0, 2, sizeof(Corner2), 0);
}

void FloorPass::draw_background() const {
  background_.use();
  nothing_.draw(GL_TRIANGLES, 3, 1);
}

void FloorPass::draw_floor(const ViewState& view, std::span<const Plane> planes, std::size_t shown) {
  const Vector3<double>& normal = planes[shown].normal;
  const double offset = planes[shown].offset;
  // The x axis of the grid is the projection of the world's x axis onto the plane, if it has one.
  const Vector3<double> rough = std::abs(normal[0]) < 0.9 ? Vector3<double>::UnitX() : Vector3<double>::UnitY();
  const Vector3<double> along = (rough - normal * normal.dot(rough)).normalized(), across = normal.cross(along);
  const Vector3<double> middle = view.target - normal * (normal.dot(view.target) - offset);
  const double decades = std::log10(view.distance / 4), cell = std::pow(10.0, std::floor(decades));
  const auto place = [&](const Vector3<double>& axis) { return float(std::fmod(axis.dot(middle) / cell, 10.0)); };
  const double reach = 6 * view.distance;
  std::vector<Corner2> polygon = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const Vector3<double>& other = planes[i].normal;
    if (i != shown) {
      polygon = cut(polygon, Corner2(float(other.dot(along)), float(other.dot(across))),
                    float((planes[i].offset - other.dot(middle)) / reach));
    }
  }
  glClear(GL_STENCIL_BUFFER_BIT);
  if (polygon.empty()) return;
  polygon_.vertices(std::span(polygon));

  floor_.use();
  floor_.set("to_clip", view.to_clip);
  floor_.set("middle", view.from_eye(middle));
  floor_.set("along", Eigen::Vector3f(along.cast<float>()));
  floor_.set("across", Eigen::Vector3f(across.cast<float>()));
  floor_.set("middle_in_cells", Eigen::Vector2f(place(along), place(across)));
  floor_.set("cell", float(cell));
  floor_.set("reach", float(reach));
  floor_.set("fine", float(1 - 0.8 * (decades - std::floor(decades))));
  floor_.set("strength", float(std::abs(normal.normalized()[2]) > 0.5 ? 1.0 : 0.5));
  glEnable(GL_STENCIL_TEST);
  glStencilFunc(GL_ALWAYS, 1, 0xff);
  glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
  polygon_.draw(GL_TRIANGLE_FAN, polygon.size(), 1);
  glDisable(GL_STENCIL_TEST);
}

}  // namespace polhode::viewer::drawing
