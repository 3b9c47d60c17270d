// SPDX-License-Identifier: BSD-3-Clause
// Rows of CSV files.
#include "experiments/study/text/csv.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace polhode::study::report_tests::csv_test {
namespace {

TEST(CsvRows, WriteEachKindOfCell) {
  std::string rows = "head\n";
  CsvRow row(rows);
  row.add("");
  row.add("plain");
  row.add("a,b");
  row.add("\"a\"");
  row.add("two\nlines");
  row.add(std::int64_t{-7});
  row.add(0.1);
  row.add(std::nan(""));
  row.add(std::optional<double>(1e-9));
  row.add(std::optional<double>());
  row.add(std::optional<double>(HUGE_VAL));
  row.end();
  EXPECT_EQ(rows, "head\n,plain,\"a,b\",\"\"\"a\"\"\",\"two\nlines\",-7,0.1,,1e-09,,\n");
  EXPECT_EQ(csv_row({"a", "b,c", ""}), "a,\"b,c\",\n");
}

}  // namespace
}  // namespace polhode::study::report_tests::csv_test
