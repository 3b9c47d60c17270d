// SPDX-License-Identifier: BSD-3-Clause
// What makes a stored run the run that it is, and in what do two runs differ?
#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <vector>

#include "experiments/explain/identity.hpp"
#include "experiments/explain/options.hpp"
#include "experiments/study/query/result_stores.hpp"
#include "experiments/study/text/aligned.hpp"
#include "experiments/study/text/notation.hpp"
#include "experiments/study/text/program.hpp"

namespace polhode::study::explain {
namespace {

void print_one(const ExplainedRun& run) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& [key, value] : identity_of_run(run)) rows.push_back({key, one_line(value)});
  fmt::print("run {}\n{}", run.id, aligned(rows, {true, true}));
  fmt::print("The scenario text, in which the varied keys are set:\n{}", run.read.scenario->canonical());
}

void print_both(const ExplainedRun& a, const ExplainedRun& b) {
  const std::vector<KeyDifference> differences = differing_keys(a, b);
  if (differences.empty()) {
    fmt::print("{}\n", a.id == b.id ? "the same run" : "no key differs, although the ids do");
    return;
  }
  const auto cell = [](const std::string& text) { return text.empty() ? std::string("-") : one_line(text); };
  std::vector<std::vector<std::string>> rows = {{"", a.id, b.id}};
  for (const KeyDifference& d : differences) rows.push_back({d.key, cell(d.first), cell(d.second)});
  fmt::print("{}{}\n", aligned(rows, {true, true, true}),
             differences.size() == 1 ? "1 key differs" : fmt::format("{} keys differ", differences.size()));
}

}  // namespace
}  // namespace polhode::study::explain

int main(int argc, char** argv) {
  using namespace polhode::study;
  return run_program("explain", [&] {
    const explain::ExplainOptions options = explain::parse_explain_options(argc, argv);
    if (options.exit_status) return *options.exit_status;
    const ResultStores stores(options.folders);
    for (const std::string& remark : stores.remarks()) fmt::print(stderr, "explain: {}\n", remark);
    const explain::ExplainedRun first = explain::explained(stores.find(options.ids.front()));
    if (options.ids.size() == 1) explain::print_one(first);
    else explain::print_both(first, explain::explained(stores.find(options.ids.back())));
    return 0;
  });
}
