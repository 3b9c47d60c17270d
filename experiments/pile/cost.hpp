// SPDX-License-Identifier: BSD-3-Clause
// Computational cost of piles of bodies, rise of their energy, and penetration depth.
#pragma once

#include "experiments/study/record/study_view.hpp"

namespace polhode::study::pile {

/// The analysis, against the number of moving bodies. Steps per second are part of Analysis::timed.
Analysis what_piles_cost(const StudyView& study);

}  // namespace polhode::study::pile
