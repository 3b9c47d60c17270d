// SPDX-License-Identifier: BSD-3-Clause
// A dashpot between a point of a body and a point of the world or of another body: f = c ḋ, d from the first end to the
// other. Unlike the damping of a spring it acts in every direction, also when the ends coincide.
#pragma once

#include "core/forces/attachment.hpp"

namespace polhode::inline core::inline forces {

template <class S>
class Damper final : public ForceModel<S> {
 public:
  static ForceKind kind() {
    std::vector<Parameter> keys = {
        {"damping", 0.0, "N s/m", "c", Parameter::Need::required, Parameter::Range::non_negative}};
    for (Parameter& key : Attachment<S>::parameters()) keys.push_back(std::move(key));
    return {"damper", "f = c d', against the relative velocity of its two ends", 1, 2, std::move(keys)};
  }

  Damper(const ForceParameters& p, std::span<const Body> bodies)
      : ends_(p, bodies), damping_(S(p.number("damping"))), damped_(p.number("damping") != 0) {}

  void add_wrench(S, std::span<const BodyMotion<S>> bodies, std::span<Wrench<S>> wrenches) const override {
    const auto s = ends_.span(bodies);
    ends_.apply(s, damping_ * ends_.rate(s, bodies), bodies, wrenches);
  }

  bool does_work() const override { return damped_; }

  S power(S, std::span<const BodyMotion<S>> bodies) const override {
    return -damping_ * ends_.rate(ends_.span(bodies), bodies).squaredNorm();
  }

  bool reads_rotation() const override { return does_work() || ends_.reads_rotation(); }
  Effect effect_on(std::size_t body) const override { return ends_.effect_on(body); }

 private:
  Attachment<S> ends_;
  S damping_;
  bool damped_;
};

}  // namespace polhode::core::forces
