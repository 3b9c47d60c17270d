// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/trajectory/csv_tables.hpp"

#include <fmt/compile.h>

#include <cerrno>
#include <iterator>
#include <utility>

#include "experiments/study/trajectory/trajectory_files.hpp"
#include "experiments/study/trajectory/trajectory_rows.hpp"

namespace polhode::study::inline trajectory {

CsvTable::CsvTable(std::filesystem::path path, const std::vector<std::string>& columns)
    : path_(std::move(path)), file_(std::fopen(unfinished(path_).c_str(), "w")) {
  if (!file_) fail();
  write(fmt::format("{}\n", fmt::join(columns, ",")));
}

CsvTable::~CsvTable() {
  if (file_) std::fclose(file_);
}

void CsvTable::add(const std::vector<double>& row, std::string_view word) {
  line_.clear();
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (i > 0) line_.push_back(',');
    if (i == 1 && !word.empty()) fmt::format_to(std::back_inserter(line_), "{},", word);
    fmt::format_to(std::back_inserter(line_), FMT_COMPILE("{}"), row[i]);
  }
  line_.push_back('\n');
  write({line_.data(), line_.size()});
}

void CsvTable::flush() {
  if (std::fflush(file_) != 0) fail();
}

void CsvTable::close() {
  if (std::fclose(std::exchange(file_, nullptr)) != 0) fail();
}

void CsvTable::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) fail();
}

void CsvTable::fail() const { cannot_write(path_, errno); }

CsvTables::CsvTables(const std::filesystem::path& folder, const System<double>& system)
    : trajectory_(folder / "trajectory.csv", trajectory_columns(system)),
      energy_(folder / "energy.csv", energy_columns(system)),
      events_(folder / "events.csv", event_columns(true)) {
  if (system.has_joints()) reactions_.emplace(folder / "reactions.csv", reaction_columns());
}

std::vector<CsvTable*> CsvTables::tables() {
  std::vector<CsvTable*> all = {&trajectory_, &energy_, &events_};
  if (reactions_) all.push_back(&*reactions_);
  return all;
}

void CsvTables::flush() {
  for (CsvTable* table : tables()) table->flush();
}

void CsvTables::close() {
  for (CsvTable* table : tables()) table->close();
}

}  // namespace polhode::study::trajectory
