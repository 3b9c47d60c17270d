// SPDX-License-Identifier: BSD-3-Clause
// FCL's signed distance behind plain numbers: FCL comes compiled with another alignment of Eigen's types than ours, so
// that no such type may pass between the two.
#pragma once

#include <memory>
#include <vector>

namespace polhode::peers {

struct FclShape {
  std::vector<double> half_extents;  ///< half extents of a box; empty for a hull
  std::vector<double> vertices;      ///< x, y, z, …
  std::vector<int> faces;            ///< count, then as many vertices, …
  int face_count = 0;
  double position[3], rotation[9];  ///< the matrix row by row
};

class FclPairs {
 public:
  FclPairs();
  ~FclPairs();
  void add(const FclShape& a, const FclShape& b);
  double distances() const;  ///< sum of the distances of all pairs

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace polhode::peers
