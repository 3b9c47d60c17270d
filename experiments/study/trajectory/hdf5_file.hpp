// SPDX-License-Identifier: BSD-3-Clause
// The layout of trajectory.h5 (README.md), common to what writes, reads and saves such files.
#pragma once

#include <hdf5.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace polhode::study::inline trajectory {

/// Owns an HDF5 identifier, which is invalid where HDF5 could not make it.
class Hdf5Handle {
 public:
  Hdf5Handle() = default;
  Hdf5Handle(hid_t id, herr_t (*close_it)(hid_t)) : id_(id), close_(close_it) {}
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Hdf5Handle() { close(); }

  explicit operator bool() const { return id_ >= 0; }
  operator hid_t() const { return id_; }

  /// False if HDF5 reports an error.
  bool close() { return id_ < 0 || close_(std::exchange(id_, H5I_INVALID_HID)) >= 0; }

 private:
  hid_t id_ = H5I_INVALID_HID;
  herr_t (*close_)(hid_t) = nullptr;
};

constexpr hsize_t hdf5_chunk_rows = 1000;
constexpr const char* hdf5_format =
    "polhode trajectory 2";  ///< attribute `format` of the file; 2: the layout's version

/// An empty file, in the format that appending in SWMR mode needs. It has no dates: the same run gives the same bytes.
Hdf5Handle create_hdf5(const std::filesystem::path& path);

/// A table of doubles without rows. Space for the rows is taken by chunks; rows that are not written are NaN.
Hdf5Handle create_hdf5_table(hid_t file, const char* name, const std::vector<std::string>& columns);

/// False if HDF5 reports an error.
bool set_attribute(hid_t object, const char* name, const std::string& text);
bool set_attribute(hid_t object, const char* name, double number);

/// Adds rows at the end of a table: `values` holds them one after another. False if HDF5 reports an error.
bool append_rows(hid_t table, hsize_t rows_before, hsize_t columns, const std::vector<double>& values);

/// An existing file, for reading; invalid if it cannot be opened. `swmr`: also one that its writer did not close.
Hdf5Handle open_hdf5(const std::filesystem::path& path, bool swmr);

/// The attribute `columns` of a table; empty if there is none that can be read.
std::vector<std::string> hdf5_columns(hid_t table);

/// An attribute with a text; empty if there is none that can be read.
std::string text_attribute(hid_t object, const char* name);

}  // namespace polhode::study::trajectory
