// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "experiments/study/record/run_options.hpp"
#include "experiments/study/text/command_line.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/suggestion.hpp"
#include "experiments/study/text/value_lists.hpp"

namespace polhode::viewer {
namespace {

/// Values of the options as written on the command line.
struct Said {
  std::string scenario = "dzhanibekov", integrator = "rk4", dt = "1e-3", tolerance = "1e-8";
  std::string drive = "accumulator";
  std::map<const study::RunOption*, std::string> options;  ///< values of chosen_options(); empty: not given
  std::vector<std::string> vary;
  std::string size = "1280x720", show = "trails,contacts,joints,reactions";
  std::optional<double> azimuth, elevation;
};

[[noreturn]] void refuse(const std::string& option, const std::string& word,
                         const std::vector<std::string_view>& known) {
  throw study::InputError(option + ": no '" + word + "'" + study::suggestion(word, "There are", known));
}

template <class T>
T one_of(const std::string& option, const std::string& word, const std::map<std::string_view, T>& known) {
  const auto found = known.find(word);
  if (found != known.end()) return found->second;
  std::vector<std::string_view> names;
  for (const auto& entry : known) names.push_back(entry.first);
  refuse(option, word, names);
}

bool on(const std::string& option, const std::string& word) {
  return one_of<bool>(option, word, {{"on", true}, {"off", false}});
}

void read_size(const std::string& text, int& width, int& height) {
  const auto times = text.find('x');
  const auto part = [&](std::size_t from, std::size_t count) {
    int n = 0;
    for (const char c : text.substr(from, count)) n = c >= '0' && c <= '9' && n < 100000 ? 10 * n + (c - '0') : 1000000;
    return n;
  };
  if (times != std::string::npos) width = part(0, times), height = part(times + 1, std::string::npos);
  if (times == std::string::npos || width < 64 || height < 64 || width > 16384 || height > 16384) {
    throw study::InputError("--size: '" + text + "' is no size in pixels from 64x64 to 16384x16384, such as 1280x720");
  }
}

Shown read_shown(const std::string& list) {
  Shown shown;
  shown.trails = shown.contacts = shown.joints = shown.reactions = false;
  const std::map<std::string_view, bool Shown::*> known = {
      {"axes", &Shown::axes},         {"omega", &Shown::angular_velocity}, {"momentum", &Shown::angular_momentum},
      {"trails", &Shown::trails},     {"polhode", &Shown::polhode},        {"poinsot", &Shown::poinsot},
      {"contacts", &Shown::contacts}, {"joints", &Shown::joints},          {"reactions", &Shown::reactions},
      {"cells", &Shown::cells}};
  if (list == "none") return shown;
  for (const std::string& word : study::split_list(list, ',', "--show")) shown.*one_of("--show", word, known) = true;
  return shown;
}

/// Throws InputError if an option on the command line affects none of the runs.
void refuse_without_effect(const Said& said, const std::vector<Configuration>& runs) {
  for (const study::RunOption* option : chosen_options()) {
    const auto has_effect = [&](const Configuration& c) { return option->applies_to(c.run); };
    if (said.options.at(option).empty() || std::any_of(runs.begin(), runs.end(), has_effect)) continue;
    throw study::InputError(fmt::format("--{}: it has no effect, because {}; leave it out, {}", option->name,
                                        option->no_effect, option->remedy));
  }
}

std::vector<Configuration> configurations(const Said& said, const study::Scenario& scenario) {
  Configuration base = usual_configuration(scenario);
  base.drive =
      one_of<Drive>("--drive", said.drive, {{"accumulator", Drive::accumulator}, {"frame_clock", Drive::frame_clock}});
  std::vector<Configuration> all;
  for (const std::string& method : study::split_list(said.integrator, ',', "--integrator")) {
    choose_integrator(base, method);
    const bool fixed = base.run.dt.has_value();
    for (const double x : study::numbers(fixed ? said.dt : said.tolerance, fixed ? "--dt" : "--tolerance")) {
      Configuration c = base;
      choose_integrator(c, method, x, x);
      for (const study::RunOption* option : chosen_options()) {
        const std::string& value = said.options.at(option);
        if (!value.empty() && option->applies_to(c.run)) choose_option(c, *option, value, scenario);
      }
      if (const std::string why = refusal(c, scenario); !why.empty()) throw study::InputError(why);
      all.push_back(c);
    }
  }
  refuse_without_effect(said, all);
  constexpr std::size_t most = 6;
  if (all.size() > most)
    throw study::InputError(fmt::format("{} runs side by side; at most {} are legible", all.size(), most));
  return all;
}

std::vector<study::Override> overrides_of(const std::vector<std::string>& vary) {
  std::vector<study::Override> all;
  for (const std::string& text : vary) {
    const auto is = text.find('=');
    if (is == std::string::npos) throw study::InputError("--vary " + text + ": say KEY=VALUE, such as body.0.mass=2");
    all.push_back({text.substr(0, is), text.substr(is + 1)});
  }
  return all;
}

}  // namespace

Options parse(const std::string& question, int argc, const char* const* argv) {
  Options options;
  Said said;
  std::vector<std::string> trajectories;
  std::string list, out, film, record = "on", captions = "on";
  study::CommandLine line{question, "viewer"};
  const auto add = [&line](const std::string& name, auto& to, const std::string& help, const std::string& type,
                           const std::string& group) { return line.add(name, to, help).type_name(type).group(group); };
  const char* const scene = "What moves";
  add("--scenario", said.scenario, "scenario, built in or a TOML file, see --list scenarios (default: dzhanibekov)",
      "NAME|FILE", scene);
  add("--integrator", said.integrator, "method, or several side by side, see --list integrators (default: rk4)",
      "NAMES", scene);
  add("--dt", said.dt, "step in s of fixed-step methods, or several (default: 1e-3)", "S", scene);
  add("--tolerance", said.tolerance, "relative and absolute, of adaptive methods, or several (default: 1e-8)", "X",
      scene);
  for (const study::RunOption* option : chosen_options()) {
    const std::string names = option->takes_all ? fmt::format(", see --list {}s", option->name) : "";
    add("--" + option->name, said.options[option], option->help + names, option->values, scene);
  }
  add("--vary", said.vary, "a key of the scenario: body.0.mass=2", "KEY=VALUE", scene);
  add("--drive", said.drive,
      "accumulator: steps of dt as time passes; frame_clock: one step a frame, of the time between two (default: "
      "accumulator)",
      "NAME", scene);
  add("--trajectory", trajectories, "play recorded trajectories of the scenario instead: trajectory.csv of a study",
      "FILE", scene);
  add("--rerun", options.rerun, "carry a recorded session out again, without window and pace, and compare its end",
      "FILE", scene);
  const char* const look = "What is seen";
  add("--size", said.size, "in pixels (default: 1280x720)", "WxH", look);
  add("--show", said.show,
      "axes, omega, momentum, trails, polhode, poinsot (rolling on its plane), contacts, joints, reactions, cells, or "
      "none (default: trails,contacts,joints,reactions)",
      "LIST", look);
  add("--azimuth", said.azimuth, "of the camera about z in rad (default: as the scene asks for)", "RAD", look);
  add("--elevation", said.elevation, "of the camera in rad", "RAD", look);
  add("--zoom", options.window.shown.zoom, "so many times as near (default: 1)", "X", look).range(1e-3, 1e3);
  add("--speed", options.window.speed, "simulated seconds to one of the wall, or of the film (default: 1)", "X", look)
      .range(1e-6, 1e6);
  add("--samples", options.window.samples, "a pixel: 1, 2, 4 or 8 (default: 4; 1 in a window that the processor draws)",
      "N", look)
      .one_of({"1", "2", "4", "8"});
  line.add_flag("--play", options.window.play, "begin at once").group(look);
  add("--script", options.window.script, "clicks and looks as this file says, then ends", "FILE", look);
  const char* const pictures = "Pictures and films, without a display";
  line.add_flag("--offscreen", options.offscreen, "pictures instead of a window").group(pictures);
  add("--from", options.pictures.from, "the first picture, in s (default: 0)", "S", pictures);
  add("--duration", options.pictures.duration, "simulated, in s; 0 for one picture (default: to the end)", "S",
      pictures);
  add("--frames-per-second", options.pictures.frames_per_second, "of the film (default: 30)", "N", pictures)
      .range(1, 240);
  add("--film", film, "also make a film of the pictures, by ffmpeg", "FILE", pictures);
  line.add_flag("--pause-on-collision", options.pictures.pause_on_collision, "end with the first collision")
      .group(pictures);
  line.add_flag("--plots", options.pictures.plots, "energy, momentum and defect below").group(pictures);
  add("--captions", captions, "method and time in the picture: on, off (default: on)", "ON|OFF", pictures);
  add("--out", out, "folder of sessions and pictures (default: results/viewer-<scenario>)", "FOLDER", "Output")
      .not_empty();
  add("--record", record, "session.toml of each live session: on, off (default: on)", "ON|OFF", "Output");
  add("--write-trajectory", options.stage.trajectory,
      "the motion of each session, as a study writes it, into this folder", "FOLDER", "Output");
  const study::CommandLineOption list_option =
      line.add("--list", list, "print the catalogue, for example scenarios (default: all)")
          .type_name("[WHAT]")
          .value_may_be_absent();
  options.exit_status = line.parse(argc, argv);
  if (options.exit_status) return options;
  if (list_option.given()) options.list = list;
  if (options.list || !options.rerun.empty()) return options;

  options.stage.scenario = said.scenario;
  options.stage.overrides = overrides_of(said.vary);
  options.stage.trajectories = trajectories;
  const study::Scenario scenario = study::ScenarioSource::open(said.scenario).resolve(options.stage.overrides);
  if (trajectories.empty()) options.stage.configurations = configurations(said, scenario);
  if (out.empty()) out = "results/viewer-" + scenario.name;
  if (on("--record", record) && !options.offscreen) options.stage.out = out;
  read_size(said.size, options.window.width, options.window.height);
  const double zoom = options.window.shown.zoom;
  options.window.shown = read_shown(said.show);
  options.window.shown.zoom = zoom;
  options.window.shown.azimuth = said.azimuth;
  options.window.shown.elevation = said.elevation;
  options.window.out = options.pictures.out = out;
  options.pictures.width = options.window.width;
  options.pictures.height = options.window.height;
  options.pictures.samples = options.window.samples.value_or(4);
  options.pictures.speed = options.window.speed;
  options.pictures.shown = options.window.shown;
  options.pictures.film = film;
  options.pictures.captions = on("--captions", captions);
  options.pictures.frames = film.empty() || options.pictures.duration == 0;
  if (options.pictures.from && !(*options.pictures.from >= 0)) throw study::InputError("--from: must not be negative");
  if (options.pictures.duration && !(*options.pictures.duration >= 0))
    throw study::InputError("--duration: must not be negative");
  return options;
}

}  // namespace polhode::viewer
