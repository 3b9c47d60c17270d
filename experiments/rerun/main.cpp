// SPDX-License-Identifier: BSD-3-Clause
// Does a stored run have the same digits when it is carried out again?
#include <fmt/format.h>

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "experiments/rerun/options.hpp"
#include "experiments/rerun/rerun.hpp"
#include "experiments/study/process/interruption.hpp"
#include "experiments/study/process/progress.hpp"
#include "experiments/study/query/result_stores.hpp"
#include "experiments/study/store/result_tables.hpp"
#include "experiments/study/text/aligned.hpp"
#include "experiments/study/text/notation.hpp"
#include "experiments/study/text/program.hpp"

namespace polhode::study::rerun {
namespace {

constexpr int different = 1;  ///< exit status
constexpr std::size_t most_named = 20;

std::string table_of(const std::vector<Difference>& differences) {
  std::vector<std::vector<std::string>> rows = {{"", "stored", "again"}};
  const auto cell = [](const std::string& text) { return text.empty() ? std::string("-") : one_line(text); };
  for (const Difference& d : differences) rows.push_back({d.name, cell(d.stored), cell(d.again)});
  return aligned(rows, {true, true, true});
}

/// Counts what became of the runs, and prints those that are not the same.
struct Tally {
  std::size_t same = 0, different = 0, not_repeated = 0;

  void add(const Repeated& one) {
    if (!one.why_not.empty()) ++not_repeated;
    else if (one.differences.empty()) ++same;
    else ++different;
    const bool named = not_repeated + different <= most_named;
    if (!one.why_not.empty() && named)
      fmt::print(stderr, "rerun: run {} of {}: not repeated: {}\n", one.run.id, one.run.where->file.string(),
                 one.why_not);
    if (!one.differences.empty() && named) {
      fmt::print("run {} ({}): {}:\n{}", one.run.id, one.words,
                 one.differences.size() == 1 ? "1 value is different"
                                             : fmt::format("{} values are different", one.differences.size()),
                 table_of(one.differences));
    }
  }
  void add_row_without_id(const OpenStore& where, std::int64_t number) {
    if (++not_repeated + different <= most_named)
      fmt::print(stderr, "rerun: row {} of {}: not repeated: it is damaged ({})\n", number, where.file.string(),
                 id_damage);
  }
  int status() const { return different > 0 ? rerun::different : not_repeated > 0 ? not_carried_out : 0; }
};

int run(const RerunOptions& options) {
  const ResultStores stores(options.folders);
  for (const std::string& remark : stores.remarks()) fmt::print(stderr, "rerun: {}\n", remark);
  Interruption interruption;
  Tally tally;
  if (!options.id.empty()) {
    bool done = false;
    repeat({stores.find(options.id)}, 1, interruption.no_more(), interruption.stop(), [&](const Repeated& one) {
      done = true;
      tally.add(one);
      if (tally.same > 0) fmt::print("run {} ({}): every digit is the same\n", one.run.id, one.words);
    });
    return done ? tally.status() : interrupted;
  }
  std::vector<FoundRun> runs = all_runs(stores);
  if (options.random) runs = drawn(std::move(runs), *options.random, options.seed);
  Progress progress("rerun", runs.size());
  const auto started = std::chrono::steady_clock::now();
  std::size_t done = 0;
  repeat(runs, options.jobs, interruption.no_more(), interruption.stop(), [&](const Repeated& one) {
    tally.add(one);
    ++done;
    if (!progress.is_due()) return;
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    const double share = static_cast<double>(done) / static_cast<double>(runs.size());
    progress.report(done, share, seconds * (1 - share) / share);
  });
  progress.finish();
  std::size_t all = runs.size();
  for (const auto& open : stores.all()) {
    if (options.random) break;
    for (const std::int64_t number : open->store.rows_without_id()) {
      tally.add_row_without_id(*open, number);
      ++all;
    }
  }
  fmt::print("{} of {} repeated: {} the same, {} different, {} not repeated\n", tally.same + tally.different,
             count(all, "run"), tally.same, tally.different, tally.not_repeated);
  return done < runs.size() ? interrupted : tally.status();
}

}  // namespace
}  // namespace polhode::study::rerun

int main(int argc, char** argv) {
  using namespace polhode::study;
  return run_program("rerun", [&] {
    const rerun::RerunOptions options = rerun::parse_rerun_options(argc, argv);
    return options.exit_status ? *options.exit_status : rerun::run(options);
  });
}
