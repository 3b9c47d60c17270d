// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/trajectory/reaction_reader.hpp"

#include "experiments/study/text/csv_reader.hpp"
#include "experiments/study/trajectory/trajectory_files.hpp"

namespace polhode::study::inline trajectory {

std::vector<Vector3<double>> read_reactions(const std::filesystem::path& folder, std::span<const double> times,
                                            std::size_t joints) {
  std::error_code ignored;
  if (joints == 0 || !std::filesystem::is_regular_file(folder / reactions_file, ignored)) return {};
  CsvReader rows((folder / reactions_file).string());
  const std::size_t t = rows.column("t_s"), joint = rows.column("joint");
  const auto force = rows.columns({"fx_N", "fy_N", "fz_N"});
  std::vector<Vector3<double>> forces;
  while (rows.next()) {
    const std::size_t instant = forces.size() / joints, expected = forces.size() % joints;
    if (instant == times.size() || rows.number(t) != times[instant] || rows.integer(joint) != std::int64_t(expected))
      return {};
    forces.emplace_back(rows.number(force[0]), rows.number(force[1]), rows.number(force[2]));
  }
  if (forces.size() != times.size() * joints) return {};
  return forces;
}

}  // namespace polhode::study::trajectory
