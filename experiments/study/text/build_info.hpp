// SPDX-License-Identifier: BSD-3-Clause
// Version, compiler and libraries of this program, for the manifest of a study.
#pragma once

#include <string_view>

namespace polhode::study::inline text {

struct BuildInfo {
  std::string_view version;
  std::string_view commit;  // git describe --always --dirty at build time; "unknown" outside a git checkout
  std::string_view compiler;
  std::string_view flags;
  std::string_view build_type;
  std::string_view eigen;
  std::string_view sundials;
  std::string_view boost;
};

const BuildInfo& build_info();

}  // namespace polhode::study::text
