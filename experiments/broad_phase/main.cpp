// SPDX-License-Identifier: BSD-3-Clause
// What does each broad phase cost as the bodies become more, and do all report the same pairs?
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "experiments/broad_phase/options.hpp"
#include "experiments/broad_phase/recorded.hpp"
#include "experiments/study/input_error.hpp"
#include "experiments/study/listing.hpp"

int main(int argc, char** argv) {
  using namespace polhode::study;
  constexpr int bad_input = 2, not_carried_out = 3;
  try {
    const BroadPhaseOptions options = parse_broad_phase_options(argc, argv);
    if (options.exit_status) return *options.exit_status;
    if (options.list) {
      fmt::print("{}", listing(*options.list));
      return 0;
    }
    if (!options.boxes.empty()) {
      answer_recorded_motion(read_recorded_motion(options.boxes), *options.phases.front(), options.out);
      return 0;
    }
    return 0;
  } catch (const InputError& error) {
    std::string line = error.what();
    std::replace(line.begin(), line.end(), '\n', ' ');
    fmt::print(stderr, "broad_phase: {}\n", line);
    return bad_input;
  } catch (const std::exception& error) {
    fmt::print(stderr, "broad_phase: {}\n", error.what());
    return not_carried_out;
  }
}
