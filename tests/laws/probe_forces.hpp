// SPDX-License-Identifier: BSD-3-Clause
// Forces that no scenario can name, made to probe integrators: one that depends on time, one that counts, one that
// breaks. They act on every moving body.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "core/problem/force.hpp"

namespace polhode::laws {

/// A force and a torque that vary smoothly with time, fixed in the world: what makes a problem non-autonomous.
template <class S>
class Shaking final : public ForceModel<S> {
 public:
  explicit Shaking(std::size_t moving) : moving_(moving) {}

  void add_wrench(S t, std::span<const BodyMotion<S>>, std::span<Wrench<S>> wrenches) const override {
    for (std::size_t i = 0; i < moving_; ++i) {
      wrenches[i].force += force(t);
      wrenches[i].torque += torque(t);
    }
  }
  bool does_work() const override { return true; }
  S power(S t, std::span<const BodyMotion<S>> bodies) const override {
    S p(0);
    for (std::size_t i = 0; i < moving_; ++i) {
      p += force(t).dot(bodies[i].velocity) + torque(t).dot(bodies[i].angular_velocity);
    }
    return p;
  }
  Effect effect_on(std::size_t) const override { return {true, std::nullopt}; }

 private:
  static Vector3<S> force(S t) {
    using std::cos, std::sin;
    return Vector3<S>(sin(S(4) * t), cos(S(3) * t), S(2) * t);
  }
  static Vector3<S> torque(S t) {
    using std::cos, std::sin;
    return Vector3<S>(S(2) * cos(S(5) * t), S(1) - S(3) * t, sin(S(3) * t) - S(1));
  }
  std::size_t moving_;
};

/// Does nothing but count how often a wrench is requested, which is once for every right-hand side.
template <class S>
class Counting final : public ForceModel<S> {
 public:
  explicit Counting(std::int64_t& count) : count_(count) {}
  void add_wrench(S, std::span<const BodyMotion<S>>, std::span<Wrench<S>>) const override { ++count_; }
  Effect effect_on(std::size_t) const override { return {}; }

 private:
  std::int64_t& count_;
};

/// Nothing until a time, then a torque that is no number.
template <class S>
class Breaking final : public ForceModel<S> {
 public:
  Breaking(std::size_t moving, double after) : moving_(moving), after_(S(after)) {}
  void add_wrench(S t, std::span<const BodyMotion<S>>, std::span<Wrench<S>> wrenches) const override {
    if (!(t > after_)) return;
    for (std::size_t i = 0; i < moving_; ++i) wrenches[i].torque.setConstant(std::numeric_limits<S>::quiet_NaN());
  }
  Effect effect_on(std::size_t) const override { return {true, std::nullopt}; }

 private:
  std::size_t moving_;
  S after_;
};

}  // namespace polhode::laws
