// SPDX-License-Identifier: BSD-3-Clause
// The journal that is safe on a file system. Write-ahead logging needs memory shared by all programs that use the
// store, which a network file system does not give (sqlite.org/wal.html): a rollback journal is used there.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

namespace polhode::study::inline store {

enum class Journal {
  write_ahead,  ///< readers and one writer at a time; on one machine only
  rollback,     ///< one program at a time
};

/// Name of the network file system with this number in statfs::f_type (linux/magic.h, statfs(2)): "NFS"; empty for all
/// others. File systems in user space (FUSE) and those of virtual machines count as network file systems: they may be
/// shared.
std::string_view network_file_system(std::uint32_t type);

/// The journal for a store in the folder, or in its nearest existing parent.
Journal journal_of(const std::filesystem::path& folder);

}  // namespace polhode::study::store
