// SPDX-License-Identifier: BSD-3-Clause
// Report of the certificates of a study: tables, sentences and certificate.csv.
#pragma once

#include "experiments/study/record/study_view.hpp"

namespace polhode::study::certificate {

Analysis certificates(const StudyView& study);

}  // namespace polhode::study::certificate
