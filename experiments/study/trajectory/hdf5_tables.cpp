// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/trajectory/hdf5_tables.hpp"

#include <cerrno>

#include "experiments/study/trajectory/trajectory_files.hpp"
#include "experiments/study/trajectory/trajectory_rows.hpp"

namespace polhode::study::inline trajectory {

bool Hdf5Table::add(const std::vector<double>& row) {
  pending_.insert(pending_.end(), row.begin(), row.end());
  // The first row of a chunk takes the place for all of it.
  const hsize_t in_chunk = (rows_ + pending_.size() / width_) % hdf5_chunk_rows;
  return in_chunk > 1 || write();
}

bool Hdf5Table::write() {
  if (pending_.empty()) return true;
  if (!append_rows(set_, rows_, width_, pending_)) return false;
  rows_ += pending_.size() / width_;
  pending_.clear();
  return true;
}

Hdf5Tables::Hdf5Tables(const std::filesystem::path& folder, const System<double>& system)
    : path_(folder / "trajectory.h5"),
      file_((errno = 0, create_hdf5(unfinished(path_)))),
      trajectory_(file_, "trajectory", trajectory_columns(system)),
      energy_(file_, "energy", energy_columns(system)),
      impacts_(file_, "impacts", event_columns(false)),
      slide_ends_(file_, "slide_ends", event_columns(false)) {
  if (system.has_joints()) reactions_.emplace(file_, "reactions", reaction_columns());
  const bool good = file_ && trajectory_ && energy_ && impacts_ && slide_ends_ && (!reactions_ || *reactions_) &&
                    set_attribute(file_, "format", hdf5_format) && H5Fstart_swmr_write(file_) >= 0;
  if (!good) fail();
}

std::vector<Hdf5Table*> Hdf5Tables::tables() {
  std::vector<Hdf5Table*> all = {&trajectory_, &energy_, &impacts_, &slide_ends_};
  if (reactions_) all.push_back(&*reactions_);
  return all;
}

void Hdf5Tables::flush() {
  errno = 0;
  for (Hdf5Table* table : tables()) {
    if (!table->write()) fail();
  }
  if (H5Fflush(file_, H5F_SCOPE_LOCAL) < 0) fail();
}

void Hdf5Tables::close() {
  flush();
  errno = 0;
  bool good = true;
  for (Hdf5Table* table : tables()) good = table->close() && good;
  good = file_.close() && good;
  if (!good) fail();
}

void Hdf5Tables::add(Hdf5Table& table, const std::vector<double>& row) {
  errno = 0;
  if (!table.add(row)) fail();
}

void Hdf5Tables::fail() const { cannot_write(path_, errno); }

}  // namespace polhode::study::trajectory
