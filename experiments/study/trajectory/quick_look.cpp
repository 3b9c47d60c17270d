// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/trajectory/quick_look.hpp"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string>

#include "experiments/study/trajectory/hdf5_file.hpp"

namespace polhode::study::inline trajectory {
namespace {

namespace fs = std::filesystem;

constexpr std::streamoff longest_end = 4096;  // bytes; a row has at most 28 numbers

/// The first cell of the last line; none if that has no end, or there is no line.
std::optional<std::string> last_time(const fs::path& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = std::max<std::streamoff>(file ? std::streamoff(file.tellg()) : 0, 0);
  std::string end(static_cast<std::size_t>(std::min(size, longest_end)), '\0');
  file.seekg(size - std::streamoff(end.size()));
  if (!file.read(end.data(), std::streamoff(end.size())) || !end.ends_with('\n')) return std::nullopt;
  end.pop_back();
  const auto before = end.rfind('\n');
  const std::string line = before == std::string::npos ? end : end.substr(before + 1);
  return line.substr(0, line.find(','));
}

bool csv_seems_whole(const fs::path& folder) {
  const auto motion = last_time(folder / "trajectory.csv");
  const fs::path reactions = folder / reactions_file;
  return motion && motion == last_time(folder / "energy.csv") && last_time(folder / "events.csv") &&
         (!fs::exists(reactions) || last_time(reactions));
}

}  // namespace

bool seems_whole(TrajectoryFormat format, const fs::path& folder) {
  if (!has_trajectory(format, folder)) return false;
  if (format == TrajectoryFormat::csv) return csv_seems_whole(folder);
  const Hdf5Handle file = open_hdf5(folder / trajectory_files(format).back(), false);
  return file && text_attribute(file, "format") == hdf5_format;
}

}  // namespace polhode::study::trajectory
