// SPDX-License-Identifier: BSD-3-Clause
// Free tops in lanes move as each does alone, to the bit, whoever is beside them.
#include "core/exact/free_tops.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "core/math/portable_random.hpp"

namespace polhode::free_tops_test {
namespace {

FreeTop top_about(const Matrix3<double>& inertia, const Vector3<double>& omega) {
  return {inertia, Quaternion<double>(0.5, -0.1, 0.7, 0.5), omega};
}
FreeTop top(const Vector3<double>& moments, const Vector3<double>& omega) {
  return top_about(moments.asDiagonal(), omega);
}

/// Gives each lane one of the tops, from the first one on, and compares their motions with those alone.
void expect_motions_of_tops_alone(const std::vector<FreeTop>& all, PortableRandom& random) {
  FreeTops together;
  const auto in = [&](int lane) -> const FreeTop& { return all[std::size_t(lane) % all.size()]; };
  for (int lane = 0; lane < lane_count; ++lane) together.set(lane, in(lane));
  for (int n = 0; n < 200; ++n) {
    const Lanes t = gather<Lanes>(
        [&](int lane) { return n == 0 ? 0.0 : random.bell() * in(lane).period() * random.power_of_ten(-12, 3); });
    const TopAt<Lanes> motion = together.at(t);
    const Vector3<Lanes> omega = together.angular_velocity_body(t);
    for (int lane = 0; lane < lane_count; ++lane) {
      const double at = t[lane];
      if (!std::isfinite(at)) continue;  // the separatrix has no period
      const TopAt<double> alone = in(lane).at(at);
      for (int k = 0; k < 4; ++k) ASSERT_EQ(motion.orientation[k][lane], alone.orientation[k]) << lane << " at " << at;
      for (int k = 0; k < 3; ++k) {
        ASSERT_EQ(motion.angular_velocity_body[k][lane], alone.angular_velocity_body[k]) << lane << " at " << at;
        ASSERT_EQ(omega[k][lane], in(lane).angular_velocity_body(at)[k]) << lane << " at " << at;
      }
    }
  }
}

const FreeTop symmetric = top({2, 2, 1}, {1, 0, 3});
const FreeTop far = top({0.6, 0.8, 1.0}, {3, 0.5, -0.9});
const FreeTop near = top({3, 5, 9}, {1e-9, 0.4, 0.01 / 9});
const FreeTop nearer = top({1, 2, 3}, {1e-60, 1, 0});
/// Twice its energy times the intermediate moment is the square of its momentum.
const FreeTop separatrix = top({1, 2, 2.25}, {0.75, 0.7, 1});

TEST(FreeTops, MoveAsEachAlone) {
  PortableRandom random(1);
  ASSERT_EQ(separatrix.regime(), "separatrix");
  for (const std::vector<FreeTop>& all : std::vector<std::vector<FreeTop>>{{symmetric},
                                                                           {far},
                                                                           {near, nearer},
                                                                           {symmetric, far},
                                                                           {symmetric, near, far},
                                                                           {separatrix, near},
                                                                           {far, separatrix}}) {
    expect_motions_of_tops_alone(all, random);
  }
}

TEST(FreeTops, MoveAsEachAloneWhereverTheyStart) {
  PortableRandom random(2);
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<FreeTop> all;
    while (all.size() < std::size_t(lane_count)) {
      const double a = random.uniform(0.5, 1), b = random.uniform(0.5, 1), c = random.uniform(std::abs(a - b), a + b);
      const Matrix3<double> turn = trial % 2 == 0 ? random.rotation() : Matrix3<double>::Identity();
      const Matrix3<double> inertia = turn * Vector3<double>(a, b, c).asDiagonal() * turn.transpose();
      all.push_back(top_about(Matrix3<double>((inertia + inertia.transpose()) / 2),
                              random.power_of_ten(-2, 2) * random.direction()));
    }
    expect_motions_of_tops_alone(all, random);
  }
}

TEST(FreeTops, TakeATopInPlaceOfAnother) {
  FreeTops tops;
  for (int lane = 0; lane < lane_count; ++lane) tops.set(lane, separatrix);
  for (int lane = 0; lane < lane_count; ++lane) tops.set(lane, far);
  tops.set(0, near);
  tops.set(lane_count - 1, symmetric);
  const TopAt<Lanes> motion = tops.at(2);
  EXPECT_EQ(motion.orientation[1][0], near.at(2).orientation[1]);
  EXPECT_EQ(motion.orientation[1][lane_count - 1], symmetric.at(2).orientation[1]);
}

TEST(FreeTops, RefuseATopOfConstantAngularVelocity) {
  FreeTops tops;
  EXPECT_THROW(tops.set(0, top({1, 2, 3}, {0, 0, 1})), std::invalid_argument);
}

}  // namespace
}  // namespace polhode::free_tops_test
