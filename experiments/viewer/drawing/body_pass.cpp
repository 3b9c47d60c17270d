// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/drawing/body_pass.hpp"

#include <algorithm>
#include <cstddef>

namespace polhode::viewer::inline drawing {

namespace {

constexpr const char* solid_vertex = R"(
layout(location = 0) in vec3 point;
layout(location = 1) in vec3 point_normal;
layout(location = 2) in vec3 point_from_edges;
layout(location = 3) in vec3 column_x;
layout(location = 4) in vec3 column_y;
layout(location = 5) in vec3 column_z;
layout(location = 6) in vec3 position;
layout(location = 7) in vec4 body_colour;
layout(location = 8) in float emphasis;
uniform mat4 to_clip;
uniform vec3 forward;
uniform float radius_in_pixels;  // at a metre's distance
uniform float edges, line_scale;
out vec3 normal, from_edges;
flat out vec3 colour, edge_colour;
flat out float edge_width, edge_share;
void main() {
  mat3 turn = mat3(column_x, column_y, column_z);
  gl_Position = to_clip * vec4(turn * point + position, 1);
  normal = turn * point_normal;
  from_edges = point_from_edges;
  colour = body_colour.rgb;
  float pixels = radius_in_pixels / max(dot(position, forward), 1e-20);
  edge_width = line_scale * mix(0.8, 2.0, emphasis) + 0.5;
  edge_share = edges * smoothstep(3.0, 16.0, pixels) * mix(0.75, 1.0, emphasis);
  edge_colour = mix(colour * 0.35, vec3(0.0, 0.18, 0.45), emphasis);
}
)";

// A key light, the sky above and a weak light at the eye, all white, so that a colour keeps its hue.
constexpr const char* solid_fragment = R"(
in vec3 normal, from_edges;
flat in vec3 colour, edge_colour;
flat in float edge_width, edge_share;
uniform vec3 forward;
uniform vec3 light;
out vec4 seen;
void main() {
  vec3 n = normalize(normal);
  float shade = 0.60 + 0.10 * n.z + 0.26 * max(dot(n, light), 0.0) + 0.12 * max(-dot(n, forward), 0.0);
  vec3 right = dFdx(from_edges), up = dFdy(from_edges);
  vec3 pixels = from_edges * inversesqrt(max(right * right + up * up, 1e-30));
  float edge = edge_share * clamp(edge_width - min(pixels.x, min(pixels.y, pixels.z)), 0.0, 1.0);
  seen = vec4(mix(colour * min(shade, 1.0), edge_colour, edge), 1);
}
)";

constexpr const char* shadow_vertex = R"(
layout(location = 0) in vec3 point;
layout(location = 3) in vec3 column_x;
layout(location = 4) in vec3 column_y;
layout(location = 5) in vec3 column_z;
layout(location = 6) in vec3 position;
uniform mat4 to_clip;
uniform vec3 light;
uniform vec4 plane;
out float height;
void main() {
  vec3 x = mat3(column_x, column_y, column_z) * point + position;
  height = dot(plane.xyz, x) - plane.w;
  gl_Position = to_clip * vec4(x - light * (max(height, 0.0) / dot(plane.xyz, light)), 1);
}
)";

constexpr const char* shadow_fragment = R"(
in float height;
uniform float reach;
out vec4 seen;
void main() { seen = vec4(0.08, 0.11, 0.16, 0.24 * exp(-max(height, 0.0) / reach)); }
)";

/// Direction to the key light in world axes, so that shadows stay when the camera moves.
const Eigen::Vector3f light = Eigen::Vector3f(0.45f, -0.25f, 0.86f).normalized();

}  // namespace

BodyPass::BodyPass(const std::vector<study::Surface>& surfaces)
    : solid_(solid_vertex, solid_fragment), shadow_(shadow_vertex, shadow_fragment) {
  using Per = VertexArray::Per;
  for (const study::Surface& surface : surfaces) {
    const SurfaceMesh mesh = mesh_of(surface);
    OnCard& card = *surfaces_.emplace_back(std::make_unique<OnCard>());
    card.radius = mesh.radius;
    card.vertices.vertices(std::span(mesh.vertices));
    card.vertices.corners(mesh.corners);
    for (GLuint i = 0; i < 3; ++i)
      card.vertices.floats(Per::vertex, i, 3, sizeof(MeshVertex), i * sizeof(Vector3<float>));
    for (GLuint i = 0; i < 3; ++i) {
      card.vertices.floats(Per::instance, 3 + i, 3, sizeof(BodyInstance),
                           offsetof(BodyInstance, rotation) + i * 3 * sizeof(float));
    }
    card.vertices.floats(Per::instance, 6, 3, sizeof(BodyInstance), offsetof(BodyInstance, position));
    card.vertices.bytes(Per::instance, 7, 4, sizeof(BodyInstance), offsetof(BodyInstance, colour));
    card.vertices.floats(Per::instance, 8, 1, sizeof(BodyInstance), offsetof(BodyInstance, emphasis));
  }
}

void BodyPass::place(std::span<std::vector<BodyInstance>> instances) {
  for (std::size_t s = 0; s < surfaces_.size(); ++s) {
    // Nearest bodies first, so that hidden parts of others are not shaded.
    std::stable_sort(instances[s].begin(), instances[s].end(), [](const BodyInstance& a, const BodyInstance& b) {
      return a.position.squaredNorm() < b.position.squaredNorm();
    });
    surfaces_[s]->instances = instances[s].size();
    surfaces_[s]->vertices.instances(std::span(instances[s]));
  }
}

void BodyPass::draw(const ViewState& view, bool edges) const {
  solid_.use();
  solid_.set("to_clip", view.to_clip);
  solid_.set("forward", view.forward);
  solid_.set("light", light);
  solid_.set("edges", edges ? 1.0f : 0.0f);
  solid_.set("line_scale", view.line_scale);
  glEnable(GL_CULL_FACE);
  for (const auto& surface : surfaces_) {
    if (surface->instances == 0) continue;
    solid_.set("radius_in_pixels", surface->radius * view.pixels_per_slope);
    surface->vertices.draw_corners(surface->instances);
  }
  glDisable(GL_CULL_FACE);
}

void BodyPass::draw_shadows(const ViewState& view, const Vector3<double>& normal, double offset, double reach) const {
  const Eigen::Vector3f n = normal.cast<float>();
  constexpr float grazing = 0.2f;
  if (n.dot(light) < grazing) return;
  shadow_.use();
  shadow_.set("to_clip", view.to_clip);
  shadow_.set("light", light);
  shadow_.set("plane", Eigen::Vector4f(n[0], n[1], n[2], float(offset - normal.dot(view.eye))));
  shadow_.set("reach", float(reach));
  // Shadows are drawn only on the floor, where FloorPass has set the stencil to 1, once for each pixel however many
  // bodies shade it. Only faces towards the light are drawn.
  glEnable(GL_STENCIL_TEST);
  glStencilFunc(GL_EQUAL, 1, 0xff);
  glStencilOp(GL_KEEP, GL_KEEP, GL_INCR);
  glEnable(GL_CULL_FACE);
  for (const auto& surface : surfaces_) {
    if (surface->instances > 0) surface->vertices.draw_corners(surface->instances);
  }
  glDisable(GL_CULL_FACE);
  glDisable(GL_STENCIL_TEST);
}

}  // namespace polhode::viewer::drawing
