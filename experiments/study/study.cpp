// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <future>
#include <map>
#include <memory>
#include <stdexcept>
#include <vector>

#include "experiments/study/plan/listing.hpp"
#include "experiments/study/plan/options.hpp"
#include "experiments/study/plan/plan.hpp"
#include "experiments/study/plan_text.hpp"
#include "experiments/study/process/interruption.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/record/shown_runs.hpp"
#include "experiments/study/report/article/article.hpp"
#include "experiments/study/report/figures/study_figures.hpp"
#include "experiments/study/report/page/report.hpp"
#include "experiments/study/report/population/population.hpp"
#include "experiments/study/report/tables/results.hpp"
#include "experiments/study/report/tables/summary.hpp"
#include "experiments/study/report/tables/tables.hpp"
#include "experiments/study/slurm.hpp"
#include "experiments/study/store/result_folder.hpp"
#include "experiments/study/store/shard_folders.hpp"
#include "experiments/study/store/store.hpp"
#include "experiments/study/text/in_order.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/program.hpp"
#include "experiments/study/text/read_file.hpp"
#include "experiments/study/text/value_lists.hpp"
#include "experiments/study/time_needed.hpp"
#include "experiments/study/workers/study_runs.hpp"

namespace polhode::study {
namespace {

std::filesystem::path folder_of(const Experiment& experiment, const Options& options, const Plan& plan) {
  if (!options.out.empty()) return options.out;
  const std::string what =
      plan.scenarios.size() == 1 ? plan.scenarios[0].name : std::to_string(plan.scenarios.size()) + "_scenarios";
  return std::filesystem::path("results") / (experiment.name + "-" + what + "-" + plan.identity.substr(0, 8));
}

/// Writes what is made of the runs besides runs.csv and timings.csv, and prints the summary.
void write_reports(const StudyView& view, const Options& options, const Plan& plan, StudyRuns& runs) {
  write_manifest(view, options, plan);
  const auto say = [&](const std::string& skipped) {
    if (!skipped.empty()) fmt::print(stderr, "{}: {}\n", view.experiment, skipped);
  };
  const auto write_drawn = [&] {  // the page and the article contain the figures
    if (options.figures) say(write_figures(view));
    write_report(view);
    if (options.article) say(write_article(view));
  };
  in_order(2, number_of_threads(options.jobs), [&](std::size_t part) -> UsePart {
    if (part == 0) write_tables(view);
    else write_drawn();
    return [] {};
  });
  runs.store().keep_study(view.experiment, view.command, read_file(view.folder / "manifest.json").value_or(""));
  fmt::print("{}\n{}\n", summary_table(view), (view.folder / "report.html").string());
}

/// Carries out a shard, in a folder of its own.
int run_shard(const Experiment& experiment, const Options& options, Plan plan, const std::filesystem::path& folder,
              Interruption& interruption) {
  const std::filesystem::path own = shard_folder(folder, options.shard->number, options.shard->count);
  const BelongsToStudy belongs = runs_of_study(experiment, options, plan, folder);
  if (!options.force) refuse_other_study(folder, belongs);
  interruption.runs_begin();  // from here on a signal lets go of the folder
  const ResultFolder held(own, belongs, options.force);
  StudyRuns runs(experiment, options, plan, folder, own);
  do {
    if (!runs.carry_out_missing(interruption)) return interrupted;
  } while (runs.missing() == 0 && runs.widen());
  fmt::print("{}: shard {}/{} is done: {} of {} runs of the study are there; --merge joins all shards\n",
             experiment.name, options.shard->number, options.shard->count, plan.size() - runs.missing(), plan.size());
  return 0;
}

/// Writes the job scripts of the study, and submits them if requested.
int prepare_jobs(const Experiment& experiment, const Options& options, const Plan& plan,
                 const std::filesystem::path& folder) {
  const SlurmJobs jobs = read_slurm_jobs(*options.slurm, plan.size());
  if (!options.force) refuse_other_study(folder, runs_of_study(experiment, options, plan, folder));
  write_job_scripts(jobs, experiment.name, options.words, folder);
  fmt::print("{}: {} runs in {} shards; submit with {}, or carry out with {}\n", experiment.name, plan.size(),
             jobs.shards, (folder / "slurm/submit.sh").string(), (folder / "slurm/parallel.sh").string());
  if (options.submit) fmt::print("{}", submit_jobs(folder));
  return 0;
}

/// Message about runs of one status: "2 of 51 runs failed, the first with: out of memory"; empty if there are none.
std::string missed_text(const std::map<std::string, Population::Outcome>& outcomes, std::size_t runs,
                        const std::string& status) {
  const auto found = outcomes.find(status);
  if (found == outcomes.end()) return {};
  const auto& [missed, message] = found->second;
  std::string text = fmt::format("{} of {} run{} {}{}: {}", missed, runs, runs == 1 ? "" : "s", status,
                                 missed > 1 ? ", the first with" : "", message);
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// The exit status of a study with these outcomes. Prints what was not carried out.
int status_of(const Experiment& experiment, bool answers_refusals,
              const std::map<std::string, Population::Outcome>& outcomes) {
  std::size_t runs = 0;
  for (const auto& [status, outcome] : outcomes) runs += outcome.runs;
  std::string text = experiment.failures_are_results ? "" : missed_text(outcomes, runs, "failed");
  const std::string refused = answers_refusals ? "" : missed_text(outcomes, runs, "refused");
  if (!refused.empty()) text += (text.empty() ? "" : "; ") + refused;
  if (text.empty()) return 0;
  fmt::print(stderr, "{}: {}\n", experiment.name, text);
  return not_carried_out;
}

/// Writes all files of the study from all its runs.
int write_study(const Experiment& experiment, const Options& options, const Plan& plan, StudyRuns& runs) {
  StudyView view = runs.view();
  view.figure_choice = options.figure_choice;
  if (experiment.analysis) {
    view.analysis = experiment.analysis(view);
    choose_figures(view.figure_choice, view.analysis->figures);
    choose_figures(view.figure_choice, view.analysis->timed.figures);
  }
  write_runs_csv(view);
  write_timings_csv(view);
  write_reports(view, options, plan, runs);
  std::map<std::string, Population::Outcome> outcomes;
  for (const RunRecord& run : view.runs) {
    Population::Outcome& outcome = outcomes[run.result.status];
    if (++outcome.runs == 1) outcome.message = run.result.message;
  }
  // A refused run is no error if the report shows the analysis alone: the refusal is part of its answer.
  return status_of(experiment, view.analysis && view.analysis->alone, outcomes);
}

/// A study whose runs are too many to be held. Its files are written from a few runs at a time, and a sample of them.
class LargeStudy {
 public:
  /// `shown`: numbers of the runs of the sample. `sample`: these, without results.
  LargeStudy(const Plan& plan, std::vector<std::size_t> shown, const StudyView& sample)
      : plan_(plan), shown_(std::move(shown)), population_(sample), results_(sample), timings_(sample) {}

  /// Makes the rows of these runs, which follow those of the parts before. Thread-safe.
  UsePart part(std::vector<RunRecord>&& records) {
    struct Part {
      std::vector<RunRecord> records;
      std::vector<std::vector<std::string>> cells;
      std::string results, timings;
    };
    const auto part = std::make_shared<Part>();
    part->records = std::move(records);
    ConfigCells cells(plan_.named);
    for (const RunRecord& run : part->records) {
      part->cells.push_back(cells.of(run.config));
      results_.write(run, part->cells.back(), part->results);
      TimingsCsv::write(run, part->timings);
    }
    return [this, part] {
      results_.add(part->results);
      timings_.add(part->timings);
      for (std::size_t k = 0; k < part->records.size(); ++k) population_.add(part->records[k], part->cells[k]);
    };
  }

  /// Writes all files, once all runs of the plan are there.
  int write(const Experiment& experiment, const Options& options, StudyRuns& runs) {
    std::future<void> settled = std::async(std::launch::async, [&runs] { runs.store().settle(); });
    runs.for_each_part([this](std::vector<RunRecord>&& records) { return part(std::move(records)); });
    results_.finish();
    timings_.finish();
    StudyView sample = runs.view(shown_);
    for (const auto& [status, outcome] : population_.outcomes()) sample.all_runs[status] = outcome.runs;
    sample.figure_choice = options.figure_choice;
    sample.analysis = population_.analysis();
    choose_figures(sample.figure_choice, sample.analysis->figures);
    write_reports(sample, options, plan_, runs);
    settled.get();
    return status_of(experiment, false, population_.outcomes());
  }

 private:
  const Plan& plan_;
  std::vector<std::size_t> shown_;
  Population population_;
  RunsCsv results_;
  TimingsCsv timings_;
};

/// Opens the files of a study with too many runs to be held; absent if they are not too many.
std::unique_ptr<LargeStudy> large_study(const Experiment& experiment, const Plan& plan, const StudyRuns& runs) {
  if (is_held(experiment, plan.size())) return nullptr;
  std::vector<std::uint64_t> motions;
  for (const PlanRow& row : plan.rows) motions.push_back(row.scenario);
  const std::vector<std::size_t> shown = shown_runs(motions, rows_of_large_tables);
  return std::make_unique<LargeStudy>(plan, shown, runs.planned(shown));
}

/// The runs that a folder and its shards have.
struct Done {
  std::vector<std::filesystem::path> stores;  // folders that have some
  std::vector<std::uint64_t> ids;             // sorted
};

/// Throws InputError where the study would refuse the store.
Done done_in(const Experiment& experiment, const std::filesystem::path& folder) {
  Done done;
  const auto add = [&](const std::filesystem::path& store) {
    const std::vector<std::uint64_t> ids = Store::ids_in(store);
    if (!ids.empty()) done.stores.push_back(store);
    done.ids.insert(done.ids.end(), ids.begin(), ids.end());
  };
  try {
    add(folder);
  } catch (const std::runtime_error& error) {
    throw InputError(fmt::format("--out: {}; {}", error.what(), another_folder));
  }
  for (const auto& shard : shard_folders(folder)) {
    try {
      add(shard);
    } catch (const std::runtime_error& error) {  // damaged, or under way on a network file system
      fmt::print(stderr, "{}: left out: {}\n", experiment.name, error.what());
    }
  }
  std::sort(done.ids.begin(), done.ids.end());
  done.ids.erase(std::unique(done.ids.begin(), done.ids.end()), done.ids.end());
  return done;
}

int run_study(const Experiment& experiment, const Options& options) {
  if (options.dry_run) {
    if (auto chosen = glance_at_plan(experiment, options)) {
      choose_curves(options, *chosen);
      fmt::print("{}{}", glance_text(experiment, *chosen), time_needed_text(experiment, options, *chosen, {}, {}));
      std::fflush(stdout);
    }
  }
  Interruption interruption;
  interruption.ends_at_once("interrupted before a run began; the same command begins\n");
  Plan plan = make_plan(experiment, options);
  choose_curves(options, plan);
  const std::filesystem::path folder = folder_of(experiment, options, plan);
  if (options.dry_run) {
    if (options.slurm) read_slurm_jobs(*options.slurm, plan.size());
    const Done done = done_in(experiment, folder);
    fmt::print("{}{}{}", plan_text(experiment, plan, folder, done.ids),
               options.shard ? shard_text(plan, *options.shard, done.ids) : "",
               time_needed_text(experiment, options, plan, done.stores, done.ids));
    return 0;
  }
  if (options.slurm) return prepare_jobs(experiment, options, plan, folder);
  if (options.shard) return run_shard(experiment, options, std::move(plan), folder, interruption);
  const BelongsToStudy belongs = runs_of_study(experiment, options, plan, folder);
  interruption.runs_begin();  // from here on a signal lets go of the folder
  const ResultFolder held(folder, belongs, options.force);
  StudyRuns runs(experiment, options, plan, folder, folder);
  const std::unique_ptr<LargeStudy> large = large_study(experiment, plan, runs);
  MakePart part;
  if (large) part = [&](std::vector<RunRecord>&& records) { return large->part(std::move(records)); };
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
    } else if (!runs.carry_out_missing(interruption, part)) {
      return interrupted;
    }
  } while (runs.widen());
  interruption.ends_at_once(
      "interrupted while results were written; all runs are kept, and the same command writes them\n");
  return large ? large->write(experiment, options, runs) : write_study(experiment, options, plan, runs);
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
