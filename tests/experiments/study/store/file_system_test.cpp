// SPDX-License-Identifier: BSD-3-Clause
// Network file systems are recognised by the numbers that statfs gives.
#include "experiments/study/store/file_system.hpp"

#include <gtest/gtest.h>
#include <linux/magic.h>

#include <cstdint>
#include <initializer_list>
#include <string_view>
#include <utility>

#include "tests/temporary_folder.hpp"

namespace polhode::study::store_tests::file_system_test {
namespace {

TEST(FileSystem, NetworkFileSystemsAreKnownByTheirNumber) {
  for (const auto& [type, name] : std::initializer_list<std::pair<std::uint32_t, std::string_view>>{
           {NFS_SUPER_MAGIC, "NFS"},   {0x0BD00BD0, "Lustre"},       {0x47504653, "GPFS"},
           {0x19830326, "BeeGFS"},     {SMB_SUPER_MAGIC, "SMB"},     {CIFS_SUPER_MAGIC, "CIFS"},
           {SMB2_SUPER_MAGIC, "SMB2"}, {FUSE_SUPER_MAGIC, "FUSE"},   {CEPH_SUPER_MAGIC, "Ceph"},
           {AFS_SUPER_MAGIC, "AFS"},   {AFS_FS_MAGIC, "AFS"},        {CODA_SUPER_MAGIC, "Coda"},
           {NCP_SUPER_MAGIC, "NCP"},   {OCFS2_SUPER_MAGIC, "OCFS2"}, {0x01161970, "GFS2"},
           {0x20030528, "OrangeFS"},   {0xAAD7AAEA, "PanFS"},        {V9FS_MAGIC, "9P"},
           {0x786F4256, "VirtualBox"}, {0xBACBACBC, "VMware"}}) {
    EXPECT_EQ(network_file_system(type), name) << std::hex << type;
  }
}

TEST(FileSystem, LocalFileSystemsAreNone) {
  for (const std::uint32_t type :
       std::initializer_list<std::uint32_t>{EXT4_SUPER_MAGIC, TMPFS_MAGIC, OVERLAYFS_SUPER_MAGIC, XFS_SUPER_MAGIC, 0}) {
    EXPECT_EQ(network_file_system(type), "") << std::hex << type;
  }
  EXPECT_EQ(network_file_system(BTRFS_SUPER_MAGIC), "");
  EXPECT_EQ(network_file_system(0x2FC12FC1), "");  // ZFS
}

TEST(FileSystem, AFolderThatIsNotThereYetHasTheJournalOfItsParent) {
  const TemporaryFolder folder;
  EXPECT_EQ(journal_of(folder.path() / "a" / "b"), journal_of(folder.path()));
}

}  // namespace
}  // namespace polhode::study::store_tests::file_system_test
