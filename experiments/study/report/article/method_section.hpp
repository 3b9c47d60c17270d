// SPDX-License-Identifier: BSD-3-Clause
// The methods of a study in LaTeX: equation, order, what is conserved, sources.
#pragma once

#include <string>
#include <vector>

#include "experiments/study/report/article/prose.hpp"

namespace polhode::study::inline report::inline article {

/// Paragraphs of the methods with these names, in this order; those that are not in the catalogue are named only.
std::string methods_in_latex(const std::vector<std::string>& methods, Prose& prose);

}  // namespace polhode::study::report::article
