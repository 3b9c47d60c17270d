// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/query/result_stores.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <system_error>

#include "experiments/study/store/shard_folders.hpp"
#include "experiments/study/store/table_form.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::inline query {
namespace {

namespace fs = std::filesystem;

bool has_results(const fs::path& folder) {
  std::error_code none;
  return fs::exists(folder / Store::file_name, none) || !shard_folders(folder).empty();
}

/// The folder if it has results, else all below it that have, in the order of their names.
std::vector<fs::path> studies_in(const fs::path& folder) {
  if (has_results(folder)) return {folder};
  std::set<fs::path> found;
  std::error_code error;
  fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied, error);
  for (; !error && at != fs::recursive_directory_iterator(); at.increment(error)) {
    if (!at->is_directory() || !has_results(at->path())) continue;
    found.insert(at->path());
    at.disable_recursion_pending();  // its shards are found from it
  }
  return {found.begin(), found.end()};
}

bool is_id(const std::string& text) {
  return !text.empty() && text.size() <= 16 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

}  // namespace

OpenStore::OpenStore(fs::path of_study, const fs::path& place)
    : folder(std::move(of_study)),
      file(place / Store::file_name),
      store(place, metric_table(), Access::read),
      configurations(store.configurations()),
      scenarios(store.scenarios()) {}

ResultStores::ResultStores(const std::vector<std::string>& folders) {
  std::set<fs::path> opened;
  for (const std::string& name : folders) {
    std::error_code error;
    if (!fs::is_directory(name, error)) {
      throw InputError(name + (fs::exists(name, error) ? " is not a folder" : ": no such folder") +
                       "; name a folder of results");
    }
    const std::vector<fs::path> studies = studies_in(name);
    if (studies.empty()) {
      throw InputError(
          fmt::format("{}: has no results: neither it nor a folder below it has a {}; name the folder of "
                      "a study",
                      name, Store::file_name));
    }
    for (const fs::path& study : studies) {
      if (!opened.insert(fs::weakly_canonical(study)).second) continue;  // named twice
      std::vector<fs::path> places = shard_folders(study);
      if (fs::exists(study / Store::file_name)) places.insert(places.begin(), study);
      for (const fs::path& place : places) {
        try {
          if (Store::is_unbegun(place)) {
            remarks_.push_back((place / Store::file_name).string() +
                               ": is empty, because its study was stopped before the first run");
          } else {
            stores_.push_back(std::make_unique<OpenStore>(study, place));
          }
        } catch (const OtherTables& reason) {
          throw InputError(reason.what() + std::string("; the command of its study makes it anew with --force"));
        } catch (const std::runtime_error& reason) {
          throw InputError(reason.what());
        }
      }
    }
  }
}

std::vector<std::string> ResultStores::folders() const {
  std::vector<std::string> names;
  for (const auto& open : stores_) {
    if (names.empty() || names.back() != open->folder.string()) names.push_back(open->folder.string());
  }
  return names;
}

FoundRun ResultStores::find(const std::string& id) const {
  if (!is_id(id)) {
    throw InputError("'" + id +
                     "' is not the id of a run; an id has 16 digits of 0 to 9 and a to f, as in the first "
                     "column of runs.csv, and may be cut short");
  }
  std::optional<FoundRun> found;
  std::set<std::string> ids;
  bool sound = false;
  for (const auto& open : stores_) {
    for (const std::string& one : open->store.ids_with(id)) {
      ids.insert(one);
      if (sound || (found && found->id != one)) continue;
      const auto run = open->store.find(one, Curves::without);
      sound = run && run->damage.empty();
      if (sound || !found) found = FoundRun{open.get(), one};
    }
  }
  if (ids.size() > 1) {
    throw InputError(fmt::format("{} runs begin with {}: {}; add digits", ids.size(), id,
                                 words(first_items({ids.begin(), ids.end()}, 4))));
  }
  if (!found)
    throw InputError(fmt::format("no run {}{} in {}", id, id.size() < 16 ? "…" : "", words(first_items(folders(), 4))));
  return *found;
}

}  // namespace polhode::study::query
