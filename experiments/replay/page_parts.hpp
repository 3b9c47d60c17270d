// SPDX-License-Identifier: BSD-3-Clause
// Files of experiments/replay/page/, compiled into the program, so that it does not depend on their location.
#pragma once

#include <span>
#include <string_view>

namespace polhode::study::replay {

struct PagePart {
  std::string_view name;  ///< name of the file without its extension
  std::string_view text;
};

std::span<const PagePart> page_parts();

}  // namespace polhode::study::replay
