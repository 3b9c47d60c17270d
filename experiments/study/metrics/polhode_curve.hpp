// SPDX-License-Identifier: BSD-3-Clause
// The search of the nearest point of a polhode. S: double, or Lanes with a polhode of its own in each lane and the
// digits that a search alone has.
#pragma once

#include <cmath>
#include <limits>

#include "core/math/lanes.hpp"
#include "core/math/linear_algebra.hpp"

namespace polhode::study::inline metrics {

template <class S>
struct PolhodeCurve {
  using Mask = typename LaneType<S>::Mask;

  Matrix3<S> inertia = Matrix3<S>::Identity(), inverse_inertia = inertia;  ///< kg m² and its inverse, body axes
  S speed{1.0}, size{1.0};                                                 ///< |ω(0)|, |y(0)|
  S reach{0.0};        ///< time within which the cubic Taylor polynomial of y is exact to round-off, s
  S search_step{0.0};  ///< longest step of a search, s

  struct Momentum {
    Vector3<S> y, omega;                                ///< kg m²/s and rad/s, body frame
    Vector3<S> rate() const { return y.cross(omega); }  ///< ẏ, Euler's equations
  };
  struct Nearest {
    S phase{0.0};     ///< s
    S distance{0.0};  ///< of y from the exact one at that phase, kg m²/s
  };

  /// The momentum of this angular velocity.
  Momentum momentum(const Vector3<S>& omega) const { return {inertia * omega, omega}; }

  /// If y is close to the curve, the minimum next to the expected phase is the global one.
  Mask is_close(const Nearest& found) const { return found.distance <= S(0.02) * size; }

  /// The nearest point from `start`, the exact momentum at t + phase, where it is sought, by Chebyshev's method. With g
  /// half the squared distance and n = −g'/g" Newton's step, its step is n − n² g"'/2g", whose error is of third order
  /// (Traub, Iterative Methods for the Solution of Equations, 1964). Where that correction is large the step is
  /// Newton's, and where g is not sufficiently convex that of the Gauss–Newton method. Steps are at most search_step.
  /// Within reach of the last elliptic functions y is their Taylor polynomial, so that a further step costs no others.
  /// exact(t): the exact angular velocity at t (s), body axes, rad/s.
  template <class Exact>
  Nearest refined(S t, const Vector3<S>& y, S phase, Momentum start, Mask sought, const Exact& exact) const;

 private:
  struct Derivatives {
    Vector3<S> rate = Vector3<S>::Zero(), second = rate, third = rate;  ///< of y in time, body frame
  };
  /// The derivatives of ẏ = y × ω.
  Derivatives derivatives(const Momentum& m) const {
    const Vector3<S> rate = m.rate(), omega_rate = inverse_inertia * rate;
    const Vector3<S> second = rate.cross(m.omega) + m.y.cross(omega_rate);
    const Vector3<S> omega_second = inverse_inertia * second;
    return {rate, second, second.cross(m.omega) + S(2) * rate.cross(omega_rate) + m.y.cross(omega_second)};
  }
};

template <class S>
template <class Exact>
typename PolhodeCurve<S>::Nearest PolhodeCurve<S>::refined(S t, const Vector3<S>& y, S phase, Momentum start,
                                                           Mask sought, const Exact& exact) const {
  using std::abs, std::sqrt;
  constexpr int most_steps = 30;
  constexpr double rounding = std::numeric_limits<double>::epsilon();
  Nearest best{phase, S(std::numeric_limits<double>::infinity())};
  Momentum m = start;
  Derivatives of_start;
  S start_phase = phase;
  for (int i = 0; i < most_steps; ++i) {
    const Vector3<S> off = y - m.y, rate = m.rate();
    const S distance = off.norm(), rate2 = rate.squaredNorm(), along = off.dot(rate);
    // Where distances do not differ but for round-off, the later point is the nearer one.
    const Mask nearer(sought & (distance <= best.distance + 4 * rounding * size));
    best.phase = select(nearer, phase, best.phase);
    best.distance = select(nearer, distance, best.distance);
    sought = sought & (abs(along) > rounding * ((abs(t) + abs(phase)) * rate2 + size * sqrt(rate2)));
    if (!any(sought)) break;
    const Derivatives d = derivatives(m);
    const Mask at_start((phase <= start_phase) & (phase >= start_phase));
    of_start.rate = select(at_start, d.rate, of_start.rate);
    of_start.second = select(at_start, d.second, of_start.second);
    of_start.third = select(at_start, d.third, of_start.third);
    const S curvature = rate2 - off.dot(d.second);
    const S newton = along / curvature;
    const S correction = newton * (3 * rate.dot(d.second) - off.dot(d.third)) / (2 * curvature);
    const S chebyshev = select(abs(correction) < 0.25, S(newton - newton * correction), newton);
    const S step = select(4 * curvature > rate2, chebyshev, S(along / rate2));
    const S longest = search_step, shortest = -search_step;
    phase += select(step < shortest, shortest, select(longest < step, longest, step));
    const S s = phase - start_phase;
    const Mask near(abs(s) <= reach);
    const Mask far = sought & !near;
    m.y = start.y + s * (of_start.rate + s / 2 * (of_start.second + s / 3 * of_start.third));
    m.omega = inverse_inertia * m.y;
    if (any(far)) {
      const Momentum found = momentum(exact(t + phase));
      m = {select(far, found.y, m.y), select(far, found.omega, m.omega)};
      start.y = select(far, found.y, start.y);
      start_phase = select(far, phase, start_phase);
    }
  }
  return best;
}

}  // namespace polhode::study::metrics
