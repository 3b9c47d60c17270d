// SPDX-License-Identifier: BSD-3-Clause
// The rows of a store in parts that several threads read.
#pragma once

#include <cstdint>
#include <functional>

#include "experiments/study/query/result_stores.hpp"
#include "experiments/study/store/run_rows.hpp"
#include "experiments/study/text/in_order.hpp"

namespace polhode::study::inline query {

/// Rows whose numbers are above `after` and at most `last`.
struct RowPart {
  const RunRows& rows;  ///< of a connection that no other thread uses meanwhile
  std::int64_t after, last;
};

/// Calls make(part) for parts that together are all rows, on all threads, and what it returns in the order of the
/// parts.
void for_each_part(const OpenStore& open, const std::function<UsePart(const RowPart& part)>& make);

}  // namespace polhode::study::query
