// SPDX-License-Identifier: BSD-3-Clause
// Command line of `explain`.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace polhode::study::explain {

struct ExplainOptions {
  std::vector<std::string> ids;      ///< one or two
  std::vector<std::string> folders;  ///< folders of results, one at least
  std::optional<int> exit_status{};  ///< set if the program must end at once (--help)
};

/// Parses the command line. Throws InputError.
ExplainOptions parse_explain_options(int argc, const char* const* argv);

}  // namespace polhode::study::explain
