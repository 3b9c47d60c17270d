// SPDX-License-Identifier: BSD-3-Clause
// Writer of report.html.
#pragma once

#include "experiments/study/record/study_view.hpp"

namespace polhode::study::inline report::inline page {

/// Writes report.html, a self-contained page that opens without a network: runs, findings, figures and tables.
void write_report(const StudyView& study);

}  // namespace polhode::study::report::page
