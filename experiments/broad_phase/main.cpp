// SPDX-License-Identifier: BSD-3-Clause
// What does each broad phase cost as the bodies become more, and do all report the same pairs?
#include <fmt/format.h>

#include "experiments/broad_phase/costs.hpp"
#include "experiments/broad_phase/options.hpp"
#include "experiments/broad_phase/recorded.hpp"
#include "experiments/study/plan/listing.hpp"
#include "experiments/study/text/program.hpp"

namespace polhode::study::broad_phase {
namespace {

int run_broad_phase(int argc, char** argv) {
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
  return measure_costs(options);
}

}  // namespace
}  // namespace polhode::study::broad_phase

int main(int argc, char** argv) {
  using namespace polhode::study;
  using namespace polhode::study::broad_phase;
  return run_program("broad_phase", [&] { return run_broad_phase(argc, argv); });
}
