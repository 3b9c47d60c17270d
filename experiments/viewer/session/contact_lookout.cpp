// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/session/contact_lookout.hpp"

#include <algorithm>
#include <iterator>

namespace polhode::viewer::inline session {
namespace {

constexpr double touching = 1e-6, apart = 1e-3;  // distances over the largest body radius

void sort_once(std::vector<BodyPair>& pairs) {
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

}  // namespace

ContactLookout::ContactLookout(const study::Scenario& scenario, const study::ContactConfig& config)
    : scene_(scenario.problem, scenario.colliders, config.broad_phase, config.narrow_phase) {
  double largest = 0;
  for (std::size_t i = 0; i < scene_.size(); ++i) largest = std::max(largest, scene_.radius(i));
  touch_ = touching * largest;
  apart_ = apart * largest;
}

std::span<const ImpulseContact> ContactLookout::look(const System<double>& system, const VectorX<double>& y,
                                                     double margin) {
  shape_poses(system, y, poses_);
  scene_.near_pairs(poses_, poses_, {}, margin);
  return scene_.contacts(poses_, margin);
}

std::vector<FrameContact> ContactLookout::contacts(const System<double>& system, const VectorX<double>& y) {
  std::vector<FrameContact> all;
  for (const ImpulseContact& c : look(system, y, touch_)) all.push_back({c.a, c.b, c.point, c.normal, c.depth});
  return all;
}

std::vector<Bounds> ContactLookout::cells(const System<double>& system, const VectorX<double>& y) {
  shape_poses(system, y, poses_);
  scene_.near_pairs(poses_, poses_, {}, 0);
  std::vector<Bounds> all;
  scene_.cells(all);
  return all;
}

void ContactLookout::begin(const System<double>& system, const VectorX<double>& y) {
  known_.clear();
  newly_met(system, y, {});
}

std::vector<BodyPair> ContactLookout::newly_met(const System<double>& system, const VectorX<double>& y,
                                                std::span<const Impact> impacts) {
  std::vector<BodyPair> touch, near, fresh, kept;
  for (const ImpulseContact& c : look(system, y, apart_)) {
    near.push_back({c.a, c.b});
    if (c.depth >= -touch_) touch.push_back({c.a, c.b});
  }
  for (const Impact& i : impacts) touch.push_back({static_cast<std::uint32_t>(i.a), static_cast<std::uint32_t>(i.b)});
  sort_once(touch);
  sort_once(near);
  std::set_difference(touch.begin(), touch.end(), known_.begin(), known_.end(), std::back_inserter(fresh));
  std::set_intersection(known_.begin(), known_.end(), near.begin(), near.end(), std::back_inserter(kept));
  known_.clear();
  std::set_union(kept.begin(), kept.end(), touch.begin(), touch.end(), std::back_inserter(known_));
  return fresh;
}

}  // namespace polhode::viewer::session
