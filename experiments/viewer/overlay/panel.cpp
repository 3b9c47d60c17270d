// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/overlay/panel.hpp"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "experiments/study/record/run_options.hpp"
#include "experiments/study/scenario/builtin_scenarios.hpp"
#include "experiments/study/text/input_error.hpp"

namespace polhode::viewer::inline overlay {
namespace {

constexpr float second_column = 150;  // place of the second check box in a line, pixels

bool button(Controls& controls, const char* label, const char* name) {
  const bool pressed = ImGui::Button(label);
  controls.named(name);
  return pressed;
}

bool check(Controls& controls, const char* label, const std::string& name, bool& value) {
  const bool changed = ImGui::Checkbox(label, &value);
  controls.named(name);
  return changed;
}

/// The width of the fields drawn during its lifetime: the usual one, but never so much that the label beside the field
/// is cut off, and more for a long text in the field if the label leaves room for it.
class FieldWidth {
 public:
  explicit FieldWidth(const char* label, const std::string& text = {}) {
    constexpr float least = 40;  // pixels
    const ImGuiStyle& style = ImGui::GetStyle();
    const float most = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(label).x - style.ItemInnerSpacing.x,
                needed = ImGui::CalcTextSize(text.c_str()).x + 2 * style.FramePadding.x + ImGui::GetFrameHeight();
    ImGui::PushItemWidth(std::max(std::min(std::max(ImGui::CalcItemWidth(), needed), most), least));
  }
  FieldWidth(const FieldWidth&) = delete;
  FieldWidth& operator=(const FieldWidth&) = delete;
  ~FieldWidth() { ImGui::PopItemWidth(); }
};

/// Draws a list of names. True if it has changed the value.
bool choose(Controls& controls, const char* label, const std::string& name, const std::vector<std::string>& items,
            std::string& value) {
  bool changed = false;
  const FieldWidth width(label, value);
  const bool open = ImGui::BeginCombo(label, value.empty() ? "default" : value.c_str(), ImGuiComboFlags_HeightLarge);
  if (!open) {
    controls.field_named(name);
    return false;
  }
  for (const std::string& item : items) {
    const std::string full = name + "/" + item;
    if (ImGui::Selectable(item.c_str(), item == value) && item != value) {
      value = item;
      changed = true;
    }
    controls.named(full);
    if (controls.reveal == full) ImGui::SetScrollHereY();
  }
  ImGui::EndCombo();
  return changed;
}

/// Draws a field for a positive number, which is set by Enter. True if it has changed the value.
bool enter(Controls& controls, const char* label, const char* name, double& value) {
  double typed = value;
  const bool entered = ImGui::InputDouble(label, &typed, 0, 0, "%.6g", ImGuiInputTextFlags_EnterReturnsTrue);
  controls.field_named(name);
  if (!entered || !(typed > 0) || !std::isfinite(typed)) return false;
  value = typed;
  return true;
}

std::vector<std::string> scenario_names() {
  std::vector<std::string> names;
  for (const study::BuiltinScenario& scenario : study::builtin_scenarios()) names.emplace_back(scenario.name);
  return names;
}

/// Draws a field for a text, which is set by Enter. True if it has changed the value.
bool type(Controls& controls, const char* label, const std::string& name, std::string& value) {
  std::array<char, 256> typed{};
  value.copy(typed.data(), typed.size() - 1);
  const FieldWidth width(label);
  const bool entered =
      ImGui::InputTextWithHint(label, "default", typed.data(), typed.size(), ImGuiInputTextFlags_EnterReturnsTrue);
  controls.field_named(name);
  if (!entered || value == typed.data()) return false;
  value = typed.data();
  return true;
}

/// Name of the control of a run option.
std::string control_of(const study::RunOption& option) {
  return option.name == "orientation" ? "chart" : study::file_key(option);  // scripts say chart
}

/// What is written beside the control of a run option.
std::string label_of(const study::RunOption& option) {
  if (!yes_of(option).empty() && !option.term.empty()) return option.term;
  const std::string text = option.header.empty() ? option.name : option.header;
  if (option.unit.empty()) return text;
  return text + (option.unit.find('/') == std::string::npos ? " / " + option.unit : " / (" + option.unit + ")");
}

/// Draws the control of a run option: a check box, a list, or a field. True if it has changed the value.
bool choose(Controls& controls, const study::RunOption& option, std::string& value) {
  const std::string label = label_of(option), name = control_of(option), yes = yes_of(option);
  if (!option.known) return type(controls, label.c_str(), name, value);
  const std::vector<std::string> known = option.known();
  if (yes.empty()) return choose(controls, label.c_str(), name, known, value);
  bool on = value == yes;
  if (!check(controls, label.c_str(), name, on)) return false;
  value = *std::find_if(known.begin(), known.end(), [&](const std::string& n) { return (n == yes) == on; });
  return true;
}

/// Shows what the option means, right of the panel, while the mouse is over its control, which was drawn last.
void explain(const study::RunOption& option) {
  constexpr float width = 400;  // pixels
  if (!ImGui::IsItemHovered()) return;
  ImGui::SetNextWindowPos({ImGui::GetWindowPos().x + ImGui::GetWindowWidth(), ImGui::GetItemRectMin().y});
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(width);
  ImGui::TextUnformatted(option.help.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

}  // namespace

std::optional<std::string> option_text(const study::RunConfig& run, const std::string& name) {
  for (const study::RunOption* option : chosen_options()) {
    if (control_of(*option) != name) continue;
    const std::string text = option->applies_to(run) ? value_text(*option, run) : "", yes = yes_of(*option);
    if (!yes.empty()) return text == yes ? "true" : "false";
    return text.empty() ? "none" : text;
  }
  return std::nullopt;
}

PanelWishes Panel::draw(Stage& stage, Controls& controls, float width, float height) {
  PanelWishes wishes;
  ImGui::SetNextWindowPos({0, 0});
  ImGui::SetNextWindowSize({width, height});
  ImGui::Begin("polhode", nullptr, ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse);
  // So close that the numbers below the controls of most scenarios are in sight.
  const ImGuiStyle& style = ImGui::GetStyle();
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {style.FramePadding.x, 2});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {style.ItemSpacing.x, 2});
  ImGui::PushItemWidth(-110);
  if (stage.live()) {
    std::string scenario = stage.setup().scenario;
    if (choose(controls, "scenario", "scenario", scenario_names(), scenario)) wishes.scenario = scenario;
  }
  time(stage, controls);
  const std::size_t runs_before = stage.size();
  if (stage.live()) {
    runs(stage, controls);
    method(stage, controls);
  }
  shown(stage, controls);
  wishes.camera = button(controls, "camera home", "camera") || stage.size() != runs_before;
  ImGui::SameLine();
  wishes.picture = button(controls, "save picture", "picture");
  numbers(stage);
  ImGui::PopItemWidth();
  ImGui::PopStyleVar(2);
  ImGui::End();
  return wishes;
}

void Panel::time(Stage& stage, Controls& controls) {
  const SessionStatus& first = stage.views().front()->status;
  bool playing = false;
  for (const auto& view : stage.views()) playing |= view->status.playing;
  if (button(controls, playing ? "pause" : "play", playing ? "pause" : "play")) {
    stage.each([&](Session& s) { playing ? s.pause() : s.play(); });
  }
  ImGui::SameLine();
  if (button(controls, "step", "step")) stage.each([](Session& s) { s.step(); });
  ImGui::SameLine();
  if (button(controls, "reset", "reset")) stage.each([](Session& s) { s.reset(); });
  speed_ = first.speed;
  float speed = float(speed_);
  if (ImGui::SliderFloat("speed", &speed, 0.01F, 100, "%.3g s per s", ImGuiSliderFlags_Logarithmic)) {
    speed_ = std::clamp(double(speed), 0.01, 100.0);
    stage.each([this](Session& s) { s.set_speed(speed_); });
  }
  controls.field_named("speed");
  double from = first.t_first, to = first.t_last;
  for (const auto& view : stage.views()) {
    from = std::max(from, view->status.t_first);
    to = std::min(to, view->status.t_last);
  }
  double t = std::clamp(stage.views().front()->frame.t, from, std::max(from, to));
  if (ImGui::SliderScalar("time / s", ImGuiDataType_Double, &t, &from, &to, "%.3f") && to > from) {
    stage.each([t](Session& s) { s.scrub(t); });
  }
  controls.field_named("time");
  if (stage.live() && check(controls, "pause on collision", "pause_on_collision", pause_on_collision_)) {
    stage.each([this](Session& s) { s.pause_on_collision(pause_on_collision_); });
  }
}

void Panel::runs(Stage& stage, Controls& controls) {
  run_ = std::min(run_, stage.size() - 1);
  ImGui::Separator();
  for (std::size_t k = 0; k < stage.size(); ++k) {
    if (k > 0) ImGui::SameLine();
    const std::string label = fmt::format("run {}", k + 1);
    if (ImGui::RadioButton(label.c_str(), k == run_)) run_ = k;
    controls.named(fmt::format("run_{}", k + 1));
  }
  constexpr std::size_t most = 6;
  if (stage.size() < most && button(controls, "add beside", "add")) {
    stage.add(stage.views()[run_]->configuration);
    stage.each([this](Session& s) {
      s.set_speed(speed_);
      s.pause_on_collision(pause_on_collision_);
    });
    stage.look_at_all();
    run_ = stage.size() - 1;
  }
  if (stage.size() > 1) {
    ImGui::SameLine();
    if (button(controls, "remove", "remove")) {
      stage.remove(run_);
      stage.look_at_all();
      run_ = std::min(run_, stage.size() - 1);
    }
  }
}

void Panel::change(Stage& stage, const Configuration& configuration) {
  refused_ = stage.session(run_).change(configuration);
}

void Panel::method(Stage& stage, Controls& controls) {
  Configuration c = stage.views()[run_]->configuration;
  study::RunConfig& run = c.run;
  std::string method = run.integrator;
  if (choose(controls, "integrator", "integrator", study::run_option("integrator").known(), method)) {
    choose_integrator(c, method, run.dt.value_or(1e-3), run.tolerance.value_or(1e-8));
    change(stage, c);
  }
  if (run.dt) {
    if (double dt = *run.dt; enter(controls, "dt / s", "dt", dt)) run.dt = dt, change(stage, c);
  } else if (double tolerance = run.tolerance.value_or(1e-8); enter(controls, "tolerance", "tolerance", tolerance)) {
    run.tolerance = tolerance;
    change(stage, c);
  }
  std::string drive(name(c.drive));
  if (choose(controls, "drive", "drive", {"accumulator", "frame_clock"}, drive)) {
    c.drive = drive == "accumulator" ? Drive::accumulator : Drive::frame_clock;
    change(stage, c);
  }
  options(stage, controls, c);
  if (!refused_.empty()) ImGui::TextWrapped("not changed: %s", refused_.c_str());
}

void Panel::options(Stage& stage, Controls& controls, Configuration& configuration) {
  bool box_at_left = false;  // check boxes stand two in a line
  for (const study::RunOption* option : chosen_options()) {
    if (!option->applies_to(configuration.run)) continue;
    const bool box = !yes_of(*option).empty();
    if (box && box_at_left) ImGui::SameLine(second_column);
    box_at_left = box && !box_at_left;
    std::string value = value_text(*option, configuration.run);
    ImGui::PushID(option->name.c_str());
    const bool chosen = choose(controls, *option, value);
    explain(*option);
    ImGui::PopID();
    if (!chosen) continue;
    try {
      choose_option(configuration, *option, value, stage.session(run_).scenario());
      change(stage, configuration);
    } catch (const study::InputError& error) {
      refused_ = error.what();
    }
  }
}

void Panel::shown(Stage& stage, Controls& controls) {
  ImGui::Separator();
  if (stage.moving().size() > 1) {
    std::string body = stage.moving()[stage.selected];
    if (choose(controls, "body", "body", stage.moving(), body)) {
      stage.selected =
          std::size_t(std::find(stage.moving().begin(), stage.moving().end(), body) - stage.moving().begin());
    }
  }
  Look& look = stage.look;
  const auto beside = [] { ImGui::SameLine(second_column); };
  check(controls, "body axes", "axes", look.axes);
  beside();
  check(controls, "angular velocity", "angular_velocity", look.angular_velocity);
  check(controls, "trails", "trails", stage.trails);
  beside();
  check(controls, "angular momentum", "angular_momentum", look.angular_momentum);
  check(controls, "polhode", "polhode", look.polhode);
  beside();
  check(controls, "contacts", "contacts", look.contacts);
  check(controls, "broad-phase cells", "cells", stage.cells);
  beside();
  if (check(controls, "Poinsot's plane", "poinsot", look.poinsot) && look.poinsot) look.polhode = true;
  if (stage.scene().joints.empty()) return;
  check(controls, "joints (J)", "joints", look.joints);
  beside();
  check(controls, "reactions (R)", "reactions", look.reactions);
}

void Panel::numbers(Stage& stage) {
  ImGui::Separator();
  const View& view = *stage.views()[std::min(run_, stage.size() - 1)];
  const Frame& frame = view.frame;
  ImGui::Text("step %lld, t = %.6f s", static_cast<long long>(frame.step), frame.t);
  ImGui::Text("energy %.9g J", frame.kinetic + frame.potential);
  ImGui::Text("energy drift %.3g J", frame.energy_drift);
  ImGui::Text("momentum drift %.3g kg m²/s", frame.momentum_drift);
  ImGui::Text("orientation defect %.3g", frame.defect);
  ImGui::Text("%zu contacts", frame.contacts.size());
  ImGui::Text("%.0f frames per second", double(ImGui::GetIO().Framerate));
  const std::vector<study::SceneJoint>& joints = stage.scene().joints;
  for (std::size_t i = 0; i < std::min(joints.size(), frame.reactions.size()); ++i)
    ImGui::Text("%s %.4g N", joints[i].name.c_str(), frame.reactions[i].force.norm());
}

}  // namespace polhode::viewer::overlay
