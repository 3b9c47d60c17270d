// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/replay/study_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "experiments/study/metrics/references.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/scenario/scenario_keys.hpp"
#include "experiments/study/text/csv_reader.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/text_file.hpp"
#include "experiments/study/text/value_lists.hpp"
#include "experiments/study/trajectory/trajectory_reader.hpp"

namespace polhode::study::replay {
namespace {

using Json = nlohmann::json;
using Path = std::filesystem::path;

/// A row of runs.csv.
struct Row {
  std::string id, status, message, energy_drift_max;
  std::vector<std::pair<std::string, std::string>> facts;
  Path motion;  ///< the folder of its trajectory

  std::string fact(std::string_view name) const {
    const auto found = std::find_if(facts.begin(), facts.end(), [&](const auto& f) { return f.first == name; });
    return found == facts.end() ? "" : found->second;
  }
};

const std::vector<std::string>& usual_columns() {
  static const auto columns = config_columns({}, options_on_demand());
  return columns;
}

/// Whether a column of runs.csv holds a key of the scenario that the study varied.
bool is_varied(const std::string& column) {
  return find_key(root_keys(), column.substr(0, column.find('.'))) != nullptr;
}

/// The places of the columns that say what a run is, in whatever order they stand: the usual ones, then those varied.
std::vector<std::size_t> columns_of_facts(const CsvReader& table) {
  std::vector<std::size_t> places = table.columns({"scenario", "integrator"});
  std::set<std::string> varied;
  for (const std::string& name : table.names()) {
    if (is_varied(name)) varied.insert(name);
  }
  const auto& names = table.names();
  for (const std::string& name : usual_columns()) {
    if (name == "scenario" || name == "integrator") continue;
    if (std::find(names.begin(), names.end(), name) != names.end()) places.push_back(table.column(name));
  }
  for (const std::string& name : varied) places.push_back(table.column(name));
  return places;
}

std::vector<Row> read_rows(const Path& folder) {
  CsvReader table((folder / "runs.csv").string());
  const std::size_t id = table.column("run"), status = table.column("status"), message = table.column("message"),
                    drift = table.column("energy_drift_max_rel");
  const std::vector<std::size_t> facts = columns_of_facts(table);
  std::vector<Row> rows;
  while (table.next()) {
    Row row{table.text(id), table.text(status), table.text(message), table.text(drift), {}, folder};
    for (const std::size_t k : facts) row.facts.emplace_back(table.names()[k], table.text(k));
    if (std::filesystem::exists(folder / "trajectories" / row.id)) row.motion = folder / "trajectories" / row.id;
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<Row> chosen(std::vector<Row> rows, const Path& folder, const std::vector<std::string>& ids,
                        std::size_t most) {
  for (const std::string& id : ids) {
    if (std::none_of(rows.begin(), rows.end(), [&](const Row& r) { return r.id == id; })) {
      throw InputError(
          fmt::format("--runs: {} has no run {}; the first column of runs.csv names them", folder.string(), id));
    }
  }
  if (!ids.empty())
    std::erase_if(rows, [&](const Row& r) { return std::find(ids.begin(), ids.end(), r.id) == ids.end(); });
  const bool only_hdf5 =
      std::any_of(rows.begin(), rows.end(), [](const Row& r) { return exists(r.motion / "trajectory.h5"); });
  std::erase_if(rows, [](const Row& r) { return !exists(r.motion / "trajectory.csv"); });
  if (rows.empty()) {
    throw InputError(
        folder.string() +
        (only_hdf5 ? " keeps its motion as HDF5 only, which replay does not read" : " keeps no trajectory") +
        "; make it again with --trajectory csv");
  }
  const auto other = [&](const Row& r) { return r.fact("scenario") != rows.front().fact("scenario"); };
  if (std::any_of(rows.begin(), rows.end(), other)) {
    throw InputError(folder.string() + " has runs of several scenarios; name those of one with --runs ID,ID");
  }
  if (rows.size() > most) {
    throw InputError(fmt::format("{} has the motion of {} runs, and a page shows at most {}; choose with --runs ID,ID",
                                 folder.string(), rows.size(), most));
  }
  return rows;
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

/// What `name` was called on the study's command line: a file, or the name itself.
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

/// Drawn with another scenario the motion would be a lie.
void check_same(const Json& manifest, const Scenario& scenario, const std::string& name) {
  const auto kept = manifest.find("scenarios");
  if (kept == manifest.end() || !kept->contains(name)) return;
  const Json& resolved = (*kept)[name].contains("resolved") ? (*kept)[name]["resolved"] : Json(scenario.canonical);
  if (resolved == scenario.canonical) return;
  throw InputError(
      "the scenario " + name +
      " has changed since the study was made; name the one it was with --scenario, or make the study again");
}

std::vector<Override> overrides_of(const Row& row) {
  std::vector<Override> varied;
  for (const auto& [column, cell] : row.facts) {
    if (!cell.empty() && is_varied(column)) varied.push_back({column, cell});
  }
  return varied;
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

/// kg m/s, or kg m²/s: of one body about its reference point, of several about their mass centre at the start.
Vector3<double> momentum_of(const Trajectory& trajectory, std::size_t k, const Problem& problem, bool linear,
                            const Vector3<double>& mass_center) {
  Vector3<double> sum = Vector3<double>::Zero(), whole = Vector3<double>::Zero();
  for (std::size_t i = 0; i < trajectory.moving; ++i) {
    const TrajectoryBody& body = trajectory.bodies[k * trajectory.moving + i];
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

/// s, of the run of that row.
double duration_of(const Row& row, const Scenario& scenario) {
  const std::string text = row.fact("t_end_s");
  if (text.empty()) return scenario.t_end;
  const double t_end = numbers(text, "runs.csv: t_end_s of run " + row.id).front();
  if (!(t_end > 0)) throw InputError("runs.csv: t_end_s of run " + row.id + " is " + text + "; make the study again");
  return t_end;
}

/// A row of runs.csv with the scenario that its run had.
struct KeptRun {
  Row row;
  Scenario scenario;
  RunConfig config;  ///< the duration alone
};

Recording read_recording(const KeptRun& run, References& truth) {
  const auto& [row, scenario, config] = run;
  Recording r;
  r.id = row.id;
  r.facts = row.facts;
  r.status = row.status;
  r.message = row.message;
  r.energy_drift_max = row.energy_drift_max;
  r.scene = scene_of(scenario);
  const auto system = make_system<double>(scenario.problem, {});
  const MotionScales scales = truth.of(config, scenario, nullptr).scales;
  r.momentum = shown_momentum(*system, scenario);
  const Trajectory trajectory = read_trajectory((row.motion / "trajectory.csv").string(), scenario.problem);
  r.moving = trajectory.moving;
  r.times = trajectory.times;
  r.instants_seen = std::int64_t(r.times.size());
  for (const TrajectoryBody& b : trajectory.bodies) {
    r.placements.push_back({b.position,
                            trajectory.has_matrix ? quaternion_from_rotation_matrix(b.rotation) : b.orientation,
                            b.angular_velocity});
  }
  read_energy(row.motion / "energy.csv", scales.energy, r);
  read_impacts(row.motion / "events.csv", scenario.problem.bodies.size(), r);
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
  const std::vector<Row> rows = chosen(read_rows(folder), folder, ids, most_runs);
  const Json manifest = read_manifest(folder);
  const std::string name = rows.front().fact("scenario");
  const ScenarioSource source = open_scenario(manifest, name, scenario);
  KeptStudy study{
      .scenario = source.resolve(), .command = manifest.value("command", ""), .made_by = {}, .recordings = {}};
  check_same(manifest, study.scenario, name);
  study.made_by =
      fmt::format("polhode {}, commit {}", manifest.value(Json::json_pointer("/polhode/version"), "unknown"),
                  manifest.value(Json::json_pointer("/polhode/commit"), "unknown"));
  References truth;  // what runs of the same motion share is computed once
  std::vector<KeptRun> runs;
  for (const Row& row : rows) {
    KeptRun run{row, source.resolve(overrides_of(row)), {}};
    run.config.t_end = duration_of(row, run.scenario);
    truth.expect(run.config, run.scenario);
    runs.push_back(std::move(run));
  }
  for (const KeptRun& run : runs) study.recordings.push_back(read_recording(run, truth));
  return study;
}

}  // namespace polhode::study::replay
