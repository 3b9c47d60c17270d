// SPDX-License-Identifier: BSD-3-Clause
// Names of scenarios that tell apart different scenarios of the same name in several stores.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "experiments/study/query/result_stores.hpp"

namespace polhode::study::inline query {

class ScenarioNames {
 public:
  explicit ScenarioNames(const ResultStores& stores);

  /// "top (results/a)" if the stores have different scenarios named top, with the first folder that has this one; else
  /// the name.
  std::string of(const std::string& name, const OpenStore& store) const;
  /// True if a name stands for different scenarios.
  bool ambiguous() const { return !names_.empty(); }

 private:
  std::map<std::pair<const OpenStore*, std::string>, std::string> names_;  ///< names with a folder
};

}  // namespace polhode::study::query
