// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "experiments/study/axes.hpp"
#include "experiments/study/build_info.hpp"
#include "experiments/study/text_file.hpp"

namespace polhode::study {
namespace {

/// RFC 4180: cells with a comma, a quote or a line break stand in quotes.
void append(std::string& line, const std::string& cell) {
  if (!line.empty() && line.back() != '\n') line += ',';
  if (cell.find_first_of(",\"\n\r") == std::string::npos) {
    line += cell;
    return;
  }
  line += '"';
  for (const char c : cell) line += c == '"' ? std::string("\"\"") : std::string(1, c);
  line += '"';
}

std::string cell(const std::optional<double>& x) { return x ? exact(*x) : std::string(); }

bool has_references(const StudyView& study) {
  return std::any_of(study.runs.begin(), study.runs.end(), [](const RunRecord& run) { return run.config.reference; });
}

/// How uncertain each reference is, once for each variant of a scenario and each duration.
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

}  // namespace

void write_runs_csv(const StudyView& study) {
  std::string text = "run";
  for (const std::string& c : config_columns(study.varied_keys)) append(text, c);
  for (const char* c : {"status", "message", "steps", "rhs_evaluations", "energy_initial_J", "energy_drift_max_rel",
                        "energy_drift_final_rel", "energy_drift_rate_W", "drift_class",
                        "linear_momentum_drift_max_rel", "angular_momentum_drift_max_rel"}) {
    append(text, c);
  }
  for (const std::string& invariant : study.invariants) append(text, invariant + "_drift_max_rel");
  for (const char* c : {"orientation_defect_max", "position_error_max_m", "attitude_error_max_rad",
                        "angular_velocity_error_max_rel"}) {
    append(text, c);
  }
  const bool references = has_references(study);
  if (references) {
    for (const char* c : {"position_reference_m", "attitude_reference_rad", "angular_velocity_reference_rel"}) {
      append(text, c);
    }
  }
  text += '\n';
  for (const RunRecord& run : study.runs) {
    const RunResult& r = run.result;
    append(text, run.id);
    for (const std::string& c : config_cells(run.config)) append(text, c);
    append(text, r.status);
    append(text, r.message);
    append(text, std::to_string(r.steps));
    append(text, std::to_string(r.evaluations));
    for (const auto& x : {r.energy_initial, r.energy_drift_max_rel, r.energy_drift_final_rel, r.energy_drift_rate}) {
      append(text, cell(x));
    }
    append(text, r.drift_class);
    append(text, cell(r.linear_momentum_drift_max_rel));
    append(text, cell(r.angular_momentum_drift_max_rel));
    for (const std::string& invariant : study.invariants) {
      const auto found = r.invariant_drift_max_rel.find(invariant);
      append(text, found == r.invariant_drift_max_rel.end() ? "" : exact(found->second));
    }
    for (const auto& x :
         {r.orientation_defect_max, r.position_error_max, r.attitude_error_max, r.angular_velocity_error_max_rel}) {
      append(text, cell(x));
    }
    if (references) {
      for (const auto& x : {r.position_reference, r.attitude_reference, r.angular_velocity_reference_rel}) {
        append(text, cell(x));
      }
    }
    text += '\n';
  }
  write_text(study.folder / "runs.csv", text);
}

void write_timings_csv(const StudyView& study) {
  std::string text = "run,wall_s,steps,wall_per_step_s\n";
  for (const RunRecord& run : study.runs) {
    const RunResult& r = run.result;
    text += fmt::format("{},{},{},{}\n", run.id, exact(r.seconds), r.steps,
                        r.steps > 0 ? exact(r.seconds / static_cast<double>(r.steps)) : "");
  }
  write_text(study.folder / "timings.csv", text);
}

void write_manifest(const StudyView& study, const Options& options, const Plan& plan) {
  using Json = nlohmann::ordered_json;
  const BuildInfo& build = build_info();
  Json axes = Json::object();
  for (const std::string& name : axis_names()) {
    if (const auto found = options.axes.find(name); found != options.axes.end()) axes[name] = found->second;
  }
  Json vary = Json::object();
  for (const auto& [key, values] : options.vary) vary[key] = values;
  Json scenarios = Json::object();
  for (const Scenario& s : study.scenarios) scenarios[s.name] = {{"title", s.title}, {"resolved", s.canonical}};
  const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
  Json manifest = {
      {"experiment", study.experiment},
      {"command", study.command},
      {"study", plan.identity},
      {"runs", study.runs.size()},
      {"seed", options.seed},
      {"axes", axes},
      {"vary", vary},
      {"scenarios", scenarios},
      {"written_at_unix_s", now.time_since_epoch().count()},
      {"polhode", {{"version", build.version}, {"commit", build.commit}}},
      {"compiler", build.compiler},
      {"flags", build.flags},
      {"build_type", build.build_type},
      {"libraries", {{"Eigen", build.eigen}, {"SUNDIALS", build.sundials}, {"Boost", build.boost}}},
      {"processor", processor()},
      {"cores", std::thread::hardware_concurrency()}};
  if (has_references(study)) manifest["references"] = references_of(study);
  write_text(study.folder / "manifest.json",
             manifest.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace polhode::study
