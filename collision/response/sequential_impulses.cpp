// SPDX-License-Identifier: BSD-3-Clause
// The response `sequential_impulses`: projected Gauss–Seidel over the contacts (Catto, "Iterative dynamics with
// temporal coherence", 2005), each a block of its normal and its two tangents, with the tangents in Coulomb's cone (as
// Jourdan, Alart & Jean, 1998). The normals obey v'·n >= wanted ⟂ j·n >= 0, which is Newton's restitution. A sweep goes
// to the last point and back; from sweep to sweep conjugate gradients carry the impulses on (conjugate_course.hpp). A
// step starts from the forces of the step before.
//
// Newton's cradle: all impulses are found together, so one ball in sends all out: of three the velocities −1/3, 2/3,
// 2/3.
#include "collision/response/sequential_impulses.hpp"

#include <algorithm>
#include <cmath>

#include "collision/response/conjugate_course.hpp"
#include "collision/response/contact_batches.hpp"
#include "collision/response/energy_guard.hpp"
#include "collision/response/friction_cone.hpp"
#include "collision/response/warm_start.hpp"

namespace polhode::inline collision::inline response {
namespace {

Lanes larger(const Lanes& a, const Lanes& b) { return select(a > b, a, b); }

class SequentialImpulses final : public Response {
 public:
  explicit SequentialImpulses(const SequentialSettings& settings)
      : settings_(settings), position_correction_(settings.position_correction) {}

  void resolve(std::span<ImpulseBody> bodies, std::span<ImpulseContact> contacts, double step) override {
    const Stop stop = when_to_stop(bodies, contacts, step);
    batches_.build(bodies, contacts);
    if (step != 0) {
      memory_.recall(bodies, contacts, step);
    } else {
      for (ImpulseContact& c : contacts) c.impulse.setZero();
    }
    prepare(contacts);
    start(bodies);
    if (step != 0) push_all();
    sweep(stop);
    write(contacts);
    finish(bodies, contacts, stop);
    if (step == 0) return;
    memory_.remember(bodies, contacts, step);
    position_correction_.undo(bodies, contacts, batches_);
  }

  void forget() override { memory_.forget(); }

 private:
  /// Limits at which the iteration stops.
  struct Stop {
    int iterations;    ///< largest number of iterations
    double tolerance;  ///< limit of the change, over the largest impulse
  };

  Stop when_to_stop(std::span<const ImpulseBody> bodies, std::span<const ImpulseContact> contacts, double step) const {
    if (step == 0) return {settings_.at_instant, settings_.instant_tolerance};
    // A bounce is as exact as at an instant.
    if (std::any_of(contacts.begin(), contacts.end(), [](const auto& c) { return c.wanted > 0; })) {
      return {settings_.at_instant, settings_.instant_tolerance};
    }
    // A contact strikes if its speed is more than a tenth of the velocity that a step of the forces gives to bodies at
    // rest.
    double fastest = 0, forced = 0;
    for (const ImpulseContact& c : contacts) {
      const double now = (bodies[c.a].velocity_at(c.point) - bodies[c.b].velocity_at(c.point)).dot(c.normal);
      fastest = std::max(fastest, -c.approach);
      forced = std::max(forced, std::abs(now - c.approach));
    }
    const bool strikes = fastest > 0.1 * forced;
    return {strikes ? settings_.in_step : settings_.at_rest, settings_.step_tolerance};
  }

  /// Data of a point of each patch of a batch, besides its geometry.
  struct Point {
    Lanes wanted, friction;
    Lanes mobility_tn, mobility_bn;  ///< change of the slip by a unit normal impulse, 1/kg
    FrictionCone<Lanes> cone;
    Lanes normal;  ///< the impulse so far
    Tangential<Lanes> tangential;
    Vector3<Lanes> change, course;  ///< change by this sweep, and conjugate course: normal, tangents
  };

  void prepare(std::span<const ImpulseContact> contacts) {
    points_.resize(batches_.points().size());
    rough_.assign(batches_.patches().size(), 0);
    for (std::size_t n = 0; n < batches_.patches().size(); ++n) {
      const PatchBatch& patch = batches_.patches()[n];
      for (std::uint32_t k = patch.first_point; k < patch.first_point + patch.point_count; ++k) {
        Point& p = points_[k];
        const PointBatch& at = batches_.points()[k];
        const Vector3<Lanes> kn = mobility_along(patch, at, patch.normal),
                             kt = mobility_along(patch, at, patch.tangent),
                             kb = mobility_along(patch, at, patch.bitangent);
        p.cone = FrictionCone<Lanes>(dot(patch.tangent, kt), dot(patch.bitangent, kt), dot(patch.bitangent, kb));
        p.mobility_tn = dot(patch.tangent, kn);
        p.mobility_bn = dot(patch.bitangent, kn);
        p.wanted = p.friction = p.normal = Lanes(0);
        Vector3<Lanes> impulse(Lanes(0), Lanes(0), Lanes(0));
        for (std::size_t i = 0; i < lane_count; ++i) {
          const std::uint32_t number = batches_.contacts()[k][i];
          if (number == ContactBatches::none) continue;
          const ImpulseContact& c = contacts[number];
          const int lane = int(i);
          p.wanted.set(lane, c.wanted);
          p.friction.set(lane, c.friction);
          for (int j = 0; j < 3; ++j) impulse[j].set(lane, c.impulse[j]);
          rough_[n] |= c.friction > 0;
        }
        const Lanes normal = dot(patch.normal, impulse), reach = p.friction * normal;
        p.normal = select(normal > Lanes(0), normal, Lanes(0));
        p.tangential = {dot(patch.tangent, impulse), dot(patch.bitangent, impulse)};
        // The normal may have turned since, and the friction may be another.
        const Lanes square = p.tangential.t * p.tangential.t + p.tangential.b * p.tangential.b;
        const Lanes shrink = select(square > reach * reach, larger(reach, Lanes(0)) / sqrt(square), Lanes(1));
        p.tangential.t *= shrink;
        p.tangential.b *= shrink;
      }
    }
  }

  /// The velocities before.
  void start(std::span<const ImpulseBody> bodies) {
    before_.resize(bodies.size() + 1);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        before_[i].linear[k] = bodies[i].velocity[Eigen::Index(k)];
        before_[i].angular[k] = bodies[i].angular_velocity[Eigen::Index(k)];
      }
    }
    before_.back() = ImpulseMotion{};
    motions_.assign(before_.begin(), before_.end());
  }

  /// Pushes by the impulses that the points have.
  void push_all() {
    for (const PatchBatch& patch : batches_.patches()) {
      PairMotion motion(patch, motions_.data());
      for (std::uint32_t k = patch.first_point; k < patch.first_point + patch.point_count; ++k) {
        motion.push(patch, batches_.points()[k], impulse(patch, points_[k]));
      }
      motion.store(patch, motions_.data());
    }
  }

  static Vector3<Lanes> impulse(const PatchBatch& patch, const Point& p) {
    return p.normal * patch.normal + p.tangential.t * patch.tangent + p.tangential.b * patch.bitangent;
  }

  /// Change of the kinetic energy by the impulses, J. It is summed patch by patch, so that the digits do not depend on
  /// the registers.
  double work_of_impulses() const {
    double work = 0;
    for (const PatchBatch& patch : batches_.patches()) {
      const PairMotion before(patch, before_.data()), after(patch, motions_.data());
      Lanes of_patch(0);
      for (std::uint32_t k = patch.first_point; k < patch.first_point + patch.point_count; ++k) {
        const PointBatch& at = batches_.points()[k];
        of_patch += Lanes(0.5) * dot(impulse(patch, points_[k]), before.at(at) + after.at(at));
      }
      for (int i = 0; i < lane_count; ++i) work += of_patch[i];
    }
    return work;
  }

  /// Sweeps over all points to the last and back, until hardly anything changes, and further while each sweep halves
  /// the change of the one before: the answer is exact if the points are so few that it costs little.
  void sweep(const Stop& stop) {
    course_.start(motions_.size());
    for (Point& p : points_) p.course = zero_lanes();
    double before = 0;
    for (int n = 1;; ++n) {
      Extent extent;
      course_.mark(motions_);
      for (Point& p : points_) p.change = zero_lanes();
      const std::size_t count = batches_.patches().size();
      for (std::size_t i = 0; i < count; ++i) visit<false>(i, extent);
      for (std::size_t i = count; i-- > 0;) visit<true>(i, extent);
      const double change = largest(extent.change), impulse = largest(extent.impulse);
      const bool fast = change < 0.5 * before && change > settings_.instant_tolerance * impulse;
      if (n == stop.iterations || (change <= stop.tolerance * impulse && !fast)) break;
      before = change;
      const double share = course_.share(products());
      course_.advance(motions_, share);
      for (Point& p : points_) {
        p.normal += share * p.course[0];
        p.tangential.t += share * p.course[1];
        p.tangential.b += share * p.course[2];
        p.course = Lanes(share) * p.course + p.change;
      }
    }
  }

  /// Inner products of the change made by a sweep.
  ConjugateCourse::Products products() const {
    ConjugateCourse::Products sum;
    for (const PatchBatch& patch : batches_.patches()) {
      Lanes size(0), along(0);
      for (std::uint32_t k = patch.first_point; k < patch.first_point + patch.point_count; ++k) {
        size += dot(points_[k].change, points_[k].change);
        along += dot(points_[k].change, points_[k].course);
      }
      sum.add(size, along);
    }
    return sum;
  }

  /// The largest of a sweep.
  struct Extent {
    Lanes change = 0, impulse = 0;
  };

  /// All points of a batch of patches, from the first to the last or back.
  template <bool back>
  void visit(std::size_t number, Extent& extent) {
    const PatchBatch& patch = batches_.patches()[number];
    PairMotion motion(patch, motions_.data());
    for (std::uint32_t k = 0; k < patch.point_count; ++k) {
      visit(patch, patch.first_point + (back ? patch.point_count - 1 - k : k), rough_[number], motion, extent);
    }
    motion.store(patch, motions_.data());
  }

  [[gnu::always_inline]] void visit(const PatchBatch& patch, std::uint32_t k, bool rough, PairMotion& motion,
                                    Extent& extent) {
    const PointBatch& at = batches_.points()[k];
    Point& p = points_[k];
    const Vector3<Lanes> v = motion.at(at);
    const Lanes raised = p.normal + at.normal_mass * (p.wanted - dot(patch.normal, v));
    const Lanes normal = select(raised > Lanes(0), raised, Lanes(0)), more = normal - p.normal;
    Vector3<Lanes> added = more * patch.normal;
    extent.change = larger(extent.change, abs(more));
    extent.impulse = larger(extent.impulse, normal);
    p.normal = normal;
    p.change[0] += more;
    if (rough) {
      const Tangential<Lanes> slip{dot(patch.tangent, v) + p.mobility_tn * more,
                                   dot(patch.bitangent, v) + p.mobility_bn * more};
      const Tangential<Lanes> next = p.cone.step(p.tangential, slip, p.friction * normal);
      const Lanes t = next.t - p.tangential.t, b = next.b - p.tangential.b;
      added += t * patch.tangent + b * patch.bitangent;
      extent.change = larger(extent.change, larger(abs(t), abs(b)));
      p.tangential.t = next.t;
      p.tangential.b = next.b;
      p.change[1] += t;
      p.change[2] += b;
    }
    motion.push(patch, at, added);
  }

  /// Writes the impulses to the contacts.
  void write(std::span<ImpulseContact> contacts) const {
    for (ImpulseContact& c : contacts) c.impulse.setZero();
    for (const PatchBatch& patch : batches_.patches()) {
      for (std::uint32_t k = patch.first_point; k < patch.first_point + patch.point_count; ++k) {
        const Vector3<Lanes> j = impulse(patch, points_[k]);
        for (std::size_t i = 0; i < lane_count; ++i) {
          const std::uint32_t number = batches_.contacts()[k][i];
          if (number == ContactBatches::none) continue;
          for (int c = 0; c < 3; ++c) contacts[number].impulse[c] = j[c][int(i)];
        }
      }
    }
  }

  /// The velocities after, in which no contact has given energy.
  void finish(std::span<ImpulseBody> bodies, std::span<ImpulseContact> contacts, const Stop& stop) {
    const bool bounces = std::any_of(contacts.begin(), contacts.end(), [](const auto& c) { return c.wanted > 0; });
    if ((bounces || work_of_impulses() > 0) && guard_.gains(bodies, contacts)) {
      // No contact can give energy without restitution, once the impulses are found.
      for (Point& p : points_) {
        p.wanted = select(p.wanted > Lanes(0), Lanes(0), p.wanted);
        p.normal = p.tangential.t = p.tangential.b = Lanes(0);
      }
      others_.resize(contacts.size());
      for (std::size_t i = 0; i < contacts.size(); ++i) others_[i] = contacts[i].impulse;
      start(bodies);
      sweep(stop);
      write(contacts);
      for (std::size_t i = 0; i < contacts.size(); ++i) std::swap(others_[i], contacts[i].impulse);
      guard_.limit(bodies, contacts, others_);
      for (const ImpulseContact& c : contacts) {
        bodies[c.a].push(c.point, c.impulse);
        bodies[c.b].push(c.point, -c.impulse);
      }
      return;
    }
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        bodies[i].velocity[Eigen::Index(k)] = motions_[i].linear[k];
        bodies[i].angular_velocity[Eigen::Index(k)] = motions_[i].angular[k];
      }
    }
  }

  SequentialSettings settings_;
  WarmStart memory_;
  ContactBatches batches_;
  std::vector<Point> points_;
  std::vector<std::uint8_t> rough_;  ///< 1 for a batch with friction, 0 without
  std::vector<ImpulseMotion> before_, motions_;
  ConjugateCourse course_;
  EnergyGuard guard_;
  std::vector<Vector3<double>> others_;
  PositionCorrection position_correction_;
};

}  // namespace

std::unique_ptr<Response> make_sequential_impulses(const SequentialSettings& settings) {
  return std::make_unique<SequentialImpulses>(settings);
}

ResponseEntry sequential_impulses() {
  return {"sequential_impulses",
          "projected Gauss–Seidel there and back, with conjugate gradients: v'·n >= wanted, j·n >= 0 complementary, "
          "|j_t| <= μ j_n against the slip",
          [] { return make_sequential_impulses({}); }};
}

}  // namespace polhode::collision::response
