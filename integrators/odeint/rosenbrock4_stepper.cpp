// SPDX-License-Identifier: BSD-3-Clause
#include "integrators/odeint/rosenbrock4_stepper.hpp"

#ifndef BOOST_UBLAS_NDEBUG
#define BOOST_UBLAS_NDEBUG  // its self-checks throw if a right-hand side is NaN
#endif
#include <algorithm>
#include <boost/numeric/odeint/stepper/rosenbrock4.hpp>
#include <boost/numeric/odeint/stepper/rosenbrock4_controller.hpp>
#include <utility>

#include "integrators/difference_quotients.hpp"

namespace polhode::inline integrators {
namespace {

namespace odeint = boost::numeric::odeint;
using Array = boost::numeric::ublas::vector<double>;
using Matrix = boost::numeric::ublas::matrix<double>;

/// Coefficients of rodas.f (Hairer & Wanner). Odeint's d4, the coefficient of ∂f/∂t, has the opposite sign and reduces
/// the order to 2 if f depends on time.
struct Coefficients : odeint::default_rosenbrock_coefficients<double> {
  const double d4 = -0.3620000000000023e-01;
};
using Stepper = odeint::rosenbrock4<double, Coefficients>;

Array copy(const std::vector<double>& from) {
  Array to(from.size());
  std::copy(from.begin(), from.end(), to.begin());
  return to;
}

}  // namespace

struct Rosenbrock4Stepper::Impl {
  Impl(double tolerance, std::size_t size)
      : stepper(tolerance, tolerance), x(size), x1(size), point(size), plus(size), minus(size) {}

  odeint::rosenbrock4_controller<Stepper> stepper;
  Array x, x1;
  Vector point, plus, minus;
};

Rosenbrock4Stepper::Rosenbrock4Stepper(double tolerance, std::size_t size)
    : impl_(std::make_unique<Impl>(tolerance, size)) {}
Rosenbrock4Stepper::~Rosenbrock4Stepper() = default;

bool Rosenbrock4Stepper::try_step(const Rate& rate, const Vector& x, double& t, Vector& x1, double& h) {
  Impl& m = *impl_;
  const auto plain = [&rate](double when, const Vector& y, Vector& dy) { rate(y, dy, when); };
  const auto derivative = [&](const Array& y, Array& dy, double when) {
    std::copy(y.begin(), y.end(), m.point.begin());
    plain(when, m.point, m.plus);
    std::copy(m.plus.begin(), m.plus.end(), dy.begin());
  };
  const auto jacobian = [&](const Array& y, Matrix& j, double when, Array& dt) {
    std::copy(y.begin(), y.end(), m.point.begin());
    jacobian_by_quotients(plain, when, m.point, m.plus, m.minus,
                          [&j](std::size_t row, std::size_t column, double d) { j(row, column) = d; });
    time_derivative_by_quotients(plain, when, m.point, m.plus, m.minus, dt);
  };
  std::copy(x.begin(), x.end(), m.x.begin());
  if (m.stepper.try_step(std::make_pair(derivative, jacobian), m.x, t, m.x1, h) != odeint::success) return false;
  m.stepper.stepper().prepare_dense_output();
  std::copy(m.x1.begin(), m.x1.end(), x1.begin());
  return true;
}

void Rosenbrock4Stepper::calc_state(double t, Vector& y, const Vector& x0, double t0, const Vector& x1,
                                    double t1) const {
  Array at(y.size());
  impl_->stepper.stepper().calc_state(t, at, copy(x0), t0, copy(x1), t1);
  std::copy(at.begin(), at.end(), y.begin());
}

}  // namespace polhode::integrators
