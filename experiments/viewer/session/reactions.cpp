// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/session/reactions.hpp"

#include "core/system/constraints.hpp"
#include "core/system/joint_projection.hpp"
#include "core/system/joint_reactions.hpp"

namespace polhode::viewer::inline session {

std::vector<FrameReaction> reactions_of(const System<double>& system, const State<double>& state,
                                        const VectorX<double>& multipliers) {
  if (!system.has_joints()) return {};
  const std::vector<Wrench<double>> found = joint_reactions(system, state.t, state.y, multipliers);
  const auto motions = motions_of(system, state.y);
  std::vector<FrameReaction> reactions;
  for (std::size_t i = 0; i < found.size(); ++i)
    reactions.push_back({system.constraints()->joint(i).anchor(motions), found[i].force});
  return reactions;
}

}  // namespace polhode::viewer::session
