// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/trajectory/hdf5_file.hpp"

#include <algorithm>
#include <limits>

namespace polhode::study::inline trajectory {
namespace {

void be_silent() {
  // HDF5 would otherwise write again at exit, and crash on a full disk.
  [[maybe_unused]] static const herr_t at_exit = H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // our own message is one line
}

/// Texts of one length, padded with zeros: HDF5 allows no others in SWMR mode.
Hdf5Handle text_type(std::size_t length) {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, std::max<std::size_t>(length, 1));
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  return type;
}

bool write_attribute(hid_t object, const char* name, hid_t type, hid_t space, const void* value) {
  const Hdf5Handle attribute(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  return attribute && H5Awrite(attribute, type, value) >= 0;
}

bool name_columns(hid_t table, const std::vector<std::string>& columns) {
  std::size_t length = 0;
  for (const std::string& c : columns) length = std::max(length, c.size());
  std::string names;
  for (const std::string& c : columns) names += c + std::string(length - c.size(), '\0');
  const hsize_t count = columns.size();
  const Hdf5Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose);
  return write_attribute(table, "columns", text_type(length), space, names.data());
}

/// The texts of an attribute; none if they cannot be read.
std::vector<std::string> texts_of(hid_t object, const char* name) {
  const Hdf5Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  if (!attribute) return {};
  const Hdf5Handle type(H5Aget_type(attribute), H5Tclose), space(H5Aget_space(attribute), H5Sclose);
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0 || count <= 0) return {};
  const std::size_t length = H5Tget_size(type);
  std::string bytes(length * static_cast<std::size_t>(count), '\0');
  if (H5Aread(attribute, type, bytes.data()) < 0) return {};
  std::vector<std::string> texts;
  for (std::size_t at = 0; at < bytes.size(); at += length) {
    texts.push_back(bytes.substr(at, std::min(bytes.find('\0', at), at + length) - at));
  }
  return texts;
}

}  // namespace

Hdf5Handle create_hdf5(const std::filesystem::path& path) {
  be_silent();
  const Hdf5Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose), access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_obj_track_times(creation, false);
  H5Pset_libver_bounds(access, H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
  H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
  return {H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, access), H5Fclose};
}

Hdf5Handle create_hdf5_table(hid_t file, const char* name, const std::vector<std::string>& columns) {
  const hsize_t width = columns.size(), start[2] = {0, width}, most[2] = {H5S_UNLIMITED, width},
                chunk[2] = {hdf5_chunk_rows, width};
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  const Hdf5Handle space(H5Screate_simple(2, start, most), H5Sclose), creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_chunk(creation, 2, chunk);
  H5Pset_obj_track_times(creation, false);
  H5Pset_fill_value(creation, H5T_NATIVE_DOUBLE, &nothing);
  // A chunk gets its place with its first row, whenever that is flushed: the bytes do not depend on when blocks end.
  H5Pset_alloc_time(creation, H5D_ALLOC_TIME_EARLY);
  H5Pset_fill_time(creation, H5D_FILL_TIME_ALLOC);
  Hdf5Handle table(H5Dcreate2(file, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose);
  if (table && !name_columns(table, columns)) table.close();
  return table;
}

bool set_attribute(hid_t object, const char* name, const std::string& text) {
  return write_attribute(object, name, text_type(text.size()), Hdf5Handle(H5Screate(H5S_SCALAR), H5Sclose),
                         text.data());
}

bool set_attribute(hid_t object, const char* name, double number) {
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Handle attribute(H5Acreate2(object, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  return attribute && H5Awrite(attribute, H5T_NATIVE_DOUBLE, &number) >= 0;
}

bool append_rows(hid_t table, hsize_t rows_before, hsize_t columns, const std::vector<double>& values) {
  const hsize_t more = values.size() / columns;
  const hsize_t size[2] = {rows_before + more, columns}, offset[2] = {rows_before, 0}, count[2] = {more, columns};
  if (H5Dset_extent(table, size) < 0) return false;
  const Hdf5Handle in_file(H5Dget_space(table), H5Sclose), in_memory(H5Screate_simple(2, count, nullptr), H5Sclose);
  return H5Sselect_hyperslab(in_file, H5S_SELECT_SET, offset, nullptr, count, nullptr) >= 0 &&
         H5Dwrite(table, H5T_NATIVE_DOUBLE, in_memory, in_file, H5P_DEFAULT, values.data()) >= 0;
}

Hdf5Handle open_hdf5(const std::filesystem::path& path, bool swmr) {
  be_silent();
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_libver_bounds(access, H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
  H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
  // While a writer is at work, HDF5 reads again what does not fit its checksum, and waits twice as long each time: 1 ms
  // in all. Of its own it waits for ages where a file is damaged.
  constexpr unsigned attempts = 20;
  H5Pset_metadata_read_attempts(access, swmr ? attempts : 1);
  return {H5Fopen(path.c_str(), H5F_ACC_RDONLY | (swmr ? H5F_ACC_SWMR_READ : 0U), access), H5Fclose};
}

std::vector<std::string> hdf5_columns(hid_t table) { return texts_of(table, "columns"); }

std::string text_attribute(hid_t object, const char* name) {
  const auto texts = texts_of(object, name);
  return texts.empty() ? std::string() : texts.front();
}

}  // namespace polhode::study::trajectory
