// SPDX-License-Identifier: BSD-3-Clause
// A program run as a child of this one, in a folder, with what it prints kept; it may be fed while it runs.
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

  /// Starts a program found on PATH, with these variables set beside the inherited ones. Absent: it is not installed.
  /// Throws std::runtime_error where it cannot be started for another reason.
  static std::optional<ChildProcess> start(const std::vector<std::string>& command, const std::filesystem::path& folder,
                                           const std::vector<std::pair<std::string, std::string>>& environment,
                                           Input input = Input::none);

  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&&) = delete;
  ~ChildProcess();  ///< waits for it

  struct Outcome {
    int exit_status = 0;  ///< 128 + signal where one ended it
    std::string printed;  ///< on stdout and stderr
  };
  /// After the end of its input.
  Outcome wait();

  /// Waits until it has taken all of these bytes. False: it reads no more.
  bool feed(std::span<const std::uint8_t> bytes);

 private:
  ChildProcess(pid_t pid, int output, int input) : pid_(pid), output_(output), input_(input) {}
  pid_t pid_;  // -1: waited for
  int output_, input_;
  std::string printed_;
};

}  // namespace polhode::study::report
