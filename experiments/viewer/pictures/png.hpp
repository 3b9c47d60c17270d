// SPDX-License-Identifier: BSD-3-Clause
// Writes pictures as PNG.
#pragma once

#include <filesystem>

#include "experiments/viewer/pictures/picture.hpp"

namespace polhode::viewer::inline pictures {

/// Writes a temporary file in the same folder, then renames it. Throws std::runtime_error with the file and the reason.
void write_png(const std::filesystem::path& path, const Picture& picture);

}  // namespace polhode::viewer::pictures
