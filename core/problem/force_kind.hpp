// SPDX-License-Identifier: BSD-3-Clause
// A kind of force as a scenario names it: its parameters with units and defaults, and how to build it on any scalar.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "core/math/lanes.hpp"
#include "core/problem/body.hpp"
#include "core/problem/force.hpp"

namespace polhode::inline core::inline problem {

using ParameterValue = std::variant<double, Vector3<double>, std::string>;

/// One key of a force. The type of the default value is the type of the key.
struct Parameter {
  enum class Need { required, optional };
  enum class Range { any, non_negative, positive };
  std::string key;
  ParameterValue value;  ///< the default; for a required key only its type is used
  std::string unit;      ///< unit as it is printed: "N/m"
  std::string meaning;
  Need need = Need::optional;
  Range range = Range::any;            ///< allowed range of a number
  std::vector<std::string> choices{};  ///< allowed values of a text
  int needs_bodies = 0;                ///< number of bodies that the key requires; 0: any number
};

/// The values of one force, every key of its kind present, and the indices of its bodies (moving ones first, in the
/// scenario's order, then static ones).
struct ForceParameters {
  std::string kind;
  std::vector<std::size_t> bodies;
  std::map<std::string, ParameterValue> values;

  double number(const std::string& key) const { return std::get<double>(values.at(key)); }
  const Vector3<double>& vector(const std::string& key) const { return std::get<Vector3<double>>(values.at(key)); }
  const std::string& text(const std::string& key) const { return std::get<std::string>(values.at(key)); }
};

struct ForceKind {
  std::string name;
  std::string summary;  ///< one line of physics, with its formula
  int min_bodies = 1;
  int max_bodies = 1;  ///< 0: any number
  std::vector<Parameter> parameters;
};

template <class S>
using ForcePointer = std::shared_ptr<const ForceModel<S>>;

/// A kind with its builders, one for each scalar.
struct ForceEntry {
  ForceKind kind;
  ForcePointer<float> (*make_float)(const ForceParameters&, std::span<const Body>);
  ForcePointer<double> (*make_double)(const ForceParameters&, std::span<const Body>);
  ForcePointer<long double> (*make_long_double)(const ForceParameters&, std::span<const Body>);
  ForcePointer<Lanes> (*make_lanes)(const ForceParameters&, std::span<const Body>) = nullptr;  ///< null: lane by lane
};

/// The argument of force_entry for a class that does not branch on its numbers, and so can be instantiated on Lanes.
inline constexpr bool in_lanes = true;

/// The one line that registers a force: force_entry<Spring>(). F<S> has a static kind() and a constructor
/// F(const ForceParameters&, std::span<const Body>). force_entry<Spring, in_lanes>() makes it faster in ensembles.
template <template <class> class F, bool with_lanes = false>
ForceEntry force_entry() {
  ForceEntry entry = {F<double>::kind(),
                      [](const ForceParameters& p, std::span<const Body> b) -> ForcePointer<float> {
                        return std::make_unique<F<float>>(p, b);
                      },
                      [](const ForceParameters& p, std::span<const Body> b) -> ForcePointer<double> {
                        return std::make_unique<F<double>>(p, b);
                      },
                      [](const ForceParameters& p, std::span<const Body> b) -> ForcePointer<long double> {
                        return std::make_unique<F<long double>>(p, b);
                      }};
  if constexpr (with_lanes) {
    entry.make_lanes = [](const ForceParameters& p, std::span<const Body> b) -> ForcePointer<Lanes> {
      return std::make_unique<F<Lanes>>(p, b);
    };
  }
  return entry;
}

}  // namespace polhode::core::problem
