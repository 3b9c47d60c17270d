// SPDX-License-Identifier: BSD-3-Clause
// Run options of a segment in session files.
#pragma once

#include <string>
#include <vector>

#include "experiments/study/record/run_options.hpp"

namespace polhode::viewer::inline session {

struct SegmentOption {
  const study::RunOption* option;
  std::string key;      ///< key in the file
  std::string if_true;  ///< value that is written as true, the other one as false; empty: not written as a boolean
};

/// The options of a session, in the order of the file.
std::vector<SegmentOption> segment_options();

}  // namespace polhode::viewer::session
