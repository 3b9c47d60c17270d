# SPDX-License-Identifier: BSD-3-Clause
# cmake -P embed_scenarios.cmake OUTPUT.cpp [SCENARIO.toml ...]: writes the table that builtin_scenarios() returns.
set(names)
math(EXPR last "${CMAKE_ARGC} - 1")
set(output ${CMAKE_ARGV3})
foreach(i RANGE 4 ${last})
  if(i GREATER last)
    break() # foreach counts down when there is no scenario
  endif()
  get_filename_component(name ${CMAKE_ARGV${i}} NAME_WLE)
  file(READ ${CMAKE_ARGV${i}} text_${name})
  list(APPEND names ${name})
endforeach()
list(SORT names)
list(LENGTH names count)

set(table)
foreach(name IN LISTS names)
  string(APPEND table "    {\"${name}\", R\"polhode(${text_${name}})polhode\"},\n")
endforeach()
file(WRITE ${output} "// SPDX-License-Identifier: BSD-3-Clause
// Generated from experiments/scenarios/ by scripts/embed_scenarios.cmake.
#include \"experiments/study/builtin_scenarios.hpp\"

#include <array>

namespace polhode::study {
namespace {

constexpr std::array<BuiltinScenario, ${count}> kScenarios{{
${table}}};

}  // namespace

std::span<const BuiltinScenario> builtin_scenarios() { return kScenarios; }

}  // namespace polhode::study
")
