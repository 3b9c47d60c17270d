// SPDX-License-Identifier: BSD-3-Clause
// Ends a run at its first impact, before it is answered, as in the course report's screenshots "paused when a collision
// is detected".
#pragma once

#include <memory>
#include <vector>

#include "core/run/contact_model.hpp"

namespace polhode::study::inline setup {

/// Wraps another contact model, which takes the steps. The impact that ends the run is listed without an impulse.
class EndAtContact final : public ContactModel {
 public:
  /// `located`: the model locates impacts within a step. Otherwise the run ends at the start of the step of the impact.
  EndAtContact(std::unique_ptr<ContactModel> model, bool located) : model_(std::move(model)), located_(located) {}

  void begin(Integrator<double>& method, const State<double>& state) override {
    model_->begin(method, state);
    impacts_.clear();
    losses_ = model_->losses();
  }

  StepResult step(Integrator<double>& method, State<double>& state, double h) override {
    before_ = state;
    StepResult result = model_->step(method, state, h);
    if (!result.ok()) return result;
    if (model_->impacts().empty()) {
      losses_ = model_->losses();
      return result;
    }
    const double t = located_ ? model_->impacts().front().t : before_.t;
    for (Impact impact : model_->impacts()) {
      if (located_ && impact.t > t) break;
      impact.t = t;
      impact.impulse.setZero();
      impact.energy_lost = 0;
      impacts_.push_back(impact);
    }
    state = before_;
    method.discard_history(state);
    const double close = 1e-15 * t;  // some methods cannot take a shorter step
    while (result.ok() && t - state.t > close) result = method.step(state, t - state.t);
    if (!result.ok()) state = before_;
    return result;
  }

  const ContactLosses& losses() const override { return losses_; }
  std::span<const Impact> impacts() const override { return impacts_; }
  std::span<const Transition> transitions() const override {
    return ended() ? std::span<const Transition>() : model_->transitions();
  }
  bool ended() const override { return !impacts_.empty(); }

 private:
  std::unique_ptr<ContactModel> model_;
  bool located_;
  ContactLosses losses_;
  std::vector<Impact> impacts_;
  State<double> before_;
};

}  // namespace polhode::study::setup
