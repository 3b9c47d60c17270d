// SPDX-License-Identifier: BSD-3-Clause
// Makes a PDF of a LaTeX document by pdflatex and bibtex.
#pragma once

#include <filesystem>
#include <string>

namespace polhode::study::inline report::inline article {

/// Compiles the document NAME.tex in the folder, as often as its references need. Returns an empty text, or, if
/// pdflatex is not installed, what to install. Throws std::runtime_error with LaTeX's first error.
std::string make_pdf(const std::filesystem::path& folder, const std::string& name);

}  // namespace polhode::study::report::article
