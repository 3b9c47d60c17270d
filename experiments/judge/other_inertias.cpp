// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/judge/other_inertias.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <tuple>
#include <utility>

namespace polhode::study::judge {
namespace {

std::vector<OtherInertia> all_other_inertias(const Body& body) {
  std::vector<OtherInertia> found;
  const Matrix3<double>& right = body.inertia;
  for (const auto& [factor, words] :
       {std::pair{0.5, "half"}, {2.0, "twice"}, {0.25, "a quarter of"}, {4.0, "four times"}}) {
    found.push_back({factor * right, fmt::format("the inertia is {} the scenario's", words)});
  }
  const Eigen::SelfAdjointEigenSolver<Matrix3<double>> principal(right);
  const bool diagonal = right.isDiagonal(1e-12);
  const Matrix3<double> axes = diagonal ? Matrix3<double>(Matrix3<double>::Identity()) : principal.eigenvectors();
  const Vector3<double> moments = diagonal ? Vector3<double>(right.diagonal()) : principal.eigenvalues();
  const auto add = [&](const Vector3<double>& m, std::string words) {
    found.push_back({axes * m.asDiagonal() * axes.transpose(), std::move(words)});
  };
  for (int k = 0; k < 3; ++k) {
    for (const double factor : {0.5, 2.0}) {
      Vector3<double> m = moments;
      m[k] *= factor;
      add(m, fmt::format("the moment of inertia about {} axis {} is {} the scenario's", diagonal ? "body" : "principal",
                         k + 1, factor < 1 ? "half" : "twice"));
    }
  }
  for (const auto& [a, b, c] : {std::tuple{0, 2, 1}, {1, 0, 2}, {2, 1, 0}, {1, 2, 0}, {2, 0, 1}}) {
    add({moments[a], moments[b], moments[c]},
        fmt::format("the moments of inertia stand in the order {}, {}, {}", a + 1, b + 1, c + 1));
  }
  found.push_back(
      {right.inverse() * (right.trace() / right.inverse().trace()), "the inverse of the inertia stands for it"});
  if (body.pinned && !body.center_of_mass.isZero(0)) {
    const Vector3<double>& l = body.center_of_mass;
    const Matrix3<double> moved = body.mass * (l.squaredNorm() * Matrix3<double>::Identity() - l * l.transpose());
    found.push_back({right - moved, "the inertia is that about the mass centre, not about the pivot"});
    found.push_back({right + moved, "the inertia is moved from the mass centre to the pivot twice"});
  }
  return found;
}

}  // namespace

std::vector<OtherInertia> other_inertias(const Body& body, bool forces_exert_torques) {
  constexpr double alike = 1e-6;  // largest relative difference of moments that count as equal
  const bool free = !forces_exert_torques;
  const auto shape = [&](const Matrix3<double>& m) { return free ? Matrix3<double>(m / m.trace()) : m; };
  std::vector<Matrix3<double>> seen = {shape(body.inertia)};
  std::vector<OtherInertia> distinct;
  for (OtherInertia& other : all_other_inertias(body)) {
    const Matrix3<double> it = shape(other.inertia);
    const auto is_it = [&](const auto& m) { return (m - it).norm() < alike * m.norm(); };
    const bool known = std::any_of(seen.begin(), seen.end(), is_it);
    const Matrix3<double> isotropic = it.trace() / 3 * Matrix3<double>::Identity();
    if (free && (it - isotropic).norm() < alike * it.norm()) continue;
    if (known || other.inertia.llt().info() != Eigen::Success) continue;
    seen.push_back(it);
    distinct.push_back(std::move(other));
  }
  return distinct;
}

}  // namespace polhode::study::judge
