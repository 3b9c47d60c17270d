// SPDX-License-Identifier: BSD-3-Clause
// Whether two boxes overlap. First a witness: the point of A nearest to B's centre, if B has it too. That needs no relative
// rotation, and tells for most boxes that overlap. Then the fifteen axes without normalising any, with a bound on the
// round-off. Where that does not decide either, the axes are taken with care. Three axes stand side by side in a register
// for one pair; for many pairs, one pair in each lane.
// Source of the axes: Gottschalk, Lin & Manocha, OBBTree, 1996.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "collision/narrow/box_sat.hpp"
#include "core/lanes.hpp"

namespace polhode {
namespace {

// In units of half extents and offset; a sum over all entries of the poses, so that a NaN in one of them decides nothing.
// An undivided edge product is off by as much at most, however short it is; and where it is shorter than `parallel`, the
// axis tells nothing that a face normal does not.
constexpr double undecided = 6e-15;
constexpr double parallel_squared = 1e-28;

bool overlap_with_care(const BoxAt& a, const BoxAt& b) {
  return best_axis(in_order(a, b) ? RelativeBoxes(a, b) : RelativeBoxes(b, a)).separation <= 0;
}

using Four [[gnu::vector_size(32)]] = double;
using FourBits [[gnu::vector_size(32)]] = long long;

inline Four four(const double* numbers) {
  Four x;
  std::memcpy(&x, numbers, sizeof x);
  return x;
}
inline Four three(const Vector3<double>& x) { return Four{x[0], x[1], x[2], x[2]}; }
inline Four all(double x) { return Four{x, x, x, x}; }
inline Four absolute(Four x) {
  constexpr long long magnitude = 0x7fffffffffffffff;
  return Four(FourBits(x) & FourBits{magnitude, magnitude, magnitude, magnitude});
}
inline Four next(Four x) { return __builtin_shufflevector(x, x, 1, 2, 0, 0); }
inline Four after_next(Four x) { return __builtin_shufflevector(x, x, 2, 0, 1, 1); }
inline Four larger(Four a, Four b) { return a > b ? a : b; }
inline Four smaller(Four a, Four b) { return a < b ? a : b; }
inline double largest(Four x) { return std::max(std::max(x[0], x[1]), x[2]); }

/// A 3×3 matrix by its rows.
struct Rows {
  Four row[3];
  explicit Rows(const Matrix3<double>& m) {
    const Four first = four(m.data()), middle = four(m.data() + 4), last = four(m.data() + 5);
    row[0] = __builtin_shufflevector(first, middle, 0, 3, 6, 6);
    row[1] = __builtin_shufflevector(first, middle, 1, 4, 7, 7);
    row[2] = __builtin_shufflevector(first, last, 2, 4, 7, 7);
  }
  /// Of the transposed matrix and x.
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
  double bound;  // m, of round-off

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

  /// `margin` is how far apart counts as overlapping. Products of parallel edges decide nothing: `guarded` leaves them out,
  /// which costs a quarter more.
  template <bool guarded>
  Answer by_axes(double margin) const;
};

template <bool guarded>
inline Answer QuickBoxes::by_axes(double margin) const {
  const Matrix3<double>&of_a = a.pose.rotation, &of_b = b.pose.rotation;
  const double most = bound + margin;
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
  if (largest(separations) > most) return Answer::no;

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
  return answer(largest(separations), most);
}

[[gnu::noinline]] bool overlap_of_undecided(const BoxAt& a, const BoxAt& b) {
  const Answer guarded = QuickBoxes(a, b).by_axes<true>(0);
  return guarded == Answer::unknown ? overlap_with_care(a, b) : guarded == Answer::yes;
}

Lanes larger(Lanes a, Lanes b) { return select(a > b, a, b); }

Lanes loaded(const double* numbers) {
  Lanes::Pack pack;
  std::memcpy(&pack, numbers, sizeof pack);
  return Lanes(pack);
}

/// The same, each lane its own pair. Neither: it is not decided.
struct LanedAnswer {
  Lanes::Mask apart, together;
};

LanedAnswer quick_overlap(const Lanes (&ra)[9], const Lanes (&rb)[9], const Lanes (&half_a)[3], const Lanes (&half_b)[3],
                          const Lanes (&d)[3]) {
  Lanes c[3][3], m[3][3], t[3];
  Lanes total(0.0);
  for (int i = 0; i < 3; ++i) {
    const Lanes *column = ra + 3 * i;
    t[i] = column[0] * d[0] + column[1] * d[1] + column[2] * d[2];
    for (int j = 0; j < 3; ++j) {
      c[i][j] = column[0] * rb[3 * j] + column[1] * rb[3 * j + 1] + column[2] * rb[3 * j + 2];
      m[i][j] = abs(c[i][j]);
    }
  }
  Lanes most(-std::numeric_limits<double>::infinity());
  for (int i = 0; i < 3; ++i) {
    const Lanes reach = half_a[i] + m[i][0] * half_b[0] + m[i][1] * half_b[1] + m[i][2] * half_b[2];
    total += reach + abs(t[i]);
    most = larger(abs(t[i]) - reach, most);
    const Lanes along = abs(t[0] * c[0][i] + t[1] * c[1][i] + t[2] * c[2][i]);
    most = larger(along - (half_b[i] + m[0][i] * half_a[0] + m[1][i] * half_a[1] + m[2][i] * half_a[2]), most);
  }
  for (int i = 0; i < 3; ++i) {
    const int y = (i + 1) % 3, z = (i + 2) % 3;
    for (int j = 0; j < 3; ++j) {
      const int v = (j + 1) % 3, w = (j + 2) % 3;
      const Lanes separation = abs(t[z] * c[y][j] - t[y] * c[z][j]) -
                               ((half_a[y] * m[z][j] + half_a[z] * m[y][j]) + (half_b[v] * m[i][w] + half_b[w] * m[i][v]));
      most = larger(separation, most);
    }
  }
  const Lanes bound = total * Lanes(undecided);
  return {most > bound, most < -bound};
}

}  // namespace

bool boxes_apart(const BoxAt& a, const BoxAt& b, double margin) { return QuickBoxes(a, b).by_axes<false>(margin) == Answer::no; }

bool boxes_overlap(const BoxAt& a, const BoxAt& b) {
  const QuickBoxes boxes(a, b);
  if (boxes.have_a_common_point()) return true;
  const Answer quick = boxes.by_axes<false>(0);
  return quick == Answer::unknown ? overlap_of_undecided(a, b) : quick == Answer::yes;
}

void boxes_overlap(std::span<const PosedBox> boxes, std::span<const BodyPair> pairs, std::span<std::uint8_t> overlap) {
  if (overlap.size() != pairs.size()) throw std::invalid_argument("boxes_overlap: there must be one answer for each pair");
  for (std::size_t first = 0; first < pairs.size(); first += lane_count) {
    const std::size_t count = std::min<std::size_t>(lane_count, pairs.size() - first);
    alignas(64) double of_a[12][lane_count], of_b[12][lane_count], between[3][lane_count];
    for (int lane = 0; lane < lane_count; ++lane) {
      const BodyPair pair = pairs[first + std::min(std::size_t(lane), count - 1)];
      const PosedBox &a = boxes[pair.a], &b = boxes[pair.b];
      for (int k = 0; k < 9; ++k) {
        of_a[k][lane] = a.pose.rotation.data()[k];
        of_b[k][lane] = b.pose.rotation.data()[k];
      }
      for (int k = 0; k < 3; ++k) {
        of_a[9 + k][lane] = a.half[k];
        of_b[9 + k][lane] = b.half[k];
        between[k][lane] = b.pose.position[k] - a.pose.position[k];
      }
    }
    Lanes ra[9], rb[9], half_a[3], half_b[3], d[3];
    for (int k = 0; k < 9; ++k) {
      ra[k] = loaded(of_a[k]);
      rb[k] = loaded(of_b[k]);
    }
    for (int k = 0; k < 3; ++k) {
      half_a[k] = loaded(of_a[9 + k]);
      half_b[k] = loaded(of_b[9 + k]);
      d[k] = loaded(between[k]);
    }
    const LanedAnswer quick = quick_overlap(ra, rb, half_a, half_b, d);
    for (std::size_t lane = 0; lane < count; ++lane) {
      const bool apart = quick.apart.bits[lane] != 0, together = quick.together.bits[lane] != 0;
      if (apart == together) {
        const PosedBox &a = boxes[pairs[first + lane].a], &b = boxes[pairs[first + lane].b];
        overlap[first + lane] = overlap_of_undecided({a.half, a.pose}, {b.half, b.pose});
      } else {
        overlap[first + lane] = together;
      }
    }
  }
}

}  // namespace polhode
