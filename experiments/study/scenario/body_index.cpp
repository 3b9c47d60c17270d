// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/scenario/body_index.hpp"

#include <string_view>

namespace polhode::study::inline scenario {

const NamedBody& read_body_name(const TomlCursor& name, const BodyIndex& index) {
  const auto found = index.find(name.text("the name of a body"));
  if (found != index.end()) return found->second;
  std::vector<std::string_view> known;
  for (const auto& body : index) known.push_back(body.first);
  name.unknown("body", "There are", known);
}

}  // namespace polhode::study::scenario
