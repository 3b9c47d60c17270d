// SPDX-License-Identifier: BSD-3-Clause
// The catalogue of integrators: everything that lists methods, the help text, the studies and the conformance tests,
// reads it.
#pragma once

#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "core/run/integrator.hpp"

namespace polhode {

template <class S>
using IntegratorPointer = std::unique_ptr<Integrator<S>>;
template <class S>
using IntegratorMaker = std::function<IntegratorPointer<S>(const System<S>&, const IntegratorSettings&)>;

/// A method with its builders, one for each scalar that it works in; an empty one means that it does not.
/// The system must outlive the integrator.
struct IntegratorEntry {
  Declaration declaration;
  IntegratorMaker<double> make;
  IntegratorMaker<float> make_float{};
  IntegratorMaker<long double> make_long_double{};
  IntegratorMaker<Lanes> make_lanes{};  ///< in the lanes of an ensemble
  /// Why it makes no sense with this problem in this formulation; empty, or an empty answer: it does.
  std::function<std::string(const Problem&, const Formulation&)> refusal{};

  template <class S>
  const IntegratorMaker<S>& maker() const {
    if constexpr (std::is_same_v<S, float>) return make_float;
    else if constexpr (std::is_same_v<S, long double>) return make_long_double;
    else if constexpr (is_lanes<S>) return make_lanes;
    else return make;
  }
};

const std::vector<IntegratorEntry>& integrator_catalogue();

/// The entry of that name, or null.
const IntegratorEntry* find_integrator(std::string_view name);

}  // namespace polhode
