// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/text/in_order.hpp"

#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>

namespace polhode::study::inline text {

std::size_t number_of_threads(int jobs) {
  return jobs > 0 ? static_cast<std::size_t>(jobs) : std::max(1U, std::thread::hardware_concurrency());
}

void in_order(std::size_t parts, std::size_t threads, const std::function<UsePart(std::size_t part)>& make,
              std::size_t ahead) {
  if (threads < 2 || parts < 2) {
    for (std::size_t part = 0; part < parts; ++part) make(part)();
    return;
  }
  // No exception passes through the pipeline, which would lose the parts on their way: the first one waits until they
  // are through. Which one that is does not depend on the threads, since one of a part waits for its turn.
  std::exception_ptr failure;
  std::atomic<bool> failed{false};
  std::size_t next = 0;
  const auto number = [&](tbb::flow_control& flow) {
    if (next == parts || failed) flow.stop();
    return next++;
  };
  const auto made = [&](std::size_t part) -> UsePart {
    if (failed) return {};
    try {
      return make(part);
    } catch (...) {
      return [thrown = std::current_exception()] { std::rethrow_exception(thrown); };
    }
  };
  const auto use = [&](const UsePart& part) {
    if (failed) return;
    try {
      part();
    } catch (...) {
      failure = std::current_exception();
      failed = true;
    }
  };
  tbb::task_arena arena(static_cast<int>(threads));
  arena.execute([&] {
    tbb::parallel_pipeline(ahead > 0 ? ahead : 2 * threads,
                           tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order, number) &
                               tbb::make_filter<std::size_t, UsePart>(tbb::filter_mode::parallel, made) &
                               tbb::make_filter<UsePart, void>(tbb::filter_mode::serial_in_order, use));
  });
  if (failure) std::rethrow_exception(failure);
}

}  // namespace polhode::study::text
