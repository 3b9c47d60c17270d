// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/trajectory/trajectory.hpp"

#include "experiments/study/trajectory/csv_tables.hpp"
#include "experiments/study/trajectory/hdf5_tables.hpp"
#include "experiments/study/trajectory/trajectory_rows.hpp"

namespace polhode::study::inline trajectory {
namespace {

/// The part common to both formats: the rows of a sample. Tables has trajectory(row), energy(row), impact(row),
/// slide_end(row), flush(), close().
template <class Tables>
class Writer final : public TrajectoryWriter {
 public:
  Writer(const std::filesystem::path& folder, const System<double>& system, BlockEnd block)
      : system_(system), block_(block), tables_(folder, system) {}

  void on_impacts(std::span<const Impact> impacts) override {
    for (const Impact& impact : impacts) tables_.impact(event_row(impact));
  }
  void on_slides_end(std::span<const Transition> transitions) override {
    for (const Transition& transition : transitions) tables_.slide_end(event_row(transition));
  }
  void on_multipliers(std::span<const double> multipliers) override {
    multipliers_ = Eigen::Map<const VectorX<double>>(multipliers.data(), Eigen::Index(multipliers.size()));
  }
  void on_contact_energy(const ContactLosses& losses) override { contact_ = losses; }
  double next_state() const override { return 0; }

  void on_start(const State<double>& state, const Sample& sample) override {
    energy_start_ = sample.ledger(contact_.total());
    on_state(state, sample);
  }
  void on_state(const State<double>& state, const Sample& sample) override {
    for (std::size_t i = 0; i < system_.moving(); ++i) {
      tables_.trajectory(trajectory_row(system_, state, i, sample.seen.energy()));
    }
    tables_.energy(energy_row(system_, sample, contact_, energy_start_));
    if (system_.has_joints()) {
      for (const auto& row : reaction_rows(system_, state, multipliers_)) tables_.reaction(row);
    }
    rows_in_block_ += system_.moving();
    if (rows_in_block_ >= block_.rows || Clock::now() - flushed_ >= block_.age) flush();
  }

  void close() override { tables_.close(); }

 private:
  using Clock = std::chrono::steady_clock;

  void flush() {
    tables_.flush();
    rows_in_block_ = 0;
    flushed_ = Clock::now();
  }

  const System<double>& system_;
  BlockEnd block_;
  Tables tables_;
  ContactLosses contact_;
  VectorX<double> multipliers_;  ///< multipliers of the next state, if the method solves for them; else empty
  double energy_start_ = 0;
  std::size_t rows_in_block_ = 0;
  Clock::time_point flushed_ = Clock::now();
};

}  // namespace

std::unique_ptr<TrajectoryWriter> open_trajectory(TrajectoryFormat format, const std::filesystem::path& folder,
                                                  const System<double>& system, BlockEnd block) {
  if (format == TrajectoryFormat::none) return nullptr;
  begin_trajectory(folder);
  if (format == TrajectoryFormat::hdf5) return std::make_unique<Writer<Hdf5Tables>>(folder, system, block);
  return std::make_unique<Writer<CsvTables>>(folder, system, block);
}

}  // namespace polhode::study::trajectory
