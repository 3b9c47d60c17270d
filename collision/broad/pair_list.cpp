// SPDX-License-Identifier: BSD-3-Clause
#include "collision/broad/pair_list.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "collision/broad/boxes.hpp"

namespace polhode::inline collision::inline broad {

void too_many_pairs() {
  std::string why = "the boxes of more than ";
  why += std::to_string(most_pairs);
  why += " pairs of bodies overlap: too many bodies are in one place; set them apart, or take fewer";
  throw std::length_error(why);
}

std::span<const BodyPair> PairList::sorted(std::size_t bodies) {
  leave_room(found_, 4 * bodies);
  sorted_.reserve(found_.capacity());
  place_.reserve(bodies + 2);
  // Neighbours share a place where there are few pairs.
  int shift = 0;
  while (bodies >> shift > 2 * found_.size() + 64) ++shift;
  const std::size_t places = (bodies >> shift) + 1;
  place_.assign(places + 1, 0);
  for (const BodyPair& p : found_) ++place_[(p.a >> shift) + 1];
  for (std::size_t k = 0; k < places; ++k) place_[k + 1] += place_[k];
  sorted_.resize(found_.size());
  for (const BodyPair& p : found_) sorted_[place_[p.a >> shift]++] = p;
  // Now place_[k] is where the pairs of place k end.
  std::uint32_t begin = 0;
  for (std::size_t k = 0; k < places; ++k) {
    const std::uint32_t end = place_[k];
    if (end - begin > 1) std::sort(sorted_.begin() + begin, sorted_.begin() + end);
    begin = end;
  }
  return sorted_;
}

}  // namespace polhode::collision::broad
