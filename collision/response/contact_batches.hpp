// SPDX-License-Identifier: BSD-3-Clause
// Contacts in SIMD lanes: patches that share no moving body stand side by side, one in each lane, so that a
// Gauss–Seidel sweep treats several at once. A graph colouring decides which patches may stand together (Fratarcangeli,
// Tibaldi & Pellacini, "Vivace", 2016). The order of the colours is the order of the sweep, and does not depend on the
// width of the registers.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "collision/response.hpp"
#include "core/math/lanes.hpp"

namespace polhode::inline collision::inline response {

/// The quantity of a body that a sweep changes: its velocity (m/s, rad/s), or the displacement that undoes penetration
/// (m, rad), of the mass centre or pivot, world axes. One cache line.
struct alignas(64) ImpulseMotion {
  std::array<double, 3> linear{}, angular{};
};

/// The largest of all lanes.
inline double largest(const Lanes& x) {
  double most = x[0];
  for (int i = 1; i < lane_count; ++i) most = std::max(most, x[i]);
  return most;
}
inline Vector3<Lanes> zero_lanes() { return {Lanes(0), Lanes(0), Lanes(0)}; }

/// Inverse inertias, one in each lane, 1/(kg m²), world axes.
struct SymmetricLanes {
  Lanes xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  [[gnu::always_inline]] Vector3<Lanes> operator*(const Vector3<Lanes>& v) const {
    return {xx * v[0] + xy * v[1] + xz * v[2], xy * v[0] + yy * v[1] + yz * v[2], xz * v[0] + yz * v[1] + zz * v[2]};
  }
};

[[gnu::always_inline]] inline Vector3<Lanes> cross(const Vector3<Lanes>& a, const Vector3<Lanes>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
[[gnu::always_inline]] inline Lanes dot(const Vector3<Lanes>& a, const Vector3<Lanes>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Patches of different bodies, one in each lane. A patch is the contact points of two bodies A and B with one normal.
/// World axes, SI units.
struct PatchBatch {
  std::array<std::uint32_t, lane_count> a{}, b{};  ///< the bodies; one past the last body in an empty lane
  std::uint32_t first_point = 0, point_count = 0;  ///< first point, and number of points of the largest patch
  Vector3<Lanes> normal = zero_lanes(), tangent = zero_lanes(), bitangent = zero_lanes();  ///< normal: from B to A
  Lanes inverse_mass_a = 0, inverse_mass_b = 0;
  SymmetricLanes inverse_inertia_a, inverse_inertia_b;
};

/// One point of each patch of a batch. Points without effect fill patches that are smaller than the largest one; they
/// lie at the mass centres and have no mass.
struct PointBatch {
  Vector3<Lanes> lever_a = zero_lanes(), lever_b = zero_lanes();  ///< lever arms from the bodies' positions, m
  Lanes normal_mass = 0;  ///< effective mass 1/K_nn, kg; 0 if no impulse can change the velocities
};

/// The change of the velocity (m/s) of A relative to B at a point by an impulse j (N s) on A there, K j.
inline Vector3<Lanes> mobility_along(const PatchBatch& patch, const PointBatch& point, const Vector3<Lanes>& j) {
  return (patch.inverse_mass_a + patch.inverse_mass_b) * j +
         cross(patch.inverse_inertia_a * cross(point.lever_a, j), point.lever_a) +
         cross(patch.inverse_inertia_b * cross(point.lever_b, j), point.lever_b);
}

class ContactBatches {
 public:
  static constexpr std::uint32_t none = 0xffffffff;

  /// Sorts the contacts into batches. At most 8 consecutive contacts of the same two bodies with the same normal are a
  /// patch. The numbers in contacts() are those in this list.
  void build(std::span<const ImpulseBody> bodies, std::span<const ImpulseContact> contacts);

  std::span<const PatchBatch> patches() const { return patches_; }
  std::span<const PointBatch> points() const { return points_; }
  /// The contact in each lane of a point; none in a lane without effect.
  std::span<const std::array<std::uint32_t, lane_count>> contacts() const { return contacts_; }

 private:
  struct Patch {
    std::uint32_t first, count, colour;
  };

  void find_patches(std::span<const ImpulseBody> bodies, std::span<const ImpulseContact> contacts);
  void sort_patches();
  void add_batch(std::span<const ImpulseBody> bodies, std::span<const ImpulseContact> contacts,
                 std::span<const Patch> lanes);

  std::vector<Patch> found_, sorted_;
  std::vector<std::uint32_t> starts_;      ///< beginnings of the groups to be sorted
  std::vector<std::uint64_t> colours_of_;  ///< colours that each body has, one in each bit
  std::vector<PatchBatch> patches_;
  std::vector<PointBatch> points_;
  std::vector<std::array<std::uint32_t, lane_count>> contacts_;
};

/// The motions of the two bodies of each lane.
struct PairMotion {
  Vector3<Lanes> va, wa, vb, wb;

  PairMotion(const PatchBatch& patch, const ImpulseMotion* motions)
      : va(lanes(patch.a, motions, &ImpulseMotion::linear)),
        wa(lanes(patch.a, motions, &ImpulseMotion::angular)),
        vb(lanes(patch.b, motions, &ImpulseMotion::linear)),
        wb(lanes(patch.b, motions, &ImpulseMotion::angular)) {}
  void store(const PatchBatch& patch, ImpulseMotion* motions) const {
    for (int i = 0; i < lane_count; ++i) {
      ImpulseMotion &a = motions[patch.a[std::size_t(i)]], &b = motions[patch.b[std::size_t(i)]];
      for (int k = 0; k < 3; ++k) {
        a.linear[std::size_t(k)] = va[k][i];
        a.angular[std::size_t(k)] = wa[k][i];
        b.linear[std::size_t(k)] = vb[k][i];
        b.angular[std::size_t(k)] = wb[k][i];
      }
    }
  }
  /// Velocity of A relative to B at a point.
  [[gnu::always_inline]] Vector3<Lanes> at(const PointBatch& point) const {
    return (va + cross(wa, point.lever_a)) - (vb + cross(wb, point.lever_b));
  }
  /// Applies an impulse to A and its reaction to B.
  [[gnu::always_inline]] void push(const PatchBatch& patch, const PointBatch& point, const Vector3<Lanes>& impulse) {
    va += patch.inverse_mass_a * impulse;
    wa += patch.inverse_inertia_a * cross(point.lever_a, impulse);
    vb -= patch.inverse_mass_b * impulse;
    wb -= patch.inverse_inertia_b * cross(point.lever_b, impulse);
  }

 private:
  using Numbers = std::array<std::uint32_t, lane_count>;
  using Part = std::array<double, 3> ImpulseMotion::*;

  static Vector3<Lanes> lanes(const Numbers& bodies, const ImpulseMotion* motions, Part part) {
    return lanes(bodies, motions, part, std::make_index_sequence<lane_count>());
  }
  template <std::size_t... I>
  static Vector3<Lanes> lanes(const Numbers& bodies, const ImpulseMotion* motions, Part part,
                              std::index_sequence<I...>) {
    return {Lanes(Lanes::Pack{(motions[bodies[I]].*part)[0]...}), Lanes(Lanes::Pack{(motions[bodies[I]].*part)[1]...}),
            Lanes(Lanes::Pack{(motions[bodies[I]].*part)[2]...})};
  }
};

}  // namespace polhode::collision::response
