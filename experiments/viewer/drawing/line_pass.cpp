// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/drawing/line_pass.hpp"

#include <cstddef>

namespace polhode::viewer::inline drawing {

namespace {

// Each line is a rectangle on the screen, a pixel wider than the line; the part behind the eye is cut off.
constexpr const char* line_vertex = R"(
layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;
layout(location = 2) in vec4 colour_from;
layout(location = 3) in vec4 colour_to;
layout(location = 4) in float line_width;
layout(location = 5) in float round_ends;
uniform mat4 to_clip;
uniform vec2 half_size;
uniform float nearest, lift, line_scale;
noperspective out vec2 place;
flat out float line_length, half_width;
out vec4 colour;
vec4 lifted(vec3 x) { return to_clip * vec4(x * (1.0 - min(lift / max(length(x), 1e-20), 0.5)), 1); }
void main() {
  vec4 a = lifted(from), b = lifted(to);
  gl_Position = vec4(2, 2, 2, 1);
  if (a.w < nearest && b.w < nearest) return;
  if (a.w < nearest) a = mix(a, b, (nearest - a.w) / (b.w - a.w));
  if (b.w < nearest) b = mix(b, a, (nearest - b.w) / (a.w - b.w));
  vec2 start = a.xy / a.w * half_size, end = b.xy / b.w * half_size;
  vec2 way = end - start;
  line_length = length(way);
  way = line_length > 1e-6 ? way / line_length : vec2(1, 0);
  half_width = 0.5 * line_scale * line_width;
  float beyond = round_ends > 0.0 ? half_width + 1.0 : 0.0, aside = half_width + 1.0;
  bool at_end = (gl_VertexID & 1) == 1;
  vec2 shift = vec2(at_end ? beyond : -beyond, (gl_VertexID & 2) == 2 ? aside : -aside);
  place = vec2(at_end ? line_length : 0.0, 0.0) + shift;
  vec4 near = at_end ? b : a;
  colour = at_end ? colour_to : colour_from;
  vec2 pixel = (at_end ? end : start) + way * shift.x + vec2(-way.y, way.x) * shift.y;
  gl_Position = vec4(pixel / half_size * near.w, near.zw);
}
)";

constexpr const char* line_fragment = R"(
noperspective in vec2 place;
flat in float line_length, half_width;
in vec4 colour;
uniform float share;
out vec4 seen;
void main() {
  float away = length(place - vec2(clamp(place.x, 0.0, line_length), 0));
  seen = vec4(colour.rgb, colour.a * share * clamp(half_width - away + 0.5, 0.0, 1.0));
}
)";

}  // namespace

LinePass::LinePass() : program_(line_vertex, line_fragment) {
  using Per = VertexArray::Per;
  constexpr std::size_t stride = sizeof(LineInstance);
  lines_.floats(Per::instance, 0, 3, stride, offsetof(LineInstance, from));
  lines_.floats(Per::instance, 1, 3, stride, offsetof(LineInstance, to));
  lines_.bytes(Per::instance, 2, 4, stride, offsetof(LineInstance, colour_from));
  lines_.bytes(Per::instance, 3, 4, stride, offsetof(LineInstance, colour_to));
  lines_.floats(Per::instance, 4, 1, stride, offsetof(LineInstance, width));
  lines_.floats(Per::instance, 5, 1, stride, offsetof(LineInstance, round));
}

void LinePass::draw(const ViewState& view, std::span<const LineInstance> lines, double through, double lift) {
  if (lines.empty()) return;
  lines_.instances(lines);
  program_.use();
  program_.set("to_clip", view.to_clip);
  program_.set("half_size", view.half_size);
  program_.set("nearest", float(0.011 * view.distance));
  program_.set("lift", float(lift));
  program_.set("line_scale", view.line_scale);
  if (through > 0) {
    glDepthFunc(GL_GREATER);
    program_.set("share", float(through));
    lines_.draw(GL_TRIANGLE_STRIP, 4, lines.size());
    glDepthFunc(GL_LEQUAL);
  }
  program_.set("share", 1.0f);
  lines_.draw(GL_TRIANGLE_STRIP, 4, lines.size());
}

}  // namespace polhode::viewer::drawing
