// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/text/child_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <stdexcept>
#include <system_error>

namespace polhode::study::inline text {

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

/// Appends what can be read at once. False at the end of the file.
bool read_some(int file, std::string& text) {
  std::array<char, 4096> buffer{};
  const auto n = ::read(file, buffer.data(), buffer.size());
  if (n > 0) text.append(buffer.data(), static_cast<std::size_t>(n));
  return n > 0 || (n < 0 && errno == EINTR);
}

/// The two ends of the child's input, ours first; −1 where there is none. A socket, so that feeding a child that has
/// ended is an error and not a signal.
std::array<int, 2> input_ends(ChildProcess::Input input) {
  std::array<int, 2> ends = {-1, -1};
  if (input == ChildProcess::Input::fed && ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    check(errno, "socketpair");
  }
  return ends;
}

void close_if_open(int file) {
  if (file >= 0) ::close(file);
}

}  // namespace

std::optional<ChildProcess> ChildProcess::start(const std::vector<std::string>& command,
                                                const std::filesystem::path& folder,
                                                const std::vector<std::pair<std::string, std::string>>& environment,
                                                Input input) {
  std::array<int, 2> ends{};
  // Close-on-exec, so that a second child does not hold the first one's pipe open.
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) check(errno, "pipe2");
  const std::array<int, 2> fed = input_ends(input);
  FileActions files;
  if (input == Input::fed) {
    posix_spawn_file_actions_adddup2(&files.actions, fed[1], 0);
  } else {
    posix_spawn_file_actions_addopen(&files.actions, 0, "/dev/null", O_RDONLY, 0);
  }
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
  close_if_open(fed[1]);
  if (error != 0) {
    ::close(ends[0]);
    close_if_open(fed[0]);
  }
  if (error == ENOENT && std::filesystem::is_directory(folder)) return std::nullopt;
  check(error, fmt::format("cannot start {} in {}", command.front(), folder.string()).c_str());
  return ChildProcess(pid, ends[0], fed[0]);
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)),
      output_(std::exchange(other.output_, -1)),
      input_(std::exchange(other.input_, -1)),
      printed_(std::move(other.printed_)) {}

ChildProcess::~ChildProcess() {
  if (pid_ >= 0) wait();
}

bool ChildProcess::feed(std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    // Its output is read meanwhile, so that the two processes do not wait for each other.
    std::array<pollfd, 2> files = {{{input_, POLLOUT, 0}, {output_, POLLIN, 0}}};
    if (::poll(files.data(), files.size(), -1) < 0 && errno != EINTR) return false;
    if ((files[1].revents & POLLIN) != 0) read_some(output_, printed_);
    if ((files[0].revents & (POLLERR | POLLHUP | POLLNVAL)) != 0) return false;
    if ((files[0].revents & POLLOUT) == 0) continue;
    const auto n = ::send(input_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (n > 0) bytes = bytes.subspan(static_cast<std::size_t>(n));
    if (n < 0 && errno != EINTR && errno != EAGAIN) return false;
  }
  return true;
}

ChildProcess::Outcome ChildProcess::wait() {
  close_if_open(std::exchange(input_, -1));
  while (read_some(output_, printed_)) {
  }
  Outcome outcome{.printed = std::move(printed_)};
  ::close(output_);
  int status = 0;
  while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  outcome.exit_status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return outcome;
}

}  // namespace polhode::study::text
