// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/overlay/captions.hpp"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

namespace polhode::viewer::inline overlay {
namespace {

ImU32 colour(Colour c) { return IM_COL32(c.red, c.green, c.blue, c.alpha); }

/// Draws a text on a pale background, so that it is legible over any picture.
void write(float left, float upper, const std::string& text, Colour ink) {
  ImDrawList* list = ImGui::GetBackgroundDrawList();
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  list->AddRectFilled({left - 3, upper - 1}, {left + size.x + 3, upper + size.y + 1}, IM_COL32(255, 255, 255, 150), 3);
  list->AddText({left, upper}, colour(ink), text.c_str());
}

std::string state_of(const View& view) {
  const SessionStatus& status = view.status;
  if (!status.message.empty()) return status.message;
  if (status.slower_than_wanted)
    return fmt::format("slower than wanted: {:.2g} of {:.2g} s per s", status.pace, status.speed);
  return {};
}

/// Text about the deepest contact of a run that paused at a collision.
std::string collision(const View& view) {
  if (!view.status.paused_at_collision || view.frame.contacts.empty()) return {};
  const auto deepest = std::max_element(view.frame.contacts.begin(), view.frame.contacts.end(),
                                        [](const FrameContact& a, const FrameContact& b) { return a.depth < b.depth; });
  return fmt::format("collision: {} point{}, depth {:.3g} m, normal ({:.3f}, {:.3f}, {:.3f})",
                     view.frame.contacts.size(), view.frame.contacts.size() == 1 ? "" : "s", deepest->depth,
                     deepest->normal[0], deepest->normal[1], deepest->normal[2]);
}

}  // namespace

void write_captions(Stage& stage, const std::vector<Label>& labels, const Rectangle& area, int picture_height) {
  for (const Label& label : labels) write(float(label.right), float(label.down), label.text, label.colour);
  const float line = ImGui::GetTextLineHeight() + 5;
  for (std::size_t k = 0; k < stage.size(); ++k) {
    const View& view = *stage.views()[k];
    const Rectangle part = stage.part(k, area);
    const float left = float(part.left) + 10;
    float upper = float(picture_height - part.bottom - part.height) + 8;
    write(left, upper, stage.title(k, view), colours::ink);
    write(left, upper += line, fmt::format("t = {:.3f} s", view.frame.t), colours::ink);
    for (const std::string& text : {collision(view), state_of(view)}) {
      if (!text.empty()) write(left, upper += line, text, colours::normal);
    }
    if (k > 0) {  // a line between the rectangles of the runs
      ImDrawList* list = ImGui::GetBackgroundDrawList();
      const float from = float(picture_height - part.bottom - part.height), to = float(picture_height - part.bottom);
      list->AddLine({float(part.left), from}, {float(part.left), to}, IM_COL32(120, 128, 140, 255), 1.5F);
    }
  }
}

}  // namespace polhode::viewer::overlay
