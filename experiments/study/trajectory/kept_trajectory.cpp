// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/trajectory/kept_trajectory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <memory>

#include "experiments/study/trajectory/hdf5_file.hpp"
#include "experiments/study/trajectory/kept_table.hpp"

namespace polhode::study::inline trajectory {
namespace {

namespace fs = std::filesystem;
using Condition = KeptTrajectory::Condition;

struct OpenTable {
  std::string name;
  fs::path file;
  std::unique_ptr<KeptTable> rows;
};

/// The instants that the trajectory and the energy have in common, from the start. A row of the energy follows the rows
/// of all bodies at its instant. `events`: any number of tables of them.
class Instants {
 public:
  Instants(KeptTrajectory& kept, OpenTable trajectory, OpenTable energy, std::vector<OpenTable> events)
      : kept_(kept), trajectory_(std::move(trajectory)), energy_(std::move(energy)), events_(std::move(events)) {}

  void read() {
    trajectory_kept_ = {trajectory_.name, trajectory_.file, 0, 0};
    energy_kept_ = {energy_.name, energy_.file, 0, 0};
    motion_ = trajectory_.rows->next();
    while (energy_.rows->next() && read_instant()) {
      interval_ = kept_.instants++ > 0 ? energy_.rows->t - kept_.t_last : 0;
      kept_.t_last = energy_.rows->t;
      trajectory_kept_ = {trajectory_.name, trajectory_.file, before_.rows, before_.bytes};
      energy_kept_ = {energy_.name, energy_.file, energy_.rows->rows, energy_.rows->bytes};
    }
    const bool same_end = !motion_ && energy_.rows->rows == energy_kept_.rows;
    kept_.tables = {trajectory_kept_, energy_kept_};
    bool cut = trajectory_.rows->cut || energy_.rows->cut;
    for (OpenTable& table : events_) {
      KeptTrajectory::Table part{table.name, table.file, 0, table.rows->bytes};
      while (table.rows->next() && table.rows->t <= latest_event())
        part = {table.name, table.file, table.rows->rows, table.rows->bytes};
      same_end_ = same_end_ && part.rows == table.rows->rows;
      cut = cut || table.rows->cut;
      kept_.tables.push_back(part);
      note(table.rows->fault);
    }
    note(trajectory_.rows->fault);
    note(energy_.rows->fault);
    same_end_ = same_end_ && same_end && !cut;
  }

  /// All tables end with the last instant.
  bool same_end() const { return same_end_; }

 private:
  struct Place {
    std::uint64_t rows = 0, bytes = 0;
  };

  /// Reads the rows of all bodies at the instant of the energy; false if some are missing.
  bool read_instant() {
    std::uint64_t bodies = 0;
    for (; motion_ && trajectory_.rows->t == energy_.rows->t && trajectory_.rows->second == double(bodies); ++bodies) {
      before_ = {trajectory_.rows->rows, trajectory_.rows->bytes};
      motion_ = trajectory_.rows->next();
    }
    if (bodies_ == 0) bodies_ = bodies;
    return bodies == bodies_ && bodies > 0;
  }

  /// Latest time of an event until the last instant. The end of a step is t + h where contacts are followed, and
  /// t0 + k h, or the end of the run, in the tables: an event may come later than its instant by a rounding.
  double latest_event() const {
    return kept_.t_last + 1e-6 * interval_ + 4 * std::numeric_limits<double>::epsilon() * std::abs(kept_.t_last);
  }

  void note(const std::string& fault) {
    if (kept_.fault.empty()) kept_.fault = fault;
  }

  KeptTrajectory& kept_;
  OpenTable trajectory_, energy_;
  std::vector<OpenTable> events_;
  bool motion_ = false, same_end_ = true;  // motion_: there is a present row of the trajectory
  std::uint64_t bodies_ = 0;
  double interval_ = 0;  // from the last instant but one to the last, s
  Place before_;
  KeptTrajectory::Table trajectory_kept_, energy_kept_;
};

/// Sets the condition. `finished`: all files were closed and have their names.
void judge_condition(KeptTrajectory& kept, bool finished, bool same_end) {
  if (kept.fault.empty() && finished && !same_end) {
    kept.fault = kept.tables.front().file.string() + ": its tables do not end with the same whole instant";
  }
  kept.condition = !kept.fault.empty() ? Condition::damaged : finished ? Condition::whole : Condition::unfinished;
}

KeptTrajectory kept_csv_files(const fs::path& folder) {
  KeptTrajectory kept{.format = TrajectoryFormat::csv, .folder = folder};
  bool finished = true;
  const auto open = [&](const char* name) -> OpenTable {
    fs::path file = folder / name;
    if (!fs::exists(file) && fs::exists(unfinished(file))) {
      file = unfinished(file);
      finished = false;
    }
    return {name, file, kept_csv(file)};
  };
  std::vector<OpenTable> events;
  events.push_back(open("events.csv"));
  const fs::path reactions = folder / reactions_file;
  if (fs::exists(reactions) || fs::exists(unfinished(reactions))) events.push_back(open(reactions_file));
  Instants all(kept, open("trajectory.csv"), open("energy.csv"), std::move(events));
  all.read();
  judge_condition(kept, finished, all.same_end());
  return kept;
}

/// The part of a file's name before its format: "trajectory" of "trajectory.h5".
fs::path recovered(const fs::path& folder, const std::string& name) {
  const fs::path path(name);
  return folder / (path.stem().string() + ".recovered" + path.extension().string());
}

/// Gives a file written as `path`.new its name.
void give_name(const fs::path& path) {
  const fs::path made = path.string() + ".new";
  sync_to_disk(made, path);
  if (std::rename(made.c_str(), path.c_str()) != 0) cannot_write(path, errno);
}

void recover_csv(const KeptTrajectory& kept, const KeptTrajectory::Table& table) {
  const fs::path path = recovered(kept.folder, table.name);
  std::ifstream from(table.file, std::ios::binary);
  errno = 0;
  std::ofstream to(path.string() + ".new", std::ios::binary);
  to << fmt::format("# ends early: recovered from {}; what follows t_s = {} is lost\n", table.file.filename().string(),
                    kept.t_last);
  std::vector<char> part(std::size_t{1} << 16);
  for (std::uint64_t left = table.bytes; left > 0 && from && to;) {
    from.read(part.data(), static_cast<std::streamsize>(std::min<std::uint64_t>(left, part.size())));
    to.write(part.data(), from.gcount());
    left -= static_cast<std::uint64_t>(from.gcount());
  }
  to.close();
  if (!from) throw TrajectoryError("cannot read " + table.file.string());
  if (!to) cannot_write(path, errno);
  give_name(path);
}

/// Copies the first rows of a table; false if HDF5 reports an error.
bool copy_rows(hid_t from, hid_t to, std::uint64_t rows, hsize_t columns) {
  std::vector<double> values;
  for (hsize_t at = 0; at < rows; at += hdf5_chunk_rows) {
    const hsize_t offset[2] = {at, 0}, count[2] = {std::min<hsize_t>(hdf5_chunk_rows, rows - at), columns};
    values.resize(count[0] * columns);
    const Hdf5Handle in_file(H5Dget_space(from), H5Sclose), in_memory(H5Screate_simple(2, count, nullptr), H5Sclose);
    if (H5Sselect_hyperslab(in_file, H5S_SELECT_SET, offset, nullptr, count, nullptr) < 0 ||
        H5Dread(from, H5T_NATIVE_DOUBLE, in_memory, in_file, H5P_DEFAULT, values.data()) < 0 ||
        !append_rows(to, at, columns, values)) {
      return false;
    }
  }
  return true;
}

void recover_hdf5(const KeptTrajectory& kept) {
  const fs::path& source = kept.tables.front().file;
  const fs::path path = recovered(kept.folder, "trajectory.h5");
  Hdf5Handle from = open_hdf5(source, false);
  if (!from) from = open_hdf5(source, true);
  if (!from) throw TrajectoryError("cannot read " + source.string());
  errno = 0;
  Hdf5Handle to = create_hdf5(path.string() + ".new");
  bool good =
      to && set_attribute(to, "format", hdf5_format) &&
      set_attribute(to, "ends_early",
                    "recovered from " + source.filename().string() + "; what follows recovered_until_s is lost") &&
      set_attribute(to, "recovered_until_s", kept.t_last);
  for (const KeptTrajectory::Table& table : kept.tables) {
    const Hdf5Handle rows(H5Dopen2(from, table.name.c_str(), H5P_DEFAULT), H5Dclose);
    if (!rows) continue;  // it is the damage
    const auto columns = hdf5_columns(rows);
    const Hdf5Handle copy = good ? create_hdf5_table(to, table.name.c_str(), columns) : Hdf5Handle();
    good = copy && copy_rows(rows, copy, table.rows, columns.size());
  }
  good = to.close() && good;
  if (!good) cannot_write(path, errno);
  give_name(path);
}

}  // namespace

KeptTrajectory kept_hdf5_file(const fs::path& path) {
  KeptTrajectory kept{.format = TrajectoryFormat::hdf5, .folder = path.parent_path()};
  Hdf5Handle file = open_hdf5(path, false);
  const bool finished = file && path.extension() != ".unfinished";
  if (!file) file = open_hdf5(path, true);
  kept.tables = {{.name = "trajectory", .file = path}};
  if (!file) {
    kept.condition = path.extension() == ".unfinished" ? Condition::unfinished : Condition::damaged;
    if (kept.condition == Condition::damaged) kept.fault = path.string() + ": it cannot be opened as HDF5";
    return kept;
  }
  if (text_attribute(file, "format") != hdf5_format) {
    kept.condition = Condition::damaged;
    kept.fault = fmt::format("its attribute format is not '{}', so another version or program made it", hdf5_format);
    return kept;
  }
  const auto open = [&](const char* name) -> OpenTable { return {name, path, kept_hdf5(file, name, path)}; };
  std::vector<OpenTable> events;
  for (const char* name : {"impacts", "slide_ends"}) events.push_back(open(name));
  if (H5Lexists(file, "reactions", H5P_DEFAULT) > 0) events.push_back(open("reactions"));
  Instants all(kept, open("trajectory"), open("energy"), std::move(events));
  all.read();
  judge_condition(kept, finished, all.same_end());
  return kept;
}

std::optional<KeptTrajectory> kept_trajectory(const fs::path& folder, TrajectoryFormat format) {
  const auto& names = trajectory_files(format);
  const auto there = [&](const std::string& name) {
    return fs::exists(folder / name) || fs::exists(unfinished(folder / name));
  };
  if (std::none_of(names.begin(), names.end(), there)) return std::nullopt;
  if (format == TrajectoryFormat::csv) return kept_csv_files(folder);
  const fs::path path = folder / names.back();
  return kept_hdf5_file(fs::exists(path) ? path : unfinished(path));
}

std::string in_words(const KeptTrajectory& kept) {
  const std::string state = kept.condition == Condition::whole        ? "whole"
                            : kept.condition == Condition::unfinished ? "unfinished"
                                                                      : "damaged";
  const std::string extent = kept.instants == 0 ? "no instant"
                                                : fmt::format("{} instant{} until t = {} s", kept.instants,
                                                              kept.instants == 1 ? "" : "s", kept.t_last);
  return state + ", " + extent + (kept.fault.empty() ? "" : "; " + kept.fault);
}

std::string remedy(const KeptTrajectory& kept) {
  const bool damaged = kept.condition == Condition::damaged;
  return fmt::format("{}the command of the study makes it whole; {}./run archive repair {} saves what there is of it",
                     damaged ? "once the file is removed, " : "", damaged ? "before that, " : "",
                     kept.folder.empty() ? "." : kept.folder.string());
}

fs::path recover(const KeptTrajectory& kept) {
  if (kept.format == TrajectoryFormat::hdf5) {
    recover_hdf5(kept);
  } else {
    for (const KeptTrajectory::Table& table : kept.tables) {
      if (table.bytes > 0) recover_csv(kept, table);
    }
  }
  sync_to_disk(kept.folder.empty() ? "." : kept.folder, kept.folder);
  return recovered(kept.folder, trajectory_files(kept.format).back());
}

}  // namespace polhode::study::trajectory
