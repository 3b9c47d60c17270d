// SPDX-License-Identifier: BSD-3-Clause
// A spring with an optional damper along it, between a point of a body and a point of the world or of another body.
// With d from the body's end to the other, n = d/|d|: f = (k (|d| − l0) + c n·ḋ) n on the body, V = ½ k (|d| − l0)².
#pragma once

#include <cmath>

#include "core/forces/attachment.hpp"
#include "core/math/flatten.hpp"

namespace polhode::inline core::inline forces {

template <class S>
class Spring final : public ForceModel<S> {
 public:
  static ForceKind kind() {
    std::vector<Parameter> keys = {
        {"stiffness", 0.0, "N/m", "k", Parameter::Need::required, Parameter::Range::non_negative},
        {"damping", 0.0, "N s/m", "c, along the spring", Parameter::Need::optional, Parameter::Range::non_negative},
        {"rest_length", 0.0, "m", "l0", Parameter::Need::optional, Parameter::Range::non_negative}};
    for (Parameter& key : Attachment<S>::parameters()) keys.push_back(std::move(key));
    return {"spring", "f = (k (|d| - l0) + c n.d') n along d = n|d|, V = k (|d| - l0)^2/2", 1, 2, std::move(keys)};
  }

  Spring(const ForceParameters& p, std::span<const Body> bodies)
      : ends_(p, bodies),
        stiffness_(S(p.number("stiffness"))),
        damping_(S(p.number("damping"))),
        rest_length_(S(p.number("rest_length"))),
        damped_(p.number("damping") != 0),
        rests_at_zero_(p.number("rest_length") == 0) {}

  POLHODE_FLATTEN void add_wrench(S, std::span<const BodyMotion<S>> bodies,
                                  std::span<Wrench<S>> wrenches) const override {
    const bool linear = rests_at_zero_ && !damped_;  // f = k d needs no direction
    if (linear && ends_.one_center()) {
      ends_.apply_at_center(stiffness_ * ends_.from_center(bodies), wrenches);
      return;
    }
    const auto s = ends_.span(bodies);
    if (linear) {
      ends_.apply(s, stiffness_ * s.d, bodies, wrenches);
      return;
    }
    using std::sqrt;
    const S length = sqrt(s.d.squaredNorm());
    const Vector3<S> n = s.d / nonzero(length);  // a spring of length 0 exerts no force
    const S tension = stiffness_ * (length - rest_length_) + (damped_ ? damping_ * n.dot(ends_.rate(s, bodies)) : S(0));
    ends_.apply(s, tension * n, bodies, wrenches);
  }

  POLHODE_FLATTEN S potential_energy(std::span<const BodyMotion<S>> bodies) const override {
    using std::sqrt;
    if (rests_at_zero_ && ends_.one_center()) return stiffness_ * ends_.from_center(bodies).squaredNorm() / S(2);
    const auto s = ends_.span(bodies);
    if (rests_at_zero_) return stiffness_ * s.d.squaredNorm() / S(2);
    const S stretch = sqrt(s.d.squaredNorm()) - rest_length_;
    return stiffness_ * stretch * stretch / S(2);
  }

  bool does_work() const override { return damped_; }

  S power(S, std::span<const BodyMotion<S>> bodies) const override {
    const auto s = ends_.span(bodies);
    const S d2 = s.d.squaredNorm();
    const S along = s.d.dot(ends_.rate(s, bodies));
    return -damping_ * along * along / nonzero(d2);
  }

  bool internal() const override { return ends_.internal(); }
  bool reads_velocity() const override { return damped_; }
  bool reads_rotation() const override { return does_work() || ends_.reads_rotation(); }
  Effect effect_on(std::size_t body) const override { return ends_.effect_on(body); }

 private:
  static S nonzero(S x) { return select(x > S(0), x, S(1)); }

  Attachment<S> ends_;
  S stiffness_, damping_, rest_length_;
  bool damped_, rests_at_zero_;
};

}  // namespace polhode::core::forces
