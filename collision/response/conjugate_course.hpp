// SPDX-License-Identifier: BSD-3-Clause
// Accelerates the convergence of Gauss–Seidel sweeps: nonsmooth nonlinear conjugate gradients (Silcowitz-Hansen, Niebe
// & Erleben, "A nonsmooth nonlinear conjugate gradient method for interactive contact force problems", 2010). The
// change made by a sweep, forwards and backwards over the points, replaces the negative gradient g (a sweep in one
// direction alone would not be the gradient of a quadratic form). After a sweep the impulses advance by β p, with β =
// |g|²/|g before|² (Fletcher & Reeves) and p = g + β p the search direction. If the sweeps do not become smaller, or
// oppose the direction (O'Donoghue & Candès, "Adaptive restart for accelerated gradient schemes", 2015), the search
// restarts. The last operation is a sweep, so that the impulses obey the law of contact.
#pragma once

#include <span>
#include <vector>

#include "collision/response/contact_batches.hpp"

namespace polhode::inline collision::inline response {

/// The search direction of the motions, and β. The solver keeps that of the impulses.
class ConjugateCourse {
 public:
  void start(std::size_t bodies) {
    course_.assign(bodies, ImpulseMotion{});
    size_ = 0;
  }

  /// Call before a sweep.
  void mark(std::span<const ImpulseMotion> motions) { marked_.assign(motions.begin(), motions.end()); }

  /// Inner products of the change made by a sweep, with itself and with the search direction; summed patch by patch, so
  /// that the digits do not depend on the width of the registers.
  struct Products {
    double size = 0, along = 0;
    void add(const Lanes& of_size, const Lanes& of_along) {
      for (int i = 0; i < lane_count; ++i) {
        size += of_size[i];
        along += of_along[i];
      }
    }
  };

  /// Call after a sweep; returns β.
  double share(const Products& changes) {
    const double before = size_;
    size_ = changes.size;
    return changes.size < before && changes.along >= 0 ? changes.size / before : 0;
  }

  /// Advances the motions along the search direction.
  void advance(std::span<ImpulseMotion> motions, double share) {
    for (std::size_t i = 0; i < motions.size(); ++i) {
      for (const auto part : {&ImpulseMotion::linear, &ImpulseMotion::angular}) {
        for (std::size_t k = 0; k < 3; ++k) {
          double &at = (motions[i].*part)[k], &course = (course_[i].*part)[k];
          const double change = at - (marked_[i].*part)[k];
          at += share * course;
          course = share * course + change;
        }
      }
    }
  }

 private:
  std::vector<ImpulseMotion> course_, marked_;
  double size_ = 0;
};

}  // namespace polhode::collision::response
