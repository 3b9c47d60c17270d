// SPDX-License-Identifier: BSD-3-Clause
// A catalogue is a list of entries that are chosen by name.
#pragma once

#include <algorithm>
#include <functional>
#include <string_view>
#include <vector>

namespace polhode::inline core::inline problem {

/// The entry of that name, or null. `name_of` gives the name of an entry; by default its member `name`.
template <class Entry, class NameOf>
const Entry* find_entry(const std::vector<Entry>& catalogue, std::string_view name, NameOf name_of) {
  const auto found = std::find_if(catalogue.begin(), catalogue.end(),
                                  [&](const Entry& entry) { return std::invoke(name_of, entry) == name; });
  return found == catalogue.end() ? nullptr : &*found;
}
template <class Entry>
const Entry* find_entry(const std::vector<Entry>& catalogue, std::string_view name) {
  return find_entry(catalogue, name, &Entry::name);
}

}  // namespace polhode::core::problem

/// Defines `const std::vector<Entry>& catalogue()` for the entries of LIST, a macro with one line ITEM(name) for each
/// entry. The function `Entry name()`, in the same namespace, makes the entry.
#define POLHODE_CATALOGUE(Entry, catalogue, LIST) \
  const std::vector<Entry>& catalogue() { \
    using Listed = Entry; \
    LIST(POLHODE_DECLARE_ENTRY) \
    static const std::vector<Entry> entries = {LIST(POLHODE_MAKE_ENTRY)}; \
    return entries; \
  }
#define POLHODE_DECLARE_ENTRY(name) extern Listed name();
#define POLHODE_MAKE_ENTRY(name) name(),
