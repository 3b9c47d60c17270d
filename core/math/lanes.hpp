// SPDX-License-Identifier: BSD-3-Clause
// A pack of doubles that stands for a scalar: one number of each of several independent copies of a system, side by
// side in a SIMD register. The templates of the mechanics and of the methods take it as their scalar, and every lane
// gets the digits that a double would: +, −, ×, ÷ and √ are correctly rounded lane by lane, other functions are called
// for each lane. Where a scalar would branch, `select` chooses in each lane.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>

#if defined(__AVX__)
#include <immintrin.h>
#endif

namespace polhode::inline core::inline math {

/// Number of lanes: the width of the SIMD registers that the program is compiled for.
#if defined(__AVX512F__)
inline constexpr int lane_count = 8;
#elif defined(__AVX__)
inline constexpr int lane_count = 4;
#else
inline constexpr int lane_count = 2;
#endif

class Lanes {
 public:
  using Pack [[gnu::vector_size(lane_count * sizeof(double))]] = double;
  using Bits [[gnu::vector_size(lane_count * sizeof(double))]] = std::int64_t;

  /// One truth value for each lane.
  struct Mask {
    Bits bits;
    Mask() = default;
    explicit Mask(bool everywhere) : bits(Bits{} - std::int64_t(everywhere)) {}
    explicit Mask(Bits b) : bits(b) {}
    friend Mask operator&(Mask a, Mask b) { return Mask(a.bits & b.bits); }
    friend Mask operator|(Mask a, Mask b) { return Mask(a.bits | b.bits); }
    friend Mask operator!(Mask a) { return Mask(~a.bits); }
    friend bool any(Mask a) {
#if defined(__AVX512F__)
      return _mm512_test_epi64_mask(__m512i(a.bits), __m512i(a.bits)) != 0;
#elif defined(__AVX__)
      return !_mm256_testz_si256(__m256i(a.bits), __m256i(a.bits));
#else
      bool found = false;
      for (int i = 0; i < lane_count; ++i) found |= a.bits[i] != 0;
      return found;
#endif
    }
  };

  Lanes() = default;
  Lanes(double everywhere) : pack_(everywhere - Pack{}) {}  // NOLINT: a number is a pack of itself
  explicit Lanes(Pack pack) : pack_(pack) {}

  double operator[](int lane) const { return pack_[lane]; }
  void set(int lane, double x) { pack_[lane] = x; }

  Lanes& operator+=(Lanes b) { return *this = *this + b; }
  Lanes& operator-=(Lanes b) { return *this = *this - b; }
  Lanes& operator*=(Lanes b) { return *this = *this * b; }
  Lanes& operator/=(Lanes b) { return *this = *this / b; }
  friend Lanes operator-(Lanes a) { return Lanes(-a.pack_); }
  friend Lanes operator+(Lanes a, Lanes b) { return Lanes(a.pack_ + b.pack_); }
  friend Lanes operator-(Lanes a, Lanes b) { return Lanes(a.pack_ - b.pack_); }
  friend Lanes operator*(Lanes a, Lanes b) { return Lanes(a.pack_ * b.pack_); }
  friend Lanes operator/(Lanes a, Lanes b) { return Lanes(a.pack_ / b.pack_); }
  friend Mask operator<(Lanes a, Lanes b) { return Mask(Bits(a.pack_ < b.pack_)); }
  friend Mask operator>(Lanes a, Lanes b) { return Mask(Bits(a.pack_ > b.pack_)); }
  friend Mask operator<=(Lanes a, Lanes b) { return Mask(Bits(a.pack_ <= b.pack_)); }
  friend Mask operator>=(Lanes a, Lanes b) { return Mask(Bits(a.pack_ >= b.pack_)); }

  friend Lanes select(Mask where, Lanes a, Lanes b) { return Lanes(where.bits ? a.pack_ : b.pack_); }
  friend Lanes abs(Lanes a) { return Lanes(Pack(Bits(a.pack_) & (Bits{} + std::numeric_limits<std::int64_t>::max()))); }
  friend Lanes sqrt(Lanes a) {
#if defined(__AVX512F__)
    return Lanes(Pack(_mm512_maskz_sqrt_pd(0xff, a.pack_)));
#elif defined(__AVX__)
    return Lanes(Pack(_mm256_sqrt_pd(a.pack_)));
#else
    return each(a, [](double x) { return std::sqrt(x); });
#endif
  }
  friend Lanes sin(Lanes a) {
    return each(a, [](double x) { return std::sin(x); });
  }
  friend Lanes cos(Lanes a) {
    return each(a, [](double x) { return std::cos(x); });
  }
  friend Lanes tan(Lanes a) {
    return each(a, [](double x) { return std::tan(x); });
  }
  friend Lanes exp(Lanes a) {
    return each(a, [](double x) { return std::exp(x); });
  }
  friend Lanes nearbyint(Lanes a) {
    return each(a, [](double x) { return std::nearbyint(x); });
  }
  friend Lanes atan2(Lanes y, Lanes x) {
    for (int i = 0; i < lane_count; ++i) y.pack_[i] = std::atan2(y.pack_[i], x.pack_[i]);
    return y;
  }
  friend Lanes copysign(Lanes size, Lanes sign) {
    const Bits without_sign = Bits{} + std::numeric_limits<std::int64_t>::max();
    return Lanes(Pack((Bits(size.pack_) & without_sign) | (Bits(sign.pack_) & ~without_sign)));
  }

 private:
  template <class F>
  static Lanes each(Lanes a, F f) {
    for (int i = 0; i < lane_count; ++i) a.pack_[i] = f(a.pack_[i]);
    return a;
  }

  Pack pack_;
};

template <class S>
inline constexpr bool is_lanes = std::same_as<S, Lanes>;

/// The number type of one lane; for a plain scalar, the scalar itself.
template <class S>
struct LaneType {
  using type = S;
  using Mask = bool;
};
template <>
struct LaneType<Lanes> {
  using type = double;
  using Mask = Lanes::Mask;
};
template <class S>
inline constexpr auto rounding_unit = std::numeric_limits<typename LaneType<S>::type>::epsilon();

/// Overloads of select and any for plain scalars, so that templates work with both.
template <std::floating_point S>
S select(bool where, S a, S b) {
  return where ? a : b;
}
inline bool any(bool a) { return a; }

/// Each component of a where the condition holds, else that of b.
template <class S, int n>
Eigen::Matrix<S, n, 1> select(typename LaneType<S>::Mask where, const Eigen::Matrix<S, n, 1>& a,
                              const Eigen::Matrix<S, n, 1>& b) {
  Eigen::Matrix<S, n, 1> chosen;
  for (int k = 0; k < n; ++k) chosen[k] = select(where, a[k], b[k]);
  return chosen;
}

/// Sine and cosine of one angle, which cost together what one of them costs.
template <class S>
struct SineAndCosine {
  S sine, cosine;
};
template <std::floating_point S>
SineAndCosine<S> sine_and_cosine(S angle) {
  return {std::sin(angle), std::cos(angle)};
}
inline SineAndCosine<Lanes> sine_and_cosine(Lanes angle) {
  SineAndCosine<Lanes> all;
  for (int i = 0; i < lane_count; ++i) {
    const auto [sine, cosine] = sine_and_cosine(angle[i]);
    all.sine.set(i, sine);
    all.cosine.set(i, cosine);
  }
  return all;
}

/// The scalar whose lane i is f(i); a plain scalar has lane 0 only.
template <class S, class F>
S gather(const F& f) {
  if constexpr (is_lanes<S>) {
    Lanes all;
    for (int i = 0; i < lane_count; ++i) all.set(i, f(i));
    return all;
  } else {
    return S(f(0));
  }
}

}  // namespace polhode::core::math

template <>
struct Eigen::NumTraits<polhode::Lanes> : Eigen::GenericNumTraits<double> {
  using Real = polhode::Lanes;
  using NonInteger = polhode::Lanes;
  using Nested = polhode::Lanes;
  using Literal = polhode::Lanes;
};
