// SPDX-License-Identifier: BSD-3-Clause
// Disjoint sets with path halving (Tarjan & van Leeuwen, 1984); islands are numbered by their first contact.
#include "collision/response/islands.hpp"

#include <numeric>

namespace polhode::inline collision::inline response {

constexpr std::uint32_t no_island = 0xffffffff;

std::uint32_t Islands::root(std::uint32_t body) {
  while (parents_[body] != body) body = parents_[body] = parents_[parents_[body]];
  return body;
}

void Islands::build(std::span<const ImpulseBody> bodies, std::span<const ImpulseContact> contacts) {
  parents_.resize(bodies.size());
  std::iota(parents_.begin(), parents_.end(), 0u);
  for (const ImpulseContact& c : contacts) {
    if (bodies[c.a].moves() && bodies[c.b].moves()) parents_[root(c.a)] = root(c.b);
  }
  numbers_.assign(bodies.size(), no_island);
  island_of_.assign(contacts.size(), no_island);
  starts_.assign(1, 0);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const ImpulseContact& c = contacts[i];
    if (!bodies[c.a].moves() && !bodies[c.b].moves()) continue;
    std::uint32_t& number = numbers_[root(bodies[c.a].moves() ? c.a : c.b)];
    if (number == no_island) {
      number = std::uint32_t(starts_.size() - 1);
      starts_.push_back(0);
    }
    island_of_[i] = number;
    ++starts_[number + 1];
  }
  for (std::size_t k = 1; k < starts_.size(); ++k) starts_[k] += starts_[k - 1];
  members_.resize(starts_.back());
  numbers_.assign(starts_.begin(), starts_.end());
  for (std::uint32_t i = 0; i < contacts.size(); ++i) {
    if (island_of_[i] != no_island) members_[numbers_[island_of_[i]]++] = i;
  }
}

}  // namespace polhode::collision::response
