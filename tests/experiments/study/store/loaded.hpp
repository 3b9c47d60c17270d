// SPDX-License-Identifier: BSD-3-Clause
// All runs of a store at once.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "experiments/study/store/store.hpp"

namespace polhode::study {

struct Loaded {
  std::map<std::string, RunResult> runs;       ///< valid results by run id
  std::map<std::string, std::string> damaged;  ///< damaged runs: run id, and name of the invalid column
};

inline Loaded load(const Store& store) {
  Loaded loaded;
  store.for_each(Curves::with, [&](StoredRun&& run) {
    if (run.damage.empty()) loaded.runs.emplace(run.id, std::move(run.result));
    else loaded.damaged.emplace(run.id, run.damage);
  });
  return loaded;
}

}  // namespace polhode::study
