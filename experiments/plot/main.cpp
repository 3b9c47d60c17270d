// SPDX-License-Identifier: BSD-3-Clause
// Quantities of stored runs: against time, against each other, and in space.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/plot/options.hpp"
#include "experiments/plot/recording.hpp"
#include "experiments/plot/run_figures.hpp"
#include "experiments/study/plot/draw_figures.hpp"
#include "experiments/study/process/interruption.hpp"
#include "experiments/study/query/result_stores.hpp"
#include "experiments/study/query/stored_run.hpp"
#include "experiments/study/query/stored_study.hpp"
#include "experiments/study/text/aligned.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/notation.hpp"
#include "experiments/study/text/program.hpp"

namespace polhode::study::plot_program {
namespace {

struct ChosenRun {
  RunConfig config;
  std::shared_ptr<const Scenario> scenario;
};

std::vector<ChosenRun> chosen_runs(const ResultStores& stores, const PlotOptions& options) {
  std::vector<ChosenRun> runs;
  for (const std::string& id : options.ids) {
    const FoundRun found = stores.find(id);
    const auto stored = found.where->store.find(found.id, Curves::without);
    if (!stored) throw InputError("run " + found.id + " was removed meanwhile");
    try {
      ReadRun read = read_run(*stored, found.where->configurations, found.where->scenarios);
      runs.push_back({std::move(read.config), std::move(read.scenario)});
    } catch (const NotReproduced& reason) {
      throw InputError(fmt::format("run {} of {}: {}", found.id, found.where->file.string(), reason.what()));
    }
  }
  if (!runs.empty()) return runs;
  StoredStudyView stored = stored_study(stores, options.where);
  for (const std::string& remark : stored.remarks) fmt::print(stderr, "plot: {}\n", remark);
  if (stored.view.runs.size() > most_runs)
    throw InputError(
        fmt::format("{} are there, and a figure shows at most {}; choose with --where, or name runs by the "
                    "ids that `results {} --columns run,integrator,dt` prints",
                    count(stored.view.runs.size(), "run"), most_runs, options.folders.front()));
  for (RunRecord& run : stored.view.runs) runs.push_back({std::move(run.config), std::move(run.scenario)});
  return runs;
}

std::string list_of_quantities() {
  std::vector<std::vector<std::string>> rows;
  for (const PlotQuantity& quantity : plot_quantities()) rows.push_back({quantity.name, quantity.shows});
  return aligned(rows, {true, true});
}

std::filesystem::path folder_of(const PlotOptions& options, const ResultStores& stores) {
  if (!options.out.empty()) return options.out;
  if (stores.folders().size() == 1) return stores.folders().front();
  throw InputError(fmt::format("--out: figures of {} need a folder of their own; name it",
                               count(stores.folders().size(), "folder")));
}

int run(const PlotOptions& options) {
  if (options.list) {
    fmt::print("{}", list_of_quantities());
    return 0;
  }
  const ResultStores stores(options.folders);
  for (const std::string& remark : stores.remarks()) fmt::print(stderr, "plot: {}\n", remark);
  const auto folder = folder_of(options, stores);
  Interruption interruption;
  std::vector<Recording> recordings;
  for (const ChosenRun& chosen : chosen_runs(stores, options)) {
    recordings.push_back(
        record(chosen.config, *chosen.scenario, options.quantities, options.body, &interruption.stop()));
    if (recordings.back().result.status == "interrupted") return interrupted;
  }
  const RunFigures made = figures_of_runs(recordings, options.quantities, options.look);
  std::string said = draw_figures({made.figures, {}}, folder, "plots", Others::keep);
  if (const auto more = draw_space_figures(made.in_space, folder, "plots"); said.empty()) said = more;
  const auto print_name = [&](const std::string& name) {
    fmt::print("{}\n", (folder / "plots" / (name + ".svg")).string());
  };
  for (const Figure& figure : made.figures) print_name(figure.name);
  for (const SpaceFigure& figure : made.in_space) print_name(figure.name);
  for (const std::string& absent : made.absent) fmt::print(stderr, "plot: {}\n", absent);
  if (!said.empty()) fmt::print(stderr, "plot: {}\n", said);
  return made.absent.empty() ? 0 : not_carried_out;
}

}  // namespace
}  // namespace polhode::study::plot_program

int main(int argc, char** argv) {
  using namespace polhode::study;
  return run_program("plot", [&] {
    const auto options = plot_program::parse_plot_options(argc, argv);
    return options.exit_status ? *options.exit_status : plot_program::run(options);
  });
}
