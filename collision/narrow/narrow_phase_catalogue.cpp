// SPDX-License-Identifier: BSD-3-Clause
#include "collision/narrow_phase.hpp"
#include "core/problem/catalogue.hpp"

// One line lists a narrow phase: the function of its name, in the file of its name in narrow/, declares it.
#define POLHODE_NARROW_PHASES(METHOD) \
  METHOD(sat) \
  METHOD(gjk) \
  METHOD(sat_course_report)

namespace polhode::inline collision::inline narrow {

POLHODE_CATALOGUE(NarrowPhaseEntry, narrow_phase_catalogue, POLHODE_NARROW_PHASES)

const NarrowPhaseEntry* find_narrow_phase(std::string_view name) { return find_entry(narrow_phase_catalogue(), name); }

}  // namespace polhode::collision::narrow
