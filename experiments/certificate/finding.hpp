// SPDX-License-Identifier: BSD-3-Clause
// One line of a certificate: a trait of a method, as declared and as measured.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace polhode::study::certificate {

enum class TraitVerdict {
  holds,           ///< declared, and measured to hold
  does_not_hold,   ///< declared, but measured not to hold
  undeclared,      ///< measured to hold, though not declared
  absent,          ///< neither declared nor measured to hold
  undecided,       ///< the measurement does not decide
  not_applicable,  ///< the trait is not defined for this method or these motions
};
std::string word_of(TraitVerdict verdict);

struct Finding {
  std::string trait;               ///< name in trait_columns(): "symplecticity"
  std::string declared;            ///< declared value: "yes", "no", an order, a number; empty: none
  std::optional<double> measured;  ///< measured value; absent: at round-off, or not measured
  std::string unit;                ///< unit of the measured value: "1", "rad", …
  std::optional<double> limit;     ///< largest measured value at which the trait holds
  TraitVerdict verdict = TraitVerdict::not_applicable;
  std::string on;    ///< scenario with the worst value
  std::string note;  ///< reason of the verdict, or a further observation
};

struct TraitColumn {
  std::string trait;    ///< name in certificate.csv
  std::string heading;  ///< heading of its column: "angular momentum"
  std::string meaning;  ///< meaning in one sentence
};
/// All traits in the order of a certificate.
const std::vector<TraitColumn>& trait_columns();

Finding not_applicable(std::string trait, std::string why);

/// The finding on a trait that holds if a defect does not exceed a limit.
Finding kept(std::string trait, bool declared, double defect, double limit, std::string on);

/// The worst of several motions' findings on one trait: that of the worst verdict, and among equals that of the largest
/// value. Findings without a measurement are ignored unless there is no other.
Finding worst(const std::vector<Finding>& findings);

}  // namespace polhode::study::certificate
