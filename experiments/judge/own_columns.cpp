// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/judge/own_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "experiments/judge/diagnosis.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::judge {
namespace {

/// A hypothesis on the contents of a column.
struct ColumnReading {
  const char* what;
  double factor;    ///< inertia from which the column was computed, over the scenario's
  bool in_body;     ///< the vector is in body axes
  double miss = 0;  ///< sum of squares over the rows
};

/// The fault that the readings indicate. size: sum of squares of the correct column.
std::optional<ColumnFault> fault_of(const std::vector<ColumnReading>& readings, double size) {
  constexpr double least = 1e-3;  // smallest relative miss of a faulty column
  const double plain = readings.front().miss;
  const auto less = [](const auto& a, const auto& b) { return a.miss < b.miss; };
  const auto best = std::min_element(readings.begin(), readings.end(), less);
  if (!(plain > least * least * size) || best->miss * naming_factor * naming_factor > plain) return std::nullopt;
  const double factor = std::sqrt(plain / std::max(best->miss, 1e-24 * size));
  if (best->in_body) return ColumnFault{"momentum_frame", "its angular momentum is in body axes", factor};
  return ColumnFault{"inertia",
                     fmt::format("its {} is that of {} times the scenario's inertia, though the motion is right",
                                 best->what, number(best->factor)),
                     factor};
}

}  // namespace

std::optional<ColumnFault> own_column_fault(const RowStates& rows) {
  constexpr std::size_t most_rows = 256;
  const Trajectory& trajectory = rows.trajectory;
  const System<double>& system = rows.right.system();
  const std::size_t n = trajectory.times.size(), stride = std::max<std::size_t>(1, n / most_rows);
  std::vector<ColumnReading> momenta, energies;
  for (const double factor : {1.0, 0.25, 0.5, 2.0, 4.0}) {
    momenta.push_back({"angular momentum", factor, false});
    energies.push_back({"energy", factor, false});
  }
  momenta.push_back({"angular momentum", 1, true});
  double size_l = 0, size_e = 0;
  for (std::size_t k = 0; k < n; k += stride) {
    const VectorX<double> y = rows.state(k, {});
    double rotation = 0;
    for (std::size_t i = 0; i < trajectory.moving; ++i) {
      const BodySnapshot<double> body = system.snapshot(y, i);
      const Vector3<double>& l = body.angular_momentum;
      rotation += 0.5 * body.angular_velocity.dot(l);
      size_l += l.squaredNorm();
      const Vector3<double>& own = trajectory.bodies[k * trajectory.moving + i].angular_momentum;
      for (ColumnReading& c : momenta) {
        Vector3<double> meant = c.factor * l;
        if (c.in_body) meant = body.rotation.transpose() * l;
        c.miss += (own - meant).squaredNorm();
      }
    }
    if (!trajectory.has_energy) continue;
    size_e += rotation * rotation;
    const double energy = system.measure(y).energy();
    for (ColumnReading& c : energies) c.miss += std::pow(trajectory.energy[k] - energy - (c.factor - 1) * rotation, 2);
  }
  if (trajectory.has_angular_velocity && trajectory.has_angular_momentum) {
    if (auto fault = fault_of(momenta, size_l)) return fault;
  }
  if (trajectory.has_energy && rows.knows_paths()) return fault_of(energies, size_e);
  return std::nullopt;
}

}  // namespace polhode::study::judge
