// SPDX-License-Identifier: BSD-3-Clause
// A program run as a child of this one, in a folder, with what it prints kept.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace polhode::study::report {

class ChildProcess {
 public:
  /// Starts a program found on PATH, with these variables set beside the inherited ones. Absent: it is not installed.
  /// Throws std::runtime_error where it cannot be started for another reason.
  static std::optional<ChildProcess> start(const std::vector<std::string>& command, const std::filesystem::path& folder,
                                           const std::vector<std::pair<std::string, std::string>>& environment);

  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&&) = delete;
  ~ChildProcess();  ///< waits for it

  struct Outcome {
    int exit_status = 0;  ///< 128 + signal where one ended it
    std::string printed;  ///< on stdout and stderr
  };
  Outcome wait();

 private:
  ChildProcess(pid_t pid, int output) : pid_(pid), output_(output) {}
  pid_t pid_;  // -1: waited for
  int output_;
};

}  // namespace polhode::study::report
