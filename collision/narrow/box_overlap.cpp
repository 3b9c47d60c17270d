// SPDX-License-Identifier: BSD-3-Clause
// Decides whether two boxes overlap. First a witness: the point of A nearest to B's centre, if B contains it too. This
// needs no relative rotation, and decides most overlapping pairs. Then the fifteen axes without normalizing them, with
// a bound on the round-off. If that does not decide either, the axes are evaluated with care. For one pair, three axes
// stand side by side in a register; for many pairs, one pair in each lane. Source of the axes: Gottschalk, Lin &
// Manocha, OBBTree, 1996.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <utility>

#include "collision/narrow/box_sat.hpp"
#include "collision/narrow/four.hpp"
#include "core/math/lanes.hpp"

#ifdef __AVX__
#include <immintrin.h>
#endif

namespace polhode::inline collision::inline narrow {
namespace {

// Bound of the round-off, in units of half extents and offset. It is over a sum of all entries of the poses, so that a
// NaN in one of them decides nothing. An undivided edge product is off by as much at most, however short it is; where
// it is shorter than `parallel`, the axis decides nothing that a face normal does not.
constexpr double undecided = 6e-15;
constexpr double parallel_squared = 1e-28;

bool overlap_with_care(const BoxAt& a, const BoxAt& b) {
  return best_axis(in_order(a, b) ? RelativeBoxes(a, b) : RelativeBoxes(b, a)).separation <= 0;
}

/// A 3×3 matrix by its rows.
struct Rows {
  Four row[3];
  explicit Rows(const Matrix3<double>& m) {
    const Four first = four(m.data()), middle = four(m.data() + 4), last = four(m.data() + 5);
    row[0] = __builtin_shufflevector(first, middle, 0, 3, 6, 6);
    row[1] = __builtin_shufflevector(first, middle, 1, 4, 7, 7);
    row[2] = __builtin_shufflevector(first, last, 2, 4, 7, 7);
  }
  /// The product of the transposed matrix and x.
  Four transposed_times(Four x) const { return all(x[0]) * row[0] + all(x[1]) * row[1] + all(x[2]) * row[2]; }
};

enum class Answer { no, yes, unknown };

inline Answer answer(double separation, double bound) {
  if (separation > bound) return Answer::no;
  return separation < -bound ? Answer::yes : Answer::unknown;
}

/// Two boxes, three numbers of each side by side.
struct QuickBoxes {
  const BoxAt &a, &b;
  Rows ra{a.pose.rotation}, rb{b.pose.rotation};
  Four half_a = three(a.half), half_b = three(b.half);
  Four between = three(b.pose.position) - three(a.pose.position);
  Four in_a = ra.transposed_times(between), in_b = rb.transposed_times(between);
  double bound;  // bound of the round-off, m

  QuickBoxes(const BoxAt& first, const BoxAt& second) : a(first), b(second) {
    const Four total = half_a + half_b + (absolute(in_a) + absolute(in_b));
    bound = undecided * (total[0] + total[1] + total[2]);
  }

  /// True only where B has the point of A that is nearest to B's centre.
  bool have_a_common_point() const {
    const Four beyond = in_a - larger(smaller(in_a, half_a), -half_a);
    const double* const columns = a.pose.rotation.data();
    // The last column is read from one number earlier.
    const Four last = __builtin_shufflevector(four(columns + 5), four(columns + 5), 1, 2, 3, 3);
    const Four offset = all(beyond[0]) * four(columns) + all(beyond[1]) * four(columns + 3) + all(beyond[2]) * last;
    return largest(absolute(rb.transposed_times(offset)) - half_b) < -bound;
  }

  /// Products of parallel edges decide nothing: `guarded` leaves them out, which costs a quarter more.
  template <bool guarded>
  Answer by_axes() const;
};

template <bool guarded>
inline Answer QuickBoxes::by_axes() const {
  const Matrix3<double>&of_a = a.pose.rotation, &of_b = b.pose.rotation;
  // The faces: columns of the relative rotation for those of A, and its rows for those of B.
  Four reach_a = half_a, reach_b = half_b;
  Four c[3], magnitude[3];
  for (int i = 0; i < 3; ++i) {
    c[i] = rb.transposed_times(three(of_a.col(i)));
    magnitude[i] = absolute(c[i]);
    reach_b += all(a.half[i]) * magnitude[i];
    reach_a += all(b.half[i]) * absolute(ra.transposed_times(three(of_b.col(i))));
  }
  Four separations = larger(absolute(in_a) - reach_a, absolute(in_b) - reach_b);
  if (largest(separations) > bound) return Answer::no;

  const Four half_next = next(half_b), half_after = after_next(half_b);
  for (int i = 0; i < 3; ++i) {
    const int y = (i + 1) % 3, z = (i + 2) % 3;
    const Four product = absolute(all(in_a[z]) * c[y] - all(in_a[y]) * c[z]);
    const Four of_edges_a = all(a.half[y]) * magnitude[z] + all(a.half[z]) * magnitude[y];
    const Four of_edges_b = half_next * after_next(magnitude[i]) + half_after * next(magnitude[i]);
    const Four separation = product - (of_edges_a + of_edges_b);
    if constexpr (guarded) {
      const Four squared = c[y] * c[y] + c[z] * c[z];
      separations = larger(separations, squared < all(parallel_squared) ? separations : separation);
    } else {
      separations = larger(separations, separation);
    }
  }
  return answer(largest(separations), bound);
}

[[gnu::noinline]] bool overlap_of_undecided(const BoxAt& a, const BoxAt& b) {
  const Answer guarded = QuickBoxes(a, b).by_axes<true>();
  return guarded == Answer::unknown ? overlap_with_care(a, b) : guarded == Answer::yes;
}

inline Lanes larger(Lanes a, Lanes b) { return select(a > b, a, b); }

/// The number nearest to x, of either sign, that is no larger than `most`.
inline Lanes clamped(Lanes x, Lanes most) {
#ifdef __AVX512DQ__
  return Lanes(Lanes::Pack(_mm512_range_pd(std::bit_cast<Lanes::Pack>(x), std::bit_cast<Lanes::Pack>(most),
                                           0b0010)));  // the smaller magnitude, the sign of x
#else
  return larger(select(x < most, x, most), -most);
#endif
}

/// a b + c, rounded once where the processor can. No answer depends on it: the bound on the round-off decides what is
/// sure.
inline Lanes sum(Lanes::Pack a, Lanes::Pack b, Lanes::Pack c) {
#if defined(__AVX512F__)
  return Lanes(Lanes::Pack(_mm512_fmadd_pd(a, b, c)));
#elif defined(__FMA__)
  return Lanes(Lanes::Pack(_mm256_fmadd_pd(a, b, c)));
#else
  return Lanes(Lanes::Pack(a * b + c));
#endif
}

constexpr std::uint32_t every_lane = (1u << lane_count) - 1;

/// Bit k of lane k.
inline std::uint32_t bits(Lanes::Mask truth) {
#if defined(__AVX512F__)
  return _mm512_cmplt_epi64_mask(__m512i(truth.bits), _mm512_setzero_si512());
#elif defined(__AVX__)
  return std::uint32_t(_mm256_movemask_pd(__m256d(truth.bits)));
#else
  return std::uint32_t((truth.bits[0] & 1) | (truth.bits[1] & 2));
#endif
}

/// Writes `first`, `first` + 1 and so on for the lanes that are not in `left_out` to `numbers`, where there is room for
/// all of them. Returns how many there are.
inline std::size_t pick(std::size_t first, std::uint32_t left_out, std::size_t* numbers) {
  const std::uint32_t picked = every_lane & ~left_out;
#if defined(__AVX512F__)
  const __m512i all =
      _mm512_add_epi64(_mm512_set1_epi64(std::int64_t(first)), _mm512_setr_epi64(0, 1, 2, 3, 4, 5, 6, 7));
  _mm512_storeu_si512(numbers, _mm512_maskz_compress_epi64(__mmask8(picked), all));
#else
  std::size_t count = 0;
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    numbers[count] = first + lane;
    count += picked >> lane & 1;
  }
#endif
  return std::size_t(std::popcount(picked));
}

/// Bit k of the truths in byte k.
inline void write(std::uint32_t truths, std::uint8_t* bytes) {
  // The bits are copied 7 places apart, so that bit k comes to the lowest place of byte k.
  const std::uint64_t low = std::uint64_t(truths & 0x7f) * 0x0002040810204081u & 0x0101010101010101u;
  const std::uint64_t spread = low | std::uint64_t(truths >> 7) << 56;
  std::memcpy(bytes, &spread, lane_count);
}

/// Some numbers of a box, as they lie in memory.
template <class Pack>
inline Pack read(const PosedBox* box, int first) {
  Pack some;
  std::memcpy(&some, reinterpret_cast<const char*>(box) + std::size_t(first) * sizeof(double), sizeof some);
  return some;
}

#ifdef __AVX512F__
/// Four numbers of eight boxes. Two boxes share a register; pairs of numbers are exchanged within its quarters, then
/// the quarters.
inline constexpr int numbers_at_once = 4;
inline void transpose(const PosedBox* const* boxes, int first, Lanes* number) {
  using Pack = Lanes::Pack;
  const auto both = [&](int k, int l) {
    return Pack(_mm512_maskz_insertf64x4(0xff, _mm512_castpd256_pd512(read<Four>(boxes[k], first)),
                                         read<Four>(boxes[l], first), 1));
  };
  const Pack p02 = both(0, 2), p13 = both(1, 3), p46 = both(4, 6), p57 = both(5, 7);
  const auto even = [](Pack a, Pack b) { return Pack(__builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14)); };
  const auto odd = [](Pack a, Pack b) { return Pack(__builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15)); };
  const auto near = [](Pack a, Pack b) { return Lanes(Pack(__builtin_shufflevector(a, b, 0, 1, 4, 5, 8, 9, 12, 13))); };
  const auto far = [](Pack a, Pack b) {
    return Lanes(Pack(__builtin_shufflevector(a, b, 2, 3, 6, 7, 10, 11, 14, 15)));
  };
  const Pack low_even = even(p02, p13), low_odd = odd(p02, p13), high_even = even(p46, p57), high_odd = odd(p46, p57);
  number[0] = near(low_even, high_even);
  number[1] = near(low_odd, high_odd);
  number[2] = far(low_even, high_even);
  number[3] = far(low_odd, high_odd);
}
#else
/// Two numbers of two or four boxes: the even boxes side by side, the odd ones, and then these two interleaved.
inline constexpr int numbers_at_once = 2;
inline void transpose(const PosedBox* const* boxes, int first, Lanes* number) {
  using Two [[gnu::vector_size(16)]] = double;
#ifdef __AVX__
  const auto both = [&](int k) {
    return _mm256_insertf128_pd(_mm256_castpd128_pd256(read<Two>(boxes[k], first)), read<Two>(boxes[k + 2], first), 1);
  };
  const Lanes::Pack even = both(0), odd = both(1);
  number[0] = Lanes(Lanes::Pack(_mm256_unpacklo_pd(even, odd)));
  number[1] = Lanes(Lanes::Pack(_mm256_unpackhi_pd(even, odd)));
#else
  const Two even = read<Two>(boxes[0], first), odd = read<Two>(boxes[1], first);
  number[0] = Lanes(Lanes::Pack(__builtin_shufflevector(even, odd, 0, 2)));
  number[1] = Lanes(Lanes::Pack(__builtin_shufflevector(even, odd, 1, 3)));
#endif
}
#endif

/// The same number of several boxes in the lanes of each pack: half extents, position, and the rotation by columns.
struct LanedBoxes {
  static constexpr int numbers = 15;
  static_assert(sizeof(PosedBox) == numbers * sizeof(double));
  Lanes number[numbers];

  const Lanes* half() const { return number; }
  const Lanes* position() const { return number + 3; }
  const Lanes* axis(int k) const { return number + 6 + 3 * k; }

  [[gnu::always_inline]] explicit LanedBoxes(const PosedBox* const (&boxes)[lane_count]) {
    take(boxes, std::make_integer_sequence<int, (numbers + numbers_at_once - 1) / numbers_at_once>());
  }

 private:
  template <int... k>
  [[gnu::always_inline]] void take(const PosedBox* const* boxes, std::integer_sequence<int, k...>) {
    // The last ones overlap those before.
    const auto first = [](int block) { return std::min(block * numbers_at_once, numbers - numbers_at_once); };
    (transpose(boxes, first(k), number + first(k)), ...);
  }
};

inline Lanes::Pack packed(Lanes x) { return std::bit_cast<Lanes::Pack>(x); }

/// Several pairs, one in each lane.
struct LanedPairs {
  LanedBoxes a, b;
  Lanes between[3], in_a[3], in_b[3];  // vector from the centre of A to that of B, in three frames
  Lanes halves{0.0};

  [[gnu::always_inline]] LanedPairs(const PosedBox* const (&of_a)[lane_count],
                                    const PosedBox* const (&of_b)[lane_count])
      : a(of_a), b(of_b) {
    for (int k = 0; k < 3; ++k) between[k] = b.position()[k] - a.position()[k];
    for (int k = 0; k < 3; ++k) {
      in_a[k] = dot(a.axis(k), between);
      in_b[k] = dot(b.axis(k), between);
      halves += a.half()[k] + b.half()[k];
    }
  }
  static Lanes total(const Lanes* x) { return abs(x[0]) + abs(x[1]) + abs(x[2]); }
  Lanes bound() const { return (halves + (total(in_a) + total(in_b))) * undecided; }

  static Lanes sum(Lanes x, Lanes y, Lanes z) { return polhode::sum(packed(x), packed(y), packed(z)); }
  static Lanes dot(const Lanes* x, const Lanes* y) { return sum(x[0], y[0], sum(x[1], y[1], x[2] * y[2])); }

  Lanes::Mask have_a_common_point() const {
    Lanes beyond[3], offset[3];
    for (int k = 0; k < 3; ++k) beyond[k] = in_a[k] - clamped(in_a[k], a.half()[k]);
    for (int k = 0; k < 3; ++k) {
      offset[k] = sum(beyond[0], a.axis(0)[k], sum(beyond[1], a.axis(1)[k], beyond[2] * a.axis(2)[k]));
    }
    // Written so that nothing is below a NaN.
    const Lanes enough = (halves + 2 * total(between)) * -undecided;
    const auto within = [&](int k) { return abs(dot(b.axis(k), offset)) - b.half()[k] < enough; };
    return within(0) & within(1) & within(2);
  }

  /// The largest separation, of an edge product times its length.
  Lanes by_axes() const {
    Lanes c[3][3], m[3][3], less_a[3], less_b[3];
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        c[i][j] = dot(a.axis(i), b.axis(j));
        m[i][j] = abs(c[i][j]);
      }
      less_a[i] = -a.half()[i];
      less_b[i] = -b.half()[i];
    }
    Lanes most(-std::numeric_limits<double>::infinity());
    for (int i = 0; i < 3; ++i) {
      const Lanes of_a =
          sum(less_b[0], m[i][0], sum(less_b[1], m[i][1], sum(less_b[2], m[i][2], abs(in_a[i]) + less_a[i])));
      const Lanes of_b =
          sum(less_a[0], m[0][i], sum(less_a[1], m[1][i], sum(less_a[2], m[2][i], abs(in_b[i]) + less_b[i])));
      most = larger(most, larger(of_a, of_b));
    }
    for (int i = 0; i < 3; ++i) {
      const int y = (i + 1) % 3, z = (i + 2) % 3;
      for (int j = 0; j < 3; ++j) {
        const int v = (j + 1) % 3, w = (j + 2) % 3;
        const Lanes product = abs(sum(in_a[z], c[y][j], -in_a[y] * c[z][j]));
        const Lanes beyond_a = sum(less_a[y], m[z][j], sum(less_a[z], m[y][j], product));
        most = larger(most, sum(less_b[v], m[i][w], sum(less_b[w], m[i][v], beyond_a)));
      }
    }
    return most;
  }
};

}  // namespace

bool boxes_overlap(const BoxAt& a, const BoxAt& b) {
  const QuickBoxes boxes(a, b);
  if (boxes.have_a_common_point()) return true;
  const Answer quick = boxes.by_axes<false>();
  return quick == Answer::unknown ? overlap_of_undecided(a, b) : quick == Answer::yes;
}

[[gnu::noinline]] static bool overlap_alone(const PosedBox& a, const PosedBox& b) {
  return boxes_overlap(BoxAt{a.half, a.pose}, BoxAt{b.half, b.pose});
}

void boxes_overlap(std::span<const PosedBox> boxes, std::span<const BodyPair> pairs, std::span<std::uint8_t> overlap) {
  if (overlap.size() != pairs.size())
    throw std::invalid_argument("boxes_overlap: there must be one answer for each pair");
  const PosedBox* const all = boxes.data();
  const BodyPair* const pair = pairs.data();
  std::uint8_t* const answer = overlap.data();
  const PosedBox *a[lane_count], *b[lane_count];
  // Pairs without a common point wait until there are enough for all lanes.
  constexpr std::size_t lanes = lane_count, at_once = 16 * lanes;
  std::size_t waiting[lanes + at_once];
  std::size_t count = 0, k = 0;
  const std::size_t last = pairs.size() - pairs.size() % lanes;
  while (k < last) {
    for (const std::size_t end = std::min(k + at_once, last); k < end; k += lanes) {
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        a[lane] = all + pair[k + lane].a;
        b[lane] = all + pair[k + lane].b;
      }
      const std::uint32_t together = bits(LanedPairs(a, b).have_a_common_point());
      write(together, answer + k);
      count += pick(k, together, waiting + count);
    }
    while (count >= lanes) {
      count -= lanes;
      const std::size_t* const these = waiting + count;
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        a[lane] = all + pair[these[lane]].a;
        b[lane] = all + pair[these[lane]].b;
      }
      const LanedPairs laned(a, b);
      const Lanes most = laned.by_axes();
      const std::uint32_t sure = bits(abs(most) > laned.bound()), together = bits(most < Lanes(0.0));
      for (std::size_t lane = 0; lane < lanes; ++lane) answer[these[lane]] = together >> lane & 1;
      for (std::uint32_t left = ~sure & every_lane; left != 0; left &= left - 1) {
        const int lane = std::countr_zero(left);
        answer[these[lane]] = overlap_alone(*a[lane], *b[lane]);
      }
    }
  }
  for (; k < pairs.size(); ++k) waiting[count++] = k;
  for (const std::size_t left : std::span(waiting, count))
    answer[left] = overlap_alone(all[pair[left].a], all[pair[left].b]);
}

}  // namespace polhode::collision::narrow
