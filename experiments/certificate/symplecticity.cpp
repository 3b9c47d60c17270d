// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/certificate/symplecticity.hpp"

#include <array>
#include <utility>

namespace polhode::study::certificate {
namespace {

/// f′ ≈ Σ weight (f(k s) − f(−k s)) / s, of sixth order (Fornberg 1988, table 1).
constexpr std::array<std::pair<int, double>, 3> stencil = {{{1, 45.0}, {2, -9.0}, {3, 1.0}}};
constexpr double denominator = 60;

template <class S>
std::optional<PhasePoint<S>> image(const PhaseSpace<S>& space, const FlatMap<S>& map, const PhasePoint<S>& of) {
  VectorX<S> y = space.state(of);
  if (!map(y) || !y.allFinite()) return std::nullopt;
  return space.point(std::move(y));
}

}  // namespace

template <class S>
std::optional<double> symplecticity_defect(const PhaseSpace<S>& space, const FlatMap<S>& map, const PhasePoint<S>& at,
                                           double increment) {
  const int n = space.dimension();
  const auto end = image(space, map, at);
  if (!end) return std::nullopt;
  MatrixX<S> derivative = MatrixX<S>::Zero(n, n), displacement = derivative;
  for (int k = 0; k < n; ++k) {
    for (const auto& [multiple, weight] : stencil) {
      for (const int side : {1, -1}) {
        VectorX<S> by = VectorX<S>::Zero(n);
        by[k] = S(side * multiple) * S(increment);
        const PhasePoint<S> displaced = space.moved(at, by);
        const auto moved = image(space, map, displaced);
        if (!moved) return std::nullopt;
        derivative.col(k) += S(side) * S(weight) * space.coordinates(*end, *moved);
        displacement.col(k) += S(side) * S(weight) * space.coordinates(at, displaced);
      }
    }
  }
  derivative /= S(denominator) * S(increment);
  displacement /= S(denominator) * S(increment);
  const MatrixX<S> before = displacement.transpose() * space.two_form(at) * displacement;
  const MatrixX<S> after = derivative.transpose() * space.two_form(*end) * derivative;
  return static_cast<double>((after - before).norm() / before.norm());
}

template std::optional<double> symplecticity_defect(const PhaseSpace<double>&, const FlatMap<double>&,
                                                    const PhasePoint<double>&, double);
template std::optional<double> symplecticity_defect(const PhaseSpace<long double>&, const FlatMap<long double>&,
                                                    const PhasePoint<long double>&, double);

}  // namespace polhode::study::certificate
