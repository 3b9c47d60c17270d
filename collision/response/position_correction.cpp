// SPDX-License-Identifier: BSD-3-Clause
#include "collision/response/position_correction.hpp"

#include <algorithm>

namespace polhode::inline collision::inline response {

void PositionCorrection::undo(std::span<ImpulseBody> bodies, std::span<const ImpulseContact> contacts) {
  if (!too_deep(bodies, contacts)) return;
  own_.build(bodies, contacts);
  solve(bodies, contacts, own_);
}

void PositionCorrection::undo(std::span<ImpulseBody> bodies, std::span<const ImpulseContact> contacts,
                              const ContactBatches& batches) {
  if (too_deep(bodies, contacts)) solve(bodies, contacts, batches);
}

bool PositionCorrection::too_deep(std::span<ImpulseBody> bodies, std::span<const ImpulseContact> contacts) const {
  for (ImpulseBody& b : bodies) {
    b.shift.setZero();
    b.turn.setZero();
  }
  return std::any_of(contacts.begin(), contacts.end(),
                     [&](const ImpulseContact& c) { return c.depth > settings_.slop; });
}

void PositionCorrection::solve(std::span<ImpulseBody> bodies, std::span<const ImpulseContact> contacts,
                               const ContactBatches& batches) {
  points_.assign(batches.points().size(), Point{Lanes(0), Lanes(0), Lanes(0), Lanes(0)});
  motions_.assign(bodies.size() + 1, ImpulseMotion{});
  for (std::size_t k = 0; k < points_.size(); ++k) {
    for (std::size_t i = 0; i < lane_count; ++i) {
      const std::uint32_t number = batches.contacts()[k][i];
      if (number == ContactBatches::none) continue;
      const double beyond = contacts[number].depth - settings_.slop;
      points_[k].wanted.set(int(i), beyond > 0 ? settings_.share * beyond : beyond);
    }
  }
  course_.start(motions_.size());
  for (int n = 1;; ++n) {
    course_.mark(motions_);
    for (Point& p : points_) p.change = Lanes(0);
    const std::size_t count = batches.patches().size();
    for (std::size_t i = 0; i < count; ++i) visit<false>(batches, i);
    for (std::size_t i = count; i-- > 0;) visit<true>(batches, i);
    Lanes change(0), most(0);
    ConjugateCourse::Products products;
    for (const PatchBatch& patch : batches.patches()) {
      Lanes size(0), along(0);
      for (std::uint32_t k = patch.first_point; k < patch.first_point + patch.point_count; ++k) {
        const Point& p = points_[k];
        size += p.change * p.change;
        along += p.change * p.course;
        change = select(abs(p.change) > change, abs(p.change), change);
        most = select(p.impulse > most, p.impulse, most);
      }
      products.add(size, along);
    }
    if (n == settings_.iterations || largest(change) <= settings_.tolerance * largest(most)) break;
    const double share = course_.share(products);
    course_.advance(motions_, share);
    for (Point& p : points_) {
      p.impulse += share * p.course;
      p.course = Lanes(share) * p.course + p.change;
    }
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    bodies[i].shift = Eigen::Map<const Vector3<double>>(motions_[i].linear.data());
    bodies[i].turn = Eigen::Map<const Vector3<double>>(motions_[i].angular.data());
  }
}

template <bool back>
void PositionCorrection::visit(const ContactBatches& batches, std::size_t number) {
  const PatchBatch& patch = batches.patches()[number];
  PairMotion motion(patch, motions_.data());
  for (std::uint32_t n = 0; n < patch.point_count; ++n) {
    const std::uint32_t k = patch.first_point + (back ? patch.point_count - 1 - n : n);
    const PointBatch& point = batches.points()[k];
    Point& p = points_[k];
    const Lanes raised = p.impulse + point.normal_mass * (p.wanted - dot(patch.normal, motion.at(point)));
    const Lanes impulse = select(raised > Lanes(0), raised, Lanes(0)), more = impulse - p.impulse;
    motion.push(patch, point, more * patch.normal);
    p.impulse = impulse;
    p.change += more;
  }
  motion.store(patch, motions_.data());
}

}  // namespace polhode::collision::response
