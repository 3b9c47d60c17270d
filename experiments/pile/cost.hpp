// SPDX-License-Identifier: BSD-3-Clause
// What a pile of bodies costs, whether its energy rises, and how deep its bodies are in each other.
#pragma once

#include "experiments/study/record/study_view.hpp"

namespace polhode::study::pile {

/// Against the number of moving bodies. Steps per second go into what is kept apart from the bytes of the study.
Analysis what_piles_cost(const StudyView& study);

}  // namespace polhode::study
