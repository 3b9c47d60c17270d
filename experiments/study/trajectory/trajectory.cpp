// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/trajectory/trajectory.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>
#include <hdf5.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <utility>

#include "experiments/study/trajectory/trajectory_rows.hpp"

namespace polhode::study::inline trajectory {
namespace {

constexpr std::size_t rows_between_flushes = 1000;

/// A file has its own name when it is whole, so that one cut off by a kill is not taken for it.
std::filesystem::path unfinished(const std::filesystem::path& path) { return path.string() + ".unfinished"; }

/// `reason`: what errno says; 0: nothing.
[[noreturn]] void cannot_write(const std::filesystem::path& path, int reason) {
  throw TrajectoryError("cannot write " + path.string() +
                        (reason != 0 ? std::string(": ") + std::strerror(reason) : ""));
}

void give_own_name(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::rename(unfinished(path), path, error);
  if (error) cannot_write(path, error.value());
}

/// A table of doubles written row by row; whole numbers in column `integer` are written without a point.
class CsvTable {
 public:
  CsvTable(std::filesystem::path path, const std::vector<std::string>& columns)
      : path_(std::move(path)), file_(std::fopen(unfinished(path_).c_str(), "w")) {
    if (!file_) fail();
    write(fmt::format("{}\n", fmt::join(columns, ",")));
  }
  CsvTable(const CsvTable&) = delete;
  CsvTable& operator=(const CsvTable&) = delete;
  ~CsvTable() {
    if (file_) std::fclose(file_);
  }

  /// `word`: a text that stands in the second column, between the numbers.
  void add(const std::vector<double>& row, std::string_view word = {}) {
    line_.clear();
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i > 0) line_.push_back(',');
      if (i == 1 && !word.empty()) fmt::format_to(std::back_inserter(line_), "{},", word);
      fmt::format_to(std::back_inserter(line_), FMT_COMPILE("{}"), row[i]);
    }
    line_.push_back('\n');
    write({line_.data(), line_.size()});
    if (++rows_ % rows_between_flushes == 0 && std::fflush(file_) != 0) fail();
  }

  void close() {
    std::FILE* file = std::exchange(file_, nullptr);
    if (file && std::fclose(file) != 0) fail();
    give_own_name(path_);
  }

 private:
  void write(std::string_view text) {
    if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) fail();
  }
  [[noreturn]] void fail() const { cannot_write(path_, errno); }

  std::filesystem::path path_;
  std::FILE* file_;
  fmt::memory_buffer line_;
  std::size_t rows_ = 0;
};

/// The HDF5 file handle, closed last.
class Hdf5File {
 public:
  explicit Hdf5File(const std::filesystem::path& path) : path_(path) {
    // HDF5 would otherwise write again at exit, and crash on a full disk.
    [[maybe_unused]] static const herr_t at_exit = H5dont_atexit();
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // our own message is one line
    const hid_t creation = H5Pcreate(H5P_FILE_CREATE);
    H5Pset_obj_track_times(creation, false);  // no dates: the same run gives the same bytes
    errno = 0;
    id = H5Fcreate(unfinished(path).c_str(), H5F_ACC_TRUNC, creation, H5P_DEFAULT);
    H5Pclose(creation);
    if (id < 0) fail();
  }
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;
  ~Hdf5File() { H5Fclose(id); }
  void finish() const {
    errno = 0;
    if (H5Fflush(id, H5F_SCOPE_GLOBAL) < 0) fail();
    give_own_name(path_);
  }
  [[noreturn]] void fail() const { cannot_write(path_, errno); }
  hid_t id;

 private:
  std::filesystem::path path_;
};

/// The same as a two-dimensional dataset that grows, flushed so that the file is readable after a kill.
class Hdf5Table {
 public:
  Hdf5Table(const Hdf5File& file, const char* name, const std::vector<std::string>& columns)
      : file_(file), width_(columns.size()) {
    errno = 0;
    const hsize_t start[2] = {0, width_}, most[2] = {H5S_UNLIMITED, width_}, chunk[2] = {rows_between_flushes, width_};
    const hid_t space = H5Screate_simple(2, start, most);
    const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_chunk(properties, 2, chunk);
    H5Pset_obj_track_times(properties, false);
    set_ = H5Dcreate2(file.id, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, properties, H5P_DEFAULT);
    H5Pclose(properties);
    H5Sclose(space);
    if (set_ < 0) file_.fail();
    name_columns(columns);
  }
  Hdf5Table(const Hdf5Table&) = delete;
  Hdf5Table& operator=(const Hdf5Table&) = delete;
  ~Hdf5Table() { H5Dclose(set_); }

  void add(const std::vector<double>& row) {
    pending_.insert(pending_.end(), row.begin(), row.end());
    if (pending_.size() >= rows_between_flushes * width_) flush();
  }

  void flush() {
    if (pending_.empty()) return;
    const hsize_t more = pending_.size() / width_;
    const hsize_t size[2] = {rows_ + more, width_}, offset[2] = {rows_, 0}, count[2] = {more, width_};
    errno = 0;
    bool good = H5Dset_extent(set_, size) >= 0;
    const hid_t in_file = H5Dget_space(set_), in_memory = H5Screate_simple(2, count, nullptr);
    good = good && H5Sselect_hyperslab(in_file, H5S_SELECT_SET, offset, nullptr, count, nullptr) >= 0 &&
           H5Dwrite(set_, H5T_NATIVE_DOUBLE, in_memory, in_file, H5P_DEFAULT, pending_.data()) >= 0 &&
           H5Fflush(file_.id, H5F_SCOPE_LOCAL) >= 0;
    H5Sclose(in_memory);
    H5Sclose(in_file);
    if (!good) file_.fail();
    rows_ += more;
    pending_.clear();
  }

 private:
  /// The attribute `columns`: an array of strings.
  void name_columns(const std::vector<std::string>& columns) {
    const hsize_t count = columns.size();
    const hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate_simple(1, &count, nullptr);
    H5Tset_size(type, H5T_VARIABLE);
    std::vector<const char*> names;
    for (const std::string& c : columns) names.push_back(c.c_str());
    const hid_t attribute = H5Acreate2(set_, "columns", type, space, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(attribute, type, names.data());
    H5Aclose(attribute);
    H5Sclose(space);
    H5Tclose(type);
  }

  const Hdf5File& file_;
  hid_t set_ = -1;
  hsize_t width_, rows_ = 0;
  std::vector<double> pending_;
};

/// `kind`: the column of words, which only a table of text has.
std::vector<std::string> event_columns(bool kind) {
  std::vector<std::string> names = {"t_s"};
  if (kind) names.emplace_back("kind");
  for (const char* n : {"body_a", "body_b", "px_m", "py_m", "pz_m", "nx", "ny", "nz", "impulse_N_s", "energy_lost_J"}) {
    names.emplace_back(n);
  }
  return names;
}

std::vector<double> event_row(const Impact& i) {
  return {i.t,
          static_cast<double>(i.a),
          static_cast<double>(i.b),
          i.point[0],
          i.point[1],
          i.point[2],
          i.normal[0],
          i.normal[1],
          i.normal[2],
          i.impulse.norm(),
          i.energy_lost};
}

/// In the same columns.
std::vector<double> event_row(const Transition& t) {
  return event_row(Impact{.t = t.t, .a = t.a, .b = t.b, .point = t.point, .normal = t.normal});
}

/// The part common to both formats: the rows of a sample. Tables has trajectory(row), energy(row), impact(row),
/// slide_end(row), close().
template <class Tables>
class Writer final : public TrajectoryWriter {
 public:
  Writer(const std::filesystem::path& folder, const System<double>& system)
      : system_(system), tables_(folder, trajectory_columns(system)) {}

  void on_impacts(std::span<const Impact> impacts) override {
    for (const Impact& impact : impacts) tables_.impact(event_row(impact));
  }
  void on_slides_end(std::span<const Transition> transitions) override {
    for (const Transition& transition : transitions) tables_.slide_end(event_row(transition));
  }
  void on_contact_energy(const ContactLosses& losses) override { contact_ = losses; }
  double next_state() const override { return 0; }

  void on_start(const State<double>& state, const Sample& sample) override {
    energy_start_ = sample.ledger(contact_.total());
    on_state(state, sample);
  }
  void on_state(const State<double>& state, const Sample& sample) override {
    for (std::size_t i = 0; i < system_.moving(); ++i) {
      tables_.trajectory(trajectory_row(system_, state, i, sample.seen.energy()));
    }
    tables_.energy(energy_row(sample, contact_, energy_start_));
  }

  void close() override { tables_.close(); }

 private:
  const System<double>& system_;
  Tables tables_;
  ContactLosses contact_;
  double energy_start_ = 0;
};

class CsvTables {
 public:
  CsvTables(const std::filesystem::path& folder, const std::vector<std::string>& columns)
      : trajectory_(folder / "trajectory.csv", columns),
        energy_(folder / "energy.csv", energy_columns()),
        events_(folder / "events.csv", event_columns(true)) {}
  void trajectory(const std::vector<double>& row) { trajectory_.add(row); }
  void energy(const std::vector<double>& row) { energy_.add(row); }
  void impact(const std::vector<double>& row) { events_.add(row, "impact"); }
  void slide_end(const std::vector<double>& row) { events_.add(row, "slide_end"); }
  void close() {
    trajectory_.close();
    energy_.close();
    events_.close();
  }

 private:
  CsvTable trajectory_, energy_, events_;
};

class Hdf5Tables {
 public:
  Hdf5Tables(const std::filesystem::path& folder, const std::vector<std::string>& columns)
      : file_(folder / "trajectory.h5"),
        trajectory_(file_, "trajectory", columns),
        energy_(file_, "energy", energy_columns()),
        impacts_(file_, "impacts", event_columns(false)),
        slide_ends_(file_, "slide_ends", event_columns(false)) {}
  void trajectory(const std::vector<double>& row) { trajectory_.add(row); }
  void energy(const std::vector<double>& row) { energy_.add(row); }
  void impact(const std::vector<double>& row) { impacts_.add(row); }
  void slide_end(const std::vector<double>& row) { slide_ends_.add(row); }
  void close() {
    trajectory_.flush();
    energy_.flush();
    impacts_.flush();
    slide_ends_.flush();
    file_.finish();
  }

 private:
  Hdf5File file_;
  Hdf5Table trajectory_, energy_, impacts_, slide_ends_;
};

}  // namespace

std::unique_ptr<TrajectoryWriter> open_trajectory(TrajectoryFormat format, const std::filesystem::path& folder,
                                                  const System<double>& system) {
  if (format == TrajectoryFormat::none) return nullptr;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw TrajectoryError("cannot create the folder " + folder.string() + ": " + error.message());
  if (format == TrajectoryFormat::hdf5) return std::make_unique<Writer<Hdf5Tables>>(folder, system);
  return std::make_unique<Writer<CsvTables>>(folder, system);
}

}  // namespace polhode::study::trajectory
