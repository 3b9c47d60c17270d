// SPDX-License-Identifier: BSD-3-Clause
// A method has one colour, marker and dash in all studies, and no two methods are alike, with colour or without.
#include "experiments/study/plot/method_style.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "integrators/catalogue.hpp"

namespace polhode::study::method_style_test {
namespace {

std::vector<std::string> all_methods() {
  std::vector<std::string> names;
  for (const IntegratorEntry& entry : integrator_catalogue()) names.push_back(entry.declaration.name);
  return names;
}

TEST(MethodStyle, IsUniqueInTheCatalogue) {
  const auto styles = styles_of(all_methods());
  std::set<std::pair<std::size_t, std::size_t>> in_colour, in_grey;
  for (const MethodStyle& style : styles) {
    ASSERT_LT(style.colour, style::colours.size());
    ASSERT_LT(style.marker, style::markers.size());
    ASSERT_LT(style.dash, style::dashes.size());
    in_colour.emplace(style.colour, style.marker);
    in_grey.emplace(style.marker, style.dash);
  }
  EXPECT_EQ(in_colour.size(), styles.size());
  EXPECT_EQ(in_grey.size(), styles.size());
}

TEST(MethodStyle, OfAPhaseIsTheSameAlone) {
  const auto all = styles_of({"sat", "gjk", "sat_course_report"});
  EXPECT_EQ(styles_of({"sat_course_report"}).front(), all[2]);
  EXPECT_EQ(styles_of({"gjk", "sat"}), (std::vector<MethodStyle>{all[1], all[0]}));
  EXPECT_FALSE(styles_of({"bvh"}).front() == styles_of({"octree"}).front());
}

TEST(MethodStyle, IsTheSameInEachStudy) {
  const auto names = all_methods();
  const auto styles = styles_of(names);
  for (std::size_t i = 0; i < names.size(); ++i) {
    EXPECT_EQ(styles_of({names[i]}).front(), styles[i]) << names[i];
    EXPECT_EQ(styles_of({"mine", names[i], names[0]})[1], styles[i]) << names[i];
  }
}

TEST(MethodStyle, TellsTheMethodsOfTheDefaultStudyApartByColourAndByMarker) {
  const auto styles = styles_of({"explicit_euler", "semi_implicit_euler", "explicit_midpoint", "rk4", "lie_midpoint",
                                 "dmv", "cvode_adams", "cvode_bdf", "odeint_dopri5"});
  std::set<std::size_t> colours, markers;
  for (const MethodStyle& style : styles) colours.insert(style.colour), markers.insert(style.marker);
  EXPECT_EQ(colours.size(), 9U);
  EXPECT_EQ(markers.size(), 9U);
}

TEST(MethodStyle, TellsTheMethodsOfAFamilyApart) {
  const auto names = all_methods();
  const auto styles = styles_of(names);
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const auto family = [&](std::size_t k) { return find_integrator(names[k])->declaration.family; };
      if (family(i) != family(j)) continue;
      EXPECT_FALSE(styles[i].colour == styles[j].colour && styles[i].dash == styles[j].dash)
          << names[i] << ' ' << names[j];
    }
  }
}

TEST(MethodStyle, OfAMethodThatTheTableDoesNotHaveIsLikeNoOther) {
  auto names = all_methods();
  const std::size_t known = names.size();
  names.emplace_back("mine");
  names.emplace_back("yours");
  const auto styles = styles_of(names);
  for (std::size_t i = 0; i + 1 < names.size(); ++i) {
    for (std::size_t j = std::max(i + 1, known); j < names.size(); ++j) {
      EXPECT_FALSE(styles[i].marker == styles[j].marker && styles[i].colour == styles[j].colour) << names[i];
      EXPECT_FALSE(styles[i].marker == styles[j].marker && styles[i].dash == styles[j].dash) << names[i];
    }
  }
}

TEST(MethodStyle, OfNamesThatAreNoMethodsBeginsAtTheBeginning) {
  const auto styles = styles_of({"float", "double", "long_double"});
  for (std::size_t i = 0; i < styles.size(); ++i) EXPECT_EQ(styles[i], (MethodStyle{i, i, 0}));
  EXPECT_EQ(styles_of(std::vector<std::string>(200, "nothing")).size(), 200U);
}

}  // namespace
}  // namespace polhode::study::method_style_test
