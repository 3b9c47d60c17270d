// SPDX-License-Identifier: BSD-3-Clause
// Sweep and prune: the boxes stand sorted by where they begin on one axis, and each is tested against those that begin
// before it ends. Baraff, "Dynamic Simulation of Non-Penetrating Rigid Bodies" (1992), section 4.1; Cohen, Lin, Manocha
// and Ponamgi, "I-COLLIDE" (1995). From step to step boxes change places with near neighbours only, so that insertion
// keeps the order in near linear time. The axis is the one on which the boxes are spread the furthest.
//
// On the two other axes the sweep compares single-precision copies, many at a time. Rounding keeps the order of
// numbers, so that boxes which overlap overlap also as rounded; the few that pass are tested as they are.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <numeric>
#include <vector>

#include "collision/broad/boxes.hpp"
#include "collision/broad/pair_list.hpp"
#include "collision/broad/rounded_box.hpp"
#include "collision/broad_phase.hpp"

namespace polhode::inline collision::inline broad {
namespace {

using broad::PlainBox;

constexpr std::size_t block = 16;           // boxes compared at a time
constexpr std::size_t moves_per_body = 32;  // moves by insertion, up to which sorting anew is not cheaper
constexpr double worth_another_axis = 1.5;  // times the spread on the present one

class SweepAndPrune final : public BroadPhase {
 public:
  void update(std::span<const Bounds> bounds) override {
    const bool new_scene = bounds.size() != boxes_.size();
    broad::take(bounds, boxes_);
    const bool new_axis = choose_axis();
    if (new_scene) order_.resize(boxes_.size());
    if (new_scene) std::iota(order_.begin(), order_.end(), std::uint32_t(0));
    sort(new_scene || new_axis);
    stale_ = true;
  }

  std::span<const BodyPair> pairs() override {
    if (!stale_) return sorted_;
    found_.clear();
    lay_out();
    for (std::size_t i = 0; i < boxes_.size(); ++i) sweep(i);
    sorted_ = found_.sorted(boxes_.size());
    stale_ = false;
    return sorted_;
  }

 private:
  struct Begin {
    double at;
    std::uint32_t body;
    bool operator<(const Begin& other) const { return at < other.at || (at == other.at && body < other.body); }
  };

  /// True where it is another one than before.
  bool choose_axis() {
    std::array<double, 3> mean{}, spread{};
    const double weight = 1.0 / static_cast<double>(std::max<std::size_t>(boxes_.size(), 1));
    for (const PlainBox& b : boxes_) {
      for (std::size_t k = 0; k < 3; ++k) mean[k] += weight * clamped(centre(b, k));
    }
    for (const PlainBox& b : boxes_) {
      for (std::size_t k = 0; k < 3; ++k) spread[k] += weight * std::abs(clamped(centre(b, k)) - mean[k]);
    }
    const auto axis = static_cast<std::size_t>(std::max_element(spread.begin(), spread.end()) - spread.begin());
    if (!(spread[axis] > worth_another_axis * spread[axis_])) return false;
    axis_ = axis;
    return true;
  }

  /// Clamps infinite and extreme numbers, so that means and variances stay finite.
  static double clamped(double x) { return std::clamp(x, -1e150, 1e150); }

  void sort(bool anew) {
    begins_.resize(boxes_.size());
    for (std::size_t k = 0; k < begins_.size(); ++k) begins_[k] = {boxes_[order_[k]].low[axis_], order_[k]};
    if (anew || !insert_all(moves_per_body * begins_.size())) std::sort(begins_.begin(), begins_.end());
    for (std::size_t k = 0; k < begins_.size(); ++k) order_[k] = begins_[k].body;
  }

  /// False where it took too many moves; begins_ still holds each body once.
  bool insert_all(std::size_t most_moves) {
    std::size_t moves = 0;
    for (std::size_t k = 1; k < begins_.size(); ++k) {
      const Begin b = begins_[k];
      std::size_t to = k;
      for (; to > 0 && b < begins_[to - 1]; --to) begins_[to] = begins_[to - 1];
      begins_[to] = b;
      moves += k - to;
      if (moves > most_moves) return false;
    }
    return true;
  }

  /// The boxes in their order, as the sweep reads them. Behind the end stand boxes that overlap nothing.
  void lay_out() {
    const std::size_t n = boxes_.size(), second = (axis_ + 1) % 3, third = (axis_ + 2) % 3;
    constexpr float never = std::numeric_limits<float>::infinity();
    for (auto* side : {&low1_, &low2_, &high2_, &low3_, &high3_}) side->assign(n + block, never);
    swept_.resize(n);
    for (std::size_t k = 0; k < n; ++k) {
      const PlainBox& b = boxes_[order_[k]];
      swept_[k] = b;
      low1_[k] = broad::rounded(b.low[axis_]);
      low2_[k] = broad::rounded(b.low[second]);
      high2_[k] = broad::rounded(b.high[second]);
      low3_[k] = broad::rounded(b.low[third]);
      high3_[k] = broad::rounded(b.high[third]);
    }
  }

  void sweep(std::size_t i) {
    const PlainBox& box = swept_[i];
    const float high1 = broad::rounded(box.high[axis_]), low2 = low2_[i], high2 = high2_[i], low3 = low3_[i],
                high3 = high3_[i];
    for (std::size_t j = i + 1; low1_[j] <= high1; j += block) {
      Hits hits{};
      for (std::size_t half = 0; half < 2; ++half) {
        const std::size_t k = j + half * lanes;
        Lanes l2, h2, l3, h3;
        load(low2_, k, l2);
        load(high2_, k, h2);
        load(low3_, k, l3);
        load(high3_, k, h3);
        const Hits hit = (l2 <= high2) & (h2 >= low2) & (l3 <= high3) & (h3 >= low3);
        hits |= hit & (Hits{1, 2, 4, 8, 16, 32, 64, 128} << static_cast<int>(half * lanes));
      }
      for (unsigned bits = all_of(hits); bits != 0; bits &= bits - 1) {
        const std::size_t k = j + static_cast<std::size_t>(std::countr_zero(bits));
        if (overlap(box, swept_[k])) found_.add(begins_[i].body, begins_[k].body);
      }
    }
  }

  static constexpr std::size_t lanes = 8;
  using Lanes [[gnu::vector_size(lanes * sizeof(float))]] = float;
  using Hits [[gnu::vector_size(lanes * sizeof(float))]] = std::int32_t;
  using Pairs [[gnu::vector_size(lanes * sizeof(float))]] = std::uint64_t;

  static void load(const std::vector<float>& numbers, std::size_t k, Lanes& x) {
    std::memcpy(&x, &numbers[k], sizeof x);
  }

  static unsigned all_of(const Hits& hits) {
    const auto pairs = reinterpret_cast<Pairs>(hits);
    const std::uint64_t two = (pairs[0] | pairs[1]) | (pairs[2] | pairs[3]);
    return static_cast<unsigned>(two | two >> 32);
  }

  std::size_t axis_ = 0;
  std::vector<PlainBox> boxes_, swept_;  // boxes by number; boxes by where they begin
  std::vector<std::uint32_t> order_;     // the bodies by where they begin
  std::vector<Begin> begins_;
  std::vector<float> low1_, low2_, high2_, low3_, high3_;
  broad::PairList found_;
  std::span<const BodyPair> sorted_;
  bool stale_ = false;
};

}  // namespace

BroadPhaseEntry sweep_and_prune() {
  return {"sweep_and_prune", "boxes sorted along one axis by insertion, tested while they overlap on it",
          [] { return std::unique_ptr<BroadPhase>(new SweepAndPrune); }};
}

}  // namespace polhode::collision::broad
