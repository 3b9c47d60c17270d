// SPDX-License-Identifier: BSD-3-Clause
// The free rigid body by the discrete Lagrangian h L(ξ/h), R₊ = R exp(ξ), with the exponential map: the momenta at the
// two ends of a step are
//   h m = dexp⁻ᵀ(−ξ) I ξ = I ξ + ½ ξ × I ξ + c ξ × (ξ × I ξ),   m₊ = exp(−ξ) m,   c = (1 − (θ/2) cot(θ/2))/θ², θ = |ξ|.
// It conserves R m and |m|. Source: Hante & Arnold, J. Comput. Appl. Math. 387 (2021), section 2; Marsden & West, Acta
// Numerica 10 (2001).
#pragma once

#include <limits>

#include "core/math/quaternion.hpp"
#include "core/system/body_frame.hpp"
#include "core/system/lie_group.hpp"

namespace polhode::inline integrators {

/// One step with the moments j (kg m²), solved for ξ by Newton's method, in whose derivative c is constant. Returns
/// null, or the reason of a failure.
template <class S>
const char* exponential_turn(const Vector3<S>& j, S h, Vector3<S>& m, Quaternion<S>& dq) {
  const auto hat = [](const Vector3<S>& a) {
    Matrix3<S> r;
    r << S(0), -a[2], a[1], a[2], S(0), -a[0], -a[1], a[0], S(0);
    return r;
  };
  Vector3<S> xi = h * m.cwiseQuotient(j);
  S last = std::numeric_limits<S>::infinity();
  for (int iteration = 0; iteration < 50; ++iteration) {
    const Vector3<S> l = j.cwiseProduct(xi), x = xi.cross(l);
    const S c = lie_group::dexp_inverse_coefficient<S>(xi.squaredNorm());
    const Vector3<S> residual = l + S(0.5) * x + c * xi.cross(x) - h * m;
    const Matrix3<S> of_x = hat(xi) * j.asDiagonal() - hat(l);
    const Matrix3<S> derivative = Matrix3<S>(j.asDiagonal()) + S(0.5) * of_x + c * (hat(xi) * of_x - hat(x));
    const Vector3<S> step = derivative.inverse() * residual;
    xi -= step;
    const S size = step.squaredNorm();
    const S below = S(16) * std::numeric_limits<S>::epsilon() * std::numeric_limits<S>::epsilon() * xi.squaredNorm();
    if (size <= below || (size >= last / S(4) && size <= S(1e4) * below)) {
      dq = quaternion_from_rotation_vector<S>(xi);
      m += body_frame::turning<S>(conjugate<S>(dq), m);
      return nullptr;
    }
    last = size;
  }
  return "the variational equation of the rotation has no solution near the motion: the step is too long";
}

}  // namespace polhode::integrators
