// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/replay/recorder.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/system/joint_reactions.hpp"
#include "experiments/study/metrics/references.hpp"
#include "experiments/study/run/run.hpp"
#include "experiments/study/text/csv.hpp"

namespace polhode::study::replay {
namespace {

class Recorder final : public TrajectoryWriter {
 public:
  Recorder(const System<double>& system, std::size_t most, Recording& recording, MotionScales scales)
      : system_(system), most_(most), recording_(recording), scales_(std::move(scales)) {}

  double next_state() const override { return 0; }

  void on_impacts(std::span<const Impact> impacts) override {
    recording_.impacts.insert(recording_.impacts.end(), impacts.begin(), impacts.end());
    recording_.impacts_seen += std::int64_t(impacts.size());
    if (recording_.impacts.size() > 2 * most_) keep_impacts(recording_, most_);
  }

  void on_multipliers(std::span<const double> multipliers) override {
    multipliers_ = Eigen::Map<const VectorX<double>>(multipliers.data(), Eigen::Index(multipliers.size()));
  }

  void on_contact_energy(const ContactLosses& losses) override { contact_ = losses; }

  void on_start(const State<double>& state, const Sample& sample) override {
    start(sample);
    on_state(state, sample);
  }
  void on_state(const State<double>& state, const Sample& sample) override {
    last_state_ = state;
    last_sample_ = sample;
    last_kept_ = recording_.instants_seen++ % stride_ == 0;
    if (last_kept_) keep();
    if (recording_.times.size() > most_) halve();
  }

  void close() override {
    if (!last_kept_) keep();
  }

 private:
  void start(const Sample& sample) {
    recording_.moving = system_.moving();
    recording_.joints = recording_.scene.joints.size();
    energy_start_ = sample.ledger(contact_.total());
    momentum_start_ = momentum(sample);
  }

  /// The shown momentum: linear, kg m/s, or angular, kg m²/s. The angular momentum of a single body is about its
  /// reference point, that of several bodies about their mass centre at the start.
  Vector3<double> momentum(const Sample& sample) const {
    if (recording_.momentum == ShownMomentum::linear) return sample.seen.linear_momentum;
    if (system_.moving() == 1) return sample.seen.angular_momentum;
    return sample.seen.angular_momentum - scales_.mass_center.cross(sample.seen.linear_momentum);
  }

  void keep() {
    recording_.times.push_back(last_state_.t);
    recording_.energy_drift.push_back(relative(last_sample_.ledger(contact_.total()) - energy_start_, scales_.energy));
    const double scale = recording_.momentum == ShownMomentum::linear ? scales_.linear : scales_.angular;
    const bool shown = recording_.momentum != ShownMomentum::none;
    recording_.momentum_drift.push_back(shown ? relative((momentum(last_sample_) - momentum_start_).norm(), scale) : 0);
    for (std::size_t i = 0; i < system_.moving(); ++i) {
      const BodySnapshot<double> s = system_.snapshot(last_state_.y, i);
      recording_.placements.push_back({s.position, s.orientation, s.angular_velocity});
    }
    if (recording_.joints == 0) return;
    for (const Wrench<double>& w : joint_reactions(system_, last_state_.t, last_state_.y, multipliers_))
      recording_.reactions.push_back(w.force);
  }

  void halve() {
    std::vector<std::size_t> even;
    for (std::size_t k = 0; k < recording_.times.size(); k += 2) even.push_back(k);
    keep_these(recording_, even);
    last_kept_ = recording_.times.back() == last_state_.t;
    stride_ *= 2;
  }

  const System<double>& system_;
  std::size_t most_;
  Recording& recording_;
  MotionScales scales_;
  ContactLosses contact_;
  VectorX<double> multipliers_;  ///< multipliers of the method at the last state
  double energy_start_ = 0;
  Vector3<double> momentum_start_ = Vector3<double>::Zero();
  std::int64_t stride_ = 1;
  State<double> last_state_;
  Sample last_sample_;
  bool last_kept_ = true;
};

}  // namespace

Recording record(const PlannedRun& run, std::size_t most) {
  Recording recording;
  recording.scene = scene_of(*run.scenario);
  References truth;
  truth.expect(std::vector(2, number_of(*run.scenario)));
  const MotionScales scales = truth.of(run.config, *run.scenario, nullptr).scales;
  TrajectoryRequest request;
  request.open = [&](const System<double>& system) {
    recording.momentum = shown_momentum(system, *run.scenario);
    return std::make_unique<Recorder>(system, std::max<std::size_t>(most, 4), recording, scales);
  };
  const RunResult result = carry_out(run.config, *run.scenario, request, nullptr, &truth);
  recording.id = run.id;
  recording.config = run.config;
  recording.status = result.status;
  recording.message = result.message;
  recording.energy_drift_max = csv_cell(result.energy_drift_max_rel);
  return recording;
}

}  // namespace polhode::study::replay
