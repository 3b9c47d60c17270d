// SPDX-License-Identifier: BSD-3-Clause
// A motion computed in extended precision, for problems without an exact solution. It proves its own digits: it is
// computed with ever smaller steps, and its uncertainty is the change made by the last halving of the step.
// Source: Gragg's extrapolated midpoint rule (Hairer, Nørsett & Wanner, Solving Ordinary Differential Equations I, 2nd
// ed., section II.9), of order 16, in long double.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <vector>

#include "core/exact/exact_motion.hpp"
#include "core/system/system.hpp"

namespace polhode::inline core::inline exact {

class ReferenceMotion {
 public:
  /// Computes the motion from t = 0 to t_end (s); `gyroscopic`: by the equations with the gyroscopic term. Refines
  /// until round-off is reached or some seconds have passed; with `stop` set it returns at once, with the uncertainty
  /// reached so far. `prepare` adds forces beyond those of the problem.
  ReferenceMotion(const Problem& problem, bool gyroscopic, double t_end, const std::atomic<bool>* stop = nullptr,
                  std::function<void(System<long double>&)> prepare = {});

  /// The largest change by the last halving, over the bodies, at 50 instants and the end; +inf if a motion could not be
  /// followed.
  struct Uncertainty {
    double position = 0;          ///< m
    double attitude = 0;          ///< rad
    double angular_velocity = 0;  ///< angular velocity, over the largest |ω| at the start
    double largest() const;
  };
  const Uncertainty& uncertainty() const { return uncertainty_; }

  /// Follows one run, forwards in time, and measures its distance from the reference. Use one Follower per thread.
  class Follower {
   public:
    explicit Follower(std::shared_ptr<const ReferenceMotion> reference);
    /// The reference's system, and its state at t (s).
    const System<long double>& system() const { return *system_; }
    const VectorX<long double>& at(double t);
    /// All errors: position (absent if every body is pinned), attitude, angular velocity.
    ExactMotion::Error error(const System<double>& system, const State<double>& state);

   private:
    std::shared_ptr<const ReferenceMotion> reference_;
    std::unique_ptr<System<long double>> system_;
    VectorX<long double> y_;
    double t_ = 0;
  };

 private:
  using Flat = VectorX<long double>;
  static constexpr int intervals = 50;

  std::unique_ptr<System<long double>> make() const;
  double instant(std::size_t k) const { return static_cast<double>(k) * t_end_ / intervals; }
  /// The states at the instants, with `steps` steps between two of them; fewer states if they cease to be finite.
  std::vector<Flat> march(const System<long double>& system, int steps, const std::atomic<bool>* stop) const;
  Uncertainty difference(const System<long double>& system, const std::vector<Flat>& a,
                         const std::vector<Flat>& b) const;

  Problem problem_;
  bool gyroscopic_;
  std::function<void(System<long double>&)> prepare_;
  double t_end_;
  double speed_scale_ = 1;  ///< rad/s
  int steps_ = 1;           ///< steps between two instants
  std::vector<Flat> states_;
  Uncertainty uncertainty_;
};

}  // namespace polhode::core::exact
