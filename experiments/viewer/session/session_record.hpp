// SPDX-License-Identifier: BSD-3-Clause
// Record of a session (session.toml), from which it can be reproduced to the last digit: the scenario and, for each
// segment, its start, its configuration and its steps. The file is only appended to: after each command, at each pause,
// and every second while the session plays. A killed session leaves the record up to the last of these.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/viewer/session/session.hpp"

namespace polhode::viewer::inline session {

/// Start of a segment: the state of another segment, counted from 1, after `step` steps; segment 0: the start of the
/// scenario.
struct SegmentStart {
  std::int64_t segment = 0, step = 0;
};

/// Consecutive steps of a segment.
struct SegmentPart {
  std::int64_t steps = 0;
  std::vector<double> sizes;  ///< size of each step, s; only for the drive `frame_clock`
  std::string digest;         ///< hash of the state after the steps
};

struct RecordedSegment {
  SegmentStart from;
  Configuration configuration;
  std::vector<SegmentPart> parts;
  std::int64_t steps() const;
};

/// True if a scenario is given by the path of its file. A record contains this path relative to its own folder.
bool is_path(const std::string& scenario);

struct SessionRecord {
  study::Scenario scenario;
  std::vector<RecordedSegment> segments;
};

class SessionWriter {
 public:
  /// Creates the file. All functions throw std::runtime_error, with the path, if it cannot be written.
  SessionWriter(const std::filesystem::path& path, const SessionSetup& setup, const study::Scenario& scenario);
  SessionWriter(const SessionWriter&) = delete;
  SessionWriter& operator=(const SessionWriter&) = delete;
  ~SessionWriter();

  void begin(SegmentStart from, const Configuration& configuration);
  void add(const SegmentPart& part);

 private:
  void append(std::string_view text);

  std::string path_;
  std::FILE* file_;
};

/// Parses the text of a record; `origin` is the file name in error messages. Throws InputError, with line, column, key
/// and a remedy; also if the scenario has changed since, or a configuration cannot be run.
SessionRecord parse_session(std::string_view text, const std::string& origin);
SessionRecord read_session(const std::string& path);

}  // namespace polhode::viewer::session
