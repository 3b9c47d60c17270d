// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/replay/study_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "experiments/study/metrics/references.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/scenario/scenario_keys.hpp"
#include "experiments/study/text/csv_reader.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/text_file.hpp"
#include "experiments/study/text/value_lists.hpp"
#include "experiments/study/trajectory/kept_trajectory.hpp"
#include "experiments/study/trajectory/reaction_reader.hpp"
#include "experiments/study/trajectory/trajectory_reader.hpp"

namespace polhode::study::replay {
namespace {

using Json = nlohmann::json;
using Path = std::filesystem::path;

/// A run of the study.
struct KeptRun {
  std::string id, status, message, energy_drift_max;
  RunConfig config;
  Path motion;  ///< folder of its trajectory
};

/// Reads the configurations of runs from runs.csv, whose columns may stand in any order.
class ConfigColumns {
 public:
  explicit ConfigColumns(const CsvReader& table) {
    const auto& names = table.names();
    for (const RunOption* option : options_by_column()) {
      const bool needed = option->name == "scenario" || option->name == "integrator" || option->name == "t-end";
      const bool there = std::find(names.begin(), names.end(), option->column) != names.end();
      if (!option->column.empty() && (needed || there)) options_.emplace_back(option, table.column(option->column));
    }
    for (const std::string& name : names) {
      const bool is_varied = find_key(root_keys(), name.substr(0, name.find('.'))) != nullptr;
      if (is_varied) varied_[name] = table.column(name);
    }
  }

  /// The configuration in the present row.
  RunConfig read(const CsvReader& table) const {
    RunConfig config;
    for (const auto& [option, column] : options_) {
      const bool needed = option->name == "t-end";
      if (needed || !table.text(column).empty()) set(*option, table, column, config);
    }
    for (const auto& [key, column] : varied_) config.varied.push_back({key, table.text(column)});
    return config;
  }

 private:
  static void set(const RunOption& option, const CsvReader& table, std::size_t column, RunConfig& config) {
    if (option.kind == RunOption::Kind::name) {
      option.set(config, table.text(column));
      if (text_of(option.value(config)) != table.text(column)) {
        table.fail(column,
                   option.column + " has a value that --" + option.name + " does not take; make the study again");
      }
      return;
    }
    const double x = table.number(column);
    if (!(x > 0) || !std::isfinite(x))
      table.fail(column, option.column + " is not a positive number; make the study again");
    if (option.kind == RunOption::Kind::whole) option.set(config, table.integer(column));
    else option.set(config, x);
  }

  std::vector<std::pair<const RunOption*, std::size_t>> options_;
  std::map<std::string, std::size_t> varied_;
};

std::vector<KeptRun> read_runs(const Path& folder) {
  CsvReader table((folder / "runs.csv").string());
  const std::size_t id = table.column("run"), status = table.column("status"), message = table.column("message"),
                    drift = table.column("energy_drift_max_rel");
  const ConfigColumns configs(table);
  std::vector<KeptRun> runs;
  while (table.next()) {
    KeptRun run{table.text(id),    table.text(status),  table.text(message),
                table.text(drift), configs.read(table), folder};
    if (std::filesystem::exists(folder / "trajectories" / run.id)) run.motion = folder / "trajectories" / run.id;
    runs.push_back(std::move(run));
  }
  return runs;
}

/// Throws InputError if the folder of a run holds a trajectory that is not whole, and no trajectory.csv.
void refuse_unfinished(const Path& motion) {
  if (exists(motion / "trajectory.csv")) return;
  for (const auto format : {TrajectoryFormat::csv, TrajectoryFormat::hdf5}) {
    const auto kept = kept_trajectory(motion, format);
    if (!kept || kept->condition == KeptTrajectory::Condition::whole) continue;
    throw InputError(fmt::format("{}: is {}; {}", kept->tables.front().file.string(), in_words(*kept), remedy(*kept)));
  }
}

std::vector<KeptRun> chosen(std::vector<KeptRun> runs, const Path& folder, const std::vector<std::string>& ids,
                            std::size_t most) {
  for (const std::string& id : ids) {
    if (std::none_of(runs.begin(), runs.end(), [&](const KeptRun& r) { return r.id == id; })) {
      throw InputError(
          fmt::format("--runs: {} has no run {}; the first column of runs.csv names them", folder.string(), id));
    }
  }
  if (!ids.empty())
    std::erase_if(runs, [&](const KeptRun& r) { return std::find(ids.begin(), ids.end(), r.id) == ids.end(); });
  for (const KeptRun& r : runs) refuse_unfinished(r.motion);
  const bool only_hdf5 =
      std::any_of(runs.begin(), runs.end(), [](const KeptRun& r) { return exists(r.motion / "trajectory.h5"); });
  std::erase_if(runs, [](const KeptRun& r) { return !exists(r.motion / "trajectory.csv"); });
  if (runs.empty()) {
    throw InputError(
        folder.string() +
        (only_hdf5 ? " keeps its motion as HDF5 only, which replay does not read" : " keeps no trajectory") +
        "; make it again with --trajectory csv");
  }
  const auto other = [&](const KeptRun& r) { return r.config.scenario != runs.front().config.scenario; };
  if (std::any_of(runs.begin(), runs.end(), other)) {
    throw InputError(folder.string() + " has runs of several scenarios; name those of one with --runs ID,ID");
  }
  if (runs.size() > most) {
    throw InputError(fmt::format("{} has the motion of {} runs, and a page shows at most {}; choose with --runs ID,ID",
                                 folder.string(), runs.size(), most));
  }
  return runs;
}

Json read_manifest(const Path& folder) {
  const Path path = folder / "manifest.json";
  if (!std::filesystem::exists(path))
    throw InputError(path.string() + ": no such file; it says which scenario the study is of");
  try {
    Json manifest = Json::parse(read_text(path.string()));
    if (!manifest.is_object()) throw InputError(path.string() + ": is no manifest of a study; make the study again");
    for (const char* name : {"/command", "/axes/scenario", "/polhode/version", "/polhode/commit"}) {
      const Json::json_pointer at(name);
      if (manifest.contains(at) && !manifest[at].is_string())
        throw InputError(path.string() + ": " + name + " is no text; make the study again");
    }
    return manifest;
  } catch (const Json::exception&) {
    throw InputError(path.string() + ": is no manifest in JSON; make the study again");
  }
}

/// The scenario `name` as given on the command line of the study: the path of a file, or the name itself.
std::string said_scenario(const Json& manifest, const std::string& name) {
  const std::string said = manifest.value(Json::json_pointer("/axes/scenario"), name);
  for (const std::string& item : split_list(said, ',', "manifest.json: axes.scenario")) {
    if (item == name || Path(item).stem() == name) return item;
  }
  return name;
}

ScenarioSource open_scenario(const Json& manifest, const std::string& name, const std::string& given) {
  try {
    return ScenarioSource::open(given.empty() ? said_scenario(manifest, name) : given);
  } catch (const InputError& error) {
    if (!given.empty()) throw;
    throw InputError(std::string(error.what()) + "; name the scenario of the study with --scenario");
  }
}

/// Throws InputError if the scenario is not that of the study.
void check_same(const Json& manifest, const Scenario& scenario, const std::string& name) {
  const auto kept = manifest.find("scenarios");
  if (kept == manifest.end() || !kept->contains(name)) return;
  const Json& resolved = (*kept)[name].contains("resolved") ? (*kept)[name]["resolved"] : Json(scenario.canonical());
  if (resolved == scenario.canonical()) return;
  throw InputError(
      "the scenario " + name +
      " has changed since the study was made; name the one it was with --scenario, or make the study again");
}

/// The scenario with the varied keys of the run; an empty value leaves a key unchanged.
Scenario scenario_of(const ScenarioSource& source, const RunConfig& config) {
  std::vector<Override> varied = config.varied;
  std::erase_if(varied, [](const Override& o) { return o.value.empty(); });
  return source.resolve(varied);
}

void read_energy(const Path& path, double scale, Recording& recording) {
  CsvReader table(path.string());
  const std::size_t t = table.column("t_s"), drift = table.column("drift_J");
  while (table.next()) {
    const std::size_t k = recording.energy_drift.size();
    if (k == recording.times.size() || table.number(t) != recording.times[k]) {
      table.fail(t, "the instants are not those of trajectory.csv beside it; make the study again");
    }
    recording.energy_drift.push_back(relative(table.number(drift), scale));
  }
  if (recording.energy_drift.size() != recording.times.size()) {
    throw InputError(path.string() + ": has fewer instants than trajectory.csv beside it; make the study again");
  }
}

void read_impacts(const Path& path, std::size_t bodies, Recording& recording) {
  if (!std::filesystem::exists(path)) return;
  CsvReader table(path.string());
  const std::size_t t = table.column("t_s"), kind = table.column("kind"), a = table.column("body_a"),
                    b = table.column("body_b"), impulse = table.column("impulse_N_s");
  const auto point = table.columns({"px_m", "py_m", "pz_m"}), normal = table.columns({"nx", "ny", "nz"});
  while (table.next()) {
    if (table.text(kind) != "impact") continue;
    const std::int64_t first = table.integer(a), second = table.integer(b);
    for (const auto& [cell, body] : {std::pair(a, first), {b, second}}) {
      if (body < 0 || std::size_t(body) >= bodies) table.fail(cell, "the scenario has no such body");
    }
    const auto vector = [&](const std::vector<std::size_t>& at) {
      return Vector3<double>(table.number(at[0]), table.number(at[1]), table.number(at[2]));
    };
    recording.impacts.push_back({.t = table.number(t),
                                 .a = std::size_t(first),
                                 .b = std::size_t(second),
                                 .point = vector(point),
                                 .normal = vector(normal),
                                 .impulse = Vector3<double>(table.number(impulse), 0, 0)});
  }
  recording.impacts_seen = std::int64_t(recording.impacts.size());
}

/// The momentum at instant k: linear, kg m/s, or angular, kg m²/s. The angular momentum of a single body is about its
/// reference point, that of several bodies about `mass_center` (m).
Vector3<double> momentum_of(const Trajectory& trajectory, std::size_t k, const Problem& problem, bool linear,
                            const Vector3<double>& mass_center) {
  Vector3<double> sum = Vector3<double>::Zero(), whole = Vector3<double>::Zero();
  for (std::size_t i = 0; i < trajectory.moving; ++i) {
    const BodySnapshot<double>& body = trajectory.bodies[k * trajectory.moving + i];
    const Vector3<double> p = problem.bodies[i].mass * body.velocity;
    whole += p;
    if (linear) sum += p;
    else
      sum += trajectory.moving == 1 ? body.angular_momentum
                                    : Vector3<double>(body.angular_momentum + body.position.cross(p));
  }
  if (!linear && trajectory.moving > 1) sum -= mass_center.cross(whole);
  return sum;
}

Recording read_recording(const KeptRun& run, const Scenario& scenario, References& truth) {
  Recording r;
  r.id = run.id;
  r.config = run.config;
  r.status = run.status;
  r.message = run.message;
  r.energy_drift_max = run.energy_drift_max;
  r.scene = scene_of(scenario);
  const auto system = make_system<double>(scenario.problem, {});
  const MotionScales scales = truth.of(run.config, scenario, nullptr).scales;
  r.momentum = shown_momentum(*system, scenario);
  const Trajectory trajectory = read_trajectory((run.motion / "trajectory.csv").string(), scenario.problem);
  r.moving = trajectory.moving;
  r.times = trajectory.times;
  r.instants_seen = std::int64_t(r.times.size());
  for (const BodySnapshot<double>& b : trajectory.bodies) {
    r.placements.push_back({b.position, b.orientation, b.angular_velocity});
  }
  r.reactions = read_reactions(run.motion, r.times, r.scene.joints.size());
  r.joints = r.reactions.empty() ? 0 : r.scene.joints.size();
  read_energy(run.motion / "energy.csv", scales.energy, r);
  read_impacts(run.motion / "events.csv", scenario.problem.bodies.size(), r);
  const bool linear = r.momentum == ShownMomentum::linear;
  const Vector3<double> first = momentum_of(trajectory, 0, scenario.problem, linear, scales.mass_center);
  for (std::size_t k = 0; k < r.times.size(); ++k) {
    const double change = (momentum_of(trajectory, k, scenario.problem, linear, scales.mass_center) - first).norm();
    r.momentum_drift.push_back(
        r.momentum == ShownMomentum::none ? 0 : relative(change, linear ? scales.linear : scales.angular));
  }
  return r;
}

}  // namespace

KeptStudy read_study(const Path& folder, const std::vector<std::string>& ids, const std::string& scenario,
                     std::size_t most_runs) {
  if (!std::filesystem::is_directory(folder)) throw InputError("--results: " + folder.string() + " is not a folder");
  if (!std::filesystem::exists(folder / "runs.csv")) {
    throw InputError("--results: " + folder.string() + " holds no study: there is no runs.csv in it");
  }
  const std::vector<KeptRun> runs = chosen(read_runs(folder), folder, ids, most_runs);
  const Json manifest = read_manifest(folder);
  const std::string name = runs.front().config.scenario;
  const ScenarioSource source = open_scenario(manifest, name, scenario);
  KeptStudy study{
      .scenario = source.resolve(), .command = manifest.value("command", ""), .made_by = {}, .recordings = {}};
  check_same(manifest, study.scenario, name);
  study.made_by =
      fmt::format("polhode {}, commit {}", manifest.value(Json::json_pointer("/polhode/version"), "unknown"),
                  manifest.value(Json::json_pointer("/polhode/commit"), "unknown"));
  References truth;  // the scales of a motion are computed once for all its runs
  std::vector<Scenario> scenarios;
  std::vector<std::uint64_t> numbers;
  for (const KeptRun& run : runs) {
    scenarios.push_back(scenario_of(source, run.config));
    numbers.push_back(number_of(scenarios.back()));
  }
  truth.expect(std::move(numbers));
  for (std::size_t k = 0; k < runs.size(); ++k)
    study.recordings.push_back(read_recording(runs[k], scenarios[k], truth));
  return study;
}

}  // namespace polhode::study::replay
