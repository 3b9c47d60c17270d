// SPDX-License-Identifier: BSD-3-Clause
// Random points of a study: the same bits everywhere, distributed as they say, and none changed by further points.
#include "experiments/study/plan/distribution.hpp"

#include <Random123/philox.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/value_lists.hpp"

namespace polhode::study::distribution_tests::distribution_test {
namespace {

using ::testing::HasSubstr;

std::string drawn(const std::string& distribution, std::uint32_t point, std::uint64_t seed = 7,
                  const std::string& key = "body.0.inertia.0") {
  return text_of(Distribution::parse(distribution, nullptr, "here").draw(seed, key, point));
}

std::vector<double> numbers_of(const std::string& distribution, std::uint32_t n) {
  std::vector<double> all;
  for (std::uint32_t point = 0; point < n; ++point) all.push_back(to_number(drawn(distribution, point)).value());
  return all;
}

std::string error_of(const std::string& distribution, const RunOption* option = nullptr) {
  try {
    Distribution::parse(distribution, option, "here").draw(1, "dt", 0);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

/// Largest distance of the distribution function of the sample from that of uniform(0, 1) (Kolmogorov).
double distance_from_uniform(std::vector<double> sample) {
  std::sort(sample.begin(), sample.end());
  double largest = 0;
  const double n = static_cast<double>(sample.size());
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const double below = static_cast<double>(i) / n;
    largest = std::max({largest, sample[i] - below, below + 1 / n - sample[i]});
  }
  return largest;
}

TEST(Distribution, TheGeneratorIsPhilox) {
  // The known answers of the Random123 distribution, file kat_vectors.
  using Philox = r123::Philox4x32;
  const auto words = [](Philox::ctr_type counter, Philox::key_type key) {
    const auto x = Philox()(counter, key);
    return std::vector<std::uint32_t>(x.begin(), x.end());
  };
  EXPECT_THAT(words({{0, 0, 0, 0}}, {{0, 0}}), ::testing::ElementsAre(0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8));
  EXPECT_THAT(words({{~0U, ~0U, ~0U, ~0U}}, {{~0U, ~0U}}),
              ::testing::ElementsAre(0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd));
  EXPECT_THAT(words({{0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}}, {{0xa4093822, 0x299f31d0}}),
              ::testing::ElementsAre(0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1));
}

TEST(Distribution, DrawsArePinned) {
  const std::map<std::string, std::vector<std::string>> pinned = {
      {"uniform(0.5, 3)", {"2.0204705826528766", "1.209939132765839", "0.686233892965282", "2.2896879809004176"}},
      {"log_uniform(1e-2, 1)",
       {"0.16457977570698462", "0.03697867163816711", "0.014092469850849706", "0.270240468239872"}},
      {"normal(10, 2)", {"12.803824884951872", "14.003437113447788", "3.6384547960934084", "11.025933972629257"}},
      {"integer(1, 1000000)", {"608189", "283976", "74494", "715876"}},
      {"sphere(3)",
       {"[0.11456802970663736, -2.4700528838966016, -1.6987386253697834]",
        "[-1.5856775063381976, 2.432195801775617, -0.7550168393606473]",
        "[-2.2804771431981465, -0.740241050958831, -1.8031825159495598]",
        "[2.0566539240588284, 2.039329759219665, 0.7818623726810792]"}},
      {"choice(a, b, c)", {"\"b\"", "\"a\"", "\"a\"", "\"c\""}},
  };
  for (const auto& [distribution, values] : pinned) {
    for (std::uint32_t point = 0; point < values.size(); ++point)
      EXPECT_EQ(drawn(distribution, point), values[point]) << distribution << ", point " << point;
  }
}

TEST(Distribution, APointDependsOnSeedKeyAndNumber) {
  const std::string here = drawn("uniform(0, 1)", 3);
  EXPECT_EQ(drawn("uniform(0, 1)", 3), here);
  EXPECT_NE(drawn("uniform(0, 1)", 4), here);
  EXPECT_NE(drawn("uniform(0, 1)", 3, 8), here);
  EXPECT_NE(drawn("uniform(0, 1)", 3, 7ULL | 1ULL << 40), here) << "all 64 bits of the seed count";
  EXPECT_NE(drawn("uniform(0, 1)", 3, 7, "body.0.inertia.1"), here);
}

TEST(Distribution, NumbersAreDistributedAsTheySay) {
  constexpr std::uint32_t n = 20000;
  constexpr double limit = 0.0138;  // exceeded with probability 0.001 at n = 20000: 1.95/sqrt(n)
  std::vector<double> x = numbers_of("uniform(-1, 3)", n);
  for (double& value : x) value = (value + 1) / 4;
  EXPECT_LT(distance_from_uniform(x), limit);
  x = numbers_of("log_uniform(1e-4, 1e2)", n);
  for (double& value : x) value = (std::log10(value) + 4) / 6;
  EXPECT_LT(distance_from_uniform(x), limit);
  x = numbers_of("normal(10, 2)", n);
  for (double& value : x) value = std::erfc((10 - value) / 2 / std::sqrt(2)) / 2;
  EXPECT_LT(distance_from_uniform(x), limit);
}

TEST(Distribution, IntegersAndChoicesReachBothEnds) {
  std::map<std::string, int> counts;
  for (std::uint32_t point = 0; point < 6000; ++point) ++counts[drawn("integer(-1, 1)", point)];
  EXPECT_EQ(counts.size(), 3U);
  for (const char* value : {"-1", "0", "1"}) EXPECT_NEAR(counts[value], 2000, 150) << value;
  counts.clear();
  for (std::uint32_t point = 0; point < 6000; ++point) ++counts[drawn("choice([1, 0, 0], [0, 1, 0])", point)];
  EXPECT_EQ(counts.size(), 2U);
  EXPECT_NEAR(counts["[1, 0, 0]"], 3000, 200);
}

TEST(Distribution, DirectionsOfASphereAreUniform) {
  std::vector<double> height[3];
  for (std::uint32_t point = 0; point < 20000; ++point) {
    const std::string text = drawn("sphere(3)", point);
    double x[3];
    ASSERT_EQ(std::sscanf(text.c_str(), "[%lf, %lf, %lf]", &x[0], &x[1], &x[2]), 3) << text;
    ASSERT_NEAR(std::hypot(x[0], x[1], x[2]), 3, 1e-14);
    for (int i = 0; i < 3; ++i) height[i].push_back((x[i] / 3 + 1) / 2);  // uniform, as Archimedes knew
  }
  for (const auto& sample : height) EXPECT_LT(distance_from_uniform(sample), 0.0138);
}

TEST(Distribution, LogUniformEndsAreItsOwn) {
  for (const double x : numbers_of("log_uniform(1e-300, 1e-299)", 1000)) {
    EXPECT_GE(x, 1e-300);
    EXPECT_LE(x, 1e-299 * (1 + 1e-14));
  }
}

TEST(Distribution, ErrorsSayWhatIsRight) {
  EXPECT_THAT(error_of("unifrom(1, 2)"), HasSubstr("here: 'unifrom' is no distribution; did you mean 'uniform'?"));
  EXPECT_THAT(error_of("uniform"), HasSubstr("write the parameters in brackets"));
  EXPECT_THAT(error_of("uniform(1)"), HasSubstr("it is uniform(from, to)"));
  EXPECT_THAT(error_of("uniform(1, big)"), HasSubstr("'big' is not a finite number"));
  EXPECT_THAT(error_of("uniform(2, 1)"), HasSubstr("below the second"));
  EXPECT_THAT(error_of("uniform(-1e308, 1e308)"), HasSubstr("too far apart"));
  EXPECT_THAT(error_of("log_uniform(0, 1)"), HasSubstr("must be positive"));
  EXPECT_THAT(error_of("normal(0, 0)"), HasSubstr("deviation must be positive"));
  EXPECT_THAT(error_of("integer(0.5, 3)"), HasSubstr("whole"));
  EXPECT_THAT(error_of("sphere(-1)"), HasSubstr("radius must be positive"));
  EXPECT_THAT(error_of("uniform(-2, -1)", &run_option("dt")), HasSubstr("is not positive"));
  EXPECT_THAT(error_of("uniform(1, 2)", &run_option("integrator")), HasSubstr("choice(a, b)"));
  EXPECT_THAT(error_of("choice(rk4, rk44)", &run_option("integrator")), HasSubstr("no 'rk44'"));
  EXPECT_THAT(error_of("sphere(1)", &run_option("dt")), HasSubstr("no option takes"));
  EXPECT_THAT(error_of("uniform(1.2, 1.4)", &run_option("samples")), HasSubstr("take integer(from, to)"));
}

}  // namespace
}  // namespace polhode::study::distribution_tests::distribution_test
