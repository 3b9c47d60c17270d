// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "collision/response.hpp"

// One line lists a response: the function of its name, in the file of its name in response/, declares it.
#define POLHODE_RESPONSES(METHOD) \
  METHOD(single_impulse) \
  METHOD(sequential_impulses) \
  METHOD(simultaneous) \
  METHOD(compliant)

namespace polhode {

#define POLHODE_DECLARE(name) ResponseEntry name();
POLHODE_RESPONSES(POLHODE_DECLARE)

const std::vector<ResponseEntry>& response_catalogue() {
#define POLHODE_ENTRY(name) name(),
  static const std::vector<ResponseEntry> entries = {POLHODE_RESPONSES(POLHODE_ENTRY)};
  return entries;
}

const ResponseEntry* find_response(std::string_view name) {
  const auto& all = response_catalogue();
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& e) { return e.name == name; });
  return found == all.end() ? nullptr : &*found;
}

std::vector<ResponseEntry> impulse_responses() {
  std::vector<ResponseEntry> some = response_catalogue();
  std::erase_if(some, [](const ResponseEntry& e) { return !e.make; });
  return some;
}

}  // namespace polhode
