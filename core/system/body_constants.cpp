// SPDX-License-Identifier: BSD-3-Clause
#include "core/system/body_constants.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace polhode::inline core::inline system {

template <class S>
BodyConstants<S>::BodyConstants(const Body& b)
    : principal(b.inertia.isDiagonal(0)),
      pinned(b.pinned),
      inverse_mass(S(1) / S(b.mass)),
      mass(S(b.mass)),
      inertia(b.inertia.cast<S>()),
      inverse_inertia(inertia.inverse()),
      axes(Matrix3<S>::Identity()),
      center_of_mass(b.center_of_mass.cast<S>()) {
  if (principal) {
    moments = inertia.diagonal();
  } else {
    const Eigen::SelfAdjointEigenSolver<Matrix3<S>> solver(inertia);
    moments = solver.eigenvalues();
    axes = solver.eigenvectors();
    if (axes.determinant() < S(0)) axes.col(2) = -axes.col(2);
  }
  inverse_moments = moments.cwiseInverse();
}

template <class S>
BodyConstants<S> constants_of(const std::vector<Problem>& problems, std::size_t body) {
  return BodyConstants<S>(problems.front().bodies[body]);
}
template <>
BodyConstants<Lanes> constants_of<Lanes>(const std::vector<Problem>& problems, std::size_t body) {
  std::vector<BodyConstants<double>> one;
  for (const Problem& p : problems) one.emplace_back(p.bodies[body]);
  BodyConstants<Lanes> all;
  const auto number = [&](auto member) {
    return gather<Lanes>([&](int lane) { return one[std::size_t(lane)].*member; });
  };
  const auto vector = [&](auto& to, auto member) {
    for (int k = 0; k < to.size(); ++k) {
      to(k) = gather<Lanes>([&](int lane) { return (one[std::size_t(lane)].*member)(k); });
    }
  };
  using C = BodyConstants<double>;
  all.mass = number(&C::mass);
  all.inverse_mass = number(&C::inverse_mass);
  vector(all.inertia, &C::inertia);
  vector(all.inverse_inertia, &C::inverse_inertia);
  vector(all.moments, &C::moments);
  vector(all.inverse_moments, &C::inverse_moments);
  vector(all.axes, &C::axes);
  vector(all.center_of_mass, &C::center_of_mass);
  all.principal = one.front().principal;
  all.pinned = one.front().pinned;
  return all;
}

template BodyConstants<float>::BodyConstants(const Body&);
template BodyConstants<double>::BodyConstants(const Body&);
template BodyConstants<long double>::BodyConstants(const Body&);
template BodyConstants<float> constants_of<float>(const std::vector<Problem>&, std::size_t);
template BodyConstants<double> constants_of<double>(const std::vector<Problem>&, std::size_t);
template BodyConstants<long double> constants_of<long double>(const std::vector<Problem>&, std::size_t);

}  // namespace polhode::core::system
