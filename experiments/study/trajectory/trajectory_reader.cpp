// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/trajectory/trajectory_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>

#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/legible.hpp"
#include "experiments/study/text/suggestion.hpp"
#include "experiments/study/text/text_file.hpp"
#include "experiments/study/text/trimmed.hpp"
#include "experiments/study/trajectory/kept_trajectory.hpp"

namespace polhode::study::inline trajectory {
namespace {

/// The names of trajectory.csv in groups that are there as a whole or not at all.
struct ColumnGroup {
  const char* what;
  std::vector<std::string> columns;
};
const ColumnGroup time_group{"the time", {"t_s"}}, body_group{"the body", {"body"}},
    position_group{"the position", {"px_m", "py_m", "pz_m"}},
    quaternion_group{"the quaternion", {"qw", "qx", "qy", "qz"}},
    velocity_group{"the velocity", {"vx_m_per_s", "vy_m_per_s", "vz_m_per_s"}},
    omega_group{"the angular velocity", {"wx_rad_per_s", "wy_rad_per_s", "wz_rad_per_s"}},
    momentum_group{"the angular momentum", {"lx_kg_m2_per_s", "ly_kg_m2_per_s", "lz_kg_m2_per_s"}},
    energy_group{"the energy", {"energy_J"}},
    matrix_group{"the rotation matrix", {"r11", "r12", "r13", "r21", "r22", "r23", "r31", "r32", "r33"}};
const std::array groups = {&time_group,  &body_group,     &position_group, &quaternion_group, &velocity_group,
                           &omega_group, &momentum_group, &energy_group,   &matrix_group};

/// Tolerances of the first orientation: few digits and single precision pass, another convention does not. Later
/// orientations may be anywhere, since leaving the manifold is a finding.
constexpr double first_defect = 0.02, least_length = 1e-6;

struct CsvCell {
  std::string_view text;
  std::size_t column;  ///< column of its first character, from 1
};

constexpr std::string_view around_cells = " \t\r\"";

std::vector<CsvCell> cells_of(std::string_view line) {
  std::vector<CsvCell> cells;
  for (std::size_t at = 0;;) {
    const auto end = std::min(line.find(',', at), line.size());
    const std::string_view whole = line.substr(at, end - at), text = trimmed(whole, around_cells);
    cells.push_back({text, at + (text.empty() ? 0 : static_cast<std::size_t>(text.data() - whole.data())) + 1});
    if (end == line.size()) return cells;
    at = end + 1;
  }
}

std::string shown(std::string_view text) { return "'" + shortened(text) + "'"; }

class Parser {
 public:
  Parser(std::string_view text, const std::string& origin, const Problem& problem)
      : text_(text), origin_(origin), problem_(problem) {
    result_.moving = problem.moving();
  }

  Trajectory parse() {
    if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);
    std::string_view line;
    if (!next(line))
      throw InputError(origin_ + ": there is nothing in it; it needs a line of column names, then numbers");
    read_header(cells_of(line));
    while (next(line)) read_row(cells_of(line));
    finish_instant();
    if (result_.times.size() < 2) {
      throw InputError(fmt::format("{}: {} instant(s); it takes two at least", origin_, result_.times.size()));
    }
    return std::move(result_);
  }

 private:
  [[noreturn]] void fail(std::size_t column, const std::string& what) const {
    throw InputError(fmt::format("{}:{}:{}: {}", origin_, line_, column, what));
  }

  /// The next line that holds something.
  bool next(std::string_view& line) {
    while (!text_.empty()) {
      const auto end = std::min(text_.find('\n'), text_.size());
      line = text_.substr(0, end);
      text_.remove_prefix(std::min(end + 1, text_.size()));
      ++line_;
      const std::string_view content = trimmed(line, around_cells);
      if (!content.empty() && content.front() != '#') return true;
    }
    return false;
  }

  void read_header(const std::vector<CsvCell>& cells) {
    columns_ = cells.size();
    for (std::size_t k = 0; k < cells.size(); ++k) {
      const std::string name(cells[k].text);
      const bool known = std::any_of(groups.begin(), groups.end(), [&](const ColumnGroup* g) {
        return std::find(g->columns.begin(), g->columns.end(), name) != g->columns.end();
      });
      if (known && !places_.emplace(name, k).second) fail(cells[k].column, "the column " + name + " stands twice");
    }
    require(time_group, cells);
    result_.has_matrix = has(matrix_group);
    if (!result_.has_matrix) require(quaternion_group, cells);
    if (result_.moving > 1) require(body_group, cells);
    has_body_ = has(body_group);
    result_.has_position = has(position_group);
    result_.has_velocity = has(velocity_group);
    result_.has_angular_velocity = has(omega_group);
    result_.has_angular_momentum = has(momentum_group);
    result_.has_energy = has(energy_group);
  }

  bool has(const ColumnGroup& group) const {
    const auto there = static_cast<std::size_t>(
        std::count_if(group.columns.begin(), group.columns.end(), [&](const auto& c) { return places_.contains(c); }));
    if (there != 0 && there != group.columns.size()) {
      const auto missing =
          std::find_if(group.columns.begin(), group.columns.end(), [&](const auto& c) { return !places_.contains(c); });
      fail(1, fmt::format("{} lacks the column {}; give all of {}, or none", group.what, *missing,
                          fmt::join(group.columns, ", ")));
    }
    return there != 0;
  }

  void require(const ColumnGroup& group, const std::vector<CsvCell>& cells) const {
    if (has(group)) return;
    std::vector<std::string_view> given;
    for (const CsvCell& cell : cells) given.push_back(cell.text);
    const std::string& name = group.columns.front();
    std::string what = fmt::format("there is no column {}", name);
    if (group.columns.size() > 1) what += fmt::format(" (of {})", fmt::join(group.columns, ", "));
    if (&group == &quaternion_group) what += ", nor r11 … r33";
    if (const auto near = nearest(name, given); !near.empty()) what += fmt::format("; is it {}?", shown(near));
    fail(1, what + "; name it in the first line");
  }

  double number(const std::vector<CsvCell>& cells, const std::string& name) const {
    const CsvCell& cell = cells[places_.at(name)];
    std::string_view text = cell.text;
    if (text.starts_with('+')) text.remove_prefix(1);
    double x = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
    if (text.empty()) fail(cell.column, name + " is empty; give a number, or leave the whole column out");
    if (error == std::errc::result_out_of_range || end != text.data() + text.size() || error != std::errc()) {
      fail(cell.column, fmt::format("{} is {}, which is not a number", name, shown(cell.text)));
    }
    if (!std::isfinite(x)) {
      fail(cell.column, fmt::format("{} is {}; cut the file before the motion is lost", name, shown(cell.text)));
    }
    return x;
  }

  Vector3<double> vector(const std::vector<CsvCell>& cells, const ColumnGroup& group) const {
    return {number(cells, group.columns[0]), number(cells, group.columns[1]), number(cells, group.columns[2])};
  }

  std::size_t cell_column(const std::vector<CsvCell>& cells, const char* name) const {
    return cells[places_.at(name)].column;
  }

  void read_row(const std::vector<CsvCell>& cells) {
    if (cells.size() != columns_) {
      fail(cells.back().column,
           fmt::format("{} cells under {} column names; end the file after a whole row", cells.size(), columns_));
    }
    const double t = number(cells, "t_s");
    if (t < 0) fail(cell_column(cells, "t_s"), "t_s is negative; the scenario starts at 0");
    if (result_.times.empty() || t != result_.times.back()) {
      finish_instant();
      if (!result_.times.empty() && t < result_.times.back()) {
        fail(cell_column(cells, "t_s"), fmt::format("t_s goes back from {} to {}; sort the rows by time, and several "
                                                    "runs into a file each",
                                                    result_.times.back(), t));
      }
      result_.times.push_back(t);
      result_.bodies.resize(result_.bodies.size() + result_.moving);
      seen_.assign(result_.moving, false);
      if (result_.has_energy) result_.energy.push_back(number(cells, "energy_J"));
    }
    const std::size_t body = body_of(cells);
    if (seen_[body]) {
      const std::size_t column = cell_column(cells, has_body_ ? "body" : "t_s");
      fail(column, fmt::format("body {} stands twice at t_s = {}; one row for each instant and body", body, t));
    }
    seen_[body] = true;
    read_body(cells, result_.bodies[result_.bodies.size() - result_.moving + body]);
  }

  std::size_t body_of(const std::vector<CsvCell>& cells) const {
    if (!has_body_) return 0;
    const double x = number(cells, "body");
    if (!(x >= 0 && x < static_cast<double>(result_.moving)) || x != std::floor(x)) {
      fail(cell_column(cells, "body"),
           fmt::format("body is {}; the scenario's moving bodies are numbered 0 to {}", x, result_.moving - 1));
    }
    return static_cast<std::size_t>(x);
  }

  void read_body(const std::vector<CsvCell>& cells, BodySnapshot<double>& body) const {
    const bool first = result_.times.size() == 1;
    if (result_.has_matrix) {
      for (int k = 0; k < 9; ++k) body.rotation(k / 3, k % 3) = number(cells, matrix_group.columns[std::size_t(k)]);
      check_matrix(body.rotation, first, cell_column(cells, "r11"));
      body.orientation = quaternion_from_rotation_matrix(body.rotation);
    } else {
      for (int k = 0; k < 4; ++k) body.orientation[k] = number(cells, quaternion_group.columns[std::size_t(k)]);
      check_quaternion(body.orientation.norm(), first, cell_column(cells, "qw"));
      body.rotation = rotation_matrix(body.orientation);
    }
    if (result_.has_position) body.position = vector(cells, position_group);
    if (result_.has_velocity) body.velocity = vector(cells, velocity_group);
    if (result_.has_angular_velocity) body.angular_velocity = vector(cells, omega_group);
    if (result_.has_angular_momentum) body.angular_momentum = vector(cells, momentum_group);
  }

  void check_quaternion(double length, bool first, std::size_t column) const {
    if (first && !(std::abs(length - 1) <= first_defect)) {
      fail(column,
           fmt::format("a quaternion of length {:.6g} at the start; give unit quaternions, scalar first", length));
    }
    if (!(length >= least_length) || !std::isfinite(length)) {
      fail(column, fmt::format("a quaternion of length {:.3g} is no orientation; cut the file before", length));
    }
  }

  void check_matrix(const Matrix3<double>& r, bool first, std::size_t column) const {
    const double defect = (r.transpose() * r - Matrix3<double>::Identity()).norm(), determinant = r.determinant();
    if (first && !(defect <= first_defect && determinant > 0)) {
      fail(column,
           fmt::format("no rotation matrix at the start: |RᵀR − 1| = {:.3g}, det R = {:.3g}; r11 … r33 take body "
                       "to world, row by row",
                       defect, determinant));
    }
    if (!(std::abs(determinant) >= least_length) || !std::isfinite(determinant)) {
      fail(column, fmt::format("a matrix of determinant {:.3g} is no orientation; cut the file before", determinant));
    }
  }

  void finish_instant() const {
    const auto missing = std::find(seen_.begin(), seen_.end(), false);
    if (missing == seen_.end()) return;
    const auto body = static_cast<std::size_t>(missing - seen_.begin());
    fail(1, fmt::format("body {} ('{}') has no row at t_s = {}; give one for each moving body", body,
                        problem_.bodies[body].name, result_.times.back()));
  }

  std::string_view text_;
  std::string origin_;
  const Problem& problem_;
  std::size_t line_ = 0, columns_ = 0;
  std::map<std::string, std::size_t> places_;
  bool has_body_ = false;
  std::vector<bool> seen_;
  Trajectory result_;
};

/// Throws InputError if the file is HDF5, whatever its name is.
void refuse_hdf5(const std::string& path) {
  std::string start(8, '\0');
  std::ifstream(path, std::ios::binary).read(start.data(), static_cast<std::streamsize>(start.size()));
  if (start != "\x89HDF\r\n\x1a\n") return;
  const KeptTrajectory kept = kept_hdf5_file(path);
  if (kept.condition == KeptTrajectory::Condition::whole) {
    throw InputError(path + ": is a trajectory in HDF5, which is not read here; make it again with --trajectory csv");
  }
  throw InputError(fmt::format("{}: is a trajectory in HDF5, {}; {}", path, in_words(kept), remedy(kept)));
}

}  // namespace

Trajectory parse_trajectory(std::string_view text, const std::string& origin, const Problem& problem) {
  return Parser(text, origin, problem).parse();
}

Trajectory read_trajectory(const std::string& path, const Problem& problem) {
  refuse_hdf5(path);
  return parse_trajectory(read_text(path, 2048 * mebibyte), path, problem);
}

}  // namespace polhode::study::trajectory
