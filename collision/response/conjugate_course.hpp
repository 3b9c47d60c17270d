// SPDX-License-Identifier: BSD-3-Clause
// What makes sweeps of Gauss–Seidel converge in fewer: nonsmooth nonlinear conjugate gradients (Silcowitz-Hansen, Niebe
// & Erleben, "A nonsmooth nonlinear conjugate gradient method for interactive contact force problems", 2010). What a
// sweep changes, to the last point and back, stands for the negative gradient g (in one direction alone it would be
// none, of no quadratic form); after the sweep the impulses go on by β p, with β = |g|²/|g before|² (Fletcher & Reeves)
// and p = g + β p the course; where the sweeps do not become smaller, or go against the course (O'Donoghue & Candès,
// "Adaptive restart for accelerated gradient schemes", 2015), it starts anew. A sweep comes last, so that
// the impulses are ones that the contacts allow.
#pragma once

#include <span>
#include <vector>

#include "collision/response/contact_batches.hpp"

namespace polhode::inline collision {

/// The course of the motions, and β. Those of the impulses the solver keeps beside them.
class ConjugateCourse {
 public:
  void start(std::size_t bodies) {
    course_.assign(bodies, ImpulseMotion{});
    size_ = 0;
  }

  /// Before a sweep.
  void mark(std::span<const ImpulseMotion> motions) { marked_.assign(motions.begin(), motions.end()); }

  /// Of what a sweep changed, with itself and with the course; summed patch by patch, so that the digits do not depend
  /// on the registers.
  struct Products {
    double size = 0, along = 0;
    void add(const Lanes& of_size, const Lanes& of_along) {
      for (int i = 0; i < lane_count; ++i) {
        size += of_size[i];
        along += of_along[i];
      }
    }
  };

  /// After a sweep: β.
  double share(const Products& changes) {
    const double before = size_;
    size_ = changes.size;
    return changes.size < before && changes.along >= 0 ? changes.size / before : 0;
  }

  /// Takes the motions along the course.
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

}  // namespace polhode
