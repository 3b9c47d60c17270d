// SPDX-License-Identifier: BSD-3-Clause
// Simulates a recorded session again.
#include <fmt/format.h>

#include <map>
#include <set>
#include <utility>

#include "experiments/viewer/session/segment_run.hpp"
#include "experiments/viewer/session/session_record.hpp"
#include "experiments/viewer/session/state_conversion.hpp"

namespace polhode::viewer::inline session {
namespace {

using Place = std::pair<std::int64_t, std::int64_t>;  // segment and step

/// Observer of the rerun of a segment: stores the states at which other segments start, and stops after the last
/// recorded step.
class Follower final : public Observer {
 public:
  Follower(const RecordedSegment& segment, std::int64_t number, const std::set<Place>& wanted,
           std::map<Place, State<double>>& kept)
      : segment_(segment), number_(number), last_(segment.steps()), wanted_(wanted), kept_(kept) {
    for (const SegmentPart& part : segment.parts) sizes_.insert(sizes_.end(), part.sizes.begin(), part.sizes.end());
  }

  std::size_t on_samples(std::span<const Sample> samples) override { return samples.size(); }
  double next_state() const override { return 0; }
  void on_state(const State<double>& state, const Sample&) override {
    if (wanted_.contains({number_, step_})) kept_[{number_, step_}] = state;
    check(state);
    end_ = state;
    if (step_ == last_) stop = true;
    else ++step_;
  }
  double next_size() const { return step_ >= 1 && step_ <= last_ ? sizes_[std::size_t(step_ - 1)] : 0; }

  const State<double>& end() const { return end_; }
  /// First difference from the record; call after the run has ended.
  std::string mismatch(const RunOutcome& outcome) const {
    if (!mismatch_.empty() || stop) return mismatch_;
    return fmt::format("segment {} ends after {} of {} steps{}{}", number_, step_ - 1, last_,
                       outcome.message.empty() ? "" : ": ", outcome.message);
  }

  std::atomic<bool> stop{false};

 private:
  void check(const State<double>& state) {
    if (part_ == segment_.parts.size()) return;
    const SegmentPart& part = segment_.parts[part_];
    if (step_ != before_ + part.steps) return;
    before_ = step_;
    ++part_;
    const std::string now = digest(state);
    if (mismatch_.empty() && now != part.digest) {
      mismatch_ = fmt::format("segment {}, step {}, t = {} s: the state is {}, and was {}", number_, step_, state.t,
                              now, part.digest);
    }
  }

  const RecordedSegment& segment_;
  std::int64_t number_, last_, step_ = 0, before_ = 0;
  std::size_t part_ = 0;
  const std::set<Place>& wanted_;
  std::map<Place, State<double>>& kept_;
  std::vector<double> sizes_;
  State<double> end_;
  std::string mismatch_;
};

}  // namespace

Rerun rerun(const std::string& session_file) {
  const SessionRecord record = read_session(session_file);
  std::set<Place> wanted;
  for (const RecordedSegment& s : record.segments) wanted.insert({s.from.segment, s.from.step});
  std::map<Place, State<double>> kept;
  Rerun result;
  for (const RecordedSegment& segment : record.segments) {
    SegmentRun run(record.scenario, segment.configuration);
    State<double> state = run.system().start();
    if (segment.from.segment > 0) {
      const auto found = kept.find({segment.from.segment, segment.from.step});
      if (found == kept.end()) break;  // that segment ended earlier than recorded, which its mismatch reports
      const Formulation& before = record.segments[std::size_t(segment.from.segment - 1)].configuration.run.formulation;
      state = converted(*make_system<double>(record.scenario.problem, before), found->second, run.system());
    }
    Follower follower(segment, ++result.segments, wanted, kept);
    const RunOutcome outcome = run.go(state, follower, follower.stop, [&] { return follower.next_size(); });
    if (result.mismatch.empty()) result.mismatch = follower.mismatch(outcome);
    result.steps += segment.steps();
    result.end = follower.end();
  }
  result.digest = digest(result.end);
  return result;
}

}  // namespace polhode::viewer::session
