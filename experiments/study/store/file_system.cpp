// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/store/file_system.hpp"

#include <sys/vfs.h>

namespace polhode::study::inline store {
namespace {

struct NetworkFileSystem {
  std::uint32_t type;
  std::string_view name;
};

constexpr NetworkFileSystem network_file_systems[] = {
    {0x00006969, "NFS"},         // linux/magic.h
    {0x0BD00BD0, "Lustre"},      // lustre_user.h
    {0x47504653, "GPFS"},        // "GPFS"
    {0x19830326, "BeeGFS"},      // beegfs client, SuperBlock
    {0x0000517B, "SMB"},         // linux/magic.h
    {0xFF534D42, "CIFS"},        // linux/magic.h
    {0xFE534D42, "SMB2"},        // linux/magic.h
    {0x65735546, "FUSE"},        // linux/magic.h
    {0x00C36400, "Ceph"},        // linux/magic.h
    {0x5346414F, "AFS"},         // linux/magic.h: OpenAFS
    {0x6B414653, "AFS"},         // linux/magic.h: kAFS
    {0x73757245, "Coda"},        // linux/magic.h
    {0x0000564C, "NCP"},         // linux/magic.h
    {0x7461636F, "OCFS2"},       // linux/magic.h
    {0x01161970, "GFS2"},        // linux/gfs2_ondisk.h
    {0x20030528, "OrangeFS"},    // fs/orangefs
    {0xAAD7AAEA, "PanFS"},       // coreutils, stat.c
    {0x01021997, "9P"},          // linux/magic.h
    {0x786F4256, "VirtualBox"},  // fs/vboxsf
    {0xBACBACBC, "VMware"},      // coreutils, stat.c: vmhgfs
};

}  // namespace

std::string_view network_file_system(std::uint32_t type) {
  for (const NetworkFileSystem& one : network_file_systems) {
    if (one.type == type) return one.name;
  }
  return {};
}

Journal journal_of(const std::filesystem::path& folder) {
  std::filesystem::path at = std::filesystem::absolute(folder);
  struct statfs facts = {};
  while (statfs(at.c_str(), &facts) != 0) {
    if (at == at.parent_path()) return Journal::rollback;  // safe everywhere
    at = at.parent_path();
  }
  const bool network = !network_file_system(static_cast<std::uint32_t>(facts.f_type)).empty();
  return network ? Journal::rollback : Journal::write_ahead;
}

}  // namespace polhode::study::store
