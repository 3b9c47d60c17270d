// SPDX-License-Identifier: BSD-3-Clause
// A kind of joint as a scenario names it: its parameters with units and defaults, and how to build it on any scalar.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/problem/force_kind.hpp"
#include "core/problem/joint.hpp"

namespace polhode::inline core::inline problem {

/// The values of one joint, every key of its kind present. Its bodies are one or two indices: moving ones first, in the
/// scenario's order, then static ones. A single body is joined to the world.
struct JointParameters {
  std::string name;
  ForceParameters of;  ///< kind, bodies and values
};

struct JointKind {
  std::string name;
  std::string summary;  ///< one line: what the joint keeps, with its equations
  int rows = 0;         ///< number of equations
  std::vector<Parameter> parameters;
};

template <class S>
using JointPointer = std::unique_ptr<JointModel<S>>;

/// A kind with its builders, one for each scalar. They read the starts of the bodies: the axes of the second body and
/// a length that is not given follow from the start.
struct JointEntry {
  template <class S>
  using Maker = JointPointer<S> (*)(const JointParameters&, std::span<const BodyStart>);
  JointKind kind;
  Maker<float> make_float;
  Maker<double> make_double;
  Maker<long double> make_long_double;
};

/// The one line that registers a joint: joint_entry<Ball>(). J<S> has a static kind() and a constructor
/// J(const JointParameters&, std::span<const BodyStart>).
template <template <class> class J>
JointEntry joint_entry() {
  return {J<double>::kind(),
          [](const JointParameters& p, std::span<const BodyStart> s) -> JointPointer<float> {
            return std::make_unique<J<float>>(p, s);
          },
          [](const JointParameters& p, std::span<const BodyStart> s) -> JointPointer<double> {
            return std::make_unique<J<double>>(p, s);
          },
          [](const JointParameters& p, std::span<const BodyStart> s) -> JointPointer<long double> {
            return std::make_unique<J<long double>>(p, s);
          }};
}

}  // namespace polhode::core::problem
