// SPDX-License-Identifier: BSD-3-Clause
// The motions that are passed to the forces, and the wrenches that the forces add up for each body: the accumulators of
// the engine slides, "Rigid Body Data".
#pragma once

#include <utility>
#include <vector>

#include "core/system/body_variables.hpp"
#include "core/system/constraints.hpp"

namespace polhode::inline core::inline system {

/// The bodies of a system with the forces on them. The motions and wrenches are scratch storage; a system serves one
/// run on one thread.
template <class S, Orientation O, AngularState A, BodyCount N>
class BodyWrenches : public BodyVariables<S, O, A, N> {
 public:
  /// A single free body has no joint: a body that is joined to the world is one of `many`.
  static constexpr bool may_have_joints = N == BodyCount::many;

  /// Result of System::has_forces(). Lanes have no joints; a check for joints in every stage costs a twentieth of a
  /// step.
  bool has_forces() const {
    if constexpr (is_lanes<S>) return !this->forces().empty();
    else return BodyVariables<S, O, A, N>::has_forces();
  }

  /// Fills the motions that are passed to forces. Skips rotations and angular velocities if no force reads them.
  void fill_motions(const S* y) const {
    for (std::size_t i = 0; i < this->count(); ++i) {
      if (this->forces_read_rotation()) {
        motions_[i] = this->motion(y, i);
      } else if (!this->pinned(i)) {
        motions_[i].position = load_vector(y + this->slot(i).position);
        motions_[i].velocity = load_vector(y + this->slot(i).velocity);
      }
    }
  }

  /// Fills the wrenches under the motions of the last fill_motions().
  void fill_wrenches(S t) const {
    for (auto& w : wrenches_) w = Wrench<S>{};
    for (const auto& force : this->forces()) force->add_wrench(t, motions_, wrenches_);
    if constexpr (may_have_joints) {
      if (this->has_joints()) this->constraints()->add_reactions(motions_, wrenches_);
    }
  }

  /// Power (W) of the forces under the motions of the last fill_motions().
  S power(S t) const {
    S p(0);
    for (const auto& force : this->forces()) {
      if (force->does_work()) p += force->power(t, motions_);
    }
    return p;
  }

  /// The moving bodies in the scenario's order, then the static ones.
  std::vector<BodyMotion<S>>& motions() const { return motions_; }
  const std::vector<Wrench<S>>& wrenches() const { return wrenches_; }

 protected:
  BodyWrenches(std::vector<Problem> problems, const Formulation& formulation)
      : BodyVariables<S, O, A, N>(std::move(problems), formulation),
        motions_(this->problem().bodies.size(),
                 {Vector3<S>::Zero(), Matrix3<S>::Identity(), Vector3<S>::Zero(), Vector3<S>::Zero()}),
        wrenches_(motions_.size()) {}

 private:
  mutable std::vector<BodyMotion<S>> motions_;
  mutable std::vector<Wrench<S>> wrenches_;
};

}  // namespace polhode::core::system
