// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plan/distribution.hpp"

#include <Random123/philox.h>
#include <fmt/format.h>
#include <xxhash.h>

#include <Random123/uniform.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "experiments/study/plan/assignments.hpp"
#include "experiments/study/plan/axis_values.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/suggestion.hpp"
#include "experiments/study/text/value_lists.hpp"

namespace polhode::study::inline plan {
namespace {

using Number = std::function<double(PointRandom&)>;

constexpr double largest_whole = 0x1p52;  // integers are drawn from one number of 53 bits

/// ratio^exponent for exponents in (0, 1) with 53 binary places: the product of the square roots of square roots.
/// Not std::pow, whose last digit differs between C libraries. Relative error below 1e-14.
class Powers {
 public:
  explicit Powers(double ratio) {
    for (double& root : roots_) root = ratio = std::sqrt(ratio);
  }
  double operator()(double exponent) const {
    double product = 1;
    for (std::size_t k = 0; exponent > 0; ++k) {
      exponent *= 2;
      if (exponent < 1) continue;
      product *= roots_[k];
      exponent -= 1;
    }
    return product;
  }

 private:
  std::array<double, 53> roots_;  // the square root of the ratio, the square root of that, …
};

/// Standard normal distribution by the ratio of uniforms (Kinderman & Monahan, ACM TOMS 3, 1977). The logarithm decides
/// only whether a value is kept: another last digit of it changes a value with a probability below 1e-15.
double standard_normal(PointRandom& random) {
  constexpr double width = 1.7155277699214135;  // sqrt(8/e)
  for (;;) {
    const double u = random.uniform(), x = width * (random.uniform() - 0.5) / u;
    if (x * x <= -4 * std::log(u)) return x;
  }
}

/// A point of the unit sphere, uniformly distributed (Marsaglia, Ann. Math. Stat. 43, 1972).
std::string point_of_sphere(PointRandom& random, double radius) {
  for (;;) {
    const double a = 2 * random.uniform() - 1, b = 2 * random.uniform() - 1, s = a * a + b * b;
    if (s >= 1) continue;
    const double r = 2 * radius * std::sqrt(1 - s);
    return fmt::format("[{}, {}, {}]", exact(a * r), exact(b * r), exact(radius * (1 - 2 * s)));
  }
}

/// A distribution as text, taken apart.
struct Call {
  std::string name;
  std::vector<std::string> arguments;
};

Call call_of(const std::string& text, const std::string& label) {
  std::vector<std::string_view> known;
  for (const DistributionKind& kind : distribution_kinds()) known.push_back(kind.name);
  const auto open = text.find('(');
  const std::string name = text.substr(0, open);
  if (std::find(known.begin(), known.end(), name) == known.end()) {
    throw InputError(label + ": '" + name + "' is no distribution" + suggestion(name, "There are", known) +
                     ", as in uniform(0.5, 3)");
  }
  if (open == std::string::npos || !text.ends_with(')')) {
    throw InputError(label + ": '" + text + "' is no distribution; write the parameters in brackets, as in " +
                     "uniform(0.5, 3)");
  }
  return {name, split_outside_brackets(std::string_view(text).substr(open + 1, text.size() - open - 2), ',')};
}

std::vector<double> parameters_of(const Call& call, const std::string& label) {
  const auto& kinds = distribution_kinds();
  const auto kind = std::find_if(kinds.begin(), kinds.end(), [&](const auto& k) { return k.name == call.name; });
  const auto refuse = [&](const std::string& what) {
    throw InputError(fmt::format("{}: {}; it is {}({})", label, what, call.name, fmt::join(kind->parameters, ", ")));
  };
  if (call.arguments.size() != kind->parameters.size())
    refuse(fmt::format("{} parameters of {}", call.arguments.size(), call.name));
  std::vector<double> numbers;
  for (const std::string& argument : call.arguments) {
    const auto x = to_number(argument);
    if (!x) refuse("'" + argument + "' is not a finite number");
    numbers.push_back(*x);
  }
  return numbers;
}

Number number_of(const Call& call, const std::string& label) {
  const std::vector<double> p = parameters_of(call, label);
  const auto need = [&](bool fits, const char* what) {
    if (!fits) throw InputError(label + ": " + call.name + ": " + what);
  };
  if (call.name == "normal") {
    need(p[1] > 0, "the deviation must be positive");
    return [p](PointRandom& random) { return p[0] + p[1] * standard_normal(random); };
  }
  need(p[0] < p[1], "the first number must be below the second");
  need(std::isfinite(p[1] - p[0]), "the numbers are too far apart");
  if (call.name == "uniform") return [p](PointRandom& random) { return p[0] + (p[1] - p[0]) * random.uniform(); };
  if (call.name == "log_uniform") {
    need(p[0] > 0, "both numbers must be positive");
    need(std::isfinite(p[1] / p[0]), "the second number must be less than 1e308 times the first");
    return [from = p[0], powers = Powers(p[1] / p[0])](PointRandom& random) { return from * powers(random.uniform()); };
  }
  need(p[0] == std::floor(p[0]) && p[1] == std::floor(p[1]), "both numbers must be whole");
  need(p[1] - p[0] < largest_whole && std::abs(p[0]) < largest_whole && std::abs(p[1]) < largest_whole,
       "the numbers must be below 4.5e15");
  return [p](PointRandom& random) { return p[0] + std::floor((p[1] - p[0] + 1) * random.uniform()); };
}

/// The values of choice(…).
std::vector<OptionValue> values_of(const Call& call, const RunOption* option, const std::string& label) {
  std::vector<OptionValue> values;
  for (const std::string& argument : call.arguments) {
    if (option) {
      for (OptionValue& value : option_values(*option, argument, label)) values.push_back(std::move(value));
    } else {
      for (std::string& value : toml_values(argument, label)) values.emplace_back(std::move(value));
    }
  }
  return values;
}

}  // namespace

const std::vector<DistributionKind>& distribution_kinds() {
  static const std::vector<DistributionKind> kinds = {
      {"uniform", {"from", "to"}}, {"log_uniform", {"from", "to"}}, {"normal", {"mean", "deviation"}},
      {"integer", {"from", "to"}}, {"choice", {"values"}},          {"sphere", {"radius"}}};
  return kinds;
}

PointRandom::PointRandom(std::uint64_t seed, std::string_view key, std::uint32_t point)
    : seed_(seed), key_(XXH3_64bits(key.data(), key.size())), point_(point) {}

double PointRandom::uniform() {
  if (next_ > 0) return std::exchange(next_, 0);
  const auto low = [](std::uint64_t x) { return static_cast<std::uint32_t>(x); };
  const auto high = [](std::uint64_t x) { return static_cast<std::uint32_t>(x >> 32); };
  const r123::Philox4x32::ctr_type counter = {{point_, block_++, low(key_), high(key_)}};
  const r123::Philox4x32::key_type key = {{low(seed_), high(seed_)}};
  const auto words = r123::Philox4x32()(counter, key);
  const auto number = [&](std::size_t i) {
    return r123::u01fixedpt<double>(std::uint64_t{words[i]} | std::uint64_t{words[i + 1]} << 32);
  };
  next_ = number(2);
  return number(0);
}

Distribution Distribution::parse(const std::string& text, const RunOption* option, const std::string& label) {
  const Call call = call_of(text, label);
  Distribution distribution;
  if (call.name == "choice") {
    distribution.choices_ = std::make_shared<const std::vector<OptionValue>>(values_of(call, option, label));
  } else if (option && (option->kind == RunOption::Kind::name || call.name == "sphere")) {
    throw InputError(fmt::format(
        "{}: {} makes {}; {}", label, call.name, call.name == "sphere" ? "vectors, which no option takes" : "numbers",
        option->kind == RunOption::Kind::name ? "name the values, as in choice(a, b)" : "take another distribution"));
  } else if (option && option->kind == RunOption::Kind::whole && call.name != "integer") {
    throw InputError(fmt::format("{}: {} makes numbers that are not whole; take integer(from, to)", label, call.name));
  } else if (call.name == "sphere") {
    const double radius = parameters_of(call, label)[0];
    if (!(radius > 0)) throw InputError(label + ": sphere: the radius must be positive");
    distribution.text_ = [radius](PointRandom& random) { return point_of_sphere(random, radius); };
  } else {
    distribution.number_ = number_of(call, label);
    if (option) distribution.value_of_number_ = [option, label](double x) { return option_value(*option, x, label); };
    else distribution.value_of_number_ = [](double x) -> OptionValue { return exact(x); };
  }
  return distribution;
}

OptionValue Distribution::draw(std::uint64_t seed, std::string_view key, std::uint32_t point) const {
  if (const auto x = number(seed, key, point)) return value_of_number_(*x);
  if (choices_) return (*choices_)[choice(seed, key, point)];
  PointRandom random(seed, key, point);
  return text_(random);
}

std::optional<double> Distribution::number(std::uint64_t seed, std::string_view key, std::uint32_t point) const {
  if (!number_) return std::nullopt;
  PointRandom random(seed, key, point);
  return number_(random);
}

std::size_t Distribution::choice(std::uint64_t seed, std::string_view key, std::uint32_t point) const {
  const double count = choices_ ? static_cast<double>(choices_->size()) : 0;
  return static_cast<std::size_t>(count * PointRandom(seed, key, point).uniform());
}

}  // namespace polhode::study::plan
