// SPDX-License-Identifier: BSD-3-Clause
// Interface of the flat ODE ẏ = f(t, y). Odeint's fixed-step steppers and the Gauss methods use nothing else of a
// system.
#pragma once

namespace polhode::inline core::inline system {

/// A flat ODE in the scalar S.
template <class S>
class Ode {
 public:
  Ode() = default;
  Ode(const Ode&) = delete;
  Ode& operator=(const Ode&) = delete;
  virtual ~Ode() = default;

  /// Number of entries of y.
  virtual int size() const = 0;
  /// dy = f(t, y). t is in s; y and dy have size() entries.
  virtual void rate(S t, const S* y, S* dy) const = 0;
};

}  // namespace polhode::core::system
