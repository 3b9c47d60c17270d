// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report/tables/run_table.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/study/report/findings/drift_words.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::report {

namespace {

struct Field {
  Column column;
  std::function<std::string(const RunRecord&)> text;
  bool only_if_it_varies = false;
  bool in_summary = true;
};

std::string measured(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? number(*value) : "";
}
std::string given(const std::optional<double>& value) { return value ? rounded(*value) : ""; }

using Kind = Column::Kind;

std::vector<Field> configuration(const StudyView& study) {
  std::vector<Field> fields;
  const auto option = [&](std::string header, std::string unit, Kind kind,
                          std::function<std::string(const RunConfig&)> text) {
    fields.push_back(
        {{std::move(header), std::move(unit), kind}, [text](const RunRecord& r) { return text(r.config); }, true});
  };
  fields.push_back({{"method", "", Kind::name}, [](const RunRecord& r) { return r.config.integrator; }});
  option("scenario", "", Kind::name, [](const RunConfig& c) { return c.scenario; });
  for (std::size_t i = 0; i < study.varied_keys.size(); ++i) {
    const auto key = study.varied_keys[i];
    fields.push_back({{key, "", Kind::text}, [key](const RunRecord& r) {
                        const auto& all = r.config.varied;
                        const auto at =
                            std::find_if(all.begin(), all.end(), [&](const auto& o) { return o.key == key; });
                        return at == all.end() ? std::string() : rounded(at->value);
                      }});
  }
  option("orientation", "", Kind::text,
         [](const RunConfig& c) { return std::string(name(c.formulation.orientation)); });
  option("angular state", "", Kind::text,
         [](const RunConfig& c) { return std::string(name(c.formulation.angular_state)); });
  option("gyroscopic", "", Kind::text,
         [](const RunConfig& c) { return std::string(c.formulation.gyroscopic ? "on" : "off"); });
  option("normalize", "", Kind::text, [](const RunConfig& c) { return std::string(c.normalise ? "step" : "never"); });
  option("rotation from", "", Kind::text,
         [](const RunConfig& c) { return std::string(name(c.formulation.rotation_from)); });
  option("precision", "", Kind::text, [](const RunConfig& c) { return std::string(name(c.precision)); });
  const auto contact = [&](const char* header, std::string ContactConfig::*member) {
    option(header, "", Kind::text,
           [member](const RunConfig& c) { return c.contact ? *c.contact.*member : std::string(); });
  };
  contact("broad phase", &ContactConfig::broad_phase);
  contact("narrow phase", &ContactConfig::narrow_phase);
  contact("response", &ContactConfig::response);
  contact("timing of impacts", &ContactConfig::impact_timing);
  option("order", "", Kind::number,
         [](const RunConfig& c) { return c.order.value_or(0) > 0 ? std::to_string(*c.order) : std::string(); });
  option("summation", "", Kind::text,
         [](const RunConfig& c) { return c.summation ? std::string(name(*c.summation)) : std::string(); });
  option("t_end", "s", Kind::number, [](const RunConfig& c) { return rounded(c.t_end); });
  option("samples", "", Kind::number, [](const RunConfig& c) { return c.samples ? std::to_string(*c.samples) : ""; });
  fields.push_back({{"dt", "s"}, [](const RunRecord& r) { return given(r.config.dt); }});
  fields.push_back({{"tolerance"}, [](const RunRecord& r) { return given(r.config.tolerance); }});
  return fields;
}

std::vector<Field> results(const StudyView& study) {
  std::vector<Field> fields;
  const auto add = [&](std::string header, std::string unit, auto member, bool in_summary = true) {
    fields.push_back({{std::move(header), std::move(unit)},
                      [member](const RunRecord& r) { return measured(r.result.*member); },
                      false,
                      in_summary});
  };
  const auto add_count = [&](std::string header, auto member) {
    const auto text = [member](const RunRecord& r) {
      return r.result.*member > 0 ? std::to_string(r.result.*member) : "";
    };
    fields.push_back({{std::move(header)}, text, false, false});
  };
  const bool all_ok =
      std::all_of(study.runs.begin(), study.runs.end(), [](const auto& r) { return r.result.status == "ok"; });
  fields.push_back({{"status", "", Kind::text}, [](const RunRecord& r) { return r.result.status; }, false, !all_ok});
  add("largest energy drift", "relative", &RunResult::energy_drift_max_rel);
  add("largest energy drift", "J", &RunResult::energy_drift_max, false);
  add("rounding of the energy", "J", &RunResult::energy_round_off, false);
  add("final energy drift", "relative", &RunResult::energy_drift_final_rel, false);
  add("energy drift rate", "W", &RunResult::energy_drift_rate, false);
  add("±", "W", &RunResult::energy_drift_rate_ci, false);
  fields.push_back({{"class of the drift", "", Kind::text}, [](const RunRecord& r) { return r.result.drift_class; }});
  add("exponent of its growth", "", &RunResult::drift_exponent, false);
  fields.push_back({{"95 % interval", "", Kind::text},
                    [](const RunRecord& r) { return exponent_interval(r.result); },
                    false,
                    false});
  add("class decided after", "s", &RunResult::drift_decided_after, false);
  add("linear momentum drift", "relative", &RunResult::linear_momentum_drift_max_rel);
  add("angular momentum drift", "relative", &RunResult::angular_momentum_drift_max_rel);
  for (const auto& name : study.invariants) {
    fields.push_back({{name + " drift", "relative"}, [name](const RunRecord& r) {
                        const auto at = r.result.invariant_drift_max_rel.find(name);
                        return at == r.result.invariant_drift_max_rel.end() ? std::string() : measured(at->second);
                      }});
  }
  add("orientation defect", "1", &RunResult::orientation_defect_max);
  add("position error", "m", &RunResult::position_error_max);
  add("attitude error", "rad", &RunResult::attitude_error_max);
  add("angular velocity error", "relative", &RunResult::angular_velocity_error_max_rel, false);
  add("along the polhode", "s", &RunResult::polhode_phase_error_max, false);
  add("off the polhode", "relative", &RunResult::polhode_off_error_max_rel, false);
  const auto add_contact = [&](const char* header, const char* unit, std::optional<double> ContactMeasures::*member) {
    fields.push_back(
        {{header, unit}, [member](const RunRecord& r) { return measured(r.result.contact.*member); }, false, false});
  };
  add_contact("first impact", "s", &ContactMeasures::first_impact);
  add_contact("lost to impacts", "J", &ContactMeasures::impact_loss);
  add_contact("lost to friction", "J", &ContactMeasures::friction_loss);
  add_contact("put in by undoing depth", "J", &ContactMeasures::penetration_energy);
  add_contact("energy rises by", "J", &ContactMeasures::energy_rise_max);
  add_contact("deepest", "m", &ContactMeasures::penetration_max);
  add_count("steps", &RunResult::steps);
  add_count("evaluations", &RunResult::evaluations);
  return fields;
}

bool varies(const Field& field, const std::vector<RunRecord>& runs) {
  return std::any_of(runs.begin(), runs.end(),
                     [&](const auto& run) { return field.text(run) != field.text(runs.front()); });
}

}  // namespace

Table run_table(const StudyView& study, Extent extent, std::size_t most_rows) {
  auto fields = configuration(study);
  for (auto& field : results(study)) fields.push_back(std::move(field));
  std::erase_if(fields, [&](const auto& field) {
    return (field.only_if_it_varies && !varies(field, study.runs)) || (extent == Extent::summary && !field.in_summary);
  });

  Table table;
  for (const auto& field : fields) table.columns.push_back(field.column);
  for (std::size_t i = 0; i < std::min(most_rows, study.runs.size()); ++i) {
    auto& row = table.rows.emplace_back();
    for (const auto& field : fields) row.push_back(field.text(study.runs[i]));
  }
  return without_empty_columns(std::move(table));
}

}  // namespace polhode::study::report
