// SPDX-License-Identifier: BSD-3-Clause
// The variations of a study, as written: the axes of its grid, its tables of points, and its conditions. The study file
// and the command line are read into the same words.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "experiments/study/plan/cells_file.hpp"
#include "experiments/study/record/run_record.hpp"

namespace polhode::study::inline plan {

/// A key of a table of points: an option, by its name on the command line without dashes, or a key of the scenario.
struct PointColumn {
  std::string key;
  std::string text;   ///< zip: the values, "1e-3,1e-2"; random: the distribution, "uniform(0.5,3)"; cells: empty
  std::string label;  ///< name in error messages: "study.toml:3:8: zip.dt" or "--zip dt"
};

/// Points that give values to several keys at once.
struct PointTable {
  enum class Kind { zip, random, cells };
  Kind kind = Kind::zip;
  std::string label;  ///< name in error messages: "study.toml:3:1: zip" or "--zip"
  std::vector<PointColumn> columns;
  std::size_t n = 0;                        ///< random: number of points
  std::uint64_t seed = 1;                   ///< random
  std::shared_ptr<const CellsFile> file{};  ///< cells: the rows; its columns are found by key
};

/// The word of the command line and of study files: "zip".
std::string word(PointTable::Kind kind);
/// The table as the command line takes it: "dt=1e-3,1e-2 t-end=10,100".
std::string words(const PointTable& table);

struct Condition {
  std::string text;   ///< "dt < 0.1 and integrator == 'rk4'"
  std::string label;  ///< "study.toml:9:9: where" or "--where"
};

struct StudyAxes {
  std::string name;  ///< name of the study; empty: the only one
  /// Values of the axes as written, by option name without dashes: {"dt", "1e-3,1e-2"}. Includes defaults.
  std::map<std::string, std::string> axes;
  std::vector<std::pair<std::string, std::string>> vary;  ///< keys of the scenario and their values, as written
  std::vector<PointTable> tables;                         ///< a key of a table overrides the same key of the grid
  std::vector<Condition> where;                           ///< cells must satisfy all of them
  std::set<std::string> said;                   ///< options that this study itself gives, in its grid or a table
  std::map<std::string, OptionValue> settings;  ///< options that are no axes, by name
  /// Places of settings in the study file, by axis, or by "vary." and a key: "study.toml:3:8: dt".
  std::map<std::string, std::string> places;

  /// Name of an option in error messages: "--dt", or its place in the study file.
  std::string label(const std::string& option) const;
  /// The table that has the key; null: none.
  const PointTable* table_with(const std::string& key) const;
  bool has(const std::string& key) const;  ///< the grid or a table has the key
  /// Adds an axis to the grid. `key` as axis_key() returns it, or any key of the scenario with `of_scenario`. Throws
  /// InputError if the study has the key.
  void add_axis(const std::string& key, const std::string& text, const std::string& label, bool of_scenario = false);
  /// Adds a table. Throws InputError if the study has one of its keys.
  void add_table(PointTable table);
  /// Removes the key from the grid and from all tables, and the tables that then have no key.
  void remove(const std::string& key);
};

/// The key as the study names it: an option in its name on the command line ("t-end" for t_end), or the key of a
/// scenario. Throws InputError, "LABEL: no such axis; did you mean …", if it is neither.
std::string axis_key(const std::string& written, const std::string& label);

/// A number of random points, or a seed. Throws InputError, which begins with the label, if the number is none.
std::size_t number_of_points(double n, const std::string& label);
std::uint64_t seed_from(double seed, const std::string& label);

/// A table of all columns of a CSV file.
PointTable table_of_cells(const std::string& path, const std::string& label);

/// True if the key is an option of runs that may be an axis, and not a key of the scenario.
bool is_option(const std::string& key);

}  // namespace polhode::study::plan
