// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report/tables/tex_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string_view>
#include <type_traits>
#include <variant>

#include "experiments/study/curves/error_ladder.hpp"
#include "experiments/study/record/metric_table.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/record/shown_runs.hpp"
#include "experiments/study/text/notation.hpp"
#include "experiments/study/text/text_file.hpp"

namespace polhode::study::inline report::inline tables {

namespace {

constexpr const char* explanation =
    R"(% The numbers of this study, for use in a text: \input{{{}}}, then for example
% \{}
% A name is \polhode, scenario, method, varied keys with their values, options that are not the default, step or
% tolerance, quantity. Digits and signs are spelt, and numbers are written with an exponent: 0.001 = 1e-3 is
% OneEMinusThree; four digits at most. Where two runs would share a name, the run's id follows, its digits 0 to f
% as a to p. Units: EnergyDriftRate W, EnergyInitial J, PositionErrorMax m, AttitudeErrorMax rad; drifts and
% AngularVelocityErrorMax are relative. What is not defined for a run has no command.
)";

constexpr std::size_t most_runs_of_a_method = 1000;  // largest number of runs of a method in its file

constexpr std::array<std::string_view, 10> digits = {"Zero", "One", "Two",   "Three", "Four",
                                                     "Five", "Six", "Seven", "Eight", "Nine"};

/// Text in letters only: words are capitalised, digits and signs spelt; other characters separate words.
std::string spelt(std::string_view text) {
  std::string out;
  bool begins_word = true;
  for (const char c : text) {
    if (c >= '0' && c <= '9') out += digits[static_cast<std::size_t>(c - '0')];
    else if (c == '.') out += "Point";
    else if (c == '-') out += "Minus";
    else if (c == ',') out += "And";
    else if (std::isalpha(static_cast<unsigned char>(c)) != 0) {
      out += begins_word ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
      begins_word = false;
      continue;
    }
    begins_word = true;
  }
  return out;
}

std::string spelt_name(std::string text) {
  std::replace(text.begin(), text.end(), '.', ' ');
  std::replace(text.begin(), text.end(), '-', ' ');
  return spelt(text);
}

/// Number in letters, with an exponent, so that it has one name: 0.001 and 1e-3 are both "OneEMinusThree". Rounded to
/// four digits, since values of a logarithmic range have seventeen.
std::string spelt_number(double value) {
  if (value == 0 || !std::isfinite(value)) return spelt(exact_number(value));
  const auto printed = scientific(std::strtod(fmt::format("{:.3e}", value).c_str(), nullptr));
  const auto e = printed.find('e');
  return spelt(printed.substr(0, e)) + "E" + spelt(printed.substr(e + 1));
}

/// TOML value in letters: numbers by spelt_number(), anything else by spelt().
std::string spelt_value(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return end != text.c_str() && *end == '\0' ? spelt_number(value) : spelt(text);
}

double usual_t_end(const StudyView& study, const std::string& scenario) {
  const auto at =
      std::find_if(study.scenarios.begin(), study.scenarios.end(), [&](const auto& s) { return s.name == scenario; });
  return at == study.scenarios.end() ? std::nan("") : at->t_end;
}

/// Options of a role with values other than the usual ones: "MatrixGyroscopicOff", "Samples100".
std::string spelt_options(RunOption::Role role, const RunConfig& config, double t_end) {
  RunConfig usual;
  usual.t_end = t_end;
  std::string out;
  for (const RunOption* option : options_of_role(role)) {
    if (!option->in_tex_names || is_usual(*option, config, usual)) continue;
    const OptionValue value = option->value(config);
    const auto* x = std::get_if<double>(&value);
    if (option->kind == RunOption::Kind::name) out += spelt_name(label_of(*option, config));
    else out += spelt_name(option->name) + (x ? spelt_number(*x) : spelt(text_of(value)));
  }
  return out;
}

std::string name_of(const RunConfig& c, double t_end) {
  std::string out = "polhode" + spelt_name(c.scenario) + spelt_name(c.integrator);
  for (const auto& varied : c.varied) {
    if (!varied.value.empty()) out += spelt_name(varied.key) + spelt_value(varied.value);
  }
  using Role = RunOption::Role;
  for (const Role role : {Role::variant, Role::duration, Role::size}) out += spelt_options(role, c, t_end);
  return out;
}

std::string letters_of(const std::string& id) {
  std::string out;
  for (const char c : id) {
    const int digit = c >= '0' && c <= '9' ? c - '0' : std::tolower(static_cast<unsigned char>(c)) - 'a' + 10;
    if (digit >= 0 && digit < 26) out += static_cast<char>('a' + digit);
  }
  return out;
}

/// A command whose name is `run` and then `quantity`.
void define_as(std::string& out, std::string_view run, std::string_view quantity, std::string_view printed) {
  for (const std::string_view part : {std::string_view("\\newcommand{\\"), run, quantity,
                                      std::string_view("}{\\ensuremath{"), printed, std::string_view("}}\n")})
    out += part;
}

void define(std::string& out, std::string_view run, std::string_view quantity, const std::optional<double>& value) {
  if (!value || !std::isfinite(*value)) return;
  const std::string printed = tex_number(number(*value, 4));
  define_as(out, run, quantity, std::string_view(printed).substr(1, printed.size() - 2));
}

void define_count(std::string& out, std::string_view run, std::string_view quantity, std::int64_t n) {
  if (n > 0) define_as(out, run, quantity, std::to_string(n));
}

void define_run(std::string& out, const std::string& run, const RunResult& r,
                const std::vector<const Metric*>& metrics) {
  for (const Metric* metric : metrics) {
    if (metric->tex.empty()) continue;
    with_value(*metric, r, [&]<class Value>(const Value& value) {
      if constexpr (std::is_same_v<Value, std::optional<double>>) {
        define(out, run, metric->tex, value);
      } else if constexpr (std::is_same_v<Value, std::int64_t>) {
        define_count(out, run, metric->tex, value);
      } else if constexpr (std::is_same_v<Value, std::map<std::string, double>>) {
        for (const auto& [invariant, drift] : value) define(out, run, spelt_name(invariant) + metric->tex, drift);
      }
    });
  }
}

/// Adds commands for the slopes of each curve, named like its runs but without the step.
void define_slopes(std::string& out, const StudyView& study, std::span<const std::size_t> shown) {
  std::set<const RunRecord*> named;
  for (const std::size_t i : shown) named.insert(&study.runs[i]);
  const auto grouping = group(study);
  std::map<std::string, int> uses;
  std::string lines;
  for (const auto& curve : grouping.curves) {
    if (!named.contains(curve.runs.front())) continue;
    auto config = curve.runs.front()->config;
    config.dt = config.tolerance = std::nullopt;
    const auto name = name_of(config, usual_t_end(study, config.scenario)) + (curve.adaptive ? "Tolerance" : "");
    if (uses[name]++ > 0) continue;
    for (const auto& [quantity, ending] : {std::pair(quantity::energy_drift(), "EnergyDriftSlope"),
                                           std::pair(quantity::angular_momentum_drift(), "AngularMomentumDriftSlope"),
                                           std::pair(quantity::attitude_error(), "AttitudeErrorSlope")}) {
      if (const auto line = told_line(observed_order(curve, quantity))) define(lines, name, ending, line->order);
    }
  }
  if (!lines.empty()) out += "\n% Observed slopes against the step (Tolerance: against the tolerance).\n" + lines;
}

}  // namespace

std::vector<std::string> tex_names(const StudyView& study, std::span<const std::size_t> shown) {
  std::vector<std::string> names;
  std::map<std::string, int> uses;
  for (const std::size_t i : shown) {
    const RunConfig& config = study.runs[i].config;
    names.push_back(name_of(config, usual_t_end(study, config.scenario)));
    ++uses[names.back()];
  }
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (uses[names[k]] > 1) names[k] += letters_of(study.runs[shown[k]].id);
  }
  return names;
}

namespace {

/// Adds the commands of the runs at these places of `shown`.
void add_values(std::string& out, const StudyView& study, std::span<const std::size_t> shown,
                const std::vector<std::string>& names, const std::vector<std::size_t>& places) {
  const auto metrics = in_table_order(study.metrics);
  std::size_t longest = out.size();          // of the whole text, so that it never moves as it grows
  constexpr std::size_t longest_rest = 100;  // of a line, besides the name of its run
  for (const std::size_t k : places) longest += (metrics.size() + 1) * (names[k].size() + longest_rest);
  out.reserve(longest);
  for (const std::size_t k : places) {
    const RunRecord& run = study.runs[shown[k]];
    out += fmt::format("\n% {}{}\n", one_line(run.id), completed(run) ? "" : ", " + one_line(run.result.status));
    define_run(out, names[k], run.result, metrics);
  }
}

/// The comment at the beginning of a file with the runs at these places, the first completed one as the example.
std::string head(const StudyView& study, std::span<const std::size_t> shown, const std::vector<std::string>& names,
                 const std::vector<std::size_t>& places, const std::string& file) {
  const auto done =
      std::find_if(places.begin(), places.end(), [&](const std::size_t k) { return completed(study.runs[shown[k]]); });
  return fmt::format(explanation, file, done == places.end() ? "polhodeRuns" : names[*done] + "EnergyDriftMax");
}

}  // namespace

void write_tex_values(const StudyView& study, std::span<const std::size_t> shown, const std::filesystem::path& folder) {
  const auto names = tex_names(study, shown);
  std::vector<std::size_t> all(shown.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const bool one_file = shown.size() <= most_runs_of_a_values_file;
  std::map<std::string, std::vector<std::size_t>> places;  // places of the runs by method
  for (const std::size_t k : all) places[study.runs[shown[k]].config.integrator].push_back(k);
  std::string out = head(study, shown, names, one_file ? all : std::vector<std::size_t>{}, "values.tex");
  if (shown.size() < study.size()) {
    out += fmt::format("% {} of {} runs, of evenly chosen motions; runs.csv has all of them.\n", shown.size(),
                       study.size());
  }
  if (!one_file)
    out +=
        "% The runs of a method are in a file of their own, since TeX cannot hold all: \\input{values_METHOD.tex}.\n";
  define_count(out, "polhode", "Runs", static_cast<std::int64_t>(study.size()));
  if (one_file) add_values(out, study, shown, names, all);
  define_slopes(out, study, shown);
  write_text(folder / "values.tex", out);
  for (const auto& [method, all_of_method] : places) {
    const std::string file = fmt::format("values_{}.tex", method);
    std::filesystem::remove(folder / file);  // a file of an earlier call, with more runs
    if (one_file) continue;
    std::vector<std::size_t> those;
    for (const std::size_t i : evenly_spread(all_of_method.size(), most_runs_of_a_method))
      those.push_back(all_of_method[i]);
    std::string text = head(study, shown, names, those, file);
    if (those.size() < all_of_method.size())
      text += fmt::format("% {} of {} runs; runs.csv has all of them.\n", those.size(), all_of_method.size());
    add_values(text, study, shown, names, those);
    write_text(folder / file, text);
  }
}

}  // namespace polhode::study::report::tables
