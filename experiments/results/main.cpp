// SPDX-License-Identifier: BSD-3-Clause
// What do the results of studies say?
#include <fmt/format.h>

#include <cstdio>
#include <string>

#include "experiments/results/best.hpp"
#include "experiments/results/listing.hpp"
#include "experiments/results/options.hpp"
#include "experiments/results/summary.hpp"
#include "experiments/study/query/result_stores.hpp"
#include "experiments/study/query/run_columns.hpp"
#include "experiments/study/text/program.hpp"

int main(int argc, char** argv) {
  using namespace polhode::study;
  return run_program("results", [&] {
    const results::ResultsOptions options = results::parse_results_options(argc, argv);
    if (options.exit_status) return *options.exit_status;
    const ResultStores stores(options.folders);
    for (const std::string& remark : stores.remarks()) fmt::print(stderr, "results: {}\n", remark);
    if (options.list) {
      for (const std::string& name : RunColumns(stores).names()) fmt::print("{}\n", name);
      return 0;
    }
    if (options.best) return results::list_best(stores, options);
    return options.plain() ? results::summarise(stores) : results::list_runs(stores, options);
  });
}
