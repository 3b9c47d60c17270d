// SPDX-License-Identifier: BSD-3-Clause
// Motions on which traits are measured (test cases), and methods whose traits are measured (subjects).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/system/system.hpp"
#include "experiments/study/scenario/scenario.hpp"
#include "integrators/catalogue.hpp"

namespace polhode::study::certificate {

/// A method in a formulation, whose traits are measured.
struct Subject {
  const IntegratorEntry& entry;
  Formulation formulation;
  const Declaration& declaration() const { return entry.declaration; }
};

/// A scenario on which traits are measured.
struct TestCase {
  std::string name;
  Problem problem;
  bool free = false;          ///< no force acts
  bool conservative = false;  ///< every force has a potential
  bool shaken = false;        ///< a time-dependent force and torque also act on every body

  template <class S>
  std::unique_ptr<System<S>> system(const Formulation& formulation) const;

  /// Reason for which the method cannot be used here; empty if it can.
  std::string refusal(const Subject& subject) const;
};

/// Test cases of the scenarios: one for each scenario, and a shaken copy of the first one with forces (if there is
/// none, of the first one).
std::vector<TestCase> test_cases_of(const std::vector<Scenario>& scenarios);

/// Adds a time-dependent force and torque, in directions fixed in the world frame, on every moving body.
template <class S>
void shake(System<S>& system);

}  // namespace polhode::study::certificate
