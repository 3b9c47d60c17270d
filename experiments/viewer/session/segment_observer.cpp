// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/session/segment_observer.hpp"

#include <utility>

namespace polhode::viewer::inline session {
namespace {

ContactLosses sum(const ContactLosses& a, const ContactLosses& b) {
  return {a.impact + b.impact, a.friction + b.friction, a.penetration + b.penetration};
}

}  // namespace

void SegmentObserver::place(Kept start, bool fresh) {
  present_ = std::move(start);
  fresh_ = fresh_ || fresh;
}

void SegmentObserver::begin_segment() {
  projection_before_ = present_.sample.projection;
  losses_before_ = present_.losses;
  losses_ = {};
  multipliers_ = {};
}

std::size_t SegmentObserver::on_samples(std::span<const Sample> samples) {
  std::size_t taken = 0;
  for (; taken < samples.size(); ++taken) {
    Sample sample = samples[taken];
    sample.projection += projection_before_;
    if (memory_.hopeless(memory_.energy_drift(sample, sum(losses_before_, losses_))) ||
        memory_.hopeless(sample.seen.kinetic))
      break;
  }
  return taken;
}

void SegmentObserver::on_start(const State<double>& state, const Sample& sample) {
  keep(state, sample);
  if (fresh_) memory_.begin(present_);
  fresh_ = false;
  after_step_(true);
  impacts_.clear();
}

void SegmentObserver::on_state(const State<double>& state, const Sample& sample) {
  keep(state, sample);
  ++present_.step;
  ++present_.place.step;
  memory_.add(present_);
  after_step_(false);
  impacts_.clear();
}

void SegmentObserver::keep(const State<double>& state, const Sample& sample) {
  std::swap(before_, present_.state);
  present_.state = state;
  present_.sample = sample;
  present_.sample.projection += projection_before_;
  present_.losses = sum(losses_before_, losses_);
  present_.multipliers = multipliers_;
}

}  // namespace polhode::viewer::session
