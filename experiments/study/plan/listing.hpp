// SPDX-License-Identifier: BSD-3-Clause
// --list: the catalogues, one line of physics or mathematics per entry.
#pragma once

#include <string>

namespace polhode::study {

/// `what` as --list takes it, "" for everything. Throws InputError on an unknown word.
std::string listing(const std::string& what);

}  // namespace polhode::study
