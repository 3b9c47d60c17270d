// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/text/aligned.hpp"

#include <gtest/gtest.h>

namespace polhode::study::aligned_test {
namespace {

TEST(Aligned, ColumnsAreAsWideAsTheirLongestCell) {
  EXPECT_EQ(aligned({{"method", "ω"}, {"rk4", "10"}}, {true, false}), "method   ω\nrk4     10\n");
}

TEST(Aligned, NoLineEndsInBlanks) { EXPECT_EQ(aligned({{"a", ""}, {"bb", ""}}, {true, true}), "a\nbb\n"); }

// The sanitizers find a read before the text here.
TEST(Aligned, ALineOfEmptyCellsIsEmpty) {
  EXPECT_EQ(aligned({{"", ""}, {"a", "b"}}, {true, true}), "\na  b\n");
  EXPECT_EQ(aligned({{}}, {}), "\n");
}

}  // namespace
}  // namespace polhode::study::aligned_test
