// SPDX-License-Identifier: BSD-3-Clause
#include "collision/response/warm_start.hpp"

#include <algorithm>
#include <tuple>

namespace polhode::inline collision::inline response {

void WarmStart::recall(std::span<const ImpulseBody> bodies, std::span<ImpulseContact> contacts, double step) {
  const auto same = [](const auto& c, const auto& d) { return c.a == d.a && c.b == d.b; };
  const auto before = [](const auto& c, const auto& d) { return std::tie(c.a, c.b) < std::tie(d.a, d.b); };
  auto first = known_.begin();
  for (std::size_t i = 0; i < contacts.size();) {
    const ImpulseContact& pair = contacts[i];
    while (first != known_.end() && before(*first, pair)) ++first;
    auto last = first;
    while (last != known_.end() && same(*last, pair)) ++last;
    new_.clear();
    const auto take = [&](ImpulseContact& c, Known& k) {
      c.impulse = step * k.force;
      k.taken = true;
    };
    for (; i < contacts.size() && same(contacts[i], pair); ++i) {
      contacts[i].impulse.setZero();
      const auto k = std::find_if(
          first, last, [&](const Known& known) { return !known.taken && known.feature == contacts[i].feature; });
      if (k != last) {
        take(contacts[i], *k);
      } else {
        new_.push_back(std::uint32_t(i));
      }
    }
    for (const std::uint32_t n : new_) {
      const Vector3<double> place = contacts[n].point - bodies[pair.a].position;
      auto nearest = last;
      for (auto k = first; k != last; ++k) {
        if (k->taken || (nearest != last && (nearest->place - place).squaredNorm() <= (k->place - place).squaredNorm()))
          continue;
        nearest = k;
      }
      if (nearest != last) take(contacts[n], *nearest);
    }
    first = last;
  }
}

void WarmStart::remember(std::span<const ImpulseBody> bodies, std::span<const ImpulseContact> contacts, double step) {
  known_.clear();
  for (const ImpulseContact& c : contacts) {
    if (c.wanted <= 0) known_.push_back({c.a, c.b, c.feature, c.point - bodies[c.a].position, c.impulse / step});
  }
}

}  // namespace polhode::collision::response
