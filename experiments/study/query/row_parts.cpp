// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/query/row_parts.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>

#include "experiments/study/query/pool.hpp"
#include "experiments/study/record/metric_table.hpp"

namespace polhode::study::inline query {
namespace {

constexpr std::int64_t rows_of_a_part = 20'000, most_parts = 64;

struct Connection {
  explicit Connection(const OpenStore& open) : store(open.file.parent_path(), metric_table(), Access::read) {}

  Store store;
  RunRows rows{store};
};

}  // namespace

void for_each_part(const OpenStore& open, const std::function<UsePart(const RowPart& part)>& make) {
  // The number of a damaged row may be any: the parts are few, and the first one has all numbers up to its end.
  constexpr std::int64_t first = std::numeric_limits<std::int64_t>::min();
  const RunRows all(open.store);
  const std::int64_t last = all.last();
  const std::int64_t length = std::max(rows_of_a_part, (last - 1) / most_parts + 1), parts = (last - 1) / length + 1;
  if (parts < 2) {
    make({all, first, last})();
    return;
  }
  Pool<Connection> connections;
  in_order(static_cast<std::size_t>(parts), number_of_threads(0), [&](std::size_t k) {
    const auto connection = connections.take([&] { return std::make_unique<Connection>(open); });
    const auto part = static_cast<std::int64_t>(k);
    return make({connection->rows, part == 0 ? first : part * length, part + 1 == parts ? last : (part + 1) * length});
  });
}

}  // namespace polhode::study::query
