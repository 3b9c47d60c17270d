// SPDX-License-Identifier: BSD-3-Clause
#include "core/system/joint_reactions.hpp"

#include <optional>

#include "core/system/constraints.hpp"
#include "core/system/joint_projection.hpp"

namespace polhode::inline core::inline system {

template <class S>
std::vector<Wrench<S>> joint_reactions(const System<S>& system, S t, const VectorX<S>& y,
                                       const VectorX<S>& multipliers) {
  const Constraints<S>& joints = *system.constraints();
  std::optional<PrescribedMultipliers<S>> prescribed;
  if (multipliers.size() > 0) prescribed.emplace(joints, multipliers);
  VectorX<S> rate(y.size());
  system.rate(t, y.data(), rate.data());
  const auto motions = motions_of(system, y);
  std::vector<Wrench<S>> reactions;
  for (std::size_t i = 0; i < joints.count(); ++i) reactions.push_back(joints.reaction(i, motions));
  return reactions;
}

template std::vector<Wrench<double>> joint_reactions(const System<double>&, double, const VectorX<double>&,
                                                     const VectorX<double>&);
template std::vector<Wrench<long double>> joint_reactions(const System<long double>&, long double,
                                                          const VectorX<long double>&, const VectorX<long double>&);

}  // namespace polhode::core::system
