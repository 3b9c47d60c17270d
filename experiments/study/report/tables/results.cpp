// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report/tables/results.hpp"

#include <fmt/format.h>
#include <sys/utsname.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <thread>
#include <variant>
#include <vector>

#include "experiments/study/record/metric_table.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/record/versions.hpp"
#include "experiments/study/text/build_info.hpp"
#include "experiments/study/text/csv.hpp"
#include "experiments/study/text/text_file.hpp"

namespace polhode::study::inline report::inline tables {
namespace {

bool has_references(const StudyView& study) {
  return std::any_of(study.runs.begin(), study.runs.end(), [](const RunRecord& run) { return run.config.reference; });
}

RunKinds kinds_of(const StudyView& study) {
  const auto any = [&](const auto& has) { return std::any_of(study.runs.begin(), study.runs.end(), has); };
  return {.reference = has_references(study),
          .contact = any([](const RunRecord& run) { return run.config.contact.has_value(); }),
          .joints = any([](const RunRecord& run) { return run.config.joints.has_value(); })};
}

/// The metrics that are defined for some run of the study.
std::vector<const Metric*> metrics_of(const StudyView& study) {
  const RunKinds kinds = kinds_of(study);
  std::vector<const Metric*> metrics;
  for (const Metric& metric : study.metrics) {
    if (kinds.define(metric.runs)) metrics.push_back(&metric);
  }
  return metrics;
}

/// Uncertainty of each reference, once for each variant of a scenario and each duration.
nlohmann::ordered_json references_of(const StudyView& study) {
  using Json = nlohmann::ordered_json;
  const auto number = [](const std::optional<double>& x) {
    return !x ? Json() : std::isfinite(*x) ? Json(*x) : Json("could not follow the motion");
  };
  Json list = Json::array();
  std::set<std::string> seen;
  for (const RunRecord& run : study.runs) {
    const RunResult& r = run.result;
    if (!r.position_reference && !r.attitude_reference && !r.angular_velocity_reference_rel) continue;
    Json varied = Json::object();
    for (const Override& o : run.config.varied) varied[o.key] = o.value;
    Json entry = {{"scenario", run.config.scenario},
                  {"varied", varied},
                  {"t_end_s", run.config.t_end},
                  {"position_reference_m", number(r.position_reference)},
                  {"attitude_reference_rad", number(r.attitude_reference)},
                  {"angular_velocity_reference_rel", number(r.angular_velocity_reference_rel)}};
    if (seen.insert(entry.dump()).second) list.push_back(std::move(entry));
  }
  return list;
}

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

/// "Debian GNU/Linux 12 (bookworm), Linux 6.1.0 x86_64"
std::string operating_system() {
  std::string distribution = "unknown";
  std::ifstream file("/etc/os-release");
  for (std::string line; std::getline(file, line);) {
    constexpr std::string_view key = "PRETTY_NAME=";
    if (line.starts_with(key)) distribution = line.substr(key.size());
  }
  std::erase(distribution, '"');
  utsname system = {};
  if (uname(&system) != 0) return distribution;
  return fmt::format("{}, {} {} {}", distribution, system.sysname, system.release, system.machine);
}

/// The build and the machine.
nlohmann::ordered_json provenance() {
  using Json = nlohmann::ordered_json;
  const BuildInfo& build = build_info();
  Json libraries = Json::object();
  for (const Library& library : build.libraries) libraries[std::string(library.name)] = library.version;
  return {{"polhode", {{"version", build.version}, {"commit", build.commit}, {"dirty", build.dirty()}}},
          {"results_version", results_version},
          {"store_version", store_version},
          {"compiler", build.compiler},
          {"flags", build.flags},
          {"build_type", build.build_type},
          {"libraries", libraries},
          {"processor", processor()},
          {"cores", std::thread::hardware_concurrency()},
          {"operating_system", operating_system()}};
}

std::string_view name_of(TrajectoryFormat format) {
  switch (format) {
    case TrajectoryFormat::csv: return "csv";
    case TrajectoryFormat::hdf5: return "hdf5";
    default: return "none";
  }
}

/// The value of an option that is no axis; null, or false for a flag, if no study has it.
nlohmann::ordered_json value_in(const std::vector<StudyAxes>& studies, const RunOption& option) {
  const auto with = std::find_if(studies.begin(), studies.end(),
                                 [&](const StudyAxes& study) { return study.settings.contains(option.name); });
  if (option.kind == RunOption::Kind::flag) return with != studies.end();
  if (with == studies.end()) return nullptr;
  return std::get<std::int64_t>(with->settings.at(option.name));
}

/// The options of the study besides its axes that are part of its results.
nlohmann::ordered_json options_of(const Options& options) {
  nlohmann::ordered_json all = {{"seed", options.seed}};
  for (const auto role : {RunOption::Role::call, RunOption::Role::study}) {
    for (const RunOption* option : options_of_role(role)) all[file_key(*option)] = value_in(options.studies, *option);
  }
  all["trajectory"] = name_of(options.trajectory);
  return all;
}

void add_to(std::vector<std::string>& row, const std::vector<std::string>& cells) {
  row.insert(row.end(), cells.begin(), cells.end());
}

}  // namespace

RunsCsv::RunsCsv(const StudyView& study)
    : metrics_(metrics_of(study)), invariants_(study.invariants), file_(study.folder / "runs.csv") {
  std::vector<std::string> header = {"run"};
  add_to(header, config_columns(study.varied_keys, study.named));
  for (const Metric* metric : metrics_) add_to(header, csv_columns(*metric, invariants_));
  file_.add(csv_row(header));
}

void RunsCsv::write(const RunRecord& run, const std::vector<std::string>& cells, std::string& rows) const {
  CsvRow row(rows);
  row.add(run.id);
  for (const std::string& cell : cells) row.add(cell);
  for (const Metric* metric : metrics_) add_csv_cells(row, *metric, run.result, invariants_);
  row.end();
}

TimingsCsv::TimingsCsv(const StudyView& study) : file_(study.folder / "timings.csv") {
  file_.add("run,wall_s,steps,wall_per_step_s\n");
}

void TimingsCsv::write(const RunRecord& run, std::string& rows) {
  const RunResult& r = run.result;
  CsvRow row(rows);
  row.add(run.id);
  row.add(r.seconds);
  row.add(r.steps);
  row.add(r.steps > 0 ? std::optional(r.seconds / static_cast<double>(r.steps)) : std::nullopt);
  row.end();
}

void write_runs_csv(const StudyView& study) {
  RunsCsv file(study);
  std::string row;
  for (const RunRecord& run : study.runs) {
    row.clear();
    file.write(run, config_cells(run.config, study.named), row);
    file.add(row);
  }
  file.finish();
}

void write_timings_csv(const StudyView& study) {
  TimingsCsv file(study);
  std::string row;
  for (const RunRecord& run : study.runs) {
    row.clear();
    TimingsCsv::write(run, row);
    file.add(row);
  }
  file.finish();
}

namespace {

/// The axes of a study, in the words of the command line.
nlohmann::ordered_json in_words(const StudyAxes& study) {
  using Json = nlohmann::ordered_json;
  Json said = Json::object();
  if (!study.name.empty()) said["name"] = study.name;
  said["axes"] = Json::object();
  for (const std::string& name : axis_names()) {
    if (const auto found = study.axes.find(name); found != study.axes.end()) said["axes"][name] = found->second;
  }
  said["vary"] = Json::object();
  for (const auto& [key, values] : study.vary) said["vary"][key] = values;
  for (const RunOption* option : options_of_role(RunOption::Role::study)) {
    if (study.settings.contains(option->name)) said[file_key(*option)] = true;
  }
  for (const PointTable& table : study.tables) said[word(table.kind)].push_back(words(table));
  for (const Condition& condition : study.where) said["where"].push_back(condition.text);
  return said;
}

}  // namespace

void write_manifest(const StudyView& study, const Options& options, const Plan& plan) {
  using Json = nlohmann::ordered_json;
  Json studies = Json::array();
  for (const StudyAxes& axes : options.studies) studies.push_back(in_words(axes));
  // The first study stands for a study that is the product of its axes, which most are; its scenarios are all of them.
  Json axes = studies.front()["axes"];
  if (studies.size() > 1 || !axes.contains("scenario"))
    axes["scenario"] = fmt::format("{}", fmt::join(plan.scenario_names, ","));
  Json scenarios = Json::object();
  for (const Scenario& s : study.scenarios) scenarios[s.name] = {{"title", s.title}, {"resolved", s.canonical()}};
  Json manifest = {{"experiment", study.experiment},  {"command", study.command},
                   {"study", plan.identity},          {"runs", study.size()},
                   {"options", options_of(options)},  {"axes", axes},
                   {"vary", studies.front()["vary"]}, {"scenarios", scenarios}};
  // One study that is the product of its axes has said all there is to say.
  const StudyAxes& first = options.studies.front();
  if (studies.size() > 1 || !first.tables.empty() || !first.where.empty()) manifest["studies"] = studies;
  if (!options.study_file.empty())
    manifest["study_file"] = {{"path", options.study_file}, {"xxh3_64", options.study_file_hash}};
  if (!plan.named.empty()) manifest["named"] = plan.named;
  if (!plan.further_axes.empty()) manifest["further_axes"] = plan.further_axes;
  if (has_references(study)) manifest["references"] = references_of(study);
  manifest.update(provenance());
  write_text(study.folder / "manifest.json", manifest.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace polhode::study::report::tables
