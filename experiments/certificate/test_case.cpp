// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/certificate/test_case.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace polhode::study::certificate {
namespace {

/// f = m (sin 4t, cos 3t, 2t) N and τ = tr(I)/3 (2 cos 5t, 1 − 3t, sin 3t − 1) N m on every moving body, m in kg, I in
/// kg m² and t in s; does work.
template <class S>
class Shaking final : public ForceModel<S> {
 public:
  explicit Shaking(const Problem& problem) {
    for (std::size_t i = 0; i < problem.moving(); ++i) {
      scales_.push_back({S(problem.bodies[i].mass), S(problem.bodies[i].inertia.trace() / 3)});
    }
  }

  void add_wrench(S t, std::span<const BodyMotion<S>>, std::span<Wrench<S>> wrenches) const override {
    for (std::size_t i = 0; i < scales_.size(); ++i) {
      wrenches[i].force += scales_[i].mass * force(t);
      wrenches[i].torque += scales_[i].inertia * torque(t);
    }
  }
  bool does_work() const override { return true; }
  S power(S t, std::span<const BodyMotion<S>> bodies) const override {
    S p(0);
    for (std::size_t i = 0; i < scales_.size(); ++i) {
      p += scales_[i].mass * force(t).dot(bodies[i].velocity) +
           scales_[i].inertia * torque(t).dot(bodies[i].angular_velocity);
    }
    return p;
  }
  Effect effect_on(std::size_t) const override { return {true, std::nullopt}; }

 private:
  struct Scale {
    S mass, inertia;
  };
  static Vector3<S> force(S t) {
    using std::cos, std::sin;
    return Vector3<S>(sin(S(4) * t), cos(S(3) * t), S(2) * t);
  }
  static Vector3<S> torque(S t) {
    using std::cos, std::sin;
    return Vector3<S>(S(2) * cos(S(5) * t), S(1) - S(3) * t, sin(S(3) * t) - S(1));
  }
  std::vector<Scale> scales_;
};

}  // namespace

template <class S>
void shake(System<S>& system) {
  system.add_force(std::make_unique<Shaking<S>>(system.problem()));
}

template <class S>
std::unique_ptr<System<S>> TestCase::system(const Formulation& formulation) const {
  auto made = make_system<S>(problem, formulation);
  if (shaken) shake(*made);
  return made;
}

std::string TestCase::refusal(const Subject& subject) const {
  return subject.entry.refusal ? subject.entry.refusal(problem, subject.formulation) : std::string();
}

std::vector<TestCase> test_cases_of(const std::vector<Scenario>& scenarios) {
  std::vector<TestCase> test_cases;
  for (const Scenario& scenario : scenarios) {
    TestCase test_case{.name = scenario.name, .problem = scenario.problem};
    test_case.free = scenario.problem.forces.empty() && scenario.problem.joints.empty();
    test_case.conservative = !test_case.free && !make_system<double>(scenario.problem, {})->forces_do_work();
    test_cases.push_back(std::move(test_case));
  }
  if (test_cases.empty()) return test_cases;
  const auto forced = std::find_if(test_cases.begin(), test_cases.end(), [](const TestCase& t) { return !t.free; });
  TestCase shaken = forced == test_cases.end() ? test_cases.front() : *forced;
  shaken.name += ", shaken";
  shaken.free = shaken.conservative = false;
  shaken.shaken = true;
  test_cases.push_back(std::move(shaken));
  return test_cases;
}

template void shake(System<double>&);
template void shake(System<long double>&);
template std::unique_ptr<System<double>> TestCase::system(const Formulation&) const;
template std::unique_ptr<System<long double>> TestCase::system(const Formulation&) const;

}  // namespace polhode::study::certificate
