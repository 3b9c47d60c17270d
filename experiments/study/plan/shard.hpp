// SPDX-License-Identifier: BSD-3-Clause
// Shards: parts of a study that processes on any machines carry out apart.
#pragma once

#include <cstddef>
#include <string>

namespace polhode::study::inline plan {

/// Shard `number` of `count`; number: 1 … count.
struct Shard {
  std::size_t number = 1, count = 1;
};

inline constexpr std::size_t most_shards = 100'000;

/// Reads "3/16". Throws InputError that begins with the label.
Shard read_shard(const std::string& text, const std::string& label);

}  // namespace polhode::study::plan
