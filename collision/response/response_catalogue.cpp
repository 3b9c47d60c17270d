// SPDX-License-Identifier: BSD-3-Clause
#include "collision/response.hpp"
#include "core/problem/catalogue.hpp"

// One line lists a response: the function of its name, in the file of its name in response/, declares it.
#define POLHODE_RESPONSES(METHOD) \
  METHOD(single_impulse) \
  METHOD(sequential_impulses) \
  METHOD(simultaneous) \
  METHOD(compliant)

namespace polhode::inline collision::inline response {

POLHODE_CATALOGUE(ResponseEntry, response_catalogue, POLHODE_RESPONSES)

const ResponseEntry* find_response(std::string_view name) { return find_entry(response_catalogue(), name); }

std::vector<ResponseEntry> impulse_responses() {
  std::vector<ResponseEntry> some = response_catalogue();
  std::erase_if(some, [](const ResponseEntry& e) { return !e.make; });
  return some;
}

}  // namespace polhode::collision::response
