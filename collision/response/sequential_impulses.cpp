// SPDX-License-Identifier: BSD-3-Clause
// The response `sequential_impulses`: projected Gauss–Seidel over the contacts (Catto, "Iterative dynamics with temporal
// coherence", 2005), each a block of its normal and its two tangents, with the tangents in Coulomb's cone (as Jourdan,
// Alart & Jean, 1998). The normals obey v'·n >= wanted ⟂ j·n >= 0, which is Newton's restitution. A step starts from the
// forces of the step before.
//
// Newton's cradle: all impulses are found together, so one ball in sends all out: of three the velocities −1/3, 2/3, 2/3.
#include "collision/response/sequential_impulses.hpp"

#include <algorithm>
#include <cmath>

#include "collision/response/contact_batches.hpp"
#include "collision/response/energy_guard.hpp"
#include "collision/response/friction_cone.hpp"
#include "collision/response/warm_start.hpp"

namespace polhode {
namespace {

Lanes larger(const Lanes& a, const Lanes& b) { return select(a > b, a, b); }

class SequentialImpulses final : public Response {
 public:
  explicit SequentialImpulses(const SequentialSettings& settings)
      : settings_(settings), penetration_(settings.penetration) {}

  void resolve(std::span<ImpulseBody> bodies, std::span<ImpulseContact> contacts, double step) override {
    const int iterations = step != 0 ? settings_.in_step : settings_.at_instant;
    batches_.build(bodies, contacts);
    if (step != 0) {
      memory_.recall(bodies, contacts, step);
    } else {
      for (ImpulseContact& c : contacts) c.impulse.setZero();
    }
    prepare(contacts);
    start(bodies);
    if (step != 0) start_warm();
    sweep(iterations);
    write(contacts);
    finish(bodies, contacts, iterations);
    if (step == 0) return;
    memory_.remember(bodies, contacts, step);
    penetration_.undo(bodies, contacts, batches_);
  }

  void forget() override { memory_.forget(); }

 private:
  /// What a point of each patch of a batch needs, beside its geometry.
  struct Point {
    Lanes wanted, friction;
    Lanes mobility_tn, mobility_bn;  ///< how a normal impulse changes the slip
    FrictionCone<Lanes> cone;
    Lanes normal;                    ///< the impulse so far
    Tangential<Lanes> tangential;
  };

  void prepare(std::span<const ImpulseContact> contacts) {
    points_.resize(batches_.points().size());
    rough_.assign(batches_.patches().size(), 0);
    for (std::size_t n = 0; n < batches_.patches().size(); ++n) {
      const PatchBatch& patch = batches_.patches()[n];
      for (std::uint32_t k = patch.first_point; k < patch.first_point + patch.point_count; ++k) {
        Point& p = points_[k];
        const PointBatch& at = batches_.points()[k];
        const Vector3<Lanes> kn = mobility_along(patch, at, patch.normal), kt = mobility_along(patch, at, patch.tangent),
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

  /// Pushes by the impulses of the step before, by that share of them which takes most energy. At rest it is all.
  void start_warm() {
    push_all();
    const auto [slope, curved] = work_of_impulses();
    // Of E(s) = s slope + s² (curved − slope) the least.
    const double share = slope < 0 ? std::min(1.0, slope / (2 * (slope - curved))) : 0;
    if (!(share < 1)) return;
    for (Point& p : points_) {
      p.normal *= share;
      p.tangential.t *= share;
      p.tangential.b *= share;
    }
    motions_.assign(before_.begin(), before_.end());
    if (share > 0) push_all();
  }

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

  struct Work {
    double before, gain;
  };
  /// What the impulses would do at the velocities before, and do to the kinetic energy: J. Summed patch by patch, so that the
  /// digits do not depend on the registers.
  Work work_of_impulses() const {
    Work w{0, 0};
    for (const PatchBatch& patch : batches_.patches()) {
      const PairMotion before(patch, before_.data()), after(patch, motions_.data());
      Lanes of_before(0), gain(0);
      for (std::uint32_t k = patch.first_point; k < patch.first_point + patch.point_count; ++k) {
        const PointBatch& at = batches_.points()[k];
        const Vector3<Lanes> j = impulse(patch, points_[k]);
        const Lanes work = dot(j, before.at(at));
        of_before += work;
        gain += Lanes(0.5) * (work + dot(j, after.at(at)));
      }
      for (int i = 0; i < lane_count; ++i) {
        w.before += of_before[i];
        w.gain += gain[i];
      }
    }
    return w;
  }

  /// Over all patches, until hardly anything changes. Within a patch from the first point to the last and back, then the
  /// other way round: in one direction alone it would turn towards the last, and a stack would lean.
  void sweep(int iterations) {
    for (int n = 0; n < iterations; ++n) {
      Extent extent;
      for (std::size_t i = 0; i < batches_.patches().size(); ++i) {
        const PatchBatch& patch = batches_.patches()[i];
        PairMotion motion(patch, motions_.data());
        const std::uint32_t first = patch.first_point, count = patch.point_count;
        for (int way = 0; way < 2; ++way) {
          const bool back = way != n % 2;
          for (std::uint32_t k = 0; k < count; ++k) {
            visit(patch, first + (back ? count - 1 - k : k), rough_[i], motion, extent);
          }
        }
        motion.store(patch, motions_.data());
      }
      if (largest(extent.change) <= settings_.tolerance * largest(extent.impulse)) break;
    }
  }

  /// The largest of a sweep.
  struct Extent {
    Lanes change = 0, impulse = 0;
  };

  [[gnu::always_inline]] void visit(const PatchBatch& patch, std::uint32_t k, bool rough, PairMotion& motion, Extent& extent) {
    const PointBatch& at = batches_.points()[k];
    Point& p = points_[k];
    const Vector3<Lanes> v = motion.at(at);
    const Lanes raised = p.normal + at.normal_mass * (p.wanted - dot(patch.normal, v));
    const Lanes normal = select(raised > Lanes(0), raised, Lanes(0)), more = normal - p.normal;
    Vector3<Lanes> added = more * patch.normal;
    extent.change = larger(extent.change, abs(more));
    extent.impulse = larger(extent.impulse, normal);
    p.normal = normal;
    if (rough) {
      const Tangential<Lanes> slip{dot(patch.tangent, v) + p.mobility_tn * more, dot(patch.bitangent, v) + p.mobility_bn * more};
      const Tangential<Lanes> next = p.cone.step(p.tangential, slip, p.friction * normal);
      const Lanes t = next.t - p.tangential.t, b = next.b - p.tangential.b;
      added += t * patch.tangent + b * patch.bitangent;
      extent.change = larger(extent.change, larger(abs(t), abs(b)));
      p.tangential.t = next.t;
      p.tangential.b = next.b;
    }
    motion.push(patch, at, added);
  }

  /// The impulses, as the contacts tell them.
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
  void finish(std::span<ImpulseBody> bodies, std::span<ImpulseContact> contacts, int iterations) {
    const bool bounces = std::any_of(contacts.begin(), contacts.end(), [](const auto& c) { return c.wanted > 0; });
    if ((bounces || work_of_impulses().gain > 0) && guard_.gains(bodies, contacts)) {
      // Without restitution none can, once the impulses are found.
      for (Point& p : points_) {
        p.wanted = select(p.wanted > Lanes(0), Lanes(0), p.wanted);
        p.normal = p.tangential.t = p.tangential.b = Lanes(0);
      }
      others_.resize(contacts.size());
      for (std::size_t i = 0; i < contacts.size(); ++i) others_[i] = contacts[i].impulse;
      start(bodies);
      sweep(iterations);
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
  std::vector<std::uint8_t> rough_;  ///< whether a batch has friction
  std::vector<ImpulseMotion> before_, motions_;
  EnergyGuard guard_;
  std::vector<Vector3<double>> others_;
  Penetration penetration_;
};

}  // namespace

std::unique_ptr<Response> make_sequential_impulses(const SequentialSettings& settings) {
  return std::make_unique<SequentialImpulses>(settings);
}

ResponseEntry sequential_impulses() {
  return {"sequential_impulses", "projected Gauss–Seidel: v'·n >= wanted, j·n >= 0 complementary, |j_t| <= μ j_n against the slip",
          [] { return make_sequential_impulses({}); }};
}

}  // namespace polhode
