// SPDX-License-Identifier: BSD-3-Clause
// The suite of the laws of an integrator: every entry of the catalogue, in every formulation, on a free problem, a
// forced one and one that depends on time.
#pragma once

#include "tests/laws/integrator_trials.hpp"

namespace polhode::laws {

class IntegratorLaw : public OverTheCatalogue {
 protected:
  /// Defined in the files that use them: integrator_batch_law_test.cpp, integrator_accuracy_law_test.cpp.
  template <class S>
  void expect_advance_is_single_steps() const;
  template <class S>
  void expect_precision(double round_off) const;
};

}  // namespace polhode::laws
