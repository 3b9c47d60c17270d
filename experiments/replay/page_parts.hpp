// SPDX-License-Identifier: BSD-3-Clause
// The files of experiments/replay/page/, compiled in, so that the program finds them wherever it runs.
#pragma once

#include <span>
#include <string_view>

namespace polhode::study::replay {

struct PagePart {
  std::string_view name;  ///< the file's name without its ending
  std::string_view text;
};

std::span<const PagePart> page_parts();

}  // namespace polhode::study
