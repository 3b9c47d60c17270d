// SPDX-License-Identifier: BSD-3-Clause
// Boost.Odeint's controlled Rosenbrock stepper on plain arrays. It stands apart since Boost 1.74's uBLAS, on which it
// is built, compiles as C++17 only: what is included here must do so too.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace polhode::inline integrators {

class Rosenbrock4Stepper {
 public:
  using Vector = std::vector<double>;
  using Rate = std::function<void(const Vector& y, Vector& dy, double t)>;

  Rosenbrock4Stepper(double tolerance, std::size_t size);
  ~Rosenbrock4Stepper();

  /// True where the step passes: then x1 and t are its end. h becomes the proposal for the next one.
  bool try_step(const Rate& rate, const Vector& x, double& t, Vector& x1, double& h);

  /// Dense output of the step that passed last, from (t0, x0) to (t1, x1).
  void calc_state(double t, Vector& y, const Vector& x0, double t0, const Vector& x1, double t1) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace polhode
