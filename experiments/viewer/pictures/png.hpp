// SPDX-License-Identifier: BSD-3-Clause
// Writes pictures as PNG.
#pragma once

#include <filesystem>

#include "experiments/viewer/pictures/picture.hpp"

namespace polhode::viewer::inline pictures {

/// Under a temporary name beside the file, then renamed. Throws std::runtime_error, which names the file and the
/// reason.
void write_png(const std::filesystem::path& path, const Picture& picture);

}  // namespace polhode::viewer
