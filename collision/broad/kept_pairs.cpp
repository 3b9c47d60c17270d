// SPDX-License-Identifier: BSD-3-Clause
#include "collision/broad/kept_pairs.hpp"

#include <algorithm>
#include <utility>

namespace polhode::inline collision::inline broad {
namespace {

// Pairs by which the bounds of kept pairs and of fresh pairs are fetched ahead.
constexpr std::ptrdiff_t pairs_ahead = 32;
constexpr std::size_t fresh_ahead = 8;

std::uint64_t key(const BodyPair& p) { return std::uint64_t(p.a) << 32 | p.b; }

/// Room for `count`, and for the pairs of a scene that goes on as it began.
void make_room(std::vector<BodyPair>& v, std::size_t count, std::size_t bodies) {
  if (v.size() < count) v.resize(std::max(2 * count, 6 * bodies));
}

}  // namespace

std::span<const BodyPair> KeptPairs::renew(const FatBoxes& boxes, std::span<const Bounds> bounds) {
  const auto fresh = fresh_.sorted(boxes.size());
  fresh_.clear();
  const std::size_t most = kept_count_ + fresh.size();
  for (auto* v : {&kept_, &next_, &pairs_}) make_room(*v, most + 1, boxes.size());
  BodyPair *kept_end = next_.data(), *pairs_end = pairs_.data();
  const BodyPair *old = kept_.data(), *const old_end = old + kept_count_;
  // Written first and counted afterwards: whether a pair stays or overlaps is nothing that a branch could foresee.
  const auto take = [&](const BodyPair& p, bool stays) {
    *kept_end = *pairs_end = p;
    kept_end += stays;
    pairs_end += all(stays, overlap(box_of(bounds[p.a]), box_of(bounds[p.b])));
  };
  const auto take_old = [&] {
    const BodyPair& soon = old[std::min(pairs_ahead, old_end - old - 1)];
    fetch(bounds[soon.a]);
    fetch(bounds[soon.b]);
    const BodyPair p = *old++;
    take(p, all(!boxes.has_left(p.a), !boxes.has_left(p.b)));
  };
  for (std::size_t k = 0; k < fresh.size(); ++k) {
    const BodyPair& soon = fresh[std::min(k + fresh_ahead, fresh.size() - 1)];
    fetch(bounds[soon.a]);
    fetch(bounds[soon.b]);
    while (old != old_end && key(*old) < key(fresh[k])) take_old();
    take(fresh[k], true);
  }
  while (old != old_end) take_old();
  kept_count_ = static_cast<std::size_t>(kept_end - next_.data());
  std::swap(kept_, next_);
  return {pairs_.data(), static_cast<std::size_t>(pairs_end - pairs_.data())};
}

}  // namespace polhode::collision::broad
