// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/drawing/arrow_pass.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

namespace polhode::viewer::inline drawing {

namespace {

/// Numbers of sides of an arrow, and of an arrow among very many.
constexpr std::uint32_t sides = 10, sides_of_many = 4;
constexpr std::size_t many = 200;
constexpr float head_radius = 2.7f, head_length = 7.5f;  // lengths over the radius of the shaft

struct ArrowVertex {
  Vector3<float> place;   // across in radii of the shaft; along: 0 at the start, 1 where the head begins, 2 at the tip
  Vector3<float> normal;  // z along
};

struct ArrowMesh {
  std::vector<ArrowVertex> vertices;
  std::vector<std::uint32_t> corners;
};

ArrowMesh arrow_mesh(std::uint32_t round) {
  ArrowMesh mesh;
  // Adds a ring between two rims. Its triangles face outward if it goes up or inward.
  const auto strip = [&](float low_radius, float low, float high_radius, float high, float tilt) {
    const auto first = std::uint32_t(mesh.vertices.size());
    for (std::uint32_t side = 0; side < round; ++side) {
      const double angle = 2 * std::numbers::pi * side / round;
      const Vector3<float> across(float(std::cos(angle)), float(std::sin(angle)), 0), along = Vector3<float>::UnitZ();
      const Vector3<float> normal = (across + tilt * along).normalized();
      mesh.vertices.push_back({low_radius * across + low * along, normal});
      mesh.vertices.push_back({high_radius * across + high * along, normal});
      const std::uint32_t a = first + 2 * side, b = first + 2 * ((side + 1) % round);
      mesh.corners.insert(mesh.corners.end(), {a, b, a + 1, a + 1, b, b + 1});
    }
  };
  constexpr float down = -1e3f;
  strip(0, 0, 1, 0, down);
  strip(1, 0, 1, 1, 0);
  strip(1, 1, head_radius, 1, down);
  strip(head_radius, 1, 0, 2, head_radius / head_length);
  return mesh;
}

constexpr const char* arrow_vertex = R"(
layout(location = 0) in vec3 place;
layout(location = 1) in vec3 across_along;
layout(location = 2) in vec3 from;
layout(location = 3) in vec3 way;
layout(location = 4) in float shaft_radius;
layout(location = 5) in vec4 arrow_colour;
uniform mat4 to_clip;
uniform float head_length;
out vec3 normal;
flat out vec4 colour;
void main() {
  float span = length(way);
  vec3 along = way / max(span, 1e-30);
  vec3 rough = abs(along.z) < 0.8 ? vec3(0, 0, 1) : vec3(1, 0, 0);
  vec3 aside = normalize(cross(rough, along)), up = cross(along, aside);
  float radius = min(shaft_radius, span / (1.4 * head_length)), head = radius * head_length;
  float reach = min(place.z, 1.0) * (span - head) + max(place.z - 1.0, 0.0) * head;
  gl_Position = to_clip * vec4(from + radius * (place.x * aside + place.y * up) + reach * along, 1);
  normal = across_along.x * aside + across_along.y * up + across_along.z * along;
  colour = arrow_colour;
}
)";

constexpr const char* arrow_fragment = R"(
in vec3 normal;
flat in vec4 colour;
uniform vec3 forward;
uniform float share;
out vec4 seen;
void main() {
  vec3 n = normalize(normal);
  float shade = 0.66 + 0.14 * n.z + 0.26 * max(-dot(n, forward), 0.0);
  seen = vec4(colour.rgb * min(shade, 1.0), colour.a * share);
}
)";

void set_up(VertexArray& arrows, const ArrowMesh& mesh) {
  using Per = VertexArray::Per;
  arrows.vertices(std::span(mesh.vertices));
  arrows.corners(mesh.corners);
  arrows.floats(Per::vertex, 0, 3, sizeof(ArrowVertex), offsetof(ArrowVertex, place));
  arrows.floats(Per::vertex, 1, 3, sizeof(ArrowVertex), offsetof(ArrowVertex, normal));
  constexpr std::size_t stride = sizeof(ArrowInstance);
  arrows.floats(Per::instance, 2, 3, stride, offsetof(ArrowInstance, from));
  arrows.floats(Per::instance, 3, 3, stride, offsetof(ArrowInstance, way));
  arrows.floats(Per::instance, 4, 1, stride, offsetof(ArrowInstance, radius));
  arrows.bytes(Per::instance, 5, 4, stride, offsetof(ArrowInstance, colour));
}

}  // namespace

ArrowPass::ArrowPass() : program_(arrow_vertex, arrow_fragment) {
  set_up(fine_, arrow_mesh(sides));
  set_up(coarse_, arrow_mesh(sides_of_many));
}

void ArrowPass::draw(const ViewState& view, std::span<const ArrowInstance> arrows, double through) {
  if (arrows.empty()) return;
  VertexArray& mesh = arrows.size() > many ? coarse_ : fine_;
  mesh.instances(arrows);
  program_.use();
  program_.set("to_clip", view.to_clip);
  program_.set("forward", view.forward);
  program_.set("head_length", head_length);
  glEnable(GL_CULL_FACE);
  if (through > 0) {
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_FALSE);
    program_.set("share", float(through));
    mesh.draw_corners(arrows.size());
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LEQUAL);
  }
  program_.set("share", 1.0f);
  mesh.draw_corners(arrows.size());
  glDisable(GL_CULL_FACE);
}

}  // namespace polhode::viewer::drawing
