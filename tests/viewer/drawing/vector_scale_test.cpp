// SPDX-License-Identifier: BSD-3-Clause
// The scale of arrows stays while it can.
#include "experiments/viewer/drawing/vector_scale.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace polhode::viewer::vector_scale_test {
namespace {

TEST(VectorScale, StaysUntilALengthIsFarBeyondIt) {
  VectorScale scale;
  EXPECT_EQ(scale.share(3), 0);
  scale.see(4);
  EXPECT_EQ(scale.share(4), 1);
  scale.see(1);
  scale.see(5.9);
  EXPECT_EQ(scale.share(2), 0.5);
  scale.see(6.1);
  EXPECT_EQ(scale.share(4), 0.5);
  scale.see(std::numeric_limits<double>::infinity());
  scale.see(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(scale.share(4), 0.5);
}

}  // namespace
}  // namespace polhode::viewer::vector_scale_test
