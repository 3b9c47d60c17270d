// SPDX-License-Identifier: BSD-3-Clause
// The colliding bodies of a problem, and the way from their poses to contact points: broad phase, narrow phase, and the
// data that each pair keeps between steps.
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

namespace polhode::inline collision::inline contact {

class ContactScene {
 public:
  /// Takes one collider for each body of the problem. Bodies that a joint connects do not touch each other. Throws
  /// std::invalid_argument for unknown names of broad and narrow phases and for a wrong number of colliders.
  ContactScene(const Problem& problem, std::vector<Collider> colliders, std::string_view broad_phase,
               std::string_view narrow_phase);

  /// Pairs, sorted, with at least one moving body, that may come closer than `margin` (m) while each body moves from
  /// its pose in `from` to that in `to`, on a path that deviates from the chord by at most `bulge` (m).
  std::span<const BodyPair> near_pairs(std::span<const Pose> from, std::span<const Pose> to,
                                       std::span<const double> bulge, double margin);

  /// Contact points of the pairs found by the last near_pairs(), sorted by pairs: points where the gap is at most
  /// `margin` (m) plus the `reach` (m, by body; empty: 0) of both bodies. Depth, point, normal, feature, friction and
  /// restitution are set; the caller sets approach and wanted.
  std::span<ImpulseContact> contacts(std::span<const Pose> poses, double margin, std::span<const double> reach = {});

  /// Signed distance of the k-th near pair.
  Distance distance(std::size_t k, std::span<const Pose> poses);

  /// Appends the cells of the broad phase after the last near_pairs(), for drawing.
  void cells(std::vector<Bounds>& all) const { broad_->cells(all); }

  std::size_t size() const { return colliders_.size(); }
  const Collider& collider(std::size_t body) const { return colliders_[body]; }
  /// True if every body with a shape moves freely.
  bool all_free() const { return all_free_; }
  /// Radius (m) about the mass centre that contains the body; 0 without a shape and for an infinite shape.
  double radius(std::size_t body) const { return radii_[body]; }

 private:
  struct NearPair {
    BodyPair pair;
    std::uint32_t memory;  ///< index of the memory of the pair
  };

  std::uint32_t new_memory();

  std::size_t moving_;
  std::vector<BodyPair> jointed_;  ///< sorted
  bool all_free_ = true;
  std::vector<Collider> colliders_;
  std::vector<double> radii_;
  std::unique_ptr<BroadPhase> broad_;
  std::unique_ptr<NarrowPhase> narrow_;
  std::vector<Bounds> bounds_;
  std::vector<BodyPair> pairs_;
  std::vector<NearPair> near_, before_;
  std::vector<PairMemory> memories_;
  std::vector<std::uint32_t> free_memories_;  ///< memories of pairs that are no longer near
  std::vector<ImpulseContact> contacts_;
};

/// Poses of the shapes in a state: the origin of a shape is the mass centre of its body.
void shape_poses(const System<double>& system, const VectorX<double>& y, std::vector<Pose>& poses);

/// Positions, velocities and inverse masses of all bodies.
void impulse_bodies(const System<double>& system, const VectorX<double>& y, std::vector<ImpulseBody>& bodies);

/// Updates positions and velocities of bodies made by impulse_bodies().
void impulse_motions(const System<double>& system, const VectorX<double>& y, std::vector<ImpulseBody>& bodies);

}  // namespace polhode::collision::contact
