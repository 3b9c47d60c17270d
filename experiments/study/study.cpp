// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include "experiments/study/interruption.hpp"
#include "experiments/study/plan/listing.hpp"
#include "experiments/study/plan/options.hpp"
#include "experiments/study/plan/plan.hpp"
#include "experiments/study/plan_text.hpp"
#include "experiments/study/report/figures/study_figures.hpp"
#include "experiments/study/report/page/report.hpp"
#include "experiments/study/report/tables/results.hpp"
#include "experiments/study/report/tables/summary.hpp"
#include "experiments/study/report/tables/tables.hpp"
#include "experiments/study/slurm.hpp"
#include "experiments/study/store/result_folder.hpp"
#include "experiments/study/store/shard_folders.hpp"
#include "experiments/study/store/store.hpp"
#include "experiments/study/study_runs.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/program.hpp"
#include "experiments/study/text/read_file.hpp"
#include "experiments/study/text/value_lists.hpp"

namespace polhode::study {
namespace {

std::filesystem::path folder_of(const Experiment& experiment, const Options& options, const Plan& plan) {
  if (!options.out.empty()) return options.out;
  const std::string what =
      plan.scenarios.size() == 1 ? plan.scenarios[0].name : std::to_string(plan.scenarios.size()) + "_scenarios";
  return std::filesystem::path("results") / (experiment.name + "-" + what + "-" + plan.identity.substr(0, 8));
}

void write_everything(const StudyView& view, const Options& options, const Plan& plan) {
  write_runs_csv(view);
  write_timings_csv(view);
  write_manifest(view, options, plan);
  write_tables(view);
  if (options.figures) {
    const std::string skipped = write_figures(view);
    if (!skipped.empty()) fmt::print(stderr, "{}: {}\n", view.experiment, skipped);
  }
  write_report(view);
}

/// Message about runs of one status: "2 of 51 runs failed, the first with: out of memory"; empty if there are none.
std::string missed_text(const std::vector<const RunRecord*>& missed, std::size_t runs, const std::string& status) {
  const auto is_so = [&](const RunRecord* run) { return run->result.status == status; };
  const auto first = std::find_if(missed.begin(), missed.end(), is_so);
  if (first == missed.end()) return {};
  const auto count = std::count_if(missed.begin(), missed.end(), is_so);
  std::string text = fmt::format("{} of {} run{} {}{}: {}", count, runs, runs == 1 ? "" : "s", status,
                                 count > 1 ? ", the first with" : "", (*first)->result.message);
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// Carries out a shard, in a folder of its own.
int run_shard(const Experiment& experiment, const Options& options, Plan plan, const std::filesystem::path& folder) {
  const std::filesystem::path own = shard_folder(folder, options.shard->number, options.shard->count);
  const Plan whole = with_further_runs(experiment, options, plan, folder);
  const auto belongs = [&](std::uint64_t id) { return whole.contains(id); };
  if (!options.force) refuse_other_study(folder, belongs);
  const ResultFolder held(own, belongs, options.force);
  Interruption interruption;
  StudyRuns runs(experiment, options, plan, folder, own);
  do {
    if (!runs.carry_out_missing(interruption)) return interrupted;
  } while (runs.missing() == 0 && runs.widen());
  fmt::print("{}: shard {}/{} is done: {} of {} runs of the study are there; --merge joins all shards\n",
             experiment.name, options.shard->number, options.shard->count, plan.size() - runs.missing(), plan.size());
  return 0;
}

/// Writes the job scripts of the study, and submits them if asked to.
int prepare_jobs(const Experiment& experiment, const Options& options, const Plan& plan,
                 const std::filesystem::path& folder) {
  const SlurmJobs jobs = read_slurm_jobs(*options.slurm, plan.size());
  if (!options.force) {
    const Plan whole = with_further_runs(experiment, options, plan, folder);
    refuse_other_study(folder, [&](std::uint64_t id) { return whole.contains(id); });
  }
  write_job_scripts(jobs, experiment.name, options.words, folder);
  fmt::print("{}: {} runs in {} shards; submit with {}, or carry out with {}\n", experiment.name, plan.size(),
             jobs.shards, (folder / "slurm/submit.sh").string(), (folder / "slurm/parallel.sh").string());
  if (options.submit) fmt::print("{}", submit_jobs(folder));
  return 0;
}

/// The exit status of a study with these results. Prints what was not carried out.
int status_of(const Experiment& experiment, const StudyView& view) {
  // A refused run is no error if the report shows the analysis alone: the refusal is part of its answer.
  const bool answers_refusals = view.analysis && view.analysis->alone;
  std::vector<const RunRecord*> missed;
  for (const RunRecord& run : view.runs) {
    const bool refused = run.result.status == "refused" && !answers_refusals;
    const bool failed = run.result.status == "failed" && !experiment.failures_are_results;
    if (refused || failed) missed.push_back(&run);
  }
  if (missed.empty()) return 0;
  std::string text = missed_text(missed, view.runs.size(), "failed");
  const std::string refused = missed_text(missed, view.runs.size(), "refused");
  if (!refused.empty()) text += (text.empty() ? "" : "; ") + refused;
  fmt::print(stderr, "{}: {}\n", experiment.name, text);
  return not_carried_out;
}

int run_study(const Experiment& experiment, const Options& options) {
  Plan plan = make_plan(experiment, options);
  choose_curves(options, plan);
  const std::filesystem::path folder = folder_of(experiment, options, plan);
  if (options.dry_run) {
    fmt::print("{}", plan_text(experiment, plan, folder, Store::ids_in(folder)));
    return 0;
  }
  if (options.slurm) return prepare_jobs(experiment, options, plan, folder);
  if (options.shard) return run_shard(experiment, options, std::move(plan), folder);
  const Plan whole = with_further_runs(experiment, options, plan, folder);
  const ResultFolder held(
      folder, [&](std::uint64_t id) { return whole.contains(id); }, options.force);
  Interruption interruption;
  StudyRuns runs(experiment, options, plan, folder, folder);
  do {
    runs.join();
    if (options.merge) {
      if (const std::size_t missing = runs.missing()) {
        fmt::print(stderr,
                   "{}: {} of {} runs are missing in {} and its shards; the same command without --merge, or with "
                   "--shard, carries them out\n",
                   experiment.name, missing, plan.size(), folder.string());
        return interrupted;
      }
    } else if (!runs.carry_out_missing(interruption)) {
      return interrupted;
    }
  } while (runs.widen());
  interruption.study_is_stored();
  StudyView view = runs.view();
  if (experiment.analysis) view.analysis = experiment.analysis(view);
  write_everything(view, options, plan);
  runs.store().keep_study(view.experiment, view.command, read_file(folder / "manifest.json").value_or(""));
  fmt::print("{}\n{}\n", summary_table(view), (folder / "report.html").string());
  return status_of(experiment, view);
}

}  // namespace

int run_experiment(const Experiment& experiment, int argc, const char* const* argv) {
  const auto program = [&] {
    const ParsedOptions parsed = parse_options(experiment, argc, argv);
    if (parsed.exit_status) return *parsed.exit_status;
    if (parsed.options.list) {
      fmt::print("{}", listing(*parsed.options.list));
      return 0;
    }
    return run_study(experiment, parsed.options);
  };
  return run_program(experiment.name, program, "; finished runs are kept, and the same command goes on from there");
}

}  // namespace polhode::study
