// SPDX-License-Identifier: BSD-3-Clause
// The motions on which traits of a method are measured, and the methods of which they are.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/system/system.hpp"
#include "experiments/study/scenario/scenario.hpp"
#include "integrators/catalogue.hpp"

namespace polhode::study::certificate {

/// What is measured: a method in a formulation.
struct Subject {
  const IntegratorEntry& entry;
  Formulation formulation;
  const Declaration& declaration() const { return entry.declaration; }
};

/// A scenario as a stage for measurements.
struct Stage {
  std::string name;
  Problem problem;
  bool free = false;          ///< no force acts
  bool conservative = false;  ///< every force has a potential
  bool shaken = false;        ///< a force and a torque that depend on time act on every body besides

  template <class S>
  std::unique_ptr<System<S>> system(const Formulation& formulation) const;

  /// Why the method makes no sense here; empty if it does.
  std::string refusal(const Subject& subject) const;
};

/// One for each scenario, and the first one with forces, or the first one of all, shaken besides.
std::vector<Stage> stages_of(const std::vector<Scenario>& scenarios);

/// Adds a force and a torque that depend on time, fixed in the world, on every moving body.
template <class S>
void shake(System<S>& system);

}  // namespace polhode::study
