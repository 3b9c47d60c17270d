// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/store/result_folder.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "experiments/study/record/analysis.hpp"
#include "experiments/study/record/run_id.hpp"
#include "experiments/study/store/database.hpp"
#include "experiments/study/store/shard_folders.hpp"
#include "experiments/study/store/store.hpp"
#include "experiments/study/text/input_error.hpp"

namespace polhode::study::inline store {
namespace {

/// Names of the files and folders that a study writes beside its store.
constexpr const char* files[] = {"runs.csv",   "timings.csv", "manifest.json", "report.html", "trajectory.csv",
                                 "energy.csv", "events.csv",  "trajectory.h5", "replay.html"};
constexpr const char* folders[] = {"figures", "tables", timings_folder, "trajectories", folder_of_shards};

std::vector<std::filesystem::path> products(const std::filesystem::path& path) {
  std::vector<std::filesystem::path> all;
  for (const char* name : files) all.push_back(path / name);
  for (const char* name : folders) all.push_back(path / name);
  return all;
}

/// Existing files with the name of a folder of the study, and existing folders with the name of a file.
std::vector<std::filesystem::path> misplaced(const std::filesystem::path& path) {
  std::vector<std::filesystem::path> all;
  const auto look = [&](const std::filesystem::path& at, bool folder) {
    std::error_code error;
    const auto status = std::filesystem::status(at, error);
    if (std::filesystem::exists(status) && std::filesystem::is_directory(status) != folder) all.push_back(at);
  };
  for (const char* name : folders) look(path / name, true);
  for (const char* name : files) look(path / name, false);
  for (const char* suffix : {"", "-wal", "-shm", "-journal"})
    look(path / (std::string(Store::file_name) + suffix), false);
  std::error_code error;
  for (const auto& run : std::filesystem::directory_iterator(path / "trajectories", error)) {
    look(run.path(), true);
    for (const char* name : {"trajectory.csv", "energy.csv", "events.csv", "trajectory.h5"})
      look(run.path() / name, false);
  }
  return all;
}

/// The folder and those of its shards.
std::vector<std::filesystem::path> with_shards(const std::filesystem::path& path) {
  std::vector<std::filesystem::path> all = shard_folders(path);
  all.insert(all.begin(), path);
  return all;
}

bool holds_only(const std::filesystem::path& path, const BelongsToStudy& belongs) {
  try {
    std::size_t stored = 0;
    for (const auto& folder : with_shards(path)) {
      const auto ids = Store::ids_in(folder);
      if (!std::all_of(ids.begin(), ids.end(), belongs)) return false;
      stored += ids.size();
    }
    return stored > 0;
  } catch (const DiskFull&) {
    throw;
  } catch (const std::runtime_error&) {
    return false;  // damaged
  }
}

/// True if the store has an intact run that does not belong to the study. Damage can change an id too.
bool holds_foreign_runs(const std::filesystem::path& path, const BelongsToStudy& belongs) {
  std::vector<std::uint64_t> others = Store::ids_in(path);
  std::erase_if(others, belongs);
  if (others.empty()) return false;
  const Store store(path, metric_table(), Access::look);
  return std::any_of(others.begin(), others.end(), [&](std::uint64_t id) {
    const auto run = store.find(id_of_number(id), Curves::without);
    return run && run->damage.empty();
  });
}

}  // namespace

void refuse_other_study(const std::filesystem::path& path, const BelongsToStudy& belongs) {
  const std::string remedy = "; " + std::string(another_folder);
  for (const auto& at : misplaced(path)) {
    throw InputError("--out: " + at.string() + " is a " +
                     (std::filesystem::is_directory(at) ? "folder where the study writes a file"
                                                        : "file where the study needs a folder") +
                     "; move it away, or overwrite it with --force");
  }
  bool foreign = false;
  try {
    for (const auto& folder : with_shards(path)) foreign = foreign || holds_foreign_runs(folder, belongs);
  } catch (const DiskFull&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw InputError("--out: " + std::string(error.what()) + remedy);
  }
  if (foreign) throw InputError("--out: " + path.string() + " holds the results of a different study" + remedy);
  if (!std::filesystem::exists(path / Store::file_name) && shard_folders(path).empty()) {
    for (const auto& product : products(path)) {
      if (std::filesystem::exists(product))
        throw InputError("--out: " + product.string() + " is there already" + remedy);
    }
  }
}

ResultFolder::ResultFolder(const std::filesystem::path& path, const BelongsToStudy& belongs, bool force) {
  std::error_code error;
  if (std::filesystem::exists(path, error) && !std::filesystem::is_directory(path, error)) {
    throw InputError("--out: " + path.string() + " is not a folder; name another one");
  }
  const std::size_t length = std::filesystem::weakly_canonical(std::filesystem::absolute(path), error).string().size();
  if (length > Store::longest_folder()) {
    throw InputError("--out: " + path.string() + ": its absolute path has " + std::to_string(length) +
                     " bytes, and SQLite, which keeps the results, takes " + std::to_string(Store::longest_folder()) +
                     " at most; name a folder with a shorter path");
  }
  std::filesystem::create_directories(path, error);
  if (error) throw InputError("--out: cannot create " + path.string() + ": " + error.message());
  // The folder is locked before it is read: of two programs started at once only one continues.
  try {
    lock_.emplace(path);
  } catch (const std::runtime_error& locked) {
    throw InputError("--out: " + std::string(locked.what()));
  }
  if (!force) {
    refuse_other_study(path, belongs);
    return;
  }
  for (const auto& at : misplaced(path)) std::filesystem::remove_all(at, error);
  if (holds_only(path, belongs)) return;
  for (const auto& product : products(path))
    std::filesystem::remove_all(product, error);  // all results of the other study
  for (const char* suffix : {"", "-wal", "-shm", "-journal"}) {
    std::filesystem::remove(path / (std::string(Store::file_name) + suffix), error);
  }
}

}  // namespace polhode::study::store
