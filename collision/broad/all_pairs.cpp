// SPDX-License-Identifier: BSD-3-Clause
// Every box against every other: n(n − 1)/2 tests, no structure to keep, and what the other broad phases are checked
// against. The baseline of Ericson, "Real-Time Collision Detection" (2005), chapter 7.
#include <cstddef>
#include <vector>

#include "collision/broad/boxes.hpp"
#include "collision/broad/pair_list.hpp"
#include "collision/broad_phase.hpp"

namespace polhode::inline collision::inline broad {
namespace {

class AllPairs final : public BroadPhase {
 public:
  void update(std::span<const Bounds> bounds) override {
    broad::take(bounds, boxes_);
    stale_ = true;
  }

  std::span<const BodyPair> pairs() override {
    if (!stale_) return pairs_;
    pairs_.clear();
    const auto n = static_cast<std::uint32_t>(boxes_.size());
    for (std::uint32_t a = 0; a < n; ++a) {
      const broad::PlainBox box = boxes_[a];
      for (std::uint32_t b = a + 1; b < n; ++b) {
        if (!overlap(box, boxes_[b])) continue;
        if (pairs_.size() == broad::most_pairs) broad::too_many_pairs();
        pairs_.push_back({a, b});
      }
    }
    broad::leave_room(pairs_, 4 * boxes_.size());
    stale_ = false;
    return pairs_;
  }

 private:
  std::vector<broad::PlainBox> boxes_;
  std::vector<BodyPair> pairs_;  // sorted as they come
  bool stale_ = false;
};

}  // namespace

BroadPhaseEntry all_pairs() {
  return {"all_pairs", "every box against every other", [] { return std::unique_ptr<BroadPhase>(new AllPairs); }};
}

}  // namespace polhode::collision::broad
