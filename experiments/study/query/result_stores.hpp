// SPDX-License-Identifier: BSD-3-Clause
// The stores of one or several folders of results. The stores of a study's shards belong to its folder.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiments/study/scenario/scenario.hpp"
#include "experiments/study/store/store.hpp"

namespace polhode::study::inline query {

/// An open store, with what stands in it once for many runs.
struct OpenStore {
  OpenStore(std::filesystem::path folder, const std::filesystem::path& place);

  std::filesystem::path folder;  ///< folder of the study
  std::filesystem::path file;    ///< results.sqlite, in the folder or in that of a shard
  Store store;
  std::map<std::int64_t, Configuration> configurations;
  std::map<std::string, StoredScenario> scenarios;
};

/// A run in one of the stores.
struct FoundRun {
  const OpenStore* where;
  std::string id;
};

class ResultStores {
 public:
  /// Opens the stores of the folders for reading. A folder without a store stands for all folders below it that have
  /// one. Throws InputError if there is no such folder, if nothing is there, or if a store cannot be read: damaged, of
  /// another version, locked. A store whose study was stopped before its first run is left out, and said in remarks().
  explicit ResultStores(const std::vector<std::string>& folders);

  /// All stores: folders in the order of their names on the command line, a study before its shards.
  const std::vector<std::unique_ptr<OpenStore>>& all() const { return stores_; }
  std::vector<std::string> folders() const;  ///< folders of the studies, each once
  const std::vector<std::string>& remarks() const { return remarks_; }

  /// The run whose id is this, or begins so if no other does. In several stores: the first in which it is not damaged.
  /// Throws InputError if there is none, or more than one.
  FoundRun find(const std::string& id) const;

 private:
  std::vector<std::unique_ptr<OpenStore>> stores_;
  std::vector<std::string> remarks_;
};

}  // namespace polhode::study::query
