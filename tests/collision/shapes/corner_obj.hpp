// SPDX-License-Identifier: BSD-3-Clause
// A surface that is not convex, as an OBJ file.
#pragma once

#include <array>
#include <filesystem>
#include <fstream>

#include "core/math/linear_algebra.hpp"

namespace polhode {

/// Writes an L of two cuboids: 3 × 1 × 1, and 1 × 1 × 2 above its end.
inline void write_corner_obj(const std::filesystem::path& path) {
  std::ofstream file(path);
  const auto cuboid = [&](const char* name, int base, const Vector3<double>& low, const Vector3<double>& high) {
    file << "o " << name << "\n";
    for (int k = 0; k < 8; ++k) {
      for (int i = 0; i < 3; ++i) file << (i ? " " : "v ") << (k >> i & 1 ? high[i] : low[i]);
      file << "\n";
    }
    for (const auto& f :
         {std::array{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}) {
      file << "f " << base + f[0] << " " << base + f[1] << " " << base + f[2] << " " << base + f[3] << "\n";
    }
  };
  cuboid("foot", 1, {0, 0, 0}, {3, 1, 1});
  cuboid("post", 9, {2, 0, 1}, {3, 1, 3});
}

}  // namespace polhode
