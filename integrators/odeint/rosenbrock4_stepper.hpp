// SPDX-License-Identifier: BSD-3-Clause
// Boost.Odeint's controlled Rosenbrock stepper on vectors of double. It is a separate source file because it uses the
// uBLAS of Boost 1.74, which compiles as C++17 only. All headers that it includes must compile as C++17 too.
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

  /// Takes a trial step of h (s) from (t, x). True if the step is accepted; x1 and t are then its end. h becomes the
  /// next proposal.
  bool try_step(const Rate& rate, const Vector& x, double& t, Vector& x1, double& h);

  /// Dense output: y at time t (s) within the last accepted step, from (t0, x0) to (t1, x1).
  void calc_state(double t, Vector& y, const Vector& x0, double t0, const Vector& x1, double t1) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace polhode::integrators
