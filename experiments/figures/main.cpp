// SPDX-License-Identifier: BSD-3-Clause
// Figures of stored runs, drawn again without carrying out any.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/figures/options.hpp"
#include "experiments/study/query/result_stores.hpp"
#include "experiments/study/query/stored_study.hpp"
#include "experiments/study/report/figures/study_figures.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/notation.hpp"
#include "experiments/study/text/program.hpp"

namespace polhode::study::figures_program {
namespace {

namespace fs = std::filesystem;

/// Folder in which figures/ is written.
fs::path folder_of(const FiguresOptions& options, const ResultStores& stores) {
  if (!options.out.empty()) return options.out;
  if (stores.folders().size() == 1) return stores.folders().front();
  throw InputError(
      fmt::format("--out: figures of {} need a folder of their own; name it", count(stores.folders().size(), "study")));
}

int run(const FiguresOptions& options) {
  const ResultStores stores(options.folders);
  StoredStudyView stored = stored_study(stores, options.where);
  for (const std::string& remark : stores.remarks()) fmt::print(stderr, "figures: {}\n", remark);
  for (const std::string& remark : stored.remarks) fmt::print(stderr, "figures: {}\n", remark);
  StudyView& view = stored.view;
  view.folder = folder_of(options, stores);
  view.figure_choice = options.choice;
  const RedrawnFigures drawn = redraw_figures(view);
  for (const std::string& name : drawn.names) fmt::print("{}\n", (view.folder / "figures" / (name + ".svg")).string());
  if (!drawn.said.empty()) fmt::print(stderr, "figures: {}\n", drawn.said);
  if (!drawn.others.empty())
    fmt::print(
        stderr,
        "figures: not drawn again: {}; they are of the analysis of {}, and its command draws them, with the same "
        "options and without carrying out a run: {}\n",
        words(drawn.others), view.experiment, view.command);
  return drawn.names.empty() ? not_carried_out : 0;
}

}  // namespace
}  // namespace polhode::study::figures_program

int main(int argc, char** argv) {
  using namespace polhode::study;
  return run_program("figures", [&] {
    const auto options = figures_program::parse_figures_options(argc, argv);
    return options.exit_status ? *options.exit_status : figures_program::run(options);
  });
}
