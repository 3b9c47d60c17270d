// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/metrics/lane_meter.hpp"

#include <algorithm>
#include <utility>

#include "core/run/run_samples.hpp"

namespace polhode::study::inline metrics {
namespace {

static_assert(DriftColumns<Lanes>::most >= std::size_t(longest_batch));

void set(Vector3<Lanes>& all, std::size_t lane, const Vector3<double>& one) {
  for (int k = 0; k < 3; ++k) all[k].set(int(lane), one[k]);
}
void set(Lanes::Mask& all, std::size_t lane, bool one) { all.bits[lane] = one ? -1 : 0; }

void set(DriftOrigin<Lanes>& all, std::size_t lane, const DriftOrigin<double>& one) {
  all.energy.set(int(lane), one.energy);
  set(all.linear, lane, one.linear);
  set(all.angular, lane, one.angular);
  set(all.linear_conserved, lane, one.linear_conserved);
  set(all.angular_conserved, lane, one.angular_conserved);
  all.bound.set(int(lane), one.bound);
  all.half.set(int(lane), one.half);
  all.per_t_end.set(int(lane), one.per_t_end);
}

DriftSums<double> lane_of(const DriftSums<Lanes>& all, std::size_t lane) {
  DriftSums<double> one;
  DriftSums<double>::for_each(one, all, [lane](double& x, const Lanes& y) { x = y[int(lane)]; });
  return one;
}

}  // namespace

void LaneMeter::begin(std::size_t lane, DriftMeter& meter) {
  meters_[lane] = &meter;
  holds_[lane] = true;
  set(origin_, lane, meter.origin_);
  DriftSums<double>::for_each(sums_, meter.sums_, [lane](Lanes& x, double y) { x.set(int(lane), y); });
  starts_.resize(meter.invariants_.size(), Lanes(0));
  worst_.resize(meter.invariants_.size(), Lanes(0));
  for (std::size_t k = 0; k < meter.invariants_.size(); ++k) {
    starts_[k].set(int(lane), meter.invariants_[k].start);
    worst_[k].set(int(lane), meter.invariants_[k].worst);
  }
  errors_.begin(lane, meter);
}

void LaneMeter::on_samples(const LaneBlock& block, std::span<const bool> running, std::span<std::size_t> accepted) {
  const std::size_t n = block.samples.size();
  const DriftOrigin<Lanes>& origin = origin_;
  const Lanes::Mask hopeless = fill(columns_, block.samples, origin, 0, [&](const LaneSample& sample) {
    return Vector3<Lanes>(sample.seen.angular_momentum - origin.angular);
  });
  std::array<std::size_t, count> all_seen{};
  for (std::size_t i = 0; i < count; ++i) {
    if (!running[i]) continue;
    std::size_t& seen = all_seen[i] = accepted[i];
    if (hopeless.bits[i]) {
      const auto is_hopeless_at = [&](std::size_t k) {
        return is_hopeless(columns_.energy[k], block.samples[k].seen.kinetic, origin.bound).bits[i] != 0;
      };
      std::size_t taken = 0;
      while (taken < seen && !is_hopeless_at(taken)) ++taken;
      seen = std::min(taken + 1, seen);
      accepted[i] = taken;
    }
    if (accepted[i] < n) end_within(block, i, seen, accepted[i]);
  }
  follow(all_seen, n);
  sums_.add(columns_, n, origin);
  for (std::size_t k = 0; k < starts_.size(); ++k) {
    Lanes worst = worst_[k];
    for (const Lanes value : block.watched[k]) raise_size(worst, value - starts_[k]);
    worst_[k] = worst;
  }
}

/// Adds samples to the means over blocks: where they all fit into the open block, in all lanes at once.
void LaneMeter::follow(const std::array<std::size_t, count>& seen, std::size_t n) {
  Lanes t = 0, energy = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (seen[i] == 0) continue;
    t.set(int(i), meters_[i]->blocks_.open_sums().t);
    energy.set(int(i), meters_[i]->blocks_.open_sums().value);
  }
  for (std::size_t k = 0; k < n; ++k) {
    t += columns_.t[k];
    energy += columns_.energy[k];
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (seen[i] == 0) continue;
    DriftMeter& meter = *meters_[i];
    meter.samples_ += static_cast<std::int64_t>(seen[i]);
    if (seen[i] == n && n <= meter.blocks_.room()) {
      meter.blocks_.set_open_sums({t[int(i)], energy[int(i)]}, n);
    } else {
      const DriftsOfRun drifts = DriftsOfRun::in(columns_, i);
      meter.blocks_.add(drifts.t, drifts.energy, seen[i]);
    }
  }
  add_to_curves(seen, n);
}

/// Adds samples to the curves that are kept: in all lanes at once up to the next sample that completes an interval of
/// one of them.
void LaneMeter::add_to_curves(const std::array<std::size_t, count>& seen, std::size_t n) {
  std::array<std::size_t, count> whole{};  // the lanes that take all samples
  std::size_t wholes = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (seen[i] == 0 || !meters_[i]->keeps_curves_) continue;
    if (seen[i] == n) whole[wholes++] = i;
    else meters_[i]->series_.add(DriftsOfRun::in(columns_, i), seen[i]);
  }
  if (wholes == 0) return;
  for (std::size_t k = 0; k < n;) {
    std::size_t end = n;
    for (std::size_t w = 0; w < wholes; ++w) end = std::min(end, k + meters_[whole[w]]->series_.room());
    const std::size_t begin = k;
    LargestDrifts<Lanes> largest{columns_.t[k], columns_.energy[k], columns_.linear2[k], columns_.angular2[k],
                                 columns_.defect[k]};
    while (++k < end)
      largest.add(columns_.t[k], columns_.energy[k], columns_.linear2[k], columns_.angular2[k], columns_.defect[k]);
    for (std::size_t w = 0; w < wholes; ++w) {
      const int i = int(whole[w]);
      meters_[whole[w]]->series_.add(
          {largest.t[i], largest.energy[i], largest.linear2[i], largest.angular2[i], largest.defect[i]}, end - begin);
    }
  }
}

/// Gives the meter of a run that ends within the block what was measured until then.
void LaneMeter::end_within(const LaneBlock& block, std::size_t lane, std::size_t seen, std::size_t accepted) {
  DriftColumns<double> columns;
  const DriftsOfRun drifts = DriftsOfRun::in(columns_, lane);
  for (std::size_t k = 0; k < seen; ++k) {
    columns.t[k] = drifts.t[k];
    columns.energy[k] = drifts.energy[k];
    columns.linear2[k] = drifts.linear2[k];
    columns.angular2[k] = drifts.angular2[k];
    columns.defect[k] = drifts.defect[k];
  }
  end(lane);
  DriftMeter& meter = *meters_[lane];
  meter.sums_.add(columns, seen, meter.origin_);
  for (std::size_t k = 0; k < starts_.size(); ++k) {
    DriftMeter::Watched& w = meter.invariants_[k];
    for (const Lanes& value : block.watched[k].first(accepted)) raise_size(w.worst, value[int(lane)] - w.start);
  }
}

void LaneMeter::end(std::size_t lane) {
  if (!std::exchange(holds_[lane], false)) return;
  DriftMeter& meter = *meters_[lane];
  meter.sums_ = lane_of(sums_, lane);
  for (std::size_t k = 0; k < starts_.size(); ++k) meter.invariants_[k].worst = worst_[k][int(lane)];
  errors_.end(lane);
}

}  // namespace polhode::study::metrics
