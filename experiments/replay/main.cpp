// SPDX-License-Identifier: BSD-3-Clause
// What does it look like? One file that plays motion in any browser, without a network.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "experiments/replay/energy_answer.hpp"
#include "experiments/replay/options.hpp"
#include "experiments/replay/page.hpp"
#include "experiments/replay/recorder.hpp"
#include "experiments/replay/study_reader.hpp"
#include "experiments/study/plan/listing.hpp"
#include "experiments/study/plan/plan.hpp"
#include "experiments/study/report/page/kept_answer.hpp"
#include "experiments/study/report/page/replay_link.hpp"
#include "experiments/study/text/build_info.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/program.hpp"
#include "experiments/study/text/text_file.hpp"

namespace polhode::study::replay {
namespace {

constexpr std::size_t most_runs = 16;
constexpr double most_turn = 1;             ///< largest rotation between two instants that can be interpolated, rad
constexpr double share_of_impacts = 0.125;  ///< largest size of the impacts over that of the motion

struct Motion {
  PageWords words;
  std::vector<Recording> recordings;
};

std::string made_by() { return fmt::format("polhode {}, commit {}", build_info().version, build_info().commit); }

PageWords words_of(const Scenario& scenario) {
  return {.scenario = scenario.name,
          .title = scenario.title,
          .description = scenario.description,
          .paragraphs = {},
          .made_by = made_by()};
}

Motion carried_out(const ReplayOptions& options) {
  const Plan plan = make_plan(replay_experiment(), options.study);
  if (plan.scenarios.size() > 1) throw InputError("--scenario: a page shows one scenario; name one");
  if (plan.size() > most_runs) {
    throw InputError(
        fmt::format("a page shows at most {} runs, and these are {}; make the axes shorter", most_runs, plan.size()));
  }
  Motion motion{words_of(plan.scenarios.front()), {}};
  motion.words.paragraphs.push_back("Carried out for this page by: " + options.study.command);
  for (const PlannedRun& run : plan.runs()) {
    if (!run.refusal.empty()) {
      fmt::print(stderr, "replay: left out: {}\n", run.refusal);
      motion.words.paragraphs.push_back("Left out: " + run.refusal + ".");
      continue;
    }
    // Four times as many instants as can fit, from which the page chooses evenly.
    const double fit = options.limit_bytes / (26 * double(run.scenario->problem.moving()) +
                                              12 * double(run.scenario->problem.joints.size()) + 12);
    motion.recordings.push_back(record(run, std::size_t(4 * fit) + 16));
  }
  motion.words.answer = energy_answer(motion.recordings);
  return motion;
}

Motion kept(const ReplayOptions& options) {
  KeptStudy study = read_study(options.results, options.runs, options.scenario, most_runs);
  Motion motion{words_of(study.scenario), std::move(study.recordings)};
  motion.words.paragraphs.push_back(fmt::format("Recorded by {} with: {}", study.made_by, study.command));
  motion.words.answer = kept_answer(options.results);
  if (motion.words.answer.empty()) motion.words.answer = energy_answer(motion.recordings);
  return motion;
}

double size_of(const std::vector<Recording>& recordings, std::size_t instants) {
  double bytes = 0;
  for (const Recording& r : recordings) bytes += bytes_of_instant(r) * double(std::min(instants, r.times.size()));
  return bytes;
}

/// Largest n such that n instants of each run, or all of a shorter run, fit into `room` bytes.
std::size_t instants_that_fit(const std::vector<Recording>& recordings, double room) {
  std::size_t low = 0, high = 0;
  for (const Recording& r : recordings) high = std::max(high, r.times.size());
  while (low < high) {
    const std::size_t middle = low + (high - low + 1) / 2;
    if (size_of(recordings, middle) <= room) low = middle;
    else high = middle - 1;
  }
  return low;
}

void say(Motion& motion, const std::string& sentence) {
  fmt::print("{}\n", sentence);
  motion.words.paragraphs.push_back(sentence + ".");
}

/// Removes impacts and instants until the page is at most `limit` bytes. Throws InputError if two instants do not fit.
void fit(Motion& motion, double limit, const ThreeJs& three) {
  std::vector<Recording> bare = motion.recordings;
  double impacts = 0;
  for (Recording& r : bare) {
    impacts += bytes_of_impact * double(r.impacts.size());
    r.impacts.clear();
    r.times.clear();
    r.placements.clear();
    r.reactions.clear();
    r.energy_drift.clear();
    r.momentum_drift.clear();
  }
  constexpr double sentences = 2000;  // size of the notes that are added later, bytes for each run
  const double room = limit - double(page_of(motion.words, bare, three).size()) - sentences * double(bare.size() + 1);
  if (impacts > share_of_impacts * room && impacts + size_of(motion.recordings, std::size_t(-1)) > room) {
    const auto most = std::size_t(std::max(0.0, share_of_impacts * room / bytes_of_impact) / double(bare.size()));
    for (Recording& r : motion.recordings) keep_impacts(r, most);
    impacts = share_of_impacts * room;
  }
  const std::size_t n = instants_that_fit(motion.recordings, room - impacts);
  if (n < 2) {
    throw InputError(fmt::format("--limit: {:.3g} MB have no room for two instants of each run; give --limit {:.0f}",
                                 limit / 1e6,
                                 std::ceil((limit - room + impacts + 100 * size_of(motion.recordings, 1)) / 1e6)));
  }
  for (Recording& r : motion.recordings) keep_instants(r, n);
}

/// Adds the sentence about each run, or a single one if it is the same for all.
void say_of_each(Motion& motion, const std::function<std::string(const Recording&)>& sentence) {
  std::vector<std::string> said;
  for (const Recording& r : motion.recordings) said.push_back(sentence(r));
  const bool same = std::all_of(said.begin(), said.end(), [&](const std::string& s) { return s == said.front(); });
  for (std::size_t i = 0; i < (same ? 1 : said.size()); ++i) {
    if (said[i].empty()) continue;
    say(motion, (said.size() == 1 ? "Here "
                 : same           ? "Of each run "
                                  : "Of " + label_of(motion.recordings[i]) + " ") +
                    said[i]);
  }
}

void say_what_is_left(Motion& motion, double limit) {
  say_of_each(motion, [&](const Recording& r) {
    if (std::int64_t(r.times.size()) == r.instants_seen) return std::string();
    return fmt::format("{} of {} instants are kept, at most {:.3g} s apart: it is thinned to fit {:g} MB",
                       r.times.size(), r.instants_seen, longest_spacing(r), limit / 1e6);
  });
  say_of_each(motion, [](const Recording& r) {
    if (std::int64_t(r.impacts.size()) == r.impacts_seen) return std::string();
    return fmt::format("{} of {} impacts are kept, those of the largest impulses", r.impacts.size(), r.impacts_seen);
  });
  say_of_each(motion, [](const Recording& r) {
    const double turn = largest_turn(r);
    if (!(turn > most_turn)) return std::string();
    return fmt::format(
        "a body turns by up to {:.3g} rad between two instants that are kept: its way between them is a guess", turn);
  });
  const bool inferred = std::any_of(motion.recordings.begin(), motion.recordings.end(), [](const Recording& r) {
    return std::any_of(r.scene.bodies.begin(), r.scene.bodies.end(),
                       [](const SceneBody& b) { return b.from_inertia && !b.fixed; });
  });
  if (inferred) {
    motion.words.paragraphs.emplace_back(
        "A body for which the scenario names no shape is drawn as the box of the same mass and moments of inertia.");
  }
  motion.words.paragraphs.emplace_back(
      "Positions are kept to 6e-8 of their size and orientations to 5e-5 rad. Between two instants that are kept, "
      "positions go straight and "
      "orientations turn evenly. Drifts are those at the instants that are kept, relative, as runs.csv defines them.");
}

int replay(const ReplayOptions& options) {
  const ThreeJs three = read_three(options.three);
  if (std::filesystem::exists(options.out) && !options.force && !is_replay_page(options.out)) {
    throw InputError("--out: " + options.out.string() +
                     " is there already and is no replay page; name another file, or overwrite it with --force");
  }
  // 1. The motions: of runs that are carried out now, or of a study.
  Motion motion = options.results.empty() ? carried_out(options) : kept(options);
  // 2. Reduction to the size of the page, with notes about it.
  fit(motion, options.limit_bytes, three);
  say_what_is_left(motion, options.limit_bytes);
  // 3. The page, and a link to it in the report of the study.
  const std::string page = page_of(motion.words, motion.recordings, three);
  if (options.out.has_parent_path()) std::filesystem::create_directories(options.out.parent_path());
  write_text(options.out, page);
  if (!options.results.empty() && options.out == options.results / replay_page) update_replay_line(options.results);
  fmt::print(
      "{}: {}, {:.2f} MB\n{}\n", motion.words.title,
      motion.recordings.size() == 1 ? "one view" : fmt::format("{} views side by side", motion.recordings.size()),
      double(page.size()) / 1e6, options.out.string());
  return 0;
}

int run_replay(int argc, char** argv) {
  const ReplayOptions options = parse_replay_options(argc, argv);
  if (options.exit_status) return *options.exit_status;
  if (options.study.list) {
    fmt::print("{}", listing(*options.study.list));
    return 0;
  }
  return replay(options);
}

}  // namespace
}  // namespace polhode::study::replay

int main(int argc, char** argv) {
  using namespace polhode::study;
  using namespace polhode::study::replay;
  return run_program("replay", [&] { return run_replay(argc, argv); });
}
