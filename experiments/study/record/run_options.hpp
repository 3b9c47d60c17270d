// SPDX-License-Identifier: BSD-3-Clause
// The table of run options: one entry holds everything about an option of a run.
//
// The command line, study files, the planner, the identity and the order of runs, the store, runs.csv, the tables,
// figures and report, session files and replays loop over this table. To add an option: add an entry, and the code that
// implements it. Make an option that stored studies do not contain `on_demand`: it then changes neither their columns
// nor their ids. The settings that methods declare (core/run/setting.hpp) are in the table by themselves.
#pragma once

#include <deque>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/run/integrator.hpp"
#include "experiments/study/record/run_record.hpp"

namespace polhode::study::inline record {

struct RunOption {
  /// The value of a flag is 1, shown as its word; a run for which it is not given has no value.
  enum class Kind { name, whole, number, flag };
  /// Property of a run that the option determines. Figures have one curve for each scenario, variant and method.
  enum class Role {
    scenario,
    method,
    variant,   ///< formulation, arithmetic or contact algorithm
    size,      ///< step or tolerance: the points of a curve
    duration,  ///< duration of the run, or number of measurements
    // No axes: all runs of a study to which the option applies have one value. No table or figure shows it.
    study,  ///< a flag of a study, of which a study file may have several
    call,   ///< a whole number for all studies of a call, which the command line alone gives
  };

  // Names on the command line, in study files and in session files.
  std::string name;    ///< name on the command line, without leading dashes; in files with '_' for '-'
  std::string values;  ///< values as shown after the name in --help: "quaternion|matrix"
  std::string help;    ///< meaning and default, in --help
  Kind kind = Kind::name;
  Role role = Role::variant;
  bool of_methods = false;                            ///< a setting that some methods declare (Declaration::settings)
  std::function<std::vector<std::string>()> known{};  ///< the valid names
  bool takes_all = false;                             ///< "all" stands for all valid names
  std::string of_unit{};                              ///< appended to "it must be a positive number": " of seconds"
  /// Reason for which a positive number is invalid: "is not an order"; empty: it is valid.
  std::function<std::string(double)> fault{};

  // Names in runs.csv, tables and figures.
  std::string column{};      ///< column of runs.csv, with the unit; empty: none
  bool on_demand = false;    ///< only studies that give the option have its column
  std::string header{};      ///< heading of its column in the table of runs
  std::string unit{};        ///< unit after that heading; empty: none
  std::string term{};        ///< name in the report's list of options; empty: the header
  std::string unsaid{};      ///< value in that list for a run without a value of the option
  std::string word{};        ///< word before a value that is shown alone: "gyroscopic on"; empty: none
  bool in_tex_names = true;  ///< values other than the usual one are part of the names of LaTeX values
  OptionValue usual{};       ///< value that is equivalent to no value in the RunConfig

  // Values in the configuration of a run.
  std::function<OptionValue(const RunConfig&)> value{};
  std::function<void(RunConfig&, const OptionValue&)> set{};
  /// True if the option affects the run, decided by the options before it in the table; empty: affects every run.
  std::function<bool(const RunConfig&)> applies{};
  bool decides = false;  ///< options after it apply or not by its value (`applies` of no option reads others)
  std::string no_effect{}, remedy{};  ///< reason for which no run of a study is affected; remedy other than omitting it
  bool needed = false;                ///< mandatory for a run to which it applies
  /// Default in a run of the scenario, if the option applies; empty: the default of RunConfig.
  std::function<OptionValue(const Scenario&)> preset{};

  bool applies_to(const RunConfig& config) const { return !applies || applies(config); }
};

/// All options, in the order in which the planner varies them (slowest first) and --help lists them.
const std::deque<RunOption>& run_options();

/// False: the option has one value for all runs of a study (Role::study, Role::call).
bool is_axis(const RunOption& option);

/// All options in the order of the columns of runs.csv: options on demand come last, sorted by column name; options
/// that are no axes follow.
const std::vector<const RunOption*>& options_by_column();
/// All options with their names in the store, sorted by these: the column, or file_key() where there is none.
const std::vector<std::pair<std::string, const RunOption*>>& options_by_stored_name();
std::vector<const RunOption*> options_of_role(RunOption::Role role);  ///< options in the order of options_by_column()

NamedOptions options_on_demand();  ///< names of all options on demand

/// The option with this name on the command line. Throws std::logic_error if there is none.
const RunOption& run_option(const std::string& name);

/// Returns the option with accessors that store its value in RunConfig::further.
RunOption without_member(RunOption option);

/// Adds an option to the table during its lifetime; for tests. No other thread may read the table meanwhile.
class AddedRunOption {
 public:
  explicit AddedRunOption(RunOption option);
  ~AddedRunOption();
  AddedRunOption(const AddedRunOption&) = delete;
  AddedRunOption& operator=(const AddedRunOption&) = delete;
};

/// Name of an option in files: "angular_state".
std::string file_key(const RunOption& option);

/// The values as shown after the name in the help of a study, where "all" may stand for all names: "NAME|all".
std::string values_in_studies(const RunOption& option);

/// The summary of a method with the options of its settings: "…, or --order 2 to 8".
std::string summary_of(const Declaration& method);

/// The value as text, with all digits; empty if there is no value.
std::string text_of(OptionValue value);
/// The value for readers: "gyroscopic on", "matrix", "order 5"; empty if the run has no value of the option.
std::string label_of(const RunOption& option, const RunConfig& config);
/// True if the run has no value of the option, the option's usual value, or the value that the run `usual` has.
bool is_usual(const RunOption& option, const RunConfig& config, const RunConfig& usual);
bool is_usual(const RunOption& option, const RunConfig& config);  ///< the same with the defaults of RunConfig

using Roles = std::initializer_list<RunOption::Role>;

/// Names of the columns of runs.csv that hold the configuration of a run, without the options of some roles; the varied
/// keys come last.
std::vector<std::string> config_columns(const std::vector<std::string>& varied_keys, const NamedOptions& named,
                                        Roles without = {});
/// The cells below config_columns().
std::vector<std::string> config_cells(const RunConfig& config, const NamedOptions& named, Roles without = {});
/// The cell of an option in those columns, "on" for a flag; empty if the option does not apply.
std::string config_cell(const RunOption& option, const RunConfig& config);
/// The option with this column; null if there is none, as for a varied key.
const RunOption* option_of_column(const std::string& column);

/// True if two configurations differ in their varied keys alone, if at all.
bool have_same_options(const RunConfig& a, const RunConfig& b);

/// config_cells() of run after run. The cells of the options are made anew where these differ from those of the run
/// before.
class ConfigCells {
 public:
  explicit ConfigCells(const NamedOptions& named) : named_(&named) {}  ///< `named` must outlive this object
  std::vector<std::string> of(const RunConfig& config);

 private:
  const NamedOptions* named_;
  std::optional<RunConfig> last_;
  std::vector<std::string> of_options_;  ///< the cells of last_ without those of its varied keys
};

/// The configuration as text, without the values of its varied keys, which stand between the two parts.
struct IdentityText {
  std::string before, after;
};
IdentityText identity_text(const RunConfig& config);
/// The configuration as text. It does not depend on the study that contains the run.
std::string identity_of(const RunConfig& config);

/// The values of a configuration by which runs are sorted. Keys are comparable if both runs vary the same keys.
std::vector<OptionValue> sort_key(const RunConfig& config);
/// Its two parts: the values of the options, and those of the varied keys, which come last.
std::vector<OptionValue> sort_key_of_options(const RunConfig& config);
std::vector<OptionValue> sort_key_of_varied(const std::vector<Override>& varied);
/// The name of the column in config_columns() of each value of a sort_key().
std::vector<std::string> sort_columns(const std::vector<std::string>& varied_keys);

}  // namespace polhode::study::record
