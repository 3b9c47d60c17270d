// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/statistics/quantiles.hpp"

#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <map>
#include <tuple>

namespace polhode::study::inline statistics {

double students_t_95(double degrees) {
  // Studies use the same few degrees over and over.
  thread_local std::map<double, double> known;
  auto at = known.find(degrees);
  if (at == known.end())
    at = known.emplace(degrees, boost::math::quantile(boost::math::students_t(degrees), 0.975)).first;
  return at->second;
}

double fisher_f_exceeded(double numerator, double denominator, double significance) {
  thread_local std::map<std::tuple<double, double, double>, double> known;
  const std::tuple key{numerator, denominator, significance};
  auto at = known.find(key);
  if (at == known.end()) {
    const boost::math::fisher_f distribution(numerator, denominator);
    at = known.emplace(key, boost::math::quantile(boost::math::complement(distribution, significance))).first;
  }
  return at->second;
}

}  // namespace polhode::study::statistics
