// SPDX-License-Identifier: BSD-3-Clause
// Numbers as words, and the escapes of each format.
#include "experiments/study/text/notation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <optional>

namespace polhode::study::report_tests::notation_test {
namespace {

TEST(ReportNotation, PrintsNumbersShortly) {
  EXPECT_EQ(number(0.0325276), "0.0325");
  EXPECT_EQ(number(3.25e-5), "3.25e-5");
  EXPECT_EQ(number(-1e6), "-1e6");
  EXPECT_EQ(number(1234.6), "1235");
  EXPECT_EQ(number(1e-10), "1e-10");
  EXPECT_EQ(number(std::nan("")), "not finite");
  EXPECT_EQ(exact_number(0.001), "0.001");
  EXPECT_EQ(exact_number(1e-5), "1e-5");
  EXPECT_EQ(exact_number(1.0 / 3), "0.3333333333333333");
  EXPECT_EQ(tex_number("3.25e-5"), "$3.25\\times10^{-5}$");
  EXPECT_EQ(tex_number("1e-5"), "$10^{-5}$");
}

TEST(ReportNotation, TellsNumbersFromTexts) {
  for (const char* text : {"0", "-0.0", "3.25e-5", "1e6", "+7", "-1.5e+3", ".5", "5.", "1e400", "-1e400", "1e-400"}) {
    const std::optional<double> value = printed_number(text);
    ASSERT_TRUE(value) << text;
    EXPECT_EQ(*value, std::strtod(text, nullptr)) << text;
  }
  for (const char* text : {"", "-", "+", ".", "e5", "1e", "1e+", "1-2", "--1", "+-1", "1 ", " 1", "0x1", "inf", "nan",
                           "1E5", "1,2", "none to 3"})
    EXPECT_FALSE(printed_number(text)) << text;
}

TEST(ReportNotation, EscapesWhatEachFormatWouldRead) {
  EXPECT_EQ(html("a & b < \"c\""), "a &amp; b &lt; &quot;c&quot;");
  EXPECT_EQ(tex("a_b & 50% {x} ^2 \\y"), "a\\_b \\& 50\\% \\{x\\} \\textasciicircum{}2 \\textbackslash{}y");
  EXPECT_EQ(tex("h|ω| ≤ ½, ∝ t²"), "h|$\\omega$| $\\leq$ ½, $\\propto$ t²");
  EXPECT_EQ(gnuplot("it's `date`\n"), "'it''s `date` '");
  EXPECT_EQ(markdown("a|b_c"), "a\\|b\\_c");
  EXPECT_EQ(shortened("größe", 5), "größe");
  EXPECT_EQ(shortened("größere", 4), "grö…");
  EXPECT_EQ(base64("Man"), "TWFu");
  EXPECT_EQ(base64("Ma"), "TWE=");
  EXPECT_EQ(base64("M"), "TQ==");
}

}  // namespace
}  // namespace polhode::study::report_tests::notation_test
