// SPDX-License-Identifier: BSD-3-Clause
// Command line of `archive`.
#pragma once

#include <optional>
#include <string>

namespace polhode::study::archive {

struct ArchiveOptions {
  bool repair = false;  ///< otherwise: check
  std::string folder;
  std::optional<int> exit_status{};  ///< set if the program must end at once (--help)
};

/// Parses the command line. Throws InputError.
ArchiveOptions parse_archive_options(int argc, const char* const* argv);

}  // namespace polhode::study::archive
