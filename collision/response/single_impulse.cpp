// SPDX-License-Identifier: BSD-3-Clause
// The response `single_impulse`: the course report's impulse, section 2.3, as classical mechanics has it (Routh, 1905),
// pair by pair. No friction.
//
//   j = −(1 + ε) v_n / (1/Ma + 1/Mb + n·((Ia⁻¹(ra × n)) × ra) + n·((Ib⁻¹(rb × n)) × rb))
//
// Policies. A pair has one point, the mean of the points of its patch; its impulse is shared evenly among them. A pair
// is pushed only while it approaches, and if its `wanted` is negative, only while it approaches faster than that. Pairs
// are treated one after the other in the order of their bodies, each with the velocities that those before it left, in
// passes until none approaches, or after 100 passes. What others have changed of a pair's velocity is reflected by its
// own restitution. So a shock passes from ball to ball: Newton's cradle has its true outcome, one ball in, one ball
// out.
#include <algorithm>
#include <cmath>

#include "collision/response.hpp"
#include "collision/response/contact_frame.hpp"
#include "collision/response/position_correction.hpp"

namespace polhode::inline collision::inline response {
namespace {

class SingleImpulse final : public Response {
 public:
  void resolve(std::span<ImpulseBody> bodies, std::span<ImpulseContact> contacts, double step) override {
    find_patches(bodies, contacts);
    for (int pass = 0; pass < most_passes; ++pass) {
      bool settled = true;
      for (Patch& p : patches_) settled &= !treat(bodies, p);
      if (settled) break;
    }
    for (const Patch& p : patches_) {
      for (ImpulseContact& c : contacts.subspan(p.first, p.count)) c.impulse = p.impulse / double(p.count) * p.normal;
    }
    if (step != 0) position_correction_.undo(bodies, contacts);
  }

 private:
  static constexpr int most_passes = 100;
  /// Relative to the velocity of approach: a slower approach is rounding.
  static constexpr double rounding = 1e-13;

  struct Patch {
    std::size_t first, count;
    std::uint32_t a, b;
    Vector3<double> normal, point;
    double mass;         ///< 1/K
    double met, wanted;  ///< normal velocity before the impulses, and its lower bound after them, m/s
    double restitution;
    double scale;  ///< sum of the speeds that cancel in a relative velocity, m/s
    double impulse = 0;
  };

  static double normal_velocity(std::span<const ImpulseBody> bodies, const Patch& p) {
    return p.normal.dot(bodies[p.a].velocity_at(p.point) - bodies[p.b].velocity_at(p.point));
  }

  void find_patches(std::span<const ImpulseBody> bodies, std::span<const ImpulseContact> contacts) {
    patches_.clear();
    for (std::size_t i = 0; i < contacts.size();) {
      const ImpulseContact& c = contacts[i];
      Patch p{i, 0, c.a, c.b, contact_frame(c.normal).normal, Vector3<double>::Zero(), 0, 0, 0, 0, 0};
      for (; i < contacts.size() && contacts[i].a == c.a && contacts[i].b == c.b && contacts[i].normal == c.normal;
           ++i) {
        p.point += contacts[i].point;
        p.wanted += contacts[i].wanted;
        p.restitution += contacts[i].restitution;
        ++p.count;
      }
      p.point /= double(p.count);
      p.wanted /= double(p.count);
      p.restitution /= double(p.count);
      const double mobility = p.normal.dot(mobility_along(bodies[p.a], bodies[p.b], p.point, p.normal));
      p.mass = mobility > 0 ? 1 / mobility : 0;
      p.met = normal_velocity(bodies, p);
      p.scale = bodies[p.a].velocity_at(p.point).norm() + bodies[p.b].velocity_at(p.point).norm();
      patches_.push_back(p);
    }
  }

  /// Answers the impact; returns whether the pair approached.
  static bool treat(std::span<ImpulseBody> bodies, Patch& p) {
    const double v = normal_velocity(bodies, p);
    if (p.mass == 0 || !(v < std::min(p.wanted, 0.0) - rounding * p.scale)) return false;
    const double reflected = p.wanted < 0 ? p.wanted : p.wanted - p.restitution * (v - p.met);
    // The pair parts no faster than it met: on a patch that turns, the mean of `wanted` may be out of reach.
    const double j = (std::clamp(reflected, std::min(p.wanted, 0.0), -v) - v) * p.mass;
    p.impulse += j;
    bodies[p.a].push(p.point, j * p.normal);
    bodies[p.b].push(p.point, -j * p.normal);
    return true;
  }

  std::vector<Patch> patches_;
  PositionCorrection position_correction_;
};

}  // namespace

ResponseEntry single_impulse() {
  return {"single_impulse", "j = (wanted − v·n)/K at the middle of each pair's patch, pair by pair, without friction",
          [] { return std::unique_ptr<Response>(new SingleImpulse); }};
}

}  // namespace polhode::collision::response
