// SPDX-License-Identifier: BSD-3-Clause
// Bodies crowded in one place, whose pairs grow with the square of their number: refused before memory runs out.
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "collision/contact/contact_scene.hpp"
#include "collision/shapes/sphere.hpp"

namespace polhode::crowd_test {
namespace {

/// The message that refuses so many spheres in one place; empty: they are let pass.
std::string said_of(std::size_t count, const char* broad_phase) {
  Problem problem;
  problem.bodies.resize(count);
  problem.starts.resize(count);
  ContactScene scene(problem, std::vector<Collider>(count, {std::make_shared<Sphere>(1), 0, 0}), broad_phase, "gjk");
  const std::vector<Pose> poses(count);
  try {
    scene.near_pairs(poses, poses, {}, 0);
  } catch (const std::length_error& error) {
    return error.what();
  }
  return {};
}

TEST(Crowd, OfTooManyNearPairsIsRefused) {
  EXPECT_EQ(said_of(1000, "sweep_and_prune"), "");  // 499 500 pairs
  const std::string why = said_of(1500, "sweep_and_prune");
  for (const char* word : {"1000000 pairs", "1500 bodies", "set them apart"}) {
    EXPECT_NE(why.find(word), std::string::npos) << why;
  }
}

}  // namespace
}  // namespace polhode::crowd_test
