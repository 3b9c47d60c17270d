// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plan/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "experiments/study/plan/assignments.hpp"
#include "experiments/study/plan/axis_values.hpp"
#include "experiments/study/plan/figure_options.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/record/shown_runs.hpp"
#include "experiments/study/text/command_line.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/value_lists.hpp"
#include "integrators/catalogue.hpp"

namespace polhode::study::inline plan {
namespace {

/// True if the study names methods and no scenario, and each method solves the equations of joints itself.
bool are_methods_of_joints(const StudyAxes& study) {
  const auto named = study.axes.find("integrator");
  if (named == study.axes.end() || study.has("scenario")) return false;
  const auto names = axis_values(run_option("integrator"), named->second, study.label("integrator"));
  return std::all_of(names.begin(), names.end(), [](const OptionValue& name) {
    return find_integrator(text_of(name))->declaration.solves_joints();
  });
}

/// The words of the command line without these options, some of which take a value.
std::vector<std::string> words_without(const std::set<std::string_view>& with_value,
                                       const std::set<std::string_view>& flags, int argc, const char* const* argv) {
  std::vector<std::string> words;
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (with_value.contains(word)) ++i;
    else if (!flags.contains(word) && !with_value.contains(word.substr(0, word.find('=')))) words.emplace_back(word);
  }
  return words;
}

/// The command line without the options of jobs, which do not change results: a study that was carried out in parts has
/// the files of one that was not.
std::string command_of(const Experiment& experiment, int argc, const char* const* argv) {
  std::string command = "./run " + experiment.name;
  for (const std::string& word : words_without({"--shard", "--slurm"}, {"--merge", "--submit"}, argc, argv))
    command += " " + shell_word(word);
  return command;
}

/// The words of the command line that hold keys and values.
struct Words {
  std::vector<std::string> grid, zip, random, cells, where;
};

/// "KEY=VALUES" as a pair.
std::pair<std::string, std::string> key_and_values(const std::string& option, const std::string& item) {
  const auto equals = item.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw InputError(option + " " + item + ": it takes KEY=VALUES, for example body.0.inertia.1=0.5:3:20");
  }
  return {item.substr(0, equals), item.substr(equals + 1)};
}

PointTable zip_of_words(const std::string& text) {
  PointTable table{.kind = PointTable::Kind::zip, .label = "--zip", .columns = {}};
  for (const auto& [key, values] : assignments(text, table.label)) {
    const std::string label = table.label + " " + key;
    table.columns.push_back({axis_key(key, label), values, label});
  }
  return table;
}

PointTable random_of_words(const std::string& text, std::uint64_t seed) {
  PointTable table{.kind = PointTable::Kind::random, .label = "--random", .columns = {}, .seed = seed};
  std::set<std::string> said;
  for (const auto& [key, value] : assignments(text, table.label)) {
    const std::string label = table.label + " " + key;
    if (key == "n" || key == "seed") {
      if (!said.insert(key).second) throw InputError(label + ": it stands twice; leave one out");
      const auto x = to_number(value);
      if (!x) throw InputError(label + ": '" + value + "' is not a number");
      if (key == "n") table.n = number_of_points(*x, label);
      else table.seed = seed_from(*x, label);
    } else {
      table.columns.push_back({axis_key(key, label), value, label});
    }
  }
  if (table.n == 0) throw InputError("--random: the number of points is missing; give it, as in n=1000");
  if (table.columns.empty()) throw InputError("--random: no key is drawn; name one, as in dt=log_uniform(1e-4,1e-1)");
  return table;
}

/// The number of runs in "all", "none" or a number; absent: all. `label`: "--curves", or its place in the study file.
std::optional<std::size_t> curves_of(const std::string& text, const std::string& label, const Experiment& experiment) {
  if (text.empty() && !experiment.curves_are_results) return most_curves;
  if (text.empty() || text == "all") return std::nullopt;
  const auto fault = [&](const std::string& what) {
    return InputError(label + " " + text + ": " + what + "; give all, none or a number of runs");
  };
  std::size_t number = 0;
  const bool none = text == "none";
  const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
  if (!none && (read.ec != std::errc() || read.ptr != text.data() + text.size())) throw fault("is no whole number");
  if (experiment.curves_are_results) throw fault(experiment.name + " derives its answer from the curves of all runs");
  return number;
}

/// The axes of each study on the command line.
StudyAxes said_by(const Words& words, const std::map<std::string, std::string>& given,
                  const std::vector<std::string>& vary, std::uint64_t seed) {
  StudyAxes study;
  for (const auto& [name, text] : given) study.add_axis(name, text, "--" + name);
  for (const std::string& item : vary) {
    const auto [key, values] = key_and_values("--vary", item);
    study.add_axis(key, values, "--vary " + key, true);
  }
  for (const std::string& item : words.grid) {
    const auto [key, values] = key_and_values("--grid", item);
    study.add_axis(axis_key(key, "--grid " + key), values, "--grid " + key);
  }
  for (const std::string& text : words.zip) study.add_table(zip_of_words(text));
  for (const std::string& text : words.random) study.add_table(random_of_words(text, seed));
  for (const std::string& path : words.cells) study.add_table(table_of_cells(path, "--cells"));
  for (const std::string& text : words.where) study.where.push_back({text, "--where"});
  return study;
}

/// Values of the command line replace those of the study; its conditions hold besides those of the study.
void override_by(const StudyAxes& said, StudyAxes& study) {
  for (const auto& [key, text] : said.axes) study.remove(key);
  for (const auto& [key, text] : said.vary) study.remove(key);
  for (const PointTable& table : said.tables) {
    for (const PointColumn& column : table.columns) study.remove(column.key);
  }
  study.axes.insert(said.axes.begin(), said.axes.end());
  study.vary.insert(study.vary.end(), said.vary.begin(), said.vary.end());
  study.places.insert(said.places.begin(), said.places.end());
  study.tables.insert(study.tables.end(), said.tables.begin(), said.tables.end());
  study.where.insert(study.where.end(), said.where.begin(), said.where.end());
  for (const auto& [name, value] : said.settings) study.settings[name] = value;
}

}  // namespace

std::vector<std::string> axis_names() {
  std::vector<std::string> all;
  for (const RunOption& option : run_options()) {
    if (is_axis(option)) all.push_back(option.name);
  }
  return all;
}

ParsedOptions parse_options(const Experiment& experiment, int argc, const char* const* argv,
                            const std::function<void(CommandLine&)>& more) {
  ParsedOptions parsed;
  Options& options = parsed.options;
  const std::string explained = experiment.meaning.empty() ? "" : "\n\n" + experiment.meaning;
  CommandLine line{experiment.question + explained +
                       "\n\nAxes take a list (a,b,c) or a range (1e-4:1e-1:10, or 1e-4:1e-1:10:log); the "
                       "study is the product of all axes and tables of points. SI units throughout.",
                   experiment.name};
  std::map<std::string, std::string> given;
  for (const RunOption& axis : run_options()) {
    if (!is_axis(axis)) continue;
    std::string meaning = axis.help;
    const auto preset = experiment.defaults.find(axis.name);
    const auto jointed = experiment.with_joints.defaults.find(axis.name);
    if (preset != experiment.defaults.end())
      meaning += fmt::format(
          " (default: {}{})", preset->second,
          jointed == experiment.with_joints.defaults.end() ? "" : "; with methods of joints alone: " + jointed->second);
    line.add_function(
            "--" + axis.name, [&given, name = axis.name](const std::string& text) { given[name] = text; }, meaning)
        .type_name(values_in_studies(axis))
        .group("Axes");
  }
  std::vector<std::string> vary;
  std::string preset_vary;
  for (const auto& [key, values] : experiment.vary) {
    preset_vary += (preset_vary.empty() ? " (default, of the default scenario: " : " ") + key + "=" + values;
  }
  line.add("--vary", vary,
           "any key of the scenario as an axis: body.0.inertia.1=0.5:3:20, or whole vectors: "
           "'body.0.angular_velocity=[0,1,0];[1,0,0]'" +
               preset_vary + (preset_vary.empty() ? "" : ")"))
      .type_name("KEY=VALUES")
      .one_value_each_time()
      .group("Axes");
  Words words;
  const auto add_words = [&](const char* name, std::vector<std::string>& into, const char* type, const char* help) {
    line.add(name, into, help).type_name(type).one_value_each_time().group("Axes");
  };
  add_words("--grid", words.grid, "KEY=VALUES", "an axis by its name in study files: dt=1e-3,1e-2 or body.0.mass=1,2");
  add_words("--zip", words.zip, "KEY=VALUES…",
            "values side by side, as many for each key: 'dt=1e-3,1e-2 t-end=10,100'");
  add_words("--random", words.random, "n=N KEY=D…",
            "points drawn at random: 'n=1000 seed=7 body.0.inertia.0=uniform(0.5,3)'; further distributions: "
            "log_uniform(from,to), normal(mean,deviation), integer(from,to), choice(a,b), sphere(radius)");
  add_words("--cells", words.cells, "FILE",
            "points in a CSV table, whose columns are named after axes or scenario keys");
  add_words("--where", words.where, "CONDITION",
            "leave out all other cells: 'dt < 0.1 * body.0.inertia.1 and not (integrator == \"rk4\")'");
  std::optional<std::string> study_file;
  line.add("--study", study_file, "read studies from a TOML file, or one of them; the command line overrides it")
      .type_name("FILE[:NAME]")
      .group("Axes");
  line.add("--out", options.out, "folder of the results (default: results/<experiment>-<scenario>-<hash>)")
      .type_name("FOLDER")
      .not_empty()
      .group("Results");
  line.add_flag("--force", options.force,
                "overwrite the results of a different study in that folder; runs of the same one that failed are "
                "carried out again")
      .group("Results");
  std::string trajectory = experiment.one_run ? "csv" : "none";
  line.add("--trajectory", trajectory, "write the motion of every run (default: " + trajectory + ")")
      .type_name("none|csv|hdf5")
      .one_of({"none", "csv", "hdf5"})
      .group("Results");
  std::map<std::string, bool> flags;
  for (const RunOption* option : options_of_role(RunOption::Role::study))
    line.add_flag("--" + option->name, flags[option->name], option->help).group("Results");
  std::string curves;
  line.add("--curves", curves,
           "curves of drift against time are kept for at most so many runs, of evenly chosen motions (default: " +
               (experiment.curves_are_results ? "all" : std::to_string(most_curves)) + ")")
      .type_name("all|none|N")
      .group("Results");
  add_article(line, options.article).group("Results");
  const CommandLineOption no_figures = add_no_figures(line, options.figures).group("Figures");
  add_figure_options(line, options.figure_choice, !experiment.analysis, &no_figures);
  line.add("--jobs", options.jobs, "runs at a time (default: one for each core)")
      .type_name("N")
      .range(1, 4096)
      .group("Running");
  std::map<std::string, std::optional<std::int64_t>> numbers;
  for (const RunOption* option : options_of_role(RunOption::Role::call)) {
    line.add("--" + option->name, numbers[option->name], option->help)
        .type_name(option->values)
        .range(std::int64_t(1), std::int64_t(1) << 52)
        .group("Running");
  }
  line.add("--seed", options.seed, "seed of random points (default: 1)").type_name("N").group("Running");
  std::optional<std::string> shard;
  line.add("--shard", shard,
           "carry out the K-th of N parts of the study, in a store of its own; --merge joins them afterwards")
      .type_name("K/N")
      .group("Running");
  line.add_flag("--merge", options.merge, "join the results of shards, say what is missing, and carry out no run")
      .group("Running");
  line.add("--slurm", options.slurm,
           "write job scripts for Slurm and GNU parallel: 'shards=64 cpus=1 time=2:00:00 mem=2G account=A "
           "partition=P warning=60 rounds=3 option=--qos=long'")
      .type_name("KEY=VALUE…")
      .group("Running");
  line.add_flag("--submit", options.submit, "submit the scripts of --slurm").group("Running");
  line.add_flag("--dry-run", options.dry_run, "print the plan and write nothing").group("Running");
  std::string list;
  const CommandLineOption list_option =
      line.add("--list", list,
               "print the catalogue: integrators, scenarios, forces, shapes, invariants, "
               "broad-phases, narrow-phases, responses, impact-timings, figures or "
               "metrics (default: all), or all of it as json")
          .type_name("[WHAT]")
          .value_may_be_absent()
          .group("Running");
  if (more) more(line);
  parsed.exit_status = line.parse(argc, argv);
  if (parsed.exit_status) return parsed;
  if (list_option.given()) options.list = list;
  options.trajectory = trajectory == "csv"    ? TrajectoryFormat::csv
                       : trajectory == "hdf5" ? TrajectoryFormat::hdf5
                                              : TrajectoryFormat::none;
  options.words = words_without({"--shard", "--slurm"}, {"--merge", "--submit", "--force"}, argc, argv);
  if (options.submit && !options.slurm) throw InputError("--submit: there is nothing to submit; give --slurm too");
  if (shard) options.shard = read_shard(*shard, "--shard");
  if (options.slurm && (shard || options.merge))
    throw InputError("--slurm: its jobs carry out the shards and the merge; leave --shard and --merge out");
  if (shard && options.merge) throw InputError("--shard and --merge: a shard carries out runs, --merge does not");
  options.command = command_of(experiment, argc, argv);
  StudyAxes said = said_by(words, given, vary, options.seed);
  for (const auto& [name, is_given] : flags) {
    if (is_given) said.settings[name] = std::int64_t{1};
  }
  for (const auto& [name, number] : numbers) {
    if (number) said.settings[name] = *number;
  }
  options.plain = !study_file && said.said.empty() && said.vary.empty() && said.tables.empty();
  StudyFile file;
  if (study_file) file = read_study_file(*study_file, options.seed);
  else file.studies.emplace_back();
  options.curves = curves.empty() ? curves_of(file.curves, file.curves_label, experiment)
                                  : curves_of(curves, "--curves", experiment);
  options.study_file = file.path;
  options.study_file_hash = file.hash;
  options.shared = std::move(file.shared);
  options.shared.insert(said.said.begin(), said.said.end());
  for (StudyAxes& study : file.studies) {
    override_by(said, study);
    if (are_methods_of_joints(study)) {
      for (const auto& [name, text] : experiment.with_joints.defaults) {
        if (!study.table_with(name)) study.axes.try_emplace(name, text);
      }
      if (experiment.with_joints.reference) study.settings["reference"] = std::int64_t{1};
    }
    for (const auto& [name, text] : experiment.defaults) {
      if (!study.table_with(name)) study.axes.try_emplace(name, text);
    }
    if (study_file || said.has("scenario")) continue;
    for (const auto& [key, text] : experiment.vary) {
      if (!study.has(key)) study.vary.emplace_back(key, text);
    }
  }
  options.studies = std::move(file.studies);
  return parsed;
}

}  // namespace polhode::study::plan
