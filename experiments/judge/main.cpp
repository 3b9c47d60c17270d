// SPDX-License-Identifier: BSD-3-Clause
// How far is a trajectory, from whatever program, from the exact motion, and what is wrong with it?
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <set>

#include "experiments/judge/judgement.hpp"
#include "experiments/judge/options.hpp"
#include "experiments/study/plan/plan.hpp"
#include "experiments/study/record/run_id.hpp"
#include "experiments/study/report/figures/study_figures.hpp"
#include "experiments/study/report/page/report.hpp"
#include "experiments/study/report/tables/results.hpp"
#include "experiments/study/report/tables/summary.hpp"
#include "experiments/study/report/tables/tables.hpp"
#include "experiments/study/store/result_folder.hpp"
#include "experiments/study/store/store.hpp"
#include "experiments/study/text/csv.hpp"
#include "experiments/study/text/program.hpp"

namespace polhode::study::judge {
namespace {

/// Names of the files: their stems; their paths if two stems are equal; their folders if all are called trajectory.csv.
std::vector<std::string> labels_of(const std::vector<std::string>& files) {
  std::vector<std::string> labels;
  for (const std::string& file : files) {
    const std::filesystem::path path = std::filesystem::path(file).lexically_normal();
    const std::string folder = path.parent_path().filename().string();
    labels.push_back(path.filename() == "trajectory.csv" && !folder.empty() ? folder : path.stem().string());
  }
  const auto once = labels;
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (std::count(once.begin(), once.end(), once[i]) > 1) labels[i] = files[i];
  }
  return labels;
}

std::vector<Judged> judged_of(const JudgeOptions& options, const Scenario& scenario) {
  std::vector<Trajectory> trajectories;  // all files are read before the first one is scored
  for (const std::string& file : options.files) trajectories.push_back(read_trajectory(file, scenario.problem));
  const auto labels = labels_of(options.files);
  std::vector<Judged> judged;
  for (std::size_t i = 0; i < trajectories.size(); ++i) {
    RunConfig config;
    config.scenario = scenario.name;
    config.integrator = labels[i];
    config.formulation.rotation_from = options.rotation_from;
    config.reference = options.reference;
    Judged one{score(trajectories[i], scenario, config), {}, {}};
    one.diagnosis = diagnose(trajectories[i], scenario, one.score);
    if (one.diagnosis.meant) one.meant = score(*one.diagnosis.meant, scenario, config);
    judged.push_back(std::move(one));
  }
  return judged;
}

int judge(const JudgeOptions& options) {
  // 1. Scores and diagnoses of the trajectories.
  StudyView view;
  view.experiment = "judge";
  view.question = judge_question;
  view.command = options.command;
  view.scenarios = {ScenarioSource::open(options.scenario).resolve()};
  const Scenario& scenario = view.scenarios.front();
  view.invariants = scenario.invariants;
  std::sort(view.invariants.begin(), view.invariants.end());
  const auto judged = judged_of(options, scenario);
  // 2. Each trajectory as a run of a study.
  Plan plan;
  std::set<std::uint64_t> ids;
  for (const Judged& one : judged) {
    const TrajectoryScore& s = one.score;
    view.runs.push_back(s.record);
    // The id is the hash of the score, which differs between trajectories.
    std::string text = scenario.canonical() + s.record.config.integrator + std::to_string(s.instants);
    for (const ErrorPoint& p : s.errors) text += exact(p.t) + csv_cell(p.attitude) + csv_cell(p.position);
    for (const SeriesPoint& p : s.record.result.series) text += exact(p.t) + exact(p.energy_drift_rel);
    view.runs.back().id = identity_of(text);
    ids.insert(number_of_id(view.runs.back().id));
    plan.identity += view.runs.back().id;
  }
  plan.identity = identity_of(plan.identity);
  // 3. The files of the study.
  view.folder = options.out.empty()
                    ? std::filesystem::path("results") / ("judge-" + scenario.name + "-" + plan.identity.substr(0, 8))
                    : std::filesystem::path(options.out);
  const ResultFolder held(
      view.folder, [&](std::uint64_t id) { return ids.contains(id); }, options.force);
  Store(view.folder).keep(view.runs);
  view.figure_choice.look = options.look;
  view.analysis = judgement(view, judged);
  choose_figures(view.figure_choice, view.analysis->figures);
  write_runs_csv(view);
  write_timings_csv(view);
  Options written;
  written.studies.emplace_back().axes = {{"scenario", options.scenario}};
  write_manifest(view, written, plan);
  write_tables(view);
  if (options.figures) {
    if (const std::string skipped = write_figures(view); !skipped.empty()) fmt::print(stderr, "judge: {}\n", skipped);
  }
  write_report(view);
  // 4. The summary.
  auto& sentences = view.analysis->sentences;  // faults come first, above the table
  const auto rest = sentences.begin() + static_cast<std::ptrdiff_t>(judged.size());
  fmt::print("{}\n\n", fmt::join(sentences.begin(), rest, "\n"));
  sentences.erase(sentences.begin(), rest);
  fmt::print("{}\n{}\n", summary_table(view), (view.folder / "report.html").string());
  return 0;
}

}  // namespace
}  // namespace polhode::study::judge

int main(int argc, char** argv) {
  using namespace polhode::study;
  using namespace polhode::study::judge;
  return run_program("judge", [&] {
    const JudgeOptions options = parse_judge_options(argc, argv);
    return options.exit_status ? *options.exit_status : judge::judge(options);
  });
}
