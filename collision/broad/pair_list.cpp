// SPDX-License-Identifier: BSD-3-Clause
#include "collision/broad/pair_list.hpp"

#include <algorithm>

#include "collision/broad/boxes.hpp"

namespace polhode::broad {

std::span<const BodyPair> PairList::sorted(std::size_t bodies) {
  leave_room(found_, 4 * bodies);
  place_.assign(bodies + 1, 0);
  for (const BodyPair& p : found_) ++place_[p.a + 1];
  for (std::size_t a = 0; a < bodies; ++a) place_[a + 1] += place_[a];
  sorted_.reserve(found_.capacity());
  sorted_.resize(found_.size());
  for (const BodyPair& p : found_) sorted_[place_[p.a]++] = p;
  // Now place_[a] is where the pairs of a end.
  std::uint32_t begin = 0;
  for (std::size_t a = 0; a < bodies; ++a) {
    const std::uint32_t end = place_[a];
    if (end - begin > 1) std::sort(sorted_.begin() + begin, sorted_.begin() + end);
    begin = end;
  }
  return sorted_;
}

}  // namespace polhode::broad
