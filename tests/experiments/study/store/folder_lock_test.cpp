// SPDX-License-Identifier: BSD-3-Clause
// The lock on a folder of results: one program has it, and the others report which.
#include "experiments/study/store/folder_lock.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>

#include "tests/temporary_folder.hpp"

namespace polhode::study::store_tests::folder_lock_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// The reason for which the folder cannot be locked; empty if it can.
std::string refusal_of_lock(const std::filesystem::path& folder) {
  try {
    const FolderLock lock(folder);
    return "";
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

TEST(FolderLock, OneAtATimeHasItAndTheOthersAreToldWhich) {
  const TemporaryFolder folder;
  std::optional<FolderLock> first;
  first.emplace(folder.path());
  for (int again = 0; again < 2; ++again) {
    const std::string why = refusal_of_lock(folder.path());
    EXPECT_THAT(why, AllOf(HasSubstr("another program is writing into " + folder.path().string()),
                           HasSubstr("process " + std::to_string(getpid()) + " on host "), HasSubstr(" UTC: "),
                           HasSubstr("wait for it")));
    EXPECT_EQ(why.find('\n'), std::string::npos);
  }
  EXPECT_TRUE(std::filesystem::exists(folder.path() / FolderLock::file_name)) << "a refused program took it away";
  first.reset();
  EXPECT_FALSE(std::filesystem::exists(folder.path() / FolderLock::file_name));
  EXPECT_EQ(refusal_of_lock(folder.path()), "");
}

TEST(FolderLock, EitherOfItsTwoLocksIsEnough) {
  const TemporaryFolder folder;
  const int by_folder = open(folder.path().c_str(), O_RDONLY | O_DIRECTORY);
  ASSERT_EQ(flock(by_folder, LOCK_EX), 0);
  EXPECT_THAT(refusal_of_lock(folder.path()), HasSubstr("another program"));
  close(by_folder);

  const int by_file = open((folder.path() / FolderLock::file_name).c_str(), O_RDWR | O_CREAT, 0666);
  struct flock whole = {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  ASSERT_EQ(fcntl(by_file, F_OFD_SETLK, &whole), 0);
  EXPECT_THAT(refusal_of_lock(folder.path()), HasSubstr("another program"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / FolderLock::file_name));
  close(by_file);
  EXPECT_EQ(refusal_of_lock(folder.path()), "");
}

TEST(FolderLock, WordsOfAProgramThatWasKilledAreNoObstacle) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / FolderLock::file_name) << "process 1 on host gone, since long ago: energy_drift\n";
  EXPECT_EQ(refusal_of_lock(folder.path()), "");
}

TEST(FolderLock, AFolderThatIsNotThereCannotBeLocked) {
  const TemporaryFolder folder;
  EXPECT_THAT(refusal_of_lock(folder.path() / "none"), AllOf(HasSubstr("cannot read"), HasSubstr("No such file")));
}

}  // namespace
}  // namespace polhode::study::store_tests::folder_lock_test
