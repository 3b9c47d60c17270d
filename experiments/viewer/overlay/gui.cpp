// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/overlay/gui.hpp"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

namespace polhode::viewer::inline overlay {
namespace {

/// The font, used if it is installed; it is that of the figures too.
constexpr const char* font = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
constexpr float font_size = 15;
constexpr ImWchar glyphs[] = {0x20,   0xff,   0x370,  0x3ff,  0x2010, 0x2027, 0x2070, 0x209f,
                              0x2190, 0x21ff, 0x2200, 0x22ff, 0x25a0, 0x25ff, 0};

}  // namespace

void Controls::named(const std::string& name) {
  const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
  places_[name] = {from.x, from.y, to.x, to.y};
}

void Controls::field_named(const std::string& name) {
  named(name);
  Place& place = places_[name];
  place.right = std::min(place.right, place.left + ImGui::CalcItemWidth());
}

const Controls::Place* Controls::find(const std::string& name) const {
  const auto found = places_.find(name);
  return found == places_.end() ? nullptr : &found->second;
}

Gui::Gui() {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGui::StyleColorsLight();
  ImGui::GetStyle().WindowRounding = 0;
  ImGui::GetStyle().FrameRounding = 3;
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  if (std::filesystem::exists(font)) io.Fonts->AddFontFromFileTTF(font, font_size, nullptr, glyphs);
  if (!ImGui_ImplOpenGL3_Init("#version 330 core")) throw std::runtime_error("Dear ImGui finds no OpenGL 3.3");
}

Gui::~Gui() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext();
}

void Gui::begin_offscreen(int width, int height, double seconds) {
  ImGui_ImplOpenGL3_NewFrame();
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {float(width), float(height)};
  io.DeltaTime = float(seconds > 0 ? seconds : 1e-3);
  ImGui::NewFrame();
  controls.begin_frame();
}

void Gui::draw() {
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace polhode::viewer::overlay
