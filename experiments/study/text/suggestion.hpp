// SPDX-License-Identifier: BSD-3-Clause
// "did you mean …": the known name nearest to an unknown one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace polhode::study::inline text {

/// Edit distance of a and b: insertions, deletions, replacements and swaps of neighbours (Damerau 1964).
int edit_distance(std::string_view a, std::string_view b);

/// The nearest known name within one edit plus one more per four letters; empty if there is none.
std::string_view nearest(std::string_view name, const std::vector<std::string_view>& known);

/// The known names that may be meant. In this order: equal but for capitals and dashes; names that contain the words of
/// this one (euler, explicit_euler); the nearest name; names that begin with it or contain it.
std::vector<std::string_view> near_names(std::string_view name, const std::vector<std::string_view>& known);

/// "; did you mean 'mass'? A body has: mass, name, …"; the question is there only if a name is near. `introduction` is
/// "A body has".
std::string suggestion(std::string_view name, std::string_view introduction,
                       const std::vector<std::string_view>& known);

/// A suggestion for catalogues too long for one line: "; did you mean 'rk4'? --list integrators prints all 45".
std::string suggestion_of_many(std::string_view name, const std::vector<std::string_view>& known,
                               std::string_view list);

/// The question alone, "; did you mean '--dt'?", or empty. `sign` is put before each name: "--".
std::string did_you_mean(std::string_view name, const std::vector<std::string_view>& known, std::string_view sign = "");

}  // namespace polhode::study::text
