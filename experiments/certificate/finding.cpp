// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/certificate/finding.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace polhode::study::certificate {
namespace {

int gravity_of(TraitVerdict verdict) {
  switch (verdict) {
    case TraitVerdict::does_not_hold: return 5;
    case TraitVerdict::absent: return 4;
    case TraitVerdict::undeclared: return 3;
    case TraitVerdict::holds: return 2;
    case TraitVerdict::undecided: return 1;
    default: return 0;
  }
}

bool worse(const Finding& a, const Finding& b) {
  if (a.verdict != b.verdict) return gravity_of(a.verdict) > gravity_of(b.verdict);
  return a.measured.value_or(-1) > b.measured.value_or(-1);
}

}  // namespace

std::string word_of(TraitVerdict verdict) {
  switch (verdict) {
    case TraitVerdict::holds: return "holds";
    case TraitVerdict::does_not_hold: return "does not hold";
    case TraitVerdict::undeclared: return "holds, not declared";
    case TraitVerdict::absent: return "not declared";
    case TraitVerdict::undecided: return "undecided";
    default: return "not applicable";
  }
}

const std::vector<TraitColumn>& trait_columns() {
  static const std::vector<TraitColumn> columns = {
      {"order_free", "order, free", "order of the error of bodies without forces"},
      {"order_forced", "order, forced", "order of the error under forces"},
      {"order_time_dependent", "order, f(t)", "order of the error under a force that depends on time"},
      {"time_reversibility", "reversible", "how far a step of h and one of −h lead from where they began"},
      {"time_reversibility_many", "reversible, many", "the same of many steps there and as many back"},
      {"symplecticity", "symplectic", "how far a step changes the canonical two-form"},
      {"energy_free", "energy, free", "largest relative drift of the energy of a free body"},
      {"energy_forced", "energy, forced", "the same under forces with a potential"},
      {"angular_momentum", "angular momentum", "largest relative drift of the momentum of a free body, in the world"},
      {"casimir", "Casimir", "largest relative drift of |IΩ| of a free body"},
      {"orientation", "orientation", "largest distance of an orientation from its manifold, without normalization"},
      {"evaluations_per_step", "rhs per step", "right-hand sides per step, as the force that is asked counts them"},
  };
  return columns;
}

Finding not_applicable(std::string trait, std::string why) {
  Finding finding;
  finding.trait = std::move(trait);
  finding.note = std::move(why);
  return finding;
}

Finding kept(std::string trait, bool declared, double defect, double limit, std::string on) {
  Finding finding{.trait = std::move(trait),
                  .declared = declared ? "yes" : "no",
                  .measured = defect,
                  .unit = "1",
                  .limit = limit,
                  .verdict = {},
                  .on = std::move(on),
                  .note = {}};
  const bool holds = defect <= limit;  // false for NaN
  finding.verdict = declared ? (holds ? TraitVerdict::holds : TraitVerdict::does_not_hold)
                             : (holds ? TraitVerdict::undeclared : TraitVerdict::absent);
  return finding;
}

Finding worst(const std::vector<Finding>& findings) {
  if (findings.empty()) throw std::invalid_argument("worst of no findings");
  return *std::max_element(findings.begin(), findings.end(),
                           [](const Finding& a, const Finding& b) { return worse(b, a); });
}

}  // namespace polhode::study::certificate
