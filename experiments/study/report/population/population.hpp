// SPDX-License-Identifier: BSD-3-Clause
// Statistics of a study with too many runs to be held: each run is counted once and then dropped. They are, for each
// metric of the tables that is one number for a run, its distribution for each method, its quantiles against each axis
// with numbers, and a map over two of these axes.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "experiments/study/record/analysis.hpp"
#include "experiments/study/record/metric_table.hpp"
#include "experiments/study/record/study_view.hpp"
#include "experiments/study/report/population/cheapest_setting.hpp"
#include "experiments/study/statistics/quantile_sketch.hpp"

namespace polhode::study::inline report::inline population {

class Population {
 public:
  /// `sample`: a study with some of the runs, evenly chosen, from whose values the ranges of the axes are taken.
  explicit Population(const StudyView& sample);

  /// `cells`: those of the run below config_columns().
  void add(const RunRecord& run, const std::vector<std::string>& cells);

  std::size_t runs() const { return runs_; }
  /// Number of runs by status, and the message of the first run of each.
  struct Outcome {
    std::size_t runs = 0;
    std::string message;
  };
  const std::map<std::string, Outcome>& outcomes() const { return outcomes_; }

  /// The answer; table and file of distributions; figures of distributions, of quantiles against the axes, and maps.
  Analysis analysis() const;

 private:
  static constexpr std::size_t bins = 32;  // number of bins of an axis

  /// A column of the configuration with numbers.
  struct NumericAxis {
    std::size_t column = 0;  // index of the column in config_columns()
    std::string name;
    bool logarithmic = false;
    double low = 0, high = 1;

    std::size_t bin(double value) const;
    double edge(std::size_t number) const;  // lower edge of a bin; of `bins`: the upper edge of the last one
    double middle(std::size_t number) const;
  };
  /// The numbers of one metric in the runs of one method.
  struct Distribution {
    QuantileSketch all;
    std::string largest_in;                                 // id of the run with the largest value
    std::vector<std::array<QuantileSketch, bins>> along{};  // quantiles by axis and bin, of metrics that are drawn
    std::vector<QuantileSketch> map{};  // quantiles by the bins of the first two axes, of the first such metric
  };

  void find_axes(const StudyView& sample);
  const Distribution* find(std::size_t method, const Metric& metric) const;
  bool has_values(const Metric& metric) const;
  Table table() const;
  std::string csv() const;
  Figure distributions() const;
  Figure envelopes() const;
  Figure maps() const;

  std::vector<NumericAxis> axes_;
  std::vector<const Metric*> metrics_;            // numbers with a column in the narrow tables
  std::vector<const Metric*> drawn_;              // metrics that are drawn
  std::vector<std::string> methods_;              // methods in the order of their first runs
  std::vector<std::vector<Distribution>> found_;  // distributions by method, then by metric
  std::map<std::string, Outcome> outcomes_;
  CheapestSetting cheapest_;
  std::size_t runs_ = 0;
};

}  // namespace polhode::study::report::population
