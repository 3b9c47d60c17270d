// SPDX-License-Identifier: BSD-3-Clause
#include "collision/response/contact_batches.hpp"

#include <algorithm>
#include <bit>

#include "collision/response/contact_frame.hpp"

namespace polhode::inline collision::inline response {
namespace {

/// Points of a patch that share a batch; longer patches are cut.
constexpr std::uint32_t most_points = 8;
/// Colours that a word has bits for. What finds none free stands alone.
constexpr std::uint32_t colour_count = 64;

bool same_patch(const ImpulseContact& c, const ImpulseContact& d) {
  return c.a == d.a && c.b == d.b && c.normal == d.normal;
}

/// Sets an inverse inertia of one lane.
void set(SymmetricLanes& lanes, int lane, const Matrix3<double>& m) {
  lanes.xx.set(lane, m(0, 0));
  lanes.xy.set(lane, m(0, 1));
  lanes.xz.set(lane, m(0, 2));
  lanes.yy.set(lane, m(1, 1));
  lanes.yz.set(lane, m(1, 2));
  lanes.zz.set(lane, m(2, 2));
}

void set(Vector3<Lanes>& lanes, int lane, const Vector3<double>& v) {
  for (int k = 0; k < 3; ++k) lanes[k].set(lane, v[k]);
}

}  // namespace

void ContactBatches::build(std::span<const ImpulseBody> bodies, std::span<const ImpulseContact> contacts) {
  patches_.clear();
  points_.clear();
  contacts_.clear();
  find_patches(bodies, contacts);
  sort_patches();
  for (std::size_t i = 0; i < sorted_.size();) {
    std::size_t end = i + 1;
    if (sorted_[i].colour < colour_count) {
      while (end < sorted_.size() && end < i + lane_count && sorted_[end].colour == sorted_[i].colour) ++end;
    }
    add_batch(bodies, contacts, std::span(sorted_).subspan(i, end - i));
    i = end;
  }
}

void ContactBatches::find_patches(std::span<const ImpulseBody> bodies, std::span<const ImpulseContact> contacts) {
  found_.clear();
  colours_of_.assign(bodies.size(), 0);
  for (std::uint32_t i = 0; i < contacts.size();) {
    const ImpulseContact& c = contacts[i];
    const bool moves_a = bodies[c.a].moves(), moves_b = bodies[c.b].moves();
    std::uint32_t end = i + 1;
    while (end < contacts.size() && end - i < most_points && same_patch(c, contacts[end])) ++end;
    if (moves_a || moves_b) {
      const std::uint64_t taken = (moves_a ? colours_of_[c.a] : 0) | (moves_b ? colours_of_[c.b] : 0);
      const auto colour = std::uint32_t(std::countr_one(taken));
      if (colour < colour_count) {
        colours_of_[c.a] |= std::uint64_t(1) << colour;
        colours_of_[c.b] |= std::uint64_t(1) << colour;
      }
      found_.push_back({i, end - i, colour});
    }
    i = end;
  }
}

/// Sorts the patches by colour, then the largest first, so that the lanes of a batch have about as many points. Patches
/// that are equal in both stay in their order.
void ContactBatches::sort_patches() {
  const auto group = [](const Patch& p) { return p.colour * most_points + (most_points - p.count); };
  starts_.assign((colour_count + 1) * most_points + 1, 0);
  for (const Patch& p : found_) ++starts_[group(p) + 1];
  for (std::size_t k = 1; k < starts_.size(); ++k) starts_[k] += starts_[k - 1];
  sorted_.resize(found_.size());
  for (const Patch& p : found_) sorted_[starts_[group(p)]++] = p;
}

void ContactBatches::add_batch(std::span<const ImpulseBody> bodies, std::span<const ImpulseContact> contacts,
                               std::span<const Patch> lanes) {
  PatchBatch& patch = patches_.emplace_back();
  patch.a.fill(std::uint32_t(bodies.size()));
  patch.b.fill(std::uint32_t(bodies.size()));
  patch.first_point = std::uint32_t(points_.size());
  for (const Patch& p : lanes) patch.point_count = std::max(patch.point_count, p.count);
  points_.resize(points_.size() + patch.point_count);
  contacts_.resize(points_.size());
  PointBatch* const points = points_.data() + patch.first_point;
  auto* const numbers = contacts_.data() + patch.first_point;
  for (std::uint32_t k = 0; k < patch.point_count; ++k) numbers[k].fill(none);
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    const int lane = int(i);
    const ImpulseContact& first = contacts[lanes[i].first];
    const ImpulseBody &a = bodies[first.a], &b = bodies[first.b];
    patch.a[i] = first.a;
    patch.b[i] = first.b;
    const ContactFrame frame = contact_frame(first.normal);
    set(patch.normal, lane, frame.normal);
    set(patch.tangent, lane, frame.tangent);
    set(patch.bitangent, lane, frame.bitangent);
    patch.inverse_mass_a.set(lane, a.inverse_mass);
    patch.inverse_mass_b.set(lane, b.inverse_mass);
    set(patch.inverse_inertia_a, lane, a.inverse_inertia);
    set(patch.inverse_inertia_b, lane, b.inverse_inertia);
    for (std::uint32_t k = 0; k < lanes[i].count; ++k) {
      numbers[k][i] = lanes[i].first + k;
      const Vector3<double>& point = contacts[lanes[i].first + k].point;
      set(points[k].lever_a, lane, point - a.position);
      set(points[k].lever_b, lane, point - b.position);
    }
  }
  for (std::uint32_t k = 0; k < patch.point_count; ++k) {
    const Lanes mobility = dot(patch.normal, mobility_along(patch, points[k], patch.normal));
    points[k].normal_mass = select(mobility > Lanes(0), Lanes(1) / mobility, Lanes(0));
    for (std::size_t i = 0; i < lane_count; ++i) {
      if (numbers[k][i] == none) points[k].normal_mass.set(int(i), 0);
    }
  }
}

}  // namespace polhode::collision::response
