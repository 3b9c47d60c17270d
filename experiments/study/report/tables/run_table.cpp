// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report/tables/run_table.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "experiments/study/record/metric_table.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::inline report::inline tables {

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
using Kind = Column::Kind;

Field field_of(const RunOption& option) {
  using Role = RunOption::Role;
  const bool number = option.kind != RunOption::Kind::name;
  const bool name = option.role == Role::method || option.role == Role::scenario;
  return {{.header = option.header,
           .unit = option.unit,
           .kind = number ? Kind::number
                   : name ? Kind::name
                          : Kind::text,
           .apart = option.role == Role::scenario || option.role == Role::duration,
           .key = true},
          [&option](const RunRecord& run) {
            const OptionValue value = option.value(run.config);
            const auto* x = std::get_if<double>(&value);
            return x ? rounded(*x) : text_of(value);
          },
          option.role != Role::method && option.role != Role::size};
}

std::vector<Field> configuration(const StudyView& study) {
  using Role = RunOption::Role;
  std::vector<Field> fields;
  const auto add = [&](Role role) {
    for (const RunOption* option : options_of_role(role)) fields.push_back(field_of(*option));
  };
  add(Role::method);
  add(Role::scenario);
  for (std::size_t i = 0; i < study.varied_keys.size(); ++i) {
    const auto key = study.varied_keys[i];
    fields.push_back({{.header = key, .kind = Kind::text, .apart = true, .key = true}, [key](const RunRecord& r) {
                        const auto& all = r.config.varied;
                        const auto at =
                            std::find_if(all.begin(), all.end(), [&](const auto& o) { return o.key == key; });
                        return at == all.end() ? std::string() : rounded(at->value);
                      }});
  }
  add(Role::variant);
  add(Role::duration);
  add(Role::size);
  return fields;
}

Column::Best best_of(const Metric& metric) { return metric.least_is_best ? Column::Best::least : Column::Best::none; }

std::vector<Field> results(const StudyView& study) {
  std::vector<Field> fields;
  const bool all_ok =
      std::all_of(study.runs.begin(), study.runs.end(), [](const auto& r) { return r.result.status == "ok"; });
  for (const Metric* metric : in_table_order(study.metrics)) {
    if (metric->label.empty()) continue;
    if (const auto* member = std::get_if<std::map<std::string, double> RunResult::*>(&metric->member)) {
      for (const std::string& name : study.invariants) {
        const auto text = [name, drifts = *member](const RunRecord& r) {
          const auto at = (r.result.*drifts).find(name);
          return at == (r.result.*drifts).end() ? std::string() : measured(at->second);
        };
        fields.push_back({{.header = name + " " + metric->label, .unit = metric->unit, .best = best_of(*metric)},
                          text,
                          false,
                          metric->in_summary});
      }
      continue;
    }
    const bool idle = metric->column == "status" && all_ok;  // redundant in a summary
    fields.push_back({{.header = metric->label,
                       .unit = metric->unit,
                       .kind = is_text(*metric) ? Kind::text : Kind::number,
                       .best = best_of(*metric)},
                      [metric](const RunRecord& r) { return table_cell(*metric, r.result); },
                      false,
                      metric->in_summary && !idle});
  }
  return fields;
}

bool varies(const Field& field, const std::vector<RunRecord>& runs) {
  return std::any_of(runs.begin(), runs.end(),
                     [&](const auto& run) { return field.text(run) != field.text(runs.front()); });
}

}  // namespace

Table run_table(const StudyView& study, Extent extent, std::span<const std::size_t> shown) {
  auto fields = configuration(study);
  for (auto& field : results(study)) fields.push_back(std::move(field));
  std::erase_if(fields, [&](const auto& field) {
    return (field.only_if_it_varies && !varies(field, study.runs)) || (extent == Extent::summary && !field.in_summary);
  });

  Table table;
  for (const auto& field : fields) table.columns.push_back(field.column);
  for (const std::size_t i : shown) {
    auto& row = table.rows.emplace_back();
    for (const auto& field : fields) row.push_back(field.text(study.runs[i]));
  }
  return without_empty_columns(std::move(table));
}

}  // namespace polhode::study::report::tables
