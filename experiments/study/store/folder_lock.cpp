// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/store/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <stdexcept>

#include "experiments/study/text/legible.hpp"
#include "experiments/study/text/read_file.hpp"

namespace polhode::study::inline store {
namespace {

enum class Taken { yes, by_another, impossible };

Taken take_folder(int handle) {
  if (flock(handle, LOCK_EX | LOCK_NB) == 0) return Taken::yes;
  return errno == EWOULDBLOCK ? Taken::by_another : Taken::impossible;
}

/// A lock of the open file, which another thread of this process does not release by closing the file elsewhere.
Taken take_file(int handle) {
  struct flock whole = {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  if (fcntl(handle, F_OFD_SETLK, &whole) == 0) return Taken::yes;
  return errno == EAGAIN || errno == EACCES ? Taken::by_another : Taken::impossible;
}

/// True if the path leads to the open file. It does not if the program that had the lock has removed the file since.
bool leads_to(const std::filesystem::path& path, int handle) {
  struct stat at_path = {}, open_file = {};
  return stat(path.c_str(), &at_path) == 0 && fstat(handle, &open_file) == 0 && at_path.st_ino == open_file.st_ino &&
         at_path.st_dev == open_file.st_dev;
}

/// The beginning of the command line of this process, with blanks between the arguments.
std::string own_command() {
  std::string command = read_file("/proc/self/cmdline").value_or("unknown command");
  while (!command.empty() && command.back() == '\0') command.pop_back();
  std::replace(command.begin(), command.end(), '\0', ' ');
  return legible(command.substr(0, 200));
}

std::string own_words() {
  char host[256] = "unknown";
  gethostname(host, sizeof host - 1);
  const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
  return fmt::format("process {} on host {}, since {:%Y-%m-%d %H:%M:%S} UTC: {}\n", getpid(), host,
                     fmt::gmtime(std::chrono::system_clock::to_time_t(now)), own_command());
}

[[noreturn]] void refuse_lock(const std::string& why) { throw std::runtime_error(why); }

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder) : folder_(folder) {
  const std::filesystem::path path = folder / file_name;
  try {
    folder_handle_ = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder_handle_ < 0) {
      refuse_lock(fmt::format("cannot read {}: {}; make it readable (chmod u+r), or name another folder",
                              folder.string(), std::strerror(errno)));
    }
    const Taken by_folder = take_folder(folder_handle_);
    Taken by_file = by_folder;
    while (by_folder != Taken::by_another) {
      // Permission bits do not show whether root can write, so the file is opened.
      file_handle_ = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
      if (file_handle_ < 0) {
        refuse_lock(fmt::format("cannot write into {}: {}; make it writable, or name another folder", folder.string(),
                                std::strerror(errno)));
      }
      by_file = take_file(file_handle_);
      if (by_file != Taken::yes || leads_to(path, file_handle_)) break;
      close(file_handle_);
    }
    if (by_folder == Taken::by_another || by_file == Taken::by_another) {
      refuse_lock(fmt::format("another program is writing into {}{}; wait for it, or name another folder",
                              folder.string(), holder(folder)));
    }
    if (by_folder == Taken::impossible && by_file == Taken::impossible) {
      refuse_lock(fmt::format("cannot lock {}: {}; name a folder on another file system", folder.string(),
                              std::strerror(errno)));
    }
    held_ = true;
    const std::string words = own_words();
    if (ftruncate(file_handle_, 0) != 0 || pwrite(file_handle_, words.data(), words.size(), 0) < 0) {
      // The lock has no words on a full disk.
    }
  } catch (...) {
    release();
    throw;
  }
}

FolderLock::~FolderLock() { release(); }

void FolderLock::release() {
  if (held_) unlink((folder_ / file_name).c_str());
  if (file_handle_ >= 0) close(file_handle_);
  if (folder_handle_ >= 0) close(folder_handle_);
}

std::string FolderLock::holder(const std::filesystem::path& folder) {
  std::string words = read_file(folder / file_name).value_or("");
  while (!words.empty() && words.back() == '\n') words.pop_back();
  return words.empty() ? "" : " (" + legible(words) + ")";
}

}  // namespace polhode::study::store
