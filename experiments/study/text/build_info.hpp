// SPDX-License-Identifier: BSD-3-Clause
// Version, compiler and libraries of this program, for the manifest of a study.
#pragma once

#include <array>
#include <string_view>

namespace polhode::study::inline text {

struct Library {
  std::string_view name, version;
};

struct BuildInfo {
  std::string_view version;
  std::string_view commit;  // git describe --always --dirty at build time; "unknown" outside a git checkout
  std::string_view compiler;
  std::string_view flags;
  std::string_view build_type;
  std::array<Library, 13> libraries;  // libraries that were found when the build was configured

  /// True if the checkout had changes that the commit does not have.
  bool dirty() const { return commit.ends_with("-dirty"); }
};

const BuildInfo& build_info();

}  // namespace polhode::study::text
