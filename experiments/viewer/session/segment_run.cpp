// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/session/segment_run.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <utility>
#include <vector>

namespace polhode::viewer::inline session {

SegmentRun::SegmentRun(const study::Scenario& scenario, const Configuration& configuration)
    : configuration_(configuration),
      system_(make_system<double>(scenario.problem, study::formulation_of(configuration.run))) {
  if (configuration.run.contact) contact_.emplace(*system_, scenario, *configuration.run.contact);
  integrator_ = study::integrator_of<double>(configuration.run, *system_);
}

RunOutcome SegmentRun::go(State<double>& state, Observer& observer, const std::atomic<bool>& stop,
                          std::function<double()> next_step) {
  Schedule schedule = study::schedule_of(configuration_.run);
  if (configuration_.drive == Drive::frame_clock) schedule.next_step = std::move(next_step);
  if (!(state.t < schedule.t_end)) {
    const Layout& layout = system_->layout();
    const double joint_work = system_->has_joints() ? state.y[layout.joint_work()] : 0.0;
    const Sample sample{state.t, system_->measure(state.y), state.y[layout.work()], 0, joint_work};
    observer.on_start(state, sample);
    RunOutcome outcome;
    outcome.t = state.t;
    return outcome;
  }
  return simulate(*system_, *system_, *integrator_, state, schedule, observer, &stop,
                  contact_ ? contact_->model.get() : nullptr);
}

std::string digest(const State<double>& state) {
  std::vector<double> numbers(std::size_t(state.y.size()) + 1, state.t);
  std::copy(state.y.data(), state.y.data() + state.y.size(), numbers.begin() + 1);
  return fmt::format("{:016x}", XXH3_64bits(numbers.data(), numbers.size() * sizeof(double)));
}

std::string digest(const std::string& text) { return fmt::format("{:016x}", XXH3_64bits(text.data(), text.size())); }

}  // namespace polhode::viewer::session
