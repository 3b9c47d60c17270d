// SPDX-License-Identifier: BSD-3-Clause
// What ends a study on the terminal.
#pragma once

#include <string>

#include "experiments/study/study_view.hpp"

namespace polhode::study {

std::string summary_table(const StudyView& study);

}  // namespace polhode::study
