// SPDX-License-Identifier: BSD-3-Clause
// Assembles the page: its parts, three.js and the motions in one file that needs no network.
#pragma once

#include <filesystem>
#include <string>

#include "experiments/replay/page_data.hpp"

namespace polhode::study::replay {

/// Texts of three.js and of its orbit controls, which are inlined.
struct ThreeJs {
  std::string library, controls;
};

/// Reads three.js from a folder that contains three.min.js (or build/three.min.js) and examples/js/controls. Throws
/// InputError.
ThreeJs read_three(const std::filesystem::path& folder);

std::string page_of(const PageWords& words, const std::vector<Recording>& recordings, const ThreeJs& three);

/// True if the file is a page written by this program, which may be overwritten.
bool is_replay_page(const std::filesystem::path& file);

}  // namespace polhode::study::replay
