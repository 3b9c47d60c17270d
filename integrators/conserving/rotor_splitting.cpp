// SPDX-License-Identifier: BSD-3-Clause
#include "integrators/conserving/rotor_splitting.hpp"

namespace polhode {

template <class System>
const char* KickFlowKick<System>::step(const System& system, S t, S h, Flat& y, RotorTurn<S> turn) {
  const S half = h / S(2);
  if (const char* failure = kick_(system, t, half, y)) return failure;
  const char* failure = nullptr;
  system.free_flow(h, y, [&](const BodyConstants<S>& body, S duration, Vector3<S>& m) {
    Quaternion<S> dq = identity_quaternion<S>();
    if (const char* reason = turn(body, duration, m, dq)) failure = reason;
    return dq;
  });
  return failure ? failure : kick_(system, t + h, half, y);
}

#define POLHODE_INSTANTIATE(S, N)                                                                           \
  template class KickFlowKick<RigidBodies<S, Orientation::quaternion, AngularState::velocity_world, N>>;    \
  template class KickFlowKick<RigidBodies<S, Orientation::quaternion, AngularState::velocity_body, N>>;     \
  template class KickFlowKick<RigidBodies<S, Orientation::quaternion, AngularState::momentum_world, N>>;    \
  template class KickFlowKick<RigidBodies<S, Orientation::matrix, AngularState::velocity_world, N>>;        \
  template class KickFlowKick<RigidBodies<S, Orientation::matrix, AngularState::velocity_body, N>>;         \
  template class KickFlowKick<RigidBodies<S, Orientation::matrix, AngularState::momentum_world, N>>

POLHODE_INSTANTIATE(double, BodyCount::one);
POLHODE_INSTANTIATE(double, BodyCount::many);
POLHODE_INSTANTIATE(float, BodyCount::many);
POLHODE_INSTANTIATE(long double, BodyCount::many);

}  // namespace polhode
