// SPDX-License-Identifier: BSD-3-Clause
// The runs of a study in its stores: which are there, how the missing ones are carried out, and their results.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "experiments/study/plan/experiment.hpp"
#include "experiments/study/plan/plan.hpp"
#include "experiments/study/process/interruption.hpp"
#include "experiments/study/record/study_view.hpp"
#include "experiments/study/store/result_folder.hpp"
#include "experiments/study/store/store.hpp"
#include "experiments/study/workers/runs_in_order.hpp"

namespace polhode::study::inline workers {

/// Results of runs by their id, as number_of_id() gives it.
using ResultsById = std::unordered_map<std::uint64_t, RunResult>;

class StudyRuns {
 public:
  /// `folder`: that of the study. `own`: that of the store into which this process writes: the study's or a shard's.
  /// Reads which runs are there. Prints what is damaged, and removes it from the own store, so that it is carried out
  /// again; with --force, failed runs are too. All parameters must outlive this object.
  StudyRuns(const Experiment& experiment, const Options& options, Plan& plan, std::filesystem::path folder,
            std::filesystem::path own);

  Store& store() { return store_; }

  /// Number of runs of the plan that no store of the study has. Refused runs are not missing.
  std::size_t missing() const;

  /// Copies results of the plan's runs from the other stores of the study into the own one.
  void join();

  /// Carries out the runs that no store has yet; of a shard its own. Returns false if interrupted. `make`:
  /// for_each_part will be called with it. Where all runs of the plan are carried out, parts are made and used
  /// meanwhile.
  bool carry_out_missing(Interruption& interruption, const MakePart& make = {});

  /// Adds the further runs that the experiment requests, given the results of the plan. Returns false if there are
  /// none.
  bool widen();

  /// The study with these runs of the plan (ascending), which must be there or be refused.
  StudyView view(const std::vector<std::size_t>& runs) const;
  /// The study with all runs that are there or refused. To be called once, after the last widen().
  StudyView view();

  /// The study with these runs of the plan, whose results are empty.
  StudyView planned(const std::vector<std::size_t>& runs) const;

  /// Calls make(runs) for the parts of the plan that carry_out_missing has not used, without scenarios, on several
  /// threads, and what it returns in the order of the plan.
  void for_each_part(const MakePart& make) const;

  /// The result of a run that is in the own store.
  RunResult result(std::size_t run, Curves curves) const;

 private:
  enum class Place : char { nowhere, own_store, other_store };

  void look();
  void hold_results();
  bool is_whole(std::size_t run, const RunResult& result) const;
  std::size_t count(Place place) const;
  void run(const std::vector<std::uint32_t>& runs, Interruption& interruption, const MakePart& make);
  void check_found(std::size_t run, const std::optional<std::string>& damage) const;

  const Experiment& experiment_;
  const Options& options_;
  Plan& plan_;
  std::filesystem::path folder_, own_;
  Store store_;
  std::vector<std::filesystem::path> others_;    // folders of the other stores of the study that can be read
  std::vector<Place> places_;                    // places of the runs of the plan
  ResultsById held_;                             // results of all stores, from one widen() to the next and to view()
  std::unordered_set<std::uint64_t> elsewhere_;  // those of held_ that only other stores have
  std::size_t used_parts_ = 0;                   // parts that for_each_part leaves out
  bool begun_ = false;                           // runs have been carried out
};

/// Chooses the runs of the plan whose curves against time are kept (--curves).
void choose_curves(const Options& options, Plan& plan);

/// Recognises the runs of the study, with all further ones that follow from the results in its folder, even if some
/// results are missing, because the study was interrupted or has more runs than before. Changes no file. `plan` must
/// outlive what is returned.
BelongsToStudy runs_of_study(const Experiment& experiment, const Options& options, const Plan& plan,
                             const std::filesystem::path& folder);

}  // namespace polhode::study::workers
