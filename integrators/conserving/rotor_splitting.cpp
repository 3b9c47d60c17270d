// SPDX-License-Identifier: BSD-3-Clause
#include "integrators/conserving/rotor_splitting.hpp"

namespace polhode::inline integrators {

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

template class KickFlowKick<ManyBodies<double>>;
template class KickFlowKick<ManyBodies<float>>;
template class KickFlowKick<ManyBodies<long double>>;

}  // namespace polhode::integrators
