// SPDX-License-Identifier: BSD-3-Clause
// The changes of energy and momenta since the start of a run, their largest values and the sums for a line through the
// energy drift. S: double for one run, Lanes for a run in each lane, with the same digits.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "core/run/integrator.hpp"
#include "experiments/study/statistics/strided.hpp"

namespace polhode::study::inline metrics {

/// The origin of drifts, and the bound beyond which a run is hopeless.
template <class S>
struct DriftOrigin {
  using Mask = typename LaneType<S>::Mask;

  S energy{};                                       ///< ledger of the start, J
  Vector3<S> linear = Vector3<S>::Zero();           ///< linear momentum of the start, kg m/s
  Vector3<S> angular = Vector3<S>::Zero();          ///< angular momentum of the start, kg m²/s
  Mask linear_conserved{}, angular_conserved{};     ///< else the change counts as 0
  S bound = S(std::numeric_limits<double>::max());  ///< largest energy drift and kinetic energy, J
  S half{};                                         ///< half of t_end, s
  S per_t_end{};                                    ///< inverse 1/t_end, 1/s
};

/// The changes in consecutive samples: one array for each quantity.
template <class S>
struct DriftColumns {
  static constexpr std::size_t most = 64;
  std::array<S, most> t;         ///< s
  std::array<S, most> energy;    ///< J
  std::array<S, most> linear2;   ///< squared change of the linear momentum, (kg m/s)²
  std::array<S, most> angular2;  ///< squared change of the angular momentum, (kg m²/s)²
  std::array<S, most> defect;    ///< orientation defect
};

/// Changes in consecutive samples of one run.
struct DriftsOfRun {
  Strided t, energy, linear2, angular2, defect;  ///< the same columns as in DriftColumns

  /// Those of a lane; for one run lane 0.
  template <class S>
  static DriftsOfRun in(const DriftColumns<S>& columns, std::size_t lane) {
    constexpr std::size_t stride = sizeof(S) / sizeof(double);
    const auto of = [lane](const auto& column) {
      return Strided{reinterpret_cast<const double*>(column.data()) + lane, stride};
    };
    return {of(columns.t), of(columns.energy), of(columns.linear2), of(columns.angular2), of(columns.defect)};
  }
};

/// The largest changes in some samples: the energy drift of largest magnitude (signed) with its time, and the largest
/// of the others.
template <class S>
struct LargestDrifts {
  S t{}, energy{}, linear2{}, angular2{}, defect{};

  void add(S t_of, S energy_of, S linear2_of, S angular2_of, S defect_of) {
    using std::abs;
    const auto as_large = abs(energy_of) <= abs(energy);
    t = select(as_large, t, t_of);
    energy = select(as_large, energy, energy_of);
    linear2 = select(linear2 < linear2_of, linear2_of, linear2);
    angular2 = select(angular2 < angular2_of, angular2_of, angular2);
    defect = select(defect < defect_of, defect_of, defect);
  }
};

/// Sets worst to max(worst, |x|), or to NaN if x is NaN.
template <class S>
void raise_size(S& worst, S x) {
  using std::abs;
  const S size = abs(x);
  worst = select(size <= worst, worst, size);
}

/// True, in lanes for each of them, if a run cannot recover from this energy drift (J) or kinetic energy (J).
template <class S>
auto is_hopeless(S energy_drift, S kinetic, S bound) {
  using std::abs;
  return !((abs(energy_drift) <= bound) & (kinetic <= bound));
}

/// Fills the columns from at most DriftColumns::most samples. angular_change(sample): the change of the angular
/// momentum, kg m²/s. Returns whether a sample is hopeless, in lanes for each of them.
template <class S, class AngularChange>
typename LaneType<S>::Mask fill(DriftColumns<S>& columns, std::span<const SampleOf<S>> samples,
                                const DriftOrigin<S>& given, double lost_in_contact,
                                const AngularChange& angular_change) {
  const DriftOrigin<S> origin = given;  // local copy, so that the compiler keeps it in registers
  typename LaneType<S>::Mask some(false);
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const SampleOf<S>& sample = samples[k];
    const Measurement<S>& m = sample.seen;
    columns.t[k] = sample.t;
    columns.energy[k] = sample.ledger(lost_in_contact) - origin.energy;
    columns.linear2[k] = select(origin.linear_conserved, (m.linear_momentum - origin.linear).squaredNorm(), S(0));
    columns.angular2[k] = select(origin.angular_conserved, Vector3<S>(angular_change(sample)).squaredNorm(), S(0));
    columns.defect[k] = m.orientation_defect;
    some = some | is_hopeless(columns.energy[k], m.kinetic, origin.bound);
  }
  return some;
}

/// Largest values and sums over the samples of a run.
template <class S>
struct DriftSums {
  // Energies in J, squared linear momenta in (kg m/s)², squared angular momenta in (kg m²/s)².
  S worst_energy{}, last_energy{}, worst_linear2{}, worst_angular2{}, worst_defect{};
  S worst_early_energy{};  ///< largest energy drift until half of t_end, J
  S t{}, tt{}, d{}, td{};  ///< sums for the least-squares slope of the drift over t/t_end

  /// Adds the first `count` samples of the columns.
  void add(const DriftColumns<S>& columns, std::size_t count, const DriftOrigin<S>& origin) {
    DriftSums sums = *this;  // local copy, so that the compiler keeps it in registers
    const S per_t_end = origin.per_t_end, half = origin.half;
    for (std::size_t k = 0; k < count; ++k) {
      const S energy = columns.energy[k];
      raise_size(sums.worst_energy, energy);
      raise_size(sums.worst_early_energy, select(columns.t[k] <= half, energy, S(0)));
      raise_size(sums.worst_linear2, columns.linear2[k]);
      raise_size(sums.worst_angular2, columns.angular2[k]);
      raise_size(sums.worst_defect, columns.defect[k]);
      const S s = columns.t[k] * per_t_end;
      sums.t += s;
      sums.tt += s * s;
      sums.d += energy;
      sums.td += s * energy;
    }
    if (count > 0) sums.last_energy = columns.energy[count - 1];
    *this = sums;
  }

  /// Calls f(number of a, the same of b) for each number.
  template <class A, class B, class F>
  static void for_each(A& a, B& b, const F& f) {
    f(a.worst_energy, b.worst_energy), f(a.last_energy, b.last_energy), f(a.worst_linear2, b.worst_linear2);
    f(a.worst_angular2, b.worst_angular2), f(a.worst_defect, b.worst_defect);
    f(a.worst_early_energy, b.worst_early_energy);
    f(a.t, b.t), f(a.tt, b.tt), f(a.d, b.d), f(a.td, b.td);
  }
};

}  // namespace polhode::study::metrics
