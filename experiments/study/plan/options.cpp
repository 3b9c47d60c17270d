// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plan/options.hpp"

#include <CLI/CLI.hpp>
#include <charconv>
#include <system_error>

#include "experiments/study/record/run_options.hpp"
#include "experiments/study/record/shown_runs.hpp"
#include "experiments/study/text/command_line.hpp"
#include "experiments/study/text/input_error.hpp"

namespace polhode::study::inline plan {

std::vector<std::string> axis_names() {
  std::vector<std::string> all;
  for (const RunOption& option : run_options()) all.push_back(option.name);
  return all;
}

namespace {

/// The number that --curves gives; absent: all.
std::optional<std::size_t> curves_of(const std::string& text, const Experiment& experiment) {
  if (text.empty() && !experiment.curves_are_results) return most_curves;
  if (text.empty() || text == "all") return std::nullopt;
  const auto fault = [&](const std::string& what) {
    return InputError("--curves " + text + ": " + what + "; give all, none or a number of runs");
  };
  std::size_t number = 0;
  const bool none = text == "none";
  const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
  if (!none && (read.ec != std::errc() || read.ptr != text.data() + text.size())) throw fault("is no whole number");
  if (experiment.curves_are_results) throw fault(experiment.name + " derives its answer from the curves of all runs");
  return number;
}

}  // namespace

ParsedOptions parse_options(const Experiment& experiment, int argc, const char* const* argv,
                            const std::function<void(CLI::App&)>& more) {
  ParsedOptions parsed;
  Options& options = parsed.options;
  const std::string explained = experiment.meaning.empty() ? "" : "\n\n" + experiment.meaning;
  CLI::App app{experiment.question + explained +
                   "\n\nAxes take a list (a,b,c) or a range (1e-4:1e-1:10, or 1e-4:1e-1:10:log); the "
                   "study is their product. SI units throughout.",
               experiment.name};
  app.get_formatter()->column_width(40);
  std::map<std::string, std::string> given;
  for (const RunOption& axis : run_options()) {
    std::string meaning = axis.help;
    const auto preset = experiment.defaults.find(axis.name);
    if (preset != experiment.defaults.end()) meaning += " (default: " + preset->second + ")";
    app.add_option_function<std::string>(
           "--" + axis.name, [&given, name = axis.name](const std::string& text) { given[name] = text; }, meaning)
        ->type_name(axis.values)
        ->group("Axes");
  }
  std::vector<std::string> vary;
  std::string preset_vary;
  for (const auto& [key, values] : experiment.vary) {
    preset_vary += (preset_vary.empty() ? " (default, of the default scenario: " : " ") + key + "=" + values;
  }
  app.add_option("--vary", vary,
                 "any key of the scenario as an axis: body.0.inertia.1=0.5:3:20, or whole vectors: "
                 "'body.0.angular_velocity=[0,1,0];[1,0,0]'" +
                     preset_vary + (preset_vary.empty() ? "" : ")"))
      ->type_name("KEY=VALUES")
      ->allow_extra_args(false)
      ->group("Axes");
  std::optional<std::string> study_file;
  app.add_option("--study", study_file, "read axes from a TOML file; the command line overrides it")
      ->type_name("FILE")
      ->group("Axes");
  app.add_option("--out", options.out, "folder of the results (default: results/<experiment>-<scenario>-<hash>)")
      ->type_name("FOLDER")
      ->group("Results");
  app.add_flag("--force", options.force,
               "overwrite the results of a different study in that folder; runs of the same one that failed are "
               "carried out again")
      ->group("Results");
  std::string trajectory = experiment.one_run ? "csv" : "none";
  app.add_option("--trajectory", trajectory, "write the motion of every run (default: " + trajectory + ")")
      ->type_name("none|csv|hdf5")
      ->check(CLI::IsMember({"none", "csv", "hdf5"}).description(""))
      ->group("Results");
  app.add_flag(
         "--reference", options.reference,
         "where no exact solution is known, measure errors against a motion in extended precision that proves its "
         "digits by halving its step")
      ->group("Results");
  std::string curves;
  app.add_option("--curves", curves,
                 "curves of drift against time are kept for at most so many runs, of evenly chosen motions (default: " +
                     (experiment.curves_are_results ? "all" : std::to_string(most_curves)) + ")")
      ->type_name("all|none|N")
      ->group("Results");
  add_no_figures(app, options.figures)->group("Results");
  app.add_option("--jobs", options.jobs, "runs at a time (default: one for each core)")
      ->type_name("N")
      ->check(CLI::Range(1, 4096).description(""))
      ->group("Running");
  app.add_option(
         "--max-steps", options.max_steps,
         "a run of an adaptive method that is not at its end after so many steps has failed (default: 100000000)")
      ->type_name("N")
      ->check(CLI::Range(std::int64_t(1), std::int64_t(1) << 52).description(""))
      ->group("Running");
  app.add_option("--seed", options.seed, "seed of random studies (default: 1)")->type_name("N")->group("Running");
  app.add_flag("--dry-run", options.dry_run, "print the plan and write nothing")->group("Running");
  std::string list;
  CLI::Option* list_option =
      app.add_option("--list", list,
                     "print the catalogue: integrators, scenarios, forces, shapes, invariants, "
                     "broad-phases, narrow-phases, responses, impact-timings or metrics (default: all)")
          ->type_name("[WHAT]")
          ->expected(0, 1)
          ->group("Running");
  if (more) more(app);
  parsed.exit_status = parse_command_line(app, argc, argv);
  if (parsed.exit_status) return parsed;
  if (*list_option) options.list = list;
  options.trajectory = trajectory == "csv"    ? TrajectoryFormat::csv
                       : trajectory == "hdf5" ? TrajectoryFormat::hdf5
                                              : TrajectoryFormat::none;
  options.curves = curves_of(curves, experiment);
  options.command = command_text(experiment.name, argc, argv);
  options.axes = experiment.defaults;
  if (!study_file && !given.contains("scenario")) options.vary = experiment.vary;
  options.plain = given.empty() && vary.empty() && !study_file;
  if (study_file) read_study_file(*study_file, options);
  for (const std::string& axis : axis_names()) {
    if (given.contains(axis) || options.places.contains(axis)) options.said.insert(axis);
  }
  for (const auto& [name, text] : given) {
    options.axes[name] = text;
    options.places.erase(name);
  }
  for (const std::string& item : vary) {
    const auto equals = item.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw InputError("--vary " + item + ": it takes KEY=VALUES, for example body.0.inertia.1=0.5:3:20");
    }
    const std::string key = item.substr(0, equals);
    std::erase_if(options.vary, [&](const auto& v) { return v.first == key; });
    options.places.erase("vary." + key);
    options.vary.emplace_back(key, item.substr(equals + 1));
  }
  return parsed;
}

}  // namespace polhode::study::plan
