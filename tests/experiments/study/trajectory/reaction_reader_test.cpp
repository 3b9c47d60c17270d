// SPDX-License-Identifier: BSD-3-Clause
// Reactions beside a trajectory are read as they were written, and only if they are those of its instants.
#include "experiments/study/trajectory/reaction_reader.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "experiments/study/text/input_error.hpp"
#include "tests/temporary_folder.hpp"

namespace polhode::study::reaction_reader_test {
namespace {

using Forces = std::vector<Vector3<double>>;

class Reactions : public testing::Test {
 protected:
  Forces read(const std::string& text, const std::vector<double>& times, std::size_t joints) const {
    std::ofstream(folder_.path() / "reactions.csv") << text;
    return read_reactions(folder_.path(), times, joints);
  }
  TemporaryFolder folder_;
};

TEST_F(Reactions, AreReadByTheNamesOfTheirColumns) {
  EXPECT_EQ(read("joint,fz_N,fy_N,fx_N,t_s\n0,3,2,1,0\n1,6,5,4,0\n0,0,0,7,0.5\n1,0,8,0,0.5\n", {0, 0.5}, 2),
            (Forces{{1, 2, 3}, {4, 5, 6}, {7, 0, 0}, {0, 8, 0}}));
}

TEST_F(Reactions, OfOtherInstantsOrJointsAreNone) {
  const std::string one = "t_s,joint,fx_N,fy_N,fz_N\n0,0,1,2,3\n0.5,0,1,2,3\n";
  EXPECT_EQ(read(one, {0, 0.5}, 1).size(), 2u);
  EXPECT_TRUE(read(one, {0, 0.6}, 1).empty());
  EXPECT_TRUE(read(one, {0}, 1).empty());
  EXPECT_TRUE(read(one, {0, 0.5, 1}, 1).empty());
  EXPECT_TRUE(read(one, {0, 0.5}, 2).empty());
  EXPECT_TRUE(read(one, {0, 0.5}, 0).empty());
  EXPECT_TRUE(read_reactions(folder_.path() / "nowhere", std::vector{0.0}, 1).empty());
  EXPECT_THROW(read("t_s,joint,fx_N,fy_N\n0,0,1,2\n", {0}, 1), InputError);
}

}  // namespace
}  // namespace polhode::study::reaction_reader_test
