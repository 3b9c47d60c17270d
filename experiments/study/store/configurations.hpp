// SPDX-License-Identifier: BSD-3-Clause
// The table `configurations` of the store: each distinct combination of run options once, so that results can be listed
// and filtered without their study being planned again. `runs.configuration` refers to its key.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <unordered_set>

#include "experiments/study/record/run_options.hpp"
#include "experiments/study/record/run_record.hpp"
#include "experiments/study/store/database.hpp"
#include "experiments/study/store/table_form.hpp"

namespace polhode::study::inline store {

/// The options that have a value in a run and apply to it, by RunOption::column, or by file_key() of an option without
/// a column.
using Configuration = std::map<std::string, OptionValue>;
Configuration configuration_of(const RunConfig& config);

/// Key of a configuration: the checksum of its names and values (value.hpp). Equal in every store.
std::int64_t key_of(const Configuration& configuration);
std::int64_t configuration_key(const RunConfig& config);  ///< the key of its configuration

/// The varied keys of the scenario, "key=value" in a line each; `\` and line breaks in a value are written `\\` and
/// `\n`. Keys that the run leaves unchanged are left out.
std::string varied_text(const RunConfig& config);
void set_varied_text(std::string& text, const RunConfig& config);  ///< the same, in the room that a text has

TableForm configurations_form();

/// Writes configurations. A column is added to the table when the first configuration has a value for it.
class ConfigurationWriter {
 public:
  explicit ConfigurationWriter(const Database& db);  ///< `db` must outlive the writer
  /// Stores the configuration of the run, which has this key, unless it is there.
  void keep(std::int64_t key, const RunConfig& config);

 private:
  const Database* db_;
  std::unordered_set<std::string> columns_;
  std::unordered_set<std::int64_t> known_;  ///< keys that are there; not all of them
};

/// All configurations of a store by key. Damaged ones are left out.
std::map<std::int64_t, Configuration> read_configurations(const Database& db);
std::unordered_set<std::int64_t> configuration_keys(const Database& db);  ///< the keys of these

}  // namespace polhode::study::store
