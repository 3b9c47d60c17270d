// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report/tables/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "experiments/study/text/build_info.hpp"
#include "experiments/study/text/csv.hpp"
#include "experiments/study/text/text_file.hpp"
#include "experiments/study/text/value_lists.hpp"

namespace polhode::study {
namespace {

bool has_references(const StudyView& study) {
  return std::any_of(study.runs.begin(), study.runs.end(), [](const RunRecord& run) { return run.config.reference; });
}

bool has_contact(const StudyView& study) {
  return std::any_of(study.runs.begin(), study.runs.end(),
                     [](const RunRecord& run) { return run.config.contact.has_value(); });
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
  std::vector<std::string> header = {"run"};
  const auto add = [](std::vector<std::string>& row, const std::vector<std::string>& cells) {
    row.insert(row.end(), cells.begin(), cells.end());
  };
  add(header, config_columns(study.varied_keys, study.named));
  add(header,
      {"status", "message", "steps", "rhs_evaluations", "energy_initial_J", "energy_scale_J", "energy_drift_max_J",
       "energy_round_off_J", "energy_drift_max_rel", "energy_drift_final_rel", "energy_drift_rate_W", "drift_class",
       "energy_drift_rate_ci_W", "drift_exponent", "drift_exponent_low", "drift_exponent_high", "drift_decided_after_s",
       "linear_momentum_drift_max_rel", "angular_momentum_drift_max_rel"});
  for (const std::string& invariant : study.invariants) header.push_back(invariant + "_drift_max_rel");
  add(header,
      {"orientation_defect_max", "position_error_max_m", "attitude_error_max_rad", "angular_velocity_error_max_rel",
       "polhode_phase_error_max_s", "polhode_phase_error_max_rad", "polhode_off_error_max_rel"});
  const bool references = has_references(study);
  if (references) add(header, {"position_reference_m", "attitude_reference_rad", "angular_velocity_reference_rel"});
  const bool contact = has_contact(study);
  if (contact) {
    add(header, {"first_impact_s", "impact_loss_J", "friction_loss_J", "penetration_J", "energy_rise_max_J",
                 "energy_change_max_J", "penetration_max_m", "penetration_end_m", "displacement_after_2s_max_m",
                 "left_place_s"});
  }
  std::string text = csv_row(header);
  for (const RunRecord& run : study.runs) {
    const RunResult& r = run.result;
    std::vector<std::string> row = {run.id};
    add(row, config_cells(run.config));
    add(row, {r.status, r.message, std::to_string(r.steps), std::to_string(r.evaluations), csv_cell(r.energy_initial),
              csv_cell(r.energy_scale), csv_cell(r.energy_drift_max), csv_cell(r.energy_round_off),
              csv_cell(r.energy_drift_max_rel), csv_cell(r.energy_drift_final_rel), csv_cell(r.energy_drift_rate),
              r.drift_class, csv_cell(r.energy_drift_rate_ci), csv_cell(r.drift_exponent),
              csv_cell(r.drift_exponent_low), csv_cell(r.drift_exponent_high), csv_cell(r.drift_decided_after),
              csv_cell(r.linear_momentum_drift_max_rel), csv_cell(r.angular_momentum_drift_max_rel)});
    for (const std::string& invariant : study.invariants) {
      const auto found = r.invariant_drift_max_rel.find(invariant);
      row.push_back(found == r.invariant_drift_max_rel.end() ? "" : exact(found->second));
    }
    add(row, {csv_cell(r.orientation_defect_max), csv_cell(r.position_error_max), csv_cell(r.attitude_error_max),
              csv_cell(r.angular_velocity_error_max_rel), csv_cell(r.polhode_phase_error_max),
              csv_cell(r.polhode_phase_error_max_rad), csv_cell(r.polhode_off_error_max_rel)});
    if (references) {
      add(row,
          {csv_cell(r.position_reference), csv_cell(r.attitude_reference), csv_cell(r.angular_velocity_reference_rel)});
    }
    if (contact) {
      const ContactMeasures& c = r.contact;
      add(row,
          {csv_cell(c.first_impact), csv_cell(c.impact_loss), csv_cell(c.friction_loss), csv_cell(c.penetration_energy),
           csv_cell(c.energy_rise_max), csv_cell(c.energy_change_max), csv_cell(c.penetration_max),
           csv_cell(c.penetration_end), csv_cell(c.displacement_max), csv_cell(c.left_place)});
    }
    text += csv_row(row);
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
  Json manifest = {{"experiment", study.experiment},
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
  if (!plan.further_axes.empty()) manifest["further_axes"] = plan.further_axes;
  if (has_references(study)) manifest["references"] = references_of(study);
  write_text(study.folder / "manifest.json", manifest.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace polhode::study
