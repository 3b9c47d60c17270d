// SPDX-License-Identifier: BSD-3-Clause
// Tables of made-up studies, and the names of their values in LaTeX.
#include "experiments/study/report/tables/tables.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>
#include <string>

#include "experiments/study/record/shown_runs.hpp"
#include "experiments/study/report/tables/tex_values.hpp"
#include "tests/experiments/study/report/made_up_study.hpp"
#include "tests/experiments/study/report/result_files.hpp"

namespace polhode::study::report_tests::tables_test {
namespace {

TEST(ReportTables, NameRunsInLettersAndNoTwoAlike) {
  auto study = power_laws("unused");
  const auto names = tex_names(study, evenly_spread(study.runs.size(), study.runs.size()));
  EXPECT_EQ(names[3 * 7 + 6], "polhodeTumblingBoxRkFourDtOneEMinusThree");
  EXPECT_EQ(names[4 * 7], "polhodeTumblingBoxCvodeAdamsToleranceOneEMinusFour");
  study.runs.push_back(study.runs.front());
  study.runs.back().id = "00000000000000ff";
  const auto more = tex_names(study, evenly_spread(study.runs.size(), study.runs.size()));
  EXPECT_EQ(std::set<std::string>(more.begin(), more.end()).size(), study.runs.size());
  for (const auto& name : more)
    EXPECT_TRUE(std::all_of(name.begin(), name.end(), [](char c) { return std::isalpha(c); })) << name;
}

TEST(ReportTables, AreWritten) {
  const Folder folder;
  auto study = power_laws(folder.path);
  study.runs.front().result.energy_drift_max_rel = std::numeric_limits<double>::infinity();
  study.runs[1].result.attitude_error_max = std::nan("");
  write_tables(study);
  const auto tex = read(folder.path / "tables/summary.tex"), md = read(folder.path / "tables/summary.md");
  const auto values = read(folder.path / "tables/values.tex");
  EXPECT_NE(tex.find("\\begin{longtable}"), std::string::npos);  // 49 rows
  EXPECT_NE(tex.find("\\texttt{semi\\_implicit\\_euler}"), std::string::npos);
  EXPECT_NE(tex.find("\\toprule"), std::string::npos);
  EXPECT_NE(md.find("| rk4 | 0.1 |"), std::string::npos) << md;
  EXPECT_NE(
      values.find(
          "\\newcommand{\\polhodeTumblingBoxRkFourDtOneEMinusOneEnergyDriftMax}{\\ensuremath{1.5\\times10^{-5}}}"),
      std::string::npos);
  EXPECT_NE(values.find("\\newcommand{\\polhodeTumblingBoxRkFourEnergyDriftSlope}"), std::string::npos);
  for (const auto& text : {tex, md, values}) EXPECT_FALSE(has_not_a_number(text));

  const auto methods = read(folder.path / "tables/methods.csv");
  EXPECT_NE(methods.find("\nrk4,"), std::string::npos) << methods;
  EXPECT_FALSE(std::filesystem::exists(folder.path / "tables/values_rk4.tex"));

  study.runs.resize(3);
  write_tables(study);
  EXPECT_NE(read(folder.path / "tables/summary.tex").find("\\begin{tabular}"), std::string::npos);
}

TEST(ReportTables, ValuesOfManyRunsAreInAFileForEachMethod) {
  const Folder folder;
  auto study = power_laws(folder.path);
  while (study.runs.size() <= most_runs_of_a_values_file) study.runs.push_back(study.runs[study.runs.size() % 49]);
  write_tables(study);
  const auto values = read(folder.path / "tables/values.tex"), of_rk4 = read(folder.path / "tables/values_rk4.tex");
  EXPECT_NE(values.find("\\newcommand{\\polhodeRuns}"), std::string::npos);
  EXPECT_EQ(values.find("EnergyDriftMax}"), std::string::npos);
  EXPECT_NE(of_rk4.find("EnergyDriftMax}"), std::string::npos);
  EXPECT_EQ(of_rk4.find("CvodeAdams"), std::string::npos);
  EXPECT_NE(of_rk4.find("\\input{values_rk4.tex}"), std::string::npos);
}

}  // namespace
}  // namespace polhode::study::report_tests::tables_test
