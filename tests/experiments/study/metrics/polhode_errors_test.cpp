// SPDX-License-Identifier: BSD-3-Clause
// Polhode errors in lanes are those of each body alone, to the bit: in small steps and large ones, near the curve and
// far off it, and where only some lanes are due.
#include "experiments/study/metrics/polhode_errors.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/math/portable_random.hpp"
#include "tests/experiments/study/metrics/free_body.hpp"

namespace polhode::study::polhode_errors_test {
namespace {

/// A body with a top that it follows more or less.
struct Body {
  FreeTop top;
  PolhodeError in_lane, alone;
  double rate = 0, off = 0;  ///< by which the phase changes; relative distance from the polhode

  explicit Body(const Problem& problem)
      : top(problem.bodies[0].inertia, identity_quaternion<double>(), problem.starts[0].angular_velocity),
        in_lane(*PolhodeError::of(*make_system<double>(problem, {}), &top)),
        alone(*PolhodeError::of(*make_system<double>(problem, {}))) {}

  BodySnapshot<double> at(double t, PortableRandom& random) const {
    BodySnapshot<double> body{};
    body.rotation = random.rotation();
    const Vector3<double> omega = top.angular_velocity_body(t + rate * t);
    body.angular_velocity = body.rotation * (omega + off * omega.norm() * random.direction());
    if (random.chance(0.01)) body.angular_velocity[1] = std::numeric_limits<double>::infinity();
    return body;
  }
};

/// Compares errors at many times in lanes with those alone.
void expect_errors_of_bodies_alone(std::vector<Body> bodies, PortableRandom& random) {
  FreeTops tops;
  PolhodeErrors together;
  const auto in = [&](int lane) -> Body& { return bodies[std::size_t(lane)]; };
  for (int lane = 0; lane < lane_count; ++lane) {
    tops.set(lane, in(lane).top);
    together.set(std::size_t(lane), in(lane).in_lane);
  }
  Lanes t = 0;
  for (int n = 0; n < 60; ++n) {
    Lanes::Mask due(false);
    BodySnapshot<Lanes> all;
    std::array<BodySnapshot<double>, std::size_t(lane_count)> each;
    for (int lane = 0; lane < lane_count; ++lane) {
      due.bits[lane] = random.chance(0.8) ? -1 : 0;
      if (due.bits[lane]) t.set(lane, t[lane] + random.uniform(0, 0.3));
      each[std::size_t(lane)] = in(lane).at(t[lane], random);
      const BodySnapshot<double>& one = each[std::size_t(lane)];
      for (int k = 0; k < 9; ++k) all.rotation.data()[k].set(lane, one.rotation.data()[k]);
      for (int k = 0; k < 3; ++k) all.angular_velocity[k].set(lane, one.angular_velocity[k]);
    }
    const PolhodeErrors::At at = together.at(t, all, tops, tops.angular_velocity_body(t), due);
    for (int lane = 0; lane < lane_count; ++lane) {
      if (!due.bits[lane]) continue;
      Body& body = in(lane);
      const auto alone = body.alone.at(t[lane], each[std::size_t(lane)], body.top.angular_velocity_body(t[lane]));
      ASSERT_EQ(at.phase[lane], alone.phase) << lane << ", call " << n;
      ASSERT_EQ(at.phase_rad[lane], alone.phase_rad) << lane << ", call " << n;
      ASSERT_EQ(at.off[lane], alone.off) << lane << ", call " << n;
    }
  }
}

TEST(PolhodeErrors, AreThoseOfEachAlone) {
  PortableRandom random(1);
  const std::vector<Problem> kinds = {free_body({0.6, 0.8, 1.0}, {3, 0.5, -0.9}), free_body({2, 2, 1}, {1, 0, 3}),
                                      free_body({3, 5, 9}, {0, 0.4, 0.01 / 9}),  // near the separatrix
                                      free_body({1, 2, 2.25}, {0.75, 0.7, 1})};  // on it
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Body> bodies;
    for (int lane = 0; lane < lane_count; ++lane) {
      bodies.emplace_back(kinds[std::size_t(trial % 5 == 4 ? random.below(4) : trial % 5)]);
      bodies.back().rate = random.bell() * random.power_of_ten(-14, 0);
      bodies.back().off = random.power_of_ten(-15, -1);
    }
    expect_errors_of_bodies_alone(std::move(bodies), random);
  }
}

}  // namespace
}  // namespace polhode::study::polhode_errors_test
