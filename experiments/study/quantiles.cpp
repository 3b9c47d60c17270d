// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/quantiles.hpp"

#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/students_t.hpp>

namespace polhode::study {

double students_t_95(double degrees) { return boost::math::quantile(boost::math::students_t(degrees), 0.975); }

double fisher_f_exceeded(double numerator, double denominator, double significance) {
  const boost::math::fisher_f distribution(numerator, denominator);
  return boost::math::quantile(boost::math::complement(distribution, significance));
}

}  // namespace polhode::study
