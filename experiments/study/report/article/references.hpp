// SPDX-License-Identifier: BSD-3-Clause
// papers/references.bib, compiled in, so that a program finds it in any folder.
#pragma once

#include <span>
#include <string_view>

namespace polhode::study::inline report::inline article {

struct Bibliography {
  std::string_view name;  ///< name of the file without its ending
  std::string_view text;
};

std::span<const Bibliography> bibliographies();

}  // namespace polhode::study::report::article
