// SPDX-License-Identifier: BSD-3-Clause
// Output files of a live session: its record (session.toml), and the trajectory of each segment.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "experiments/study/trajectory/trajectory.hpp"
#include "experiments/viewer/session/session_memory.hpp"
#include "experiments/viewer/session/session_record.hpp"

namespace polhode::viewer::inline session {

class SessionRecorder {
 public:
  /// Throws std::runtime_error, with the path, if the record cannot be written.
  SessionRecorder(const SessionSetup& setup, const study::Scenario& scenario);

  // The next two functions throw std::runtime_error if the record can no longer be written, and then stop recording.

  /// Records the start of a segment.
  void begin_segment(SegmentStart from, const Configuration& configuration);
  /// Writes those steps of the segment, up to the present state, that are not in the record yet.
  void write_steps(const Kept& present);

  /// Adds the size (s) of a step; only for the drive `frame_clock`.
  void add_size(double size) { sizes_.push_back(size); }
  /// Adds elapsed wall time, s. Returns true if write_steps() is due.
  bool pass_time(double seconds);

  /// An observer that writes the trajectory of a segment; null if no trajectory is to be written. Throws
  /// study::TrajectoryError.
  std::unique_ptr<study::TrajectoryWriter> trajectory(std::int64_t segment, const System<double>& system);
  /// Gives the closed files of a segment's trajectory their names. Throws study::TrajectoryError.
  void finish_trajectory(std::int64_t segment) const;
  /// Reports that a segment, and thus its trajectory, broke off with this message.
  void trajectory_broke_off(const std::string& message);

  /// The first file that could not be written, and the reason; empty: all were written.
  const std::string& unwritten() const { return unwritten_; }

 private:
  template <class F>
  void write(const F& f);
  std::filesystem::path segment_folder(std::int64_t segment) const;

  const std::filesystem::path trajectory_;
  std::unique_ptr<SessionWriter> writer_;
  std::int64_t written_steps_ = 0;  ///< number of steps of the present segment in the record
  std::vector<double> sizes_;       ///< sizes of the steps that are not written yet, s
  double since_written_ = 0;        ///< wall time since the last writing, s
  std::string unwritten_;
};

}  // namespace polhode::viewer::session
