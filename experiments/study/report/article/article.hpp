// SPDX-License-Identifier: BSD-3-Clause
// The folder article/ of a study: a LaTeX article of its question, answer, figures, tables, methods, scenarios and
// provenance, and its PDF.
#pragma once

#include <string>

#include "experiments/study/record/study_view.hpp"

namespace polhode::study::inline report::inline article {

inline constexpr const char* article_folder = "article";

/// Writes article/article.tex, its sections, tables, figures, numbers.tex and references.bib into the folder of the
/// study, then article.pdf. Reads manifest.json, which must be there before. Returns a message if there is no
/// PDF, since pdflatex is not installed, else an empty text. Throws std::runtime_error if LaTeX finds an error.
std::string write_article(const StudyView& study);

}  // namespace polhode::study::report::article
