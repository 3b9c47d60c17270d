// SPDX-License-Identifier: BSD-3-Clause
// What of the bodies can touch, and the way from where they stand to the points where they do: broad phase, narrow
// phase, and what a pair remembers from one step to the next.
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "collision/broad_phase.hpp"
#include "collision/contact/collider.hpp"
#include "collision/narrow_phase.hpp"
#include "collision/response.hpp"
#include "core/system/system.hpp"

namespace polhode::inline collision {

class ContactScene {
 public:
  /// One collider for each body of the problem. Throws std::invalid_argument for names that the catalogues do not have,
  /// and for another number of colliders.
  ContactScene(const Problem& problem, std::vector<Collider> colliders, std::string_view broad_phase,
               std::string_view narrow_phase);

  /// The pairs with a moving body of which some two points may come closer than `margin` (m) while each body goes from
  /// one of its poses to the other, on a path that leaves the chord by at most `bulge` (m); sorted.
  std::span<const BodyPair> near_pairs(std::span<const Pose> from, std::span<const Pose> to,
                                       std::span<const double> bulge, double margin);

  /// The points of the near pairs that were found last where surfaces are no further apart than `margin` and what both
  /// bodies `reach` (m, by body; none: 0); sorted by pairs. Depth, point, normal, feature and the pair's surface are
  /// filled in; approach and wanted are left to the caller.
  std::span<ImpulseContact> contacts(std::span<const Pose> poses, double margin, std::span<const double> reach = {});

  /// Of the near pair number k.
  Distance distance(std::size_t k, std::span<const Pose> poses);

  /// Appends the cells of the broad phase as near_pairs() left them, for drawing.
  void cells(std::vector<Bounds>& all) const { broad_->cells(all); }

  std::size_t size() const { return colliders_.size(); }
  const Collider& collider(std::size_t body) const { return colliders_[body]; }
  /// True where everything that can touch is a body that moves freely.
  bool all_free() const { return all_free_; }
  /// m, the radius about the mass centre that holds the body; 0 without a shape and of what has no end.
  double radius(std::size_t body) const { return radii_[body]; }

 private:
  struct NearPair {
    BodyPair pair;
    std::uint32_t memory;  ///< which of the memories is the pair's
  };

  std::uint32_t new_memory();

  std::size_t moving_;
  bool all_free_ = true;
  std::vector<Collider> colliders_;
  std::vector<double> radii_;
  std::unique_ptr<BroadPhase> broad_;
  std::unique_ptr<NarrowPhase> narrow_;
  std::vector<Bounds> bounds_;
  std::vector<BodyPair> pairs_;
  std::vector<NearPair> near_, before_;
  std::vector<PairMemory> memories_;
  std::vector<std::uint32_t> free_memories_;  ///< of pairs that are no longer near
  std::vector<ImpulseContact> contacts_;
};

/// The poses of the shapes in a state: at the mass centre.
void shape_poses(const System<double>& system, const VectorX<double>& y, std::vector<Pose>& poses);

/// The bodies as impulses see them.
void impulse_bodies(const System<double>& system, const VectorX<double>& y, std::vector<ImpulseBody>& bodies);

/// Their places and velocities alone, of bodies that were made by that.
void impulse_motions(const System<double>& system, const VectorX<double>& y, std::vector<ImpulseBody>& bodies);

}  // namespace polhode
