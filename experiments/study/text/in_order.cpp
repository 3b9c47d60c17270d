// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/text/in_order.hpp"

#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <exception>
#include <thread>

namespace polhode::study::inline text {

std::size_t number_of_threads(int jobs) {
  return jobs > 0 ? static_cast<std::size_t>(jobs) : std::max(1U, std::thread::hardware_concurrency());
}

void in_order(std::size_t parts, std::size_t threads, const std::function<UsePart(std::size_t part)>& make) {
  if (threads < 2 || parts < 2) {
    for (std::size_t part = 0; part < parts; ++part) make(part)();
    return;
  }
  std::size_t next = 0;
  const auto number = [&](tbb::flow_control& flow) {
    if (next == parts) flow.stop();
    return next++;
  };
  // An exception waits for its turn: which one is rethrown does not depend on the threads.
  const auto made = [&](std::size_t part) -> UsePart {
    try {
      return make(part);
    } catch (...) {
      return [failure = std::current_exception()] { std::rethrow_exception(failure); };
    }
  };
  const auto use = [](const UsePart& part) { part(); };
  tbb::task_arena arena(static_cast<int>(threads));
  arena.execute([&] {
    tbb::parallel_pipeline(2 * threads, tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order, number) &
                                            tbb::make_filter<std::size_t, UsePart>(tbb::filter_mode::parallel, made) &
                                            tbb::make_filter<UsePart, void>(tbb::filter_mode::serial_in_order, use));
  });
}

}  // namespace polhode::study::text
