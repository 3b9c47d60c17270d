// SPDX-License-Identifier: BSD-3-Clause
// A force in the lanes of an ensemble, evaluated lane by lane: each lane has a force with parameters of its own. Every
// force works in lanes this way, even if it branches on its numbers, with the digits of a run alone.
#pragma once

#include <vector>

#include "core/forces/catalogue.hpp"
#include "core/math/lanes.hpp"
#include "core/problem/problem.hpp"

namespace polhode::inline core::inline forces {

class LaneForce final : public ForceModel<Lanes> {
 public:
  /// The k-th force of each problem; each problem has one body.
  LaneForce(std::span<const Problem> problems, std::size_t k) {
    for (const Problem& p : problems) forces_.push_back(make_force<double>(p.forces[k], p.bodies));
    rotation_ = forces_.front()->reads_rotation();
  }

  void add_wrench(Lanes t, std::span<const BodyMotion<Lanes>> bodies,
                  std::span<Wrench<Lanes>> wrenches) const override {
    for (int i = 0; i < lane_count; ++i) {
      const BodyMotion<double> body = motion(bodies.front(), i);
      Wrench<double> w = {lane(wrenches.front().force, i), lane(wrenches.front().torque, i)};
      force(i).add_wrench(t[i], {&body, 1}, {&w, 1});
      for (int k = 0; k < 3; ++k) {
        wrenches.front().force[k].set(i, w.force[k]);
        wrenches.front().torque[k].set(i, w.torque[k]);
      }
    }
  }

  Lanes potential_energy(std::span<const BodyMotion<Lanes>> bodies) const override {
    return gather<Lanes>([&](int i) {
      const BodyMotion<double> body = motion(bodies.front(), i);
      return force(i).potential_energy({&body, 1});
    });
  }

  bool does_work() const override { return forces_.front()->does_work(); }
  Lanes power(Lanes t, std::span<const BodyMotion<Lanes>> bodies) const override {
    return gather<Lanes>([&](int i) {
      const BodyMotion<double> body = motion(bodies.front(), i);
      return force(i).power(t[i], {&body, 1});
    });
  }

  bool internal() const override { return forces_.front()->internal(); }
  bool reads_rotation() const override { return rotation_; }
  bool reads_velocity() const override { return forces_.front()->reads_velocity(); }
  Effect effect_on(std::size_t body) const override { return forces_.front()->effect_on(body); }

 private:
  const ForceModel<double>& force(int i) const { return *forces_[std::size_t(i)]; }
  static Vector3<double> lane(const Vector3<Lanes>& v, int i) { return {v[0][i], v[1][i], v[2][i]}; }
  BodyMotion<double> motion(const BodyMotion<Lanes>& all, int i) const {
    BodyMotion<double> one;
    one.position = lane(all.position, i);
    one.velocity = lane(all.velocity, i);
    if (rotation_) {
      for (int k = 0; k < 9; ++k) one.rotation(k) = all.rotation(k)[i];
      one.angular_velocity = lane(all.angular_velocity, i);
    }
    return one;
  }

  std::vector<ForcePointer<double>> forces_;
  bool rotation_ = true;
};

}  // namespace polhode::core::forces
