// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/plot/recording.hpp"

#include <memory>
#include <string_view>
#include <utility>

#include "experiments/study/run/run.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/suggestion.hpp"

namespace polhode::study::plot_program {
namespace {

constexpr std::size_t most_rows = 2048;

class Recorder final : public TrajectoryWriter {
 public:
  Recorder(const System<double>& system, std::size_t body, const std::vector<const PlotQuantity*>& quantities,
           Recording& recording)
      : recording_(recording) {
    for (const PlotQuantity* quantity : quantities) {
      Measure measure = quantity->measure ? quantity->measure(system, body) : Measure();
      recording.tracks.push_back(
          {.series = {}, .times = {}, .rows = {}, .known = quantity->drawn == Drawn::events || measure});
      measures_.push_back(std::move(measure));
      thinned_.emplace_back(quantity->drawn == Drawn::against_time ? quantity->components.size() : 0);
    }
    const BodySnapshot<double> start = system.snapshot(system.start().y, body);
    recording.inertia = system.problem().bodies[body].inertia;
    recording.omega = start.angular_velocity;
    recording.momentum = start.angular_momentum;
    recording.rotation = start.rotation;
  }

  double next_state() const override { return 0; }

  void on_start(const State<double>& state, const Sample& sample) override {
    ledger_start_ = sample.ledger(contact_.total());
    on_state(state, sample);
  }

  void on_state(const State<double>& state, const Sample& sample) override {
    const Instant at{state, sample, contact_, ledger_start_};
    const bool kept = seen_++ % stride_ == 0;
    for (std::size_t q = 0; q < measures_.size(); ++q) {
      if (!measures_[q]) continue;
      const auto values = measures_[q](at);
      for (std::size_t c = 0; c < thinned_[q].size(); ++c) thinned_[q][c].add(state.t, values[c]);
      if (!thinned_[q].empty() || !kept) continue;
      recording_.tracks[q].times.push_back(state.t);
      recording_.tracks[q].rows.push_back(values);
    }
    if (kept && ++rows_ > most_rows) halve();
  }

  void on_impacts(std::span<const Impact> impacts) override {
    recording_.impacts.insert(recording_.impacts.end(), impacts.begin(), impacts.end());
  }
  void on_slides_end(std::span<const Transition> ends) override {
    recording_.slides_end.insert(recording_.slides_end.end(), ends.begin(), ends.end());
  }
  void on_contact_energy(const ContactLosses& losses) override { contact_ = losses; }

  void close() override {
    for (std::size_t q = 0; q < thinned_.size(); ++q) {
      for (const ThinnedCurve& curve : thinned_[q]) recording_.tracks[q].series.push_back(curve.points());
    }
  }

 private:
  /// Every other row is dropped, and from now on every other state.
  void halve() {
    for (Track& track : recording_.tracks) {
      std::size_t n = 0;
      for (std::size_t k = 0; k < track.rows.size(); k += 2, ++n) {
        if (n != k) track.rows[n] = std::move(track.rows[k]);
        track.times[n] = track.times[k];
      }
      track.rows.resize(n);
      track.times.resize(n);
    }
    rows_ = (rows_ + 1) / 2;
    stride_ *= 2;
  }

  Recording& recording_;
  std::vector<Measure> measures_;
  std::vector<std::vector<ThinnedCurve>> thinned_;
  ContactLosses contact_;
  double ledger_start_ = 0;
  std::size_t seen_ = 0, stride_ = 1, rows_ = 0;
};

std::size_t moving_body(const Problem& problem, const std::string& name) {
  std::vector<std::string_view> known;
  for (std::size_t i = 0; i < problem.moving(); ++i) {
    if (name.empty() || problem.bodies[i].name == name) return i;
    known.push_back(problem.bodies[i].name);
  }
  throw InputError("--body: no moving body '" + name + "'" + suggestion(name, "There are", known));
}

}  // namespace

Recording record(const RunConfig& config, const Scenario& scenario, const std::vector<const PlotQuantity*>& quantities,
                 const std::string& body, const std::atomic<bool>* stop) {
  Recording recording{.config = config};
  const std::size_t index = moving_body(scenario.problem, body);
  for (const Body& one : scenario.problem.bodies) recording.bodies.push_back(one.name);
  TrajectoryRequest request;
  request.open = [&](const System<double>& system) -> std::unique_ptr<TrajectoryWriter> {
    return std::make_unique<Recorder>(system, index, quantities, recording);
  };
  recording.result = carry_out(config, scenario, request, stop);
  return recording;
}

}  // namespace polhode::study::plot_program
