// SPDX-License-Identifier: BSD-3-Clause
// The joints of a scenario: the tables under [[joint]], and the check that the start closes them.
#pragma once

#include "experiments/study/scenario/body_index.hpp"
#include "experiments/study/scenario/scenario.hpp"

namespace polhode::study::inline scenario {

/// Reads the joints into the problem. The start must close every joint to 1e-9 (m, rad, m/s, rad/s); with
/// `assemble = true` it is projected onto the joints instead. Fills Scenario::notes with what was moved and with the
/// joints whose equations depend on others. Throws a Fault.
void read_joints(const TomlCursor& root, const BodyIndex& index, Scenario& scenario);

}  // namespace polhode::study::scenario
