// SPDX-License-Identifier: BSD-3-Clause
// The catalogue of integrators. Help text, studies and conformance tests read their lists of methods from it.
#pragma once

#include <functional>
#include <memory>
#include <string_view>
#include <tuple>
#include <vector>

#include "core/run/integrator.hpp"
#include "integrators/shifted_system.hpp"

namespace polhode::inline integrators {

template <class S>
using IntegratorPointer = std::unique_ptr<Integrator<S>>;
/// Builds a method for a system.
template <class S>
using IntegratorMaker = std::function<IntegratorPointer<S>(const System<S>&, const IntegratorSettings&)>;
/// Builds a fixed-step method for the ODE of the change of the state (ShiftedSystem).
template <class S>
using IncrementMaker = std::function<IntegratorPointer<S>(const ShiftedSystem<S>&, const IntegratorSettings&)>;

/// A method with one builder for each supported scalar. An empty builder means that the scalar is not supported. The
/// system must outlive the integrator.
struct IntegratorEntry {
  Declaration declaration;
  IntegratorMaker<double> make;
  IntegratorMaker<float> make_float{};
  IntegratorMaker<long double> make_long_double{};
  IntegratorMaker<Lanes> make_lanes{};  ///< builder for the lanes of an ensemble
  /// Returns why the method does not apply to this problem in this formulation; an empty string if it does. An empty
  /// function means that it always applies.
  std::function<std::string(const Problem&, const Formulation&)> refusal{};

  /// Builders of an additive method for the change of the state (integrators/compensated.hpp); empty for other methods.
  std::tuple<IncrementMaker<float>, IncrementMaker<double>, IncrementMaker<long double>> increments{};

  template <class S>
  const IncrementMaker<S>& increment() const {
    return std::get<IncrementMaker<S>>(increments);
  }

  template <class S>
  const IntegratorMaker<S>& maker() const {
    if constexpr (std::is_same_v<S, float>) return make_float;
    else if constexpr (std::is_same_v<S, long double>) return make_long_double;
    else if constexpr (is_lanes<S>) return make_lanes;
    else return make;
  }
};

/// All methods.
const std::vector<IntegratorEntry>& integrator_catalogue();

/// The entry with this name, or null.
const IntegratorEntry* find_integrator(std::string_view name);

}  // namespace polhode::integrators
