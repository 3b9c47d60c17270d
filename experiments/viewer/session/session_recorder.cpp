// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/session/session_recorder.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "experiments/viewer/session/segment_run.hpp"

namespace polhode::viewer::inline session {
namespace {

constexpr double between_writes = 1;  // wall time between writes, s

}  // namespace

SessionRecorder::SessionRecorder(const SessionSetup& setup, const study::Scenario& scenario)
    : trajectory_(setup.trajectory) {
  if (!setup.record.empty()) writer_ = std::make_unique<SessionWriter>(setup.record, setup, scenario);
}

template <class F>
void SessionRecorder::write(const F& f) {
  if (!writer_) return;
  try {
    f();
  } catch (const std::exception& error) {
    const std::string message = fmt::format("the session is no longer recorded: {}", error.what());
    if (unwritten_.empty()) unwritten_ = message;
    writer_.reset();
    throw std::runtime_error(message);
  }
}

void SessionRecorder::begin_segment(SegmentStart from, const Configuration& configuration) {
  written_steps_ = 0;
  sizes_.clear();
  write([&] { writer_->begin(from, configuration); });
}

void SessionRecorder::write_steps(const Kept& present) {
  since_written_ = 0;
  const std::int64_t steps = present.place.step - std::exchange(written_steps_, present.place.step);
  const std::vector<double> sizes = std::exchange(sizes_, {});
  if (steps > 0) write([&] { writer_->add({steps, sizes, digest(present.state)}); });
}

bool SessionRecorder::pass_time(double seconds) {
  since_written_ += seconds;
  return since_written_ >= between_writes;
}

std::unique_ptr<study::TrajectoryWriter> SessionRecorder::trajectory(std::int64_t segment,
                                                                     const System<double>& system) {
  if (trajectory_.empty()) return nullptr;
  return study::open_trajectory(study::TrajectoryFormat::csv, segment_folder(segment), system);
}

void SessionRecorder::finish_trajectory(std::int64_t segment) const {
  study::finish_trajectories(study::TrajectoryFormat::csv, {segment_folder(segment)});
}

std::filesystem::path SessionRecorder::segment_folder(std::int64_t segment) const {
  return trajectory_ / fmt::format("segment_{}", segment);
}

void SessionRecorder::trajectory_broke_off(const std::string& message) {
  if (!trajectory_.empty() && unwritten_.empty()) unwritten_ = message;
}

}  // namespace polhode::viewer::session
