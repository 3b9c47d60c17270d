// SPDX-License-Identifier: BSD-3-Clause
// Drifts of known kind: hardly a decided class is wrong, no growth is claimed of round-off, and what is clear is
// decided.
#include "experiments/study/metrics/drift_class.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <set>
#include <string>

namespace polhode::study::drift_class_test {
namespace {

using std::numbers::pi;

const std::set<std::string> growths = {"random walk", "sublinear", "linear", "quadratic", "faster"};

/// The same numbers from every standard library.
class Chance {
 public:
  explicit Chance(unsigned seed) : engine_(seed) {}
  double uniform(double from, double to) {
    return from + (to - from) * (static_cast<double>(engine_()) + 0.5) / 4294967296.0;
  }
  double logarithmic(double from, double to) { return std::exp(uniform(std::log(from), std::log(to))); }
  double normal() { return std::sqrt(-2 * std::log(uniform(0, 1))) * std::cos(2 * pi * uniform(0, 1)); }
  int below(int n) { return std::min(n - 1, static_cast<int>(uniform(0, n))); }
  bool one_in(int n) { return below(n) == 0; }
  double sign() { return one_in(2) ? 1 : -1; }

 private:
  std::mt19937 engine_;
};

/// A drift in terms of s = t/t_end, with the classes that are right.
struct Drift {
  std::string kind;
  std::set<std::string> right;
  bool clear = false;  ///< nothing stands in the way of deciding
  int samples = 0;
  double t_end = 1, round_off = 0;
  std::function<double(double)> law = [](double) { return 0.0; };
  double walk = 0;                ///< standard deviation at the end
  double noise = 0;               ///< standard deviation of the noise of each sample
  std::vector<double> impacts{};  ///< times of the impacts, over t_end
};

/// An oscillation of size 1, with `periods` in the run: a sine, a sine with a harmonic, or a row of pulses as a body
/// near its unstable axis has.
std::function<double(double)> oscillation(Chance& chance, double periods) {
  const double phase = chance.uniform(0, 2 * pi), sharp = chance.logarithmic(2, 30), other = chance.uniform(0, 2 * pi);
  switch (chance.below(3)) {
    case 0: return [=](double s) { return std::sin(2 * pi * periods * s + phase); };
    case 1:
      return [=](double s) {
        const double u = 2 * pi * periods * s + phase;
        return 0.8 * std::sin(u) + 0.3 * std::sin(2 * u + other);
      };
    default: return [=](double s) { return std::exp(sharp * (std::cos(2 * pi * periods * s + phase) - 1)); };
  }
}

std::function<double(double)> growth(Chance& chance, const std::string& kind) {
  if (kind == "linear") return [](double s) { return s; };
  if (kind == "quadratic") return [](double s) { return s * s; };
  if (kind == "sublinear") return [](double s) { return std::sqrt(s); };
  if (chance.one_in(2)) {
    const double p = chance.uniform(3, 4.5);
    return [p](double s) { return std::pow(s, p); };
  }
  const double rate = chance.uniform(4, 10);
  return [rate](double s) { return std::expm1(rate * s) / std::expm1(rate); };
}

Drift drift(const std::string& kind, Chance& chance) {
  Drift d{.kind = kind, .right = {kind}};
  const int lengths[] = {40, 64, 100, 300, 1000, 4000, 8000};
  d.samples = lengths[chance.below(7)];
  d.t_end = chance.logarithmic(0.1, 1e4);
  d.round_off = chance.logarithmic(1e-17, 1e-9);  // round-off of terms of 1 J
  const double most_periods = std::max(9.0, d.samples / 5.0);
  if (kind == "round-off") {
    if (chance.one_in(2)) {
      d.walk = d.round_off * chance.uniform(0.05, 0.6);  // now and then somewhat above the level
    } else {
      const double size = chance.sign() * d.round_off * chance.uniform(0.05, 0.95), p = chance.uniform(0.5, 4);
      d.law = [=](double s) { return size * std::pow(s, p); };
      d.noise = 0.02 * d.round_off;
    }
    d.clear = false;
    return d;
  }
  const double size = std::min(chance.sign() * d.round_off * chance.logarithmic(1, 1e8), 1e-2);
  const double above = std::abs(size) / d.round_off;
  if (above < 6) d.right.insert("round-off");
  d.walk = d.round_off * chance.uniform(0, 0.3);
  if (kind == "bounded") {
    const double periods = chance.logarithmic(0.8, most_periods), more = chance.logarithmic(0.8, most_periods);
    const auto one = oscillation(chance, periods), two = oscillation(chance, more);
    const double second = chance.one_in(2) ? 0 : chance.logarithmic(0.01, 1);
    d.law = [=](double s) { return size * (one(s) + second * two(s)); };
    if (chance.one_in(3)) d.noise = std::abs(size) * chance.logarithmic(1e-3, 0.3);
    d.clear = above > 100 && d.samples >= 100 && periods >= 8 && (more >= 8 || second == 0);
    return d;
  }
  if (kind == "swelling") {  // an oscillation whose size grows, and its mean, where it has one
    const double power = chance.uniform(1, 3), periods = chance.logarithmic(2, most_periods);
    d.right = {power < 1.5 ? "linear" : power < 2.5 ? "quadratic" : "faster"};
    const auto one = oscillation(chance, periods);
    d.law = [=](double s) { return size * std::pow(s, power) * one(s); };
    return d;
  }
  if (kind == "jumps") {
    const int count = 1 + chance.below(6);
    std::vector<double> heights;
    for (int i = 0; i < count; ++i)
      d.impacts.push_back(chance.uniform(0.05, 0.95)), heights.push_back(size * chance.uniform(0.3, 1));
    std::sort(d.impacts.begin(), d.impacts.end());
    d.law = [=, at = d.impacts](double s) {
      double sum = 0;
      for (std::size_t i = 0; i < at.size(); ++i) sum += s > at[i] ? heights[i] : 0;
      return sum;
    };
    d.clear = above > 100 && d.samples >= 100;
    return d;
  }
  if (kind == "saturated") {
    const double time = chance.logarithmic(0.02, 0.12);
    d.law = [=](double s) { return size * -std::expm1(-s / time); };
    d.clear = above > 100 && d.samples >= 64;
    return d;
  }
  // Growth with an oscillation of up to ten times its size.
  const bool alone = chance.one_in(3);
  const double periods = chance.logarithmic(2, most_periods), share = alone ? 0 : chance.logarithmic(0.01, 10);
  const auto beside = oscillation(chance, periods);
  if (kind == "random walk") {
    d.walk = std::abs(size);
    d.law = [=](double s) { return share * size * beside(s); };
    d.clear = above > 100 && d.samples >= 300 && (alone || (periods >= 8 && share < 1));
    return d;
  }
  if (kind == "stairs") {  // the bursts of a method that loses energy at each turn
    d.right.erase("stairs");
    d.right.insert("linear");
    const double steps = chance.logarithmic(3, 40), phase = chance.uniform(0, 1), steep = chance.uniform(0, 0.95);
    d.law = [=](double s) {
      const double u = 2 * pi * (steps * s + phase);
      return size * (s - steep * std::sin(u) / (2 * pi * steps) + 0.3 * std::min(share, 1.0) * beside(s));
    };
    d.clear = above > 100 && d.samples >= 100 && steps >= 8 && (alone || periods >= 8);
    return d;
  }
  const auto grows = growth(chance, kind);
  d.law = [=](double s) { return size * (grows(s) + share * beside(s)); };
  if (chance.one_in(3)) d.walk = std::max(d.walk, std::abs(size) * chance.logarithmic(1e-3, 0.1));
  if (chance.one_in(3)) d.noise = std::abs(size) * chance.logarithmic(1e-3, 0.1);
  d.clear = above > 100 && d.samples >= 100 && (alone || (periods >= 8 && share < 3)) && kind != "sublinear" &&
            kind != "faster";
  return d;
}

DriftRecord record_of(const Drift& d, Chance& chance) {
  DriftRecord r;
  BlockMeans blocks;
  double walk = 0, start = 0;
  for (int k = 0; k <= d.samples; ++k) {
    const double s = static_cast<double>(k) / d.samples;
    double value = d.law(s) + walk + d.noise * chance.normal();
    if (k == 0) start = value;
    value -= start;
    blocks.add(s * d.t_end, value);
    r.largest = std::max(r.largest, std::abs(value));
    if (2 * k <= d.samples) r.largest_early = r.largest;
    walk += d.walk * chance.normal() / std::sqrt(d.samples);
  }
  r.blocks = blocks.finish();
  r.round_off = d.round_off;
  r.scale = 1;
  r.samples = d.samples + 1;
  r.t_end = d.t_end;
  for (const double s : d.impacts) r.impacts.push_back(s * d.t_end);
  return r;
}

TEST(DriftClass, OfAThousandDriftsOfKnownKindIsHardlyEverWrong) {
  const char* kinds[] = {"round-off", "bounded", "bounded", "random walk", "linear",    "linear",  "quadratic",
                         "faster",    "jumps",   "stairs",  "sublinear",   "saturated", "swelling"};
  constexpr int drifts = 1000;
  int decided = 0, wrong = 0, clear = 0, clear_and_decided = 0, growth_from_round_off = 0;
  std::string which;
  for (int i = 0; i < drifts; ++i) {
    Chance chance(static_cast<unsigned>(i + 1));
    const Drift d = drift(kinds[i % 13], chance);
    const DriftRecord record = record_of(d, chance);
    const DriftClass c = classify(record);
    const bool told = c.name != "undecided",
               right = d.right.contains(c.name) || (record.largest <= record.round_off && c.name == "round-off");
    decided += told;
    wrong += told && !right;
    clear += d.clear;
    clear_and_decided += d.clear && told;
    growth_from_round_off += d.kind == "round-off" && growths.contains(c.name);
    if (told && !right) which += std::to_string(i) + " " + d.kind + " is called " + c.name + "\n";
  }
  EXPECT_LE(wrong, 0.02 * decided) << which;
  EXPECT_EQ(growth_from_round_off, 0) << which;
  EXPECT_GE(clear_and_decided, 0.6 * clear);
}

/// `law` over s = t/t_end at 4000 samples of a run of 10 s.
DriftRecord record_of(const std::function<double(double)>& law, double round_off, std::vector<double> impacts = {}) {
  Drift d{.kind = "", .right = {}, .samples = 4000, .t_end = 10, .round_off = round_off, .law = law};
  d.impacts = std::move(impacts);
  Chance chance(1);
  return record_of(d, chance);
}

double slow_and_linear(double s) { return 1e-6 * (s + 0.5 * std::sin(9 * s)); }
double quick(double s) { return 1e-6 * std::sin(300 * s); }

TEST(DriftClass, OfGrowthThatStandsLittleAboveRoundOffClaimsNoGrowth) {
  const auto line = [](double s) { return 1e-6 * s; };
  EXPECT_EQ(classify(record_of(line, 1e-8)).name, "linear");
  EXPECT_EQ(classify(record_of(line, 0.5e-6)).name, "undecided");
  const DriftClass c = classify(record_of(line, 1.1e-6));
  EXPECT_EQ(c.name, "round-off");
  EXPECT_FALSE(c.exponent || c.low || c.high || c.decided_after);
  EXPECT_TRUE(c.slope_half_width);
}

TEST(DriftClass, OfAnOscillationOnWhichRoundingWalksIsBounded) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Chance chance(seed);
    const Drift d{.kind = "", .right = {}, .samples = 4000, .t_end = 10, .round_off = 3e-8, .law = quick, .walk = 1e-8};
    const std::string name = classify(record_of(d, chance)).name;
    EXPECT_TRUE(name == "bounded" || name == "undecided") << name;
  }
}

TEST(DriftClass, OfAFewPeriodsHasTheDurationOfSix) {
  const DriftClass c = classify(record_of([](double s) { return 1e-6 * std::sin(2 * pi * 2.5 * s); }, 1e-12));
  EXPECT_EQ(c.name, "undecided");
  ASSERT_TRUE(c.decided_after);
  EXPECT_NEAR(*c.decided_after, 24, 7);
  const DriftClass decided = classify(record_of([](double s) { return 1e-6 * std::sin(2 * pi * 10 * s); }, 1e-12));
  EXPECT_EQ(decided.name, "bounded");
  EXPECT_FALSE(decided.decided_after);
  EXPECT_EQ(classify(record_of(slow_and_linear, 1e-12)).name, "undecided");
}

TEST(DriftClass, OfOneJumpAtAnImpactIsThatAndNoRandomWalk) {
  const auto jump = [](double s) { return s > 0.31 ? 1e-3 : 0; };
  EXPECT_EQ(classify(record_of(jump, 1e-12, {0.31})).name, "jumps");
  // The drift changes between its impacts too: neither class is decided.
  const auto both = [&](double s) { return jump(s) + 1e-3 * s; };
  EXPECT_EQ(classify(record_of(both, 1e-12, {0.31})).name, "undecided");
  // The same without an impact has come to rest; several are no walk.
  EXPECT_EQ(classify(record_of(jump, 1e-12)).name, "saturated");
  const auto jumps = [](double s) { return 1e-3 * ((s > 0.2) - (s > 0.45) + (s > 0.6) + (s > 0.9)); };
  EXPECT_EQ(classify(record_of(jumps, 1e-12)).name, "undecided");
}

TEST(DriftClass, OfTheSizeOfTheEnergyIsNoBoundedOne) {
  const auto rest = [](double s) { return -0.2 * std::expm1(-20 * s); };
  const DriftClass c = classify(record_of(rest, 1e-12));
  EXPECT_EQ(c.name, "saturated");
  EXPECT_FALSE(c.exponent || c.decided_after);
  EXPECT_EQ(classify(record_of([](double s) { return 0.7 * quick(s) / 1e-6; }, 1e-12)).name, "saturated");
  EXPECT_EQ(classify(record_of([](double s) { return 2 * s; }, 1e-12)).name, "linear");
}

TEST(DriftClass, OfAnOscillationThatSwellsIsNotBounded) {
  EXPECT_EQ(classify(record_of([](double s) { return s * s * quick(s); }, 1e-12)).name, "undecided");
}

TEST(DriftClass, OfTooFewSamplesHasTheDurationThatHasEnough) {
  DriftRecord r{.blocks = {{0, 0}, {1, 1}, {2, 2}, {3, 3}},
                .largest = 3,
                .largest_early = 1,
                .round_off = 0,
                .scale = 10,
                .samples = 4,
                .t_end = 3,
                .impacts = {}};
  const DriftClass c = classify(r);
  EXPECT_EQ(c.name, "undecided");
  EXPECT_DOUBLE_EQ(*c.decided_after, 24);
  r.round_off = 3;
  EXPECT_EQ(classify(r).name, "round-off");
}

}  // namespace
}  // namespace polhode::study::drift_class_test
