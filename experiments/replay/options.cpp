// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/replay/options.hpp"

#include "experiments/study/report/page/replay_link.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/value_lists.hpp"

namespace polhode::study::replay {

const Experiment& replay_experiment() {
  static const Experiment experiment = {
      .name = "replay",
      .question = "What does it look like? One file that plays motion in any browser, without a network.",
      .defaults = {{"scenario", "dzhanibekov"},
                   {"integrator", "rk4,semi_implicit_euler"},
                   {"dt", "1e-2"},
                   {"tolerance", "1e-8"}}};
  return experiment;
}

ReplayOptions parse_replay_options(int argc, const char* const* argv) {
  ReplayOptions options;
  std::string out, results, runs, three = "/usr/share/javascript/three";
  double megabytes = 3;
  const auto own = [&](CommandLine& line) {
    for (const char* name : {"--out", "--force", "--trajectory", "--reference", "--curves", "--no-figures", "--figure",
                             "--figure-width", "--figure-font", "--figure-title", "--figure-language", "--jobs",
                             "--seed", "--shard", "--merge", "--slurm", "--submit", "--dry-run"}) {
      line.remove(name);
    }
    line.add("--results", results, "play what a study with --trajectory csv, or simulate, has kept in this folder")
        .type_name("FOLDER")
        .group("Motion");
    line.add("--runs", runs, "of that study: the runs with these ids (first column of runs.csv; default: all)")
        .type_name("ID,…")
        .group("Motion");
    line.add("--out", out, "the page (default: replay.html, in the folder of --results)")
        .type_name("FILE")
        .not_empty()
        .group("Page");
    line.add_flag("--force", options.force, "overwrite a file that is no replay page").group("Page");
    line.add("--limit", megabytes, "MB, how large the page may become; motion is thinned to fit (default: 3)")
        .type_name("MB")
        .group("Page");
    line.add("--three", three,
             "folder that holds three.min.js and examples/js/controls/OrbitControls.js (default: Debian's libjs-three)")
        .type_name("FOLDER")
        .group("Page");
  };
  ParsedOptions parsed = parse_options(replay_experiment(), argc, argv, own);
  options.study = std::move(parsed.options);
  options.exit_status = parsed.exit_status;
  if (options.exit_status) return options;
  if (!(megabytes > 0 && megabytes <= 1000)) throw InputError("--limit takes a number of MB above 0 and up to 1000");
  options.limit_bytes = 1e6 * megabytes;
  options.results = results;
  options.three = three;
  if (!runs.empty()) {
    if (results.empty()) throw InputError("--runs names runs of a study; name its folder with --results");
    options.runs = split_list(runs, ',', "--runs");
  }
  if (!results.empty()) {
    const std::string preset = replay_experiment().defaults.at("scenario");
    const StudyAxes& said = options.study.studies.front();
    auto axes = said.axes;
    if (const auto found = axes.find("scenario"); found != axes.end() && found->second != preset)
      options.scenario = found->second;
    axes["scenario"] = preset;
    const bool more =
        options.study.studies.size() > 1 || !said.vary.empty() || !said.tables.empty() || !said.where.empty();
    if (axes != replay_experiment().defaults || more) {
      throw InputError("--results plays what was run already; of the axes it takes --scenario alone");
    }
  }
  options.out = !out.empty() ? std::filesystem::path(out) : std::filesystem::path(results) / replay_page;
  return options;
}

}  // namespace polhode::study::replay
