// SPDX-License-Identifier: BSD-3-Clause
// A child process in a given folder, with its output captured and optional input while it runs.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace polhode::study::inline text {

class ChildProcess {
 public:
  enum class Input { none, fed };

  /// Starts a program found on PATH, with these environment variables besides the inherited ones. Absent: the program
  /// is not installed. Throws std::runtime_error if it cannot be started for another reason.
  static std::optional<ChildProcess> start(const std::vector<std::string>& command, const std::filesystem::path& folder,
                                           const std::vector<std::pair<std::string, std::string>>& environment,
                                           Input input = Input::none);

  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&&) = delete;
  ~ChildProcess();  ///< waits for it

  struct Outcome {
    int exit_status = 0;  ///< 128 + signal if a signal ended it
    std::string printed;  ///< its stdout and stderr
  };
  /// Closes the input and waits for the end.
  Outcome wait();

  /// Writes all bytes to the input. False: the process has stopped reading.
  bool feed(std::span<const std::uint8_t> bytes);

 private:
  ChildProcess(pid_t pid, int output, int input) : pid_(pid), output_(output), input_(input) {}
  pid_t pid_;  // -1: waited for
  int output_, input_;
  std::string printed_;
};

}  // namespace polhode::study::text
