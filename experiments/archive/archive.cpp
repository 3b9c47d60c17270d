// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/archive/archive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "experiments/study/trajectory/kept_trajectory.hpp"

namespace polhode::study::archive {
namespace {

namespace fs = std::filesystem;
using Condition = KeptTrajectory::Condition;

std::vector<KeptTrajectory> trajectories_below(const fs::path& folder) {
  std::set<fs::path> folders = {folder};
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_directory()) folders.insert(entry.path());
  }
  std::vector<KeptTrajectory> all;
  for (const fs::path& at : folders) {
    for (const auto format : {TrajectoryFormat::csv, TrajectoryFormat::hdf5}) {
      if (auto kept = kept_trajectory(at, format)) all.push_back(std::move(*kept));
    }
  }
  return all;
}

std::string line_of(const KeptTrajectory& kept) {
  return fmt::format("{}: {}", kept.tables.front().file.string(), in_words(kept));
}

/// "3 trajectories: 2 whole, 1 unfinished, 0 damaged".
std::string sum_of(const std::vector<KeptTrajectory>& all) {
  std::map<Condition, int> count;
  for (const KeptTrajectory& kept : all) ++count[kept.condition];
  return fmt::format("{} trajector{}: {} whole, {} unfinished, {} damaged\n", all.size(), all.size() == 1 ? "y" : "ies",
                     count[Condition::whole], count[Condition::unfinished], count[Condition::damaged]);
}

}  // namespace

Inventory check(const fs::path& folder) {
  Inventory inventory;
  const auto all = trajectories_below(folder);
  for (const KeptTrajectory& kept : all) {
    inventory.text += line_of(kept) + "\n";
    inventory.all_well = inventory.all_well && kept.condition == Condition::whole;
  }
  inventory.text += sum_of(all);
  if (inventory.all_well) return inventory;
  const bool damaged =
      std::any_of(all.begin(), all.end(), [](const auto& kept) { return kept.condition == Condition::damaged; });
  inventory.text += fmt::format(
      "{}the command of the study makes them whole; {}./run archive repair {} saves what there is of them\n",
      damaged ? "once the files named as damaged are removed, " : "", damaged ? "before that, " : "", folder.string());
  return inventory;
}

Inventory repair(const fs::path& folder) {
  Inventory inventory;
  const auto all = trajectories_below(folder);
  for (const KeptTrajectory& kept : all) {
    if (kept.condition == Condition::whole) continue;
    const bool something = kept.instants > 0;
    inventory.text += fmt::format(
        "{}; {}\n", line_of(kept),
        something ? fmt::format("saved as {}, lost from there on", recover(kept).string()) : "nothing can be saved");
    inventory.all_well = inventory.all_well && something;
  }
  inventory.text += sum_of(all);
  return inventory;
}

}  // namespace polhode::study::archive
