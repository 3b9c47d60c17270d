// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report/child_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <stdexcept>
#include <system_error>

namespace polhode::study::report {

namespace {

void check(int error, const char* what) {
  if (error != 0) throw std::runtime_error(fmt::format("{}: {}", what, std::generic_category().message(error)));
}

struct FileActions {
  posix_spawn_file_actions_t actions;
  FileActions() { check(posix_spawn_file_actions_init(&actions), "posix_spawn_file_actions_init"); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;
  ~FileActions() { posix_spawn_file_actions_destroy(&actions); }
};

/// A child starts with no signal blocked or ignored, whatever its parent does with SIGINT and SIGPIPE.
struct Attributes {
  posix_spawnattr_t attributes;
  Attributes() {
    check(posix_spawnattr_init(&attributes), "posix_spawnattr_init");
    sigset_t none, usual;
    sigemptyset(&none);
    sigemptyset(&usual);
    for (const int signal : {SIGINT, SIGTERM, SIGPIPE}) sigaddset(&usual, signal);
    check(posix_spawnattr_setsigmask(&attributes, &none), "posix_spawnattr_setsigmask");
    check(posix_spawnattr_setsigdefault(&attributes, &usual), "posix_spawnattr_setsigdefault");
    check(posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF),
          "posix_spawnattr_setflags");
  }
  Attributes(const Attributes&) = delete;
  Attributes& operator=(const Attributes&) = delete;
  ~Attributes() { posix_spawnattr_destroy(&attributes); }
};

std::vector<std::string> environment_with(const std::vector<std::pair<std::string, std::string>>& added) {
  std::vector<std::string> all;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    bool replaced = false;
    for (const auto& [key, value] : added) replaced = replaced || text.rfind(key + "=", 0) == 0;
    if (!replaced) all.push_back(text);
  }
  for (const auto& [key, value] : added) all.push_back(key + "=" + value);
  return all;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> all;
  for (auto& text : texts) all.push_back(text.data());
  all.push_back(nullptr);
  return all;
}

std::string read_all(int file) {
  std::string text;
  std::array<char, 4096> buffer{};
  for (;;) {
    const auto n = ::read(file, buffer.data(), buffer.size());
    if (n > 0)
      text.append(buffer.data(), static_cast<std::size_t>(n));
    else if (n == 0 || errno != EINTR)
      return text;
  }
}

}  // namespace

std::optional<ChildProcess> ChildProcess::start(const std::vector<std::string>& command,
                                                const std::filesystem::path& folder,
                                                const std::vector<std::pair<std::string, std::string>>& environment) {
  std::array<int, 2> ends{};
  // Close-on-exec, so that a second child does not hold the first one's pipe open.
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) check(errno, "pipe2");
  FileActions files;
  posix_spawn_file_actions_addopen(&files.actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&files.actions, ends[1], 1);
  posix_spawn_file_actions_adddup2(&files.actions, ends[1], 2);
  posix_spawn_file_actions_addchdir_np(&files.actions, folder.c_str());
  const Attributes attributes;
  auto arguments = command;
  auto variables = environment_with(environment);
  pid_t pid = -1;
  const int error = posix_spawnp(&pid, command.front().c_str(), &files.actions, &attributes.attributes,
                                 pointers(arguments).data(), pointers(variables).data());
  ::close(ends[1]);
  if (error != 0) ::close(ends[0]);
  if (error == ENOENT && std::filesystem::is_directory(folder)) return std::nullopt;
  check(error, fmt::format("cannot start {} in {}", command.front(), folder.string()).c_str());
  return ChildProcess(pid, ends[0]);
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)), output_(std::exchange(other.output_, -1)) {}

ChildProcess::~ChildProcess() {
  if (pid_ >= 0) wait();
}

ChildProcess::Outcome ChildProcess::wait() {
  Outcome outcome{.printed = read_all(output_)};
  ::close(output_);
  int status = 0;
  while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  outcome.exit_status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return outcome;
}

}  // namespace polhode::study::report
