// SPDX-License-Identifier: BSD-3-Clause
// Puts the page together: its parts, three.js and the motion, in one file that asks nothing of a network.
#pragma once

#include <filesystem>
#include <string>

#include "experiments/replay/page_data.hpp"

namespace polhode::study::replay {

/// three.js and its orbit controls, as they are inlined.
struct ThreeJs {
  std::string library, controls;
};

/// From the folder that holds three.min.js (or build/three.min.js) and examples/js/controls. Throws InputError.
ThreeJs read_three(const std::filesystem::path& folder);

std::string page_of(const PageWords& words, const std::vector<Recording>& recordings, const ThreeJs& three);

/// Whether this is a page of ours, which may be written over.
bool is_replay_page(const std::filesystem::path& file);

}  // namespace polhode::study
