// SPDX-License-Identifier: BSD-3-Clause
// What decided the digits of a session, as a file (session.toml): the scenario, and segment by segment where it
// started, how it was configured and how far it went. It is only ever appended to, after each command, where it pauses,
// and each second that it plays, so that a session that is killed leaves what it had done up to then.
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

/// A segment starts where another, counted from 1, was after so many steps; segment 0: at the scenario's start.
struct SegmentStart {
  std::int64_t segment = 0, step = 0;
};

/// Some steps, one after the other.
struct SegmentPart {
  std::int64_t steps = 0;
  std::vector<double> sizes;  ///< s, of each; where the frame clock drives
  std::string digest;         ///< of the state after them
};

struct RecordedSegment {
  SegmentStart from;
  Configuration configuration;
  std::vector<SegmentPart> parts;
  std::int64_t steps() const;
};

/// Whether a scenario is named by its file, which a record names as seen from its own folder.
bool is_path(const std::string& scenario);

struct SessionRecord {
  study::Scenario scenario;
  std::vector<RecordedSegment> segments;
};

class SessionWriter {
 public:
  /// Throws std::runtime_error, naming the file, where it cannot be written; so do the others.
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

/// The text of a file that is named `origin` in errors. Throws InputError, with line, column, key and a remedy; also
/// where the scenario is another one by now, or a configuration cannot be run.
SessionRecord parse_session(std::string_view text, const std::string& origin);
SessionRecord read_session(const std::string& path);

}  // namespace polhode::viewer
