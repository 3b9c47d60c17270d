// SPDX-License-Identifier: BSD-3-Clause
// "did you mean …": the name nearest to one that does not exist.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace polhode::study::inline text {

/// The fewest insertions, deletions, replacements and swaps of neighbours that make b of a (Damerau 1964).
int edit_distance(std::string_view a, std::string_view b);

/// The known name nearest to this one, if it is near: one edit, and one more per four letters. Empty: none.
std::string_view nearest(std::string_view name, const std::vector<std::string_view>& known);

/// The known names that may be meant: the same but for capitals and dashes; else those of which this one is some of the
/// words (euler, explicit_euler); else the nearest; else those that begin with it, or hold it.
std::vector<std::string_view> near_names(std::string_view name, const std::vector<std::string_view>& known);

/// "; did you mean 'mass'? A body has: mass, name, …", the question only if a name is near.
/// `introduction` is "A body has".
std::string suggestion(std::string_view name, std::string_view introduction,
                       const std::vector<std::string_view>& known);

/// Where the names are too many for a line: "; did you mean 'rk4'? --list integrators prints all 45".
std::string suggestion_of_many(std::string_view name, const std::vector<std::string_view>& known,
                               std::string_view list);

/// The question alone, "; did you mean '--dt'?", or nothing. `sign` stands before each name: "--".
std::string did_you_mean(std::string_view name, const std::vector<std::string_view>& known, std::string_view sign = "");

}  // namespace polhode::study
