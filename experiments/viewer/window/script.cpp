// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/window/script.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <charconv>
#include <map>
#include <memory>
#include <sstream>
#include <utility>

#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/text_file.hpp"
#include "experiments/viewer/overlay/panel.hpp"

namespace polhode::viewer::inline window {
namespace {

/// Commands with the numbers of arguments that they take.
const std::map<std::string, std::vector<std::size_t>> commands = {
    {"click", {1}},     {"choose", {2}}, {"drag", {2}}, {"type", {2}},    {"wait", {1}},  {"until", {1, 2}},
    {"expect", {2, 3}}, {"pull", {2}},   {"key", {1}},  {"picture", {1}}, {"places", {1}}};
const std::map<std::string, int> keys = {{"space", GLFW_KEY_SPACE},
                                         {"right", GLFW_KEY_RIGHT},
                                         {"home", GLFW_KEY_HOME},
                                         {"j", GLFW_KEY_J},
                                         {"r", GLFW_KEY_R}};
constexpr int most_frames = 20000;   // longest wait
constexpr int patience = 300;        // frames until what is expected must hold; runs are threads of their own
constexpr float double_click_s = 5;  // longest time between its clicks: frames of a loaded machine are slow

}  // namespace

Script::Script(const std::string& file, FileMaker take_picture, FileMaker write_places)
    : file_(file), take_picture_(std::move(take_picture)), write_places_(std::move(write_places)) {
  std::istringstream text(study::read_text(file, study::mebibyte));
  int n = 0;
  for (std::string line; std::getline(text, line);) {
    line_ = {++n, {}};
    std::istringstream words(line);
    for (std::string word; words >> word;) line_.words.push_back(word);
    if (line_.words.empty() || line_.words.front().starts_with('#')) continue;
    const auto known = commands.find(line_.words.front());
    if (known == commands.end()) fail("no command '" + line_.words.front() + "'");
    bool fits = false;
    for (const std::size_t count : known->second) fits |= line_.words.size() == count + 1;
    if (!fits) fail("'" + known->first + "' takes " + std::to_string(known->second.front()) + " words");
    lines_.push_back(line_);
  }
}

void Script::fail(const std::string& why) const {
  throw study::InputError(fmt::format("{}:{}: {}", file_, line_.number, why));
}

double Script::number(const std::string& word) const {
  double x = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), x);
  if (error != std::errc() || end != word.data() + word.size()) fail("'" + word + "' is not a number");
  return x;
}

void Script::before_frame() {
  ImGuiIO& io = ImGui::GetIO();
  if (!inputs_.empty()) {
    now_ = inputs_.front();
    inputs_.pop_front();
  } else {
    now_.pressed = false;
    now_.key = 0;
    now_.typed.clear();
  }
  io.MouseDoubleClickTime = double_click_s;
  io.MousePos = {now_.x, now_.y};
  io.MouseDown[0] = now_.pressed;
  io.KeysDown[GLFW_KEY_ENTER] = now_.key == GLFW_KEY_ENTER;
  for (const auto& [name, key] : keys) io.KeysDown[key] = key == now_.key;
  if (!now_.typed.empty()) io.AddInputCharactersUTF8(now_.typed.c_str());
}

void Script::after_frame(Stage& stage, Controls& controls) {
  if (!inputs_.empty()) return;
  if (!opened_.empty()) {  // a list opens in the frame after the click, and scrolls in the one after that
    const Controls::Place* item = controls.find(opened_);
    if (!item && waited_ > 10) fail("no '" + opened_ + "' in the list");
    if (++waited_ < 4 || !item) return;
    controls.reveal.clear();
    const std::string name = std::exchange(opened_, {});
    click(controls, name);
    return;
  }
  while (!lines_.empty() && inputs_.empty() && opened_.empty()) {
    line_ = lines_.front();
    const std::string& command = line_.words[0];
    if (command == "wait" || command == "until") {
      const bool over = command == "wait" ? waited_ >= number(line_.words[1]) : holds(stage, line_.words);
      if (!over) {
        if (++waited_ > most_frames) fail("waited for " + std::to_string(most_frames) + " frames");
        return;
      }
    }
    if (command == "expect" && !holds(stage, line_.words) && ++waited_ < patience) return;
    lines_.pop_front();
    waited_ = 0;
    take(stage, controls);
  }
}

void Script::click(const Controls& controls, const std::string& name, float share) {
  const Controls::Place* place = controls.find(name);
  if (!place) fail("there is no control '" + name + "' now");
  Input at;
  at.x = place->left + share * (place->right - place->left);
  at.y = (place->upper + place->lower) / 2;
  inputs_.push_back(at);
  at.pressed = true;
  inputs_.push_back(at);
  inputs_.push_back(at);
  at.pressed = false;
  inputs_.push_back(at);
  inputs_.push_back(at);
}

void Script::take(Stage& stage, Controls& controls) {
  const std::vector<std::string>& w = line_.words;
  if (w[0] == "click") {
    click(controls, w[1]);
  } else if (w[0] == "choose") {
    click(controls, w[1], 0.2F);
    opened_ = controls.reveal = w[1] + "/" + w[2];
  } else if (w[0] == "drag") {
    click(controls, w[1], float(number(w[2])));
  } else if (w[0] == "type") {
    click(controls, w[1], 0.2F);
    inputs_.pop_back();
    Input again = inputs_.back();
    again.pressed = true;
    inputs_.push_back(again);  // the second click of a double click, which selects all
    again.pressed = false;
    inputs_.push_back(again);
    again.typed = w[2];
    inputs_.push_back(again);
    again.typed.clear();
    again.key = GLFW_KEY_ENTER;
    inputs_.push_back(again);
    again.key = 0;
    inputs_.push_back(again);
    inputs_.push_back(again);
  } else if (w[0] == "expect") {
    if (!holds(stage, w))
      fail(fmt::format("expected {}; it is {}", fmt::join(w.begin() + 1, w.end(), " "), value(stage, w[1])));
  } else if (w[0] == "pull") {
    Input at;
    at.x = view_x_;
    at.y = view_y_;
    inputs_.push_back(at);
    at.pressed = true;
    inputs_.push_back(at);
    for (int n = 0; n < 10; ++n) {
      at.x += float(number(w[1])) / 10;
      at.y += float(number(w[2])) / 10;
      inputs_.push_back(at);
    }
    at.pressed = false;
    inputs_.push_back(at);
    inputs_.push_back(at);
  } else if (w[0] == "key") {
    const auto found = keys.find(w[1]);
    if (found == keys.end()) fail("no key '" + w[1] + "'; there are home, j, r, right and space");
    Input at = now_;
    at.key = found->second;
    inputs_.push_back(at);
    at.key = 0;
    inputs_.push_back(at);
    inputs_.push_back(at);
  } else if (w[0] == "picture") {
    take_picture_(w[1]);
  } else if (w[0] == "places") {
    write_places_(w[1]);
  }
}

std::string Script::value(Stage& stage, const std::string& of) const {
  std::size_t k = 0;
  std::string name = of;
  if (of.size() > 2 && of[of.size() - 2] == '#') {  // t#2: time of the second run
    k = std::size_t(of.back() - '1');
    name = of.substr(0, of.size() - 2);
  }
  if (k >= stage.size()) fail("there are " + std::to_string(stage.size()) + " runs");
  const std::shared_ptr<const View> latest = stage.session(k).view();  // lives on when the session publishes the next
  const View& view = *latest;
  const study::RunConfig& run = view.configuration.run;
  const auto truth = [](bool x) { return std::string(x ? "true" : "false"); };
  const std::map<std::string, std::function<std::string()>> values = {
      {"t", [&] { return fmt::format("{}", view.frame.t); }},
      {"step", [&] { return std::to_string(view.frame.step); }},
      {"segment", [&] { return std::to_string(view.status.segment); }},
      {"contacts", [&] { return std::to_string(view.frame.contacts.size()); }},
      {"cells", [&] { return std::to_string(view.frame.cells.size()); }},
      {"speed", [&] { return fmt::format("{}", view.status.speed); }},
      {"runs", [&] { return std::to_string(stage.size()); }},
      {"body", [&] { return stage.moving()[stage.selected]; }},
      {"scenario", [&] { return stage.setup().scenario; }},
      {"playing", [&] { return truth(view.status.playing); }},
      {"paused", [&] { return truth(!view.status.playing); }},
      {"collision", [&] { return truth(view.status.paused_at_collision); }},
      {"at_end", [&] { return truth(view.status.at_end); }},
      {"integrator", [&] { return run.integrator; }},
      {"dt", [&] { return run.dt ? fmt::format("{}", *run.dt) : "none"; }},
      {"tolerance", [&] { return run.tolerance ? fmt::format("{}", *run.tolerance) : "none"; }},
      {"drive", [&] { return std::string(viewer::name(view.configuration.drive)); }},
      {"axes", [&] { return truth(stage.look.axes); }},
      {"angular_velocity", [&] { return truth(stage.look.angular_velocity); }},
      {"angular_momentum", [&] { return truth(stage.look.angular_momentum); }},
      {"trails", [&] { return truth(stage.trails); }},
      {"polhode", [&] { return truth(stage.look.polhode); }},
      {"contacts_shown", [&] { return truth(stage.look.contacts); }},
      {"joints_shown", [&] { return truth(stage.look.joints); }},
      {"reactions_shown", [&] { return truth(stage.look.reactions); }},
      {"reactions", [&] { return std::to_string(view.frame.reactions.size()); }},
      {"poinsot", [&] { return truth(stage.look.poinsot); }},
      {"azimuth", [&] { return fmt::format("{}", stage.camera.azimuth); }},
  };
  if (const auto option = option_text(run, name)) return *option;
  const auto found = values.find(name);
  if (found == values.end()) fail("nothing is called '" + name + "'");
  return found->second();
}

/// `expect NAME TEXT`, `expect NAME < NUMBER`, `until NAME NUMBER` (at least), `until NAME` (true).
bool Script::holds(Stage& stage, const std::vector<std::string>& words) const {
  const std::string is = value(stage, words[1]);
  if (words[0] == "until") return words.size() == 2 ? is == "true" : number(is) >= number(words[2]);
  if (words.size() == 3) return is == words[2];
  if (words[2] == "<") return number(is) < number(words[3]);
  if (words[2] == ">") return number(is) > number(words[3]);
  fail("'" + words[2] + "' is neither < nor >");
}

}  // namespace polhode::viewer::window
