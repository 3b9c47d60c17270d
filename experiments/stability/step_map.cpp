// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/stability/step_map.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

#include "experiments/study/scenario/characteristic_rate.hpp"

namespace polhode::study::stability {
namespace {

/// Indices in y of positions and velocities of mass centres; positions come first.
std::vector<int> translation(const Layout& layout) {
  std::vector<int> at;
  for (const bool velocities : {false, true}) {
    for (const Layout::Slot& slot : layout.slots) {
      const int first = velocities ? slot.velocity : slot.position;
      for (int k = 0; k < 3 && first >= 0; ++k) at.push_back(first + k);
    }
  }
  return at;
}

/// Sizes of displacements: 1 m for positions, 1 m times the characteristic rate for velocities.
std::vector<double> scales(const System<double>& system, std::size_t n) {
  const double rate = characteristic_rate(system.problem()).value_or(1);
  std::vector<double> all(n, 1.0);
  std::fill(all.begin() + static_cast<std::ptrdiff_t>(n / 2), all.end(), rate);
  return all;
}

VectorX<double> rate_at(const System<double>& system, double t, const VectorX<double>& y) {
  VectorX<double> dy = VectorX<double>::Zero(y.size());
  system.rate(t, y.data(), dy.data());
  return dy;
}

}  // namespace

bool is_linear(const System<double>& system) {
  const auto at = translation(system.layout());
  if (at.size() != 6 * system.moving()) return false;  // a pinned body
  const auto scale = scales(system, at.size());
  const VectorX<double> y0 = system.start().y;
  // Two displacements in generic directions.
  VectorX<double> u = VectorX<double>::Zero(y0.size()), w = u;
  for (std::size_t k = 0; k < at.size(); ++k) {
    const double x = static_cast<double>(k);
    u[at[k]] = scale[k] * std::sin(1 + 2.3 * x);
    w[at[k]] = scale[k] * std::cos(2 + 1.7 * x);
  }
  const VectorX<double> f0 = rate_at(system, 0, y0), fu = rate_at(system, 0, y0 + u), fw = rate_at(system, 0, y0 + w);
  const VectorX<double> both = rate_at(system, 0, y0 + u + w), later = rate_at(system, 1, y0 + u);
  const double size = f0.norm() + fu.norm() + fw.norm() + both.norm();
  for (int i = 0; i < system.layout().work(); ++i) {
    if (std::find(at.begin(), at.end(), i) == at.end()) {
      if (f0[i] != 0 || fu[i] != 0 || fw[i] != 0 || both[i] != 0) return false;  // a body rotates
    } else if (!(std::abs(both[i] - fu[i] - fw[i] + f0[i]) <= 1e-12 * size) || later[i] != fu[i]) {
      return false;
    }
  }
  return true;
}

std::optional<double> spectral_radius(const IntegratorEntry& method, const Problem& problem,
                                      const Formulation& formulation, double dt) {
  if (method.declaration.adaptive || method.declaration.multi_step) return std::nullopt;
  const auto system = make_system<double>(problem, formulation);
  if (!is_linear(*system)) return std::nullopt;
  const auto at = translation(system->layout());
  const auto scale = scales(*system, at.size());
  const State<double> start = system->start();
  const auto stepped = [&](std::size_t k, double by) -> std::optional<VectorX<double>> {
    State<double> state = start;
    state.y[at[k]] += by;
    const auto integrator = method.make(*system, {.dt = dt, .t_end = dt});
    integrator->begin(state);
    if (!integrator->step(state, dt).ok() || !state.y.allFinite()) return std::nullopt;
    return state.y;
  };
  const auto n = static_cast<Eigen::Index>(at.size());
  Eigen::MatrixXd map(n, n);
  const auto origin = stepped(0, 0);
  if (!origin) return std::nullopt;
  for (Eigen::Index j = 0; j < n; ++j) {
    const auto column = static_cast<std::size_t>(j);
    const auto moved = stepped(column, scale[column]);
    if (!moved) return std::nullopt;
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto row = static_cast<std::size_t>(i);
      map(i, j) = ((*moved)[at[row]] - (*origin)[at[row]]) / scale[row];
    }
  }
  return map.eigenvalues().cwiseAbs().maxCoeff();
}

}  // namespace polhode::study::stability
