// SPDX-License-Identifier: BSD-3-Clause

#include "collision/narrow_phase.hpp"
#include "core/problem/catalogue.hpp"

// One line lists a narrow phase: the function of its name, in the file of its name in narrow/, declares it.
#define POLHODE_NARROW_PHASES(METHOD) \
  METHOD(sat) \
  METHOD(gjk) \
  METHOD(sat_course_report)

namespace polhode::inline collision {

#define POLHODE_DECLARE(name) NarrowPhaseEntry name();
POLHODE_NARROW_PHASES(POLHODE_DECLARE)

const std::vector<NarrowPhaseEntry>& narrow_phase_catalogue() {
#define POLHODE_ENTRY(name) name(),
  static const std::vector<NarrowPhaseEntry> entries = {POLHODE_NARROW_PHASES(POLHODE_ENTRY)};
  return entries;
}

const NarrowPhaseEntry* find_narrow_phase(std::string_view name) { return find_entry(narrow_phase_catalogue(), name); }

}  // namespace polhode::collision
