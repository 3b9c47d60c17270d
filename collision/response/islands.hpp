// SPDX-License-Identifier: BSD-3-Clause
// Islands: sets of contacts connected by moving bodies. Islands do not affect each other.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "collision/response.hpp"

namespace polhode::inline collision::inline response {

class Islands {
 public:
  void build(std::span<const ImpulseBody> bodies, std::span<const ImpulseContact> contacts);

  std::size_t count() const { return starts_.empty() ? 0 : starts_.size() - 1; }
  /// The contacts of one island, in their order. Contacts between two static bodies are in none.
  std::span<const std::uint32_t> contacts(std::size_t island) const {
    return std::span(members_).subspan(starts_[island], starts_[island + 1] - starts_[island]);
  }

 private:
  std::uint32_t root(std::uint32_t body);

  std::vector<std::uint32_t> parents_, numbers_, starts_, members_, island_of_;
};

}  // namespace polhode::collision::response
