// SPDX-License-Identifier: BSD-3-Clause
// One line of a certificate: a trait of a method, what the method declares of it, and what was measured.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace polhode::study::certificate {

enum class TraitVerdict {
  holds,           ///< declared, and so it is
  does_not_hold,   ///< declared, and it is not so
  undeclared,      ///< not declared, but measured to hold
  absent,          ///< neither declared nor so
  undecided,       ///< the measurement says nothing either way
  not_applicable,  ///< it makes no sense of this method, or on these motions
};
std::string word_of(TraitVerdict verdict);

struct Finding {
  std::string trait;               ///< one of trait_columns(): "symplecticity"
  std::string declared;            ///< "yes", "no", an order, a number; empty: nothing is declared of it
  std::optional<double> measured;  ///< absent: at round-off, or not measured
  std::string unit;                ///< "1", "rad", …
  std::optional<double> limit;     ///< it holds up to here
  TraitVerdict verdict = TraitVerdict::not_applicable;
  std::string on;    ///< the scenario that showed the worst
  std::string note;  ///< why, or what else was seen
};

struct TraitColumn {
  std::string trait;    ///< as in certificate.csv
  std::string heading;  ///< of a column: "angular momentum"
  std::string meaning;  ///< one sentence
};
/// Every trait in the order of a certificate.
const std::vector<TraitColumn>& trait_columns();

Finding not_applicable(std::string trait, std::string why);

/// A trait that holds where a defect is no larger than a limit.
Finding kept(std::string trait, bool declared, double defect, double limit, std::string on);

/// The worst of what several motions showed of one trait: the worst verdict, and among equals the largest number.
/// Motions on which it could not be measured are left out unless there is no other.
Finding worst(const std::vector<Finding>& findings);

}  // namespace polhode::study
