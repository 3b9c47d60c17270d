// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/trajectory/kept_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <string_view>
#include <vector>

#include "experiments/study/text/legible.hpp"
#include "experiments/study/trajectory/hdf5_file.hpp"

namespace polhode::study::inline trajectory {
namespace {

constexpr std::size_t longest_line = std::size_t{1} << 16;  // bytes

/// Goes to the end of a cell and past its comma.
std::string_view next_cell(std::string_view& line) {
  const auto end = std::min(line.find(','), line.size());
  const std::string_view cell = line.substr(0, end);
  line.remove_prefix(std::min(end + 1, line.size()));
  return cell;
}

class CsvRows final : public KeptTable {
 public:
  explicit CsvRows(const std::filesystem::path& path) : path_(path), file_(path, std::ios::binary) {
    if (!file_) {
      fault = path.string() + ": no such file, or it cannot be read";
    } else if (std::string_view names; read_line(names)) {
      while (!names.empty()) columns_.emplace_back(next_cell(names));
      if (columns_.empty() || columns_.front() != "t_s") fault = path.string() + ":1: its first column is not t_s";
      bytes = read_;
    } else {
      cut = true;
    }
  }

  bool next() override {
    std::string_view line;
    if (!fault.empty() || columns_.empty() || !read_line(line)) return false;
    std::size_t cells = 0;
    for (bool more = true; more; ++cells) {
      more = line.find(',') != std::string_view::npos;
      const std::string_view cell = next_cell(line);
      if (cells < columns_.size() && !read_cell(cells, cell)) {
        fault = fmt::format("{}:{}: {} is '{}', which is not a number", path_.string(), line_number_, columns_[cells],
                            legible(std::string(cell.substr(0, 40))));
        return false;
      }
    }
    if (cells != columns_.size()) {
      fault =
          fmt::format("{}:{}: {} cells under {} column names", path_.string(), line_number_, cells, columns_.size());
      return false;
    }
    ++rows;
    bytes = read_;
    return true;
  }

 private:
  /// The next line that has an end.
  bool read_line(std::string_view& line) {
    ++line_number_;
    line_.resize(longest_line);
    file_.getline(line_.data(), static_cast<std::streamsize>(line_.size()));
    const auto count = static_cast<std::size_t>(file_.gcount());
    if (file_.bad() || (file_.fail() && !file_.eof())) {
      fault = fmt::format("{}:{}: the line cannot be read, or is longer than {} bytes", path_.string(), line_number_,
                          longest_line);
      return false;
    }
    if (file_.eof()) {
      cut = count > 0;
      return false;
    }
    read_ += count;
    line = std::string_view(line_).substr(0, count - 1);
    return true;
  }

  bool read_cell(std::size_t column, std::string_view cell) {
    if (columns_[column] == "kind") return cell == "impact" || cell == "slide_end";
    double x = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), x);
    if (cell.empty() || error != std::errc() || end != cell.data() + cell.size()) return false;
    if (column == 0) t = x;
    if (column == 1) second = x;
    return column > 0 || std::isfinite(x);
  }

  std::filesystem::path path_;
  std::ifstream file_;
  std::string line_;
  std::vector<std::string> columns_;
  std::uint64_t read_ = 0, line_number_ = 0;
};

class Hdf5Rows final : public KeptTable {
 public:
  Hdf5Rows(hid_t file, const std::string& name, const std::filesystem::path& path)
      : table_(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose), where_(path.string() + ": table " + name) {
    if (!table_) {
      fault = where_ + ": it is not there, or cannot be read";
      return;
    }
    const Hdf5Handle space(H5Dget_space(table_), H5Sclose), type(H5Dget_type(table_), H5Tclose);
    hsize_t size[2] = {0, 0};
    const auto columns = hdf5_columns(table_);
    if (H5Sget_simple_extent_ndims(space) != 2 || H5Sget_simple_extent_dims(space, size, nullptr) < 0 ||
        H5Tget_class(type) != H5T_FLOAT || columns.size() < 2 || columns.size() != size[1] ||
        columns.front() != "t_s") {
      fault = where_ + ": it is no table of doubles whose attribute columns names them, t_s first";
      return;
    }
    count_ = size[0];
    width_ = size[1];
  }

  bool next() override {
    if (!fault.empty() || rows == count_ || !has_block()) return false;
    const double* row = block_.data() + (rows - first_) * width_;
    if (std::isnan(row[0])) return false;  // never written
    t = row[0];
    second = row[1];
    ++rows;
    return true;
  }

 private:
  /// Reads the block that holds the next row.
  bool has_block() {
    if (rows >= first_ && (rows - first_) * width_ < block_.size()) return true;
    first_ = rows;
    const hsize_t offset[2] = {first_, 0}, count[2] = {std::min(hdf5_chunk_rows, count_ - first_), width_};
    block_.resize(count[0] * count[1]);
    const Hdf5Handle in_file(H5Dget_space(table_), H5Sclose), in_memory(H5Screate_simple(2, count, nullptr), H5Sclose);
    if (H5Sselect_hyperslab(in_file, H5S_SELECT_SET, offset, nullptr, count, nullptr) >= 0 &&
        H5Dread(table_, H5T_NATIVE_DOUBLE, in_memory, in_file, H5P_DEFAULT, block_.data()) >= 0) {
      return true;
    }
    fault = fmt::format("{}: row {} and those after it cannot be read", where_, rows);
    return false;
  }

  Hdf5Handle table_;
  std::string where_;
  hsize_t count_ = 0, width_ = 1, first_ = 0;
  std::vector<double> block_;
};

}  // namespace

std::unique_ptr<KeptTable> kept_csv(const std::filesystem::path& path) { return std::make_unique<CsvRows>(path); }

std::unique_ptr<KeptTable> kept_hdf5(hid_t file, const std::string& name, const std::filesystem::path& path) {
  return std::make_unique<Hdf5Rows>(file, name, path);
}

}  // namespace polhode::study::trajectory
