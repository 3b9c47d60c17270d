// SPDX-License-Identifier: BSD-3-Clause
// The operations of a system on plain vectors of doubles, whatever type has them: one body, many bodies, or one lane of
// an ensemble. A law that is written against Operations is compiled once and holds for all three.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/exact/free_top.hpp"
#include "core/system/concepts.hpp"
#include "core/system/visit_system.hpp"
#include "tests/laws/probe_forces.hpp"
#include "tests/laws/problems.hpp"
#include "tests/laws/random_motion.hpp"

namespace polhode::laws {

/// Each operation returns what the system writes. y is a flat state; xi, theta, eta and wrenches are tangent vectors.
class Operations {
 public:
  using Flat = VectorX<double>;
  using Tangent = VectorX<double>;

  Operations() = default;
  Operations(const Operations&) = delete;
  Operations& operator=(const Operations&) = delete;
  virtual ~Operations() = default;

  virtual Flat rate(double t, const Flat& y) const = 0;
  virtual Flat project(const Flat& y) const = 0;

  virtual Tangent twist(const Flat& y) const = 0;
  virtual Flat retract(const Flat& y, const Tangent& xi) const = 0;
  virtual Tangent dexp_inverse(const Tangent& theta, const Tangent& eta) const = 0;

  virtual Tangent wrench(double t, const Flat& y) const = 0;
  virtual Tangent momentum(const Flat& y) const = 0;
  virtual Flat set_momentum(const Tangent& p, const Flat& y) const = 0;

  virtual Tangent body_twist(const Flat& y) const = 0;
  virtual Flat set_body_twist(const Tangent& xi, const Flat& y) const = 0;
  virtual Tangent body_acceleration(const Flat& y, const Tangent& wrench) const = 0;
  virtual Flat retract_in_body(const Flat& y, const Tangent& xi) const = 0;
  virtual Tangent bracket(const Tangent& a, const Tangent& b) const = 0;
  virtual Flat carry_momentum(const Tangent& theta, const Tangent& impulse, const Flat& y) const = 0;

  virtual Flat kick(double t, double h, const Flat& y) const = 0;
  virtual Flat kick(double t, double h, const Flat& seen, const Flat& y) const = 0;
  /// The free flow with the exact rotor. A system in lanes has none.
  virtual bool has_free_flow() const = 0;
  virtual Flat free_flow(double h, const Flat& y) const = 0;
};

/// The operations of one concrete system; of a system in lanes those of one lane. The other lanes get other numbers.
template <class System>
class OperationsOf final : public Operations {
 public:
  using S = typename System::Scalar;
  static_assert(LieGroup<System> && BodyFrame<System> && Measurable<System>);
  static_assert(MechanicalSystem<System> == !is_lanes<S>, "an ensemble in lanes has no free flow, and all else");

  explicit OperationsOf(std::unique_ptr<polhode::System<S>> owner, const System& system, int lane)
      : owner_(std::move(owner)), system_(system), lane_(lane) {}

  Flat rate(double t, const Flat& y) const override {
    typename System::Flat dy = system_.zero();
    system_.rate(S(t), flat(y), dy);
    return narrow(dy);
  }
  Flat project(const Flat& y) const override {
    return changed(y, [&](auto& to) { system_.project_flat(to.data()); });
  }

  Tangent twist(const Flat& y) const override {
    return filled([&](auto& xi) { system_.twist(flat(y), xi); });
  }
  Flat retract(const Flat& y, const Tangent& xi) const override {
    return changed(y, [&](auto& to) { system_.retract(to, tangent(xi)); });
  }
  Tangent dexp_inverse(const Tangent& theta, const Tangent& eta) const override {
    return filled([&](auto& out) { system_.dexp_inverse(tangent(theta), tangent(eta), out); });
  }

  Tangent wrench(double t, const Flat& y) const override {
    return filled([&](auto& w) { system_.wrench(S(t), flat(y), w); });
  }
  Tangent momentum(const Flat& y) const override {
    return filled([&](auto& p) { system_.momentum(flat(y), p); });
  }
  Flat set_momentum(const Tangent& p, const Flat& y) const override {
    return changed(y, [&](auto& to) { system_.set_momentum(tangent(p), to); });
  }

  Tangent body_twist(const Flat& y) const override {
    return filled([&](auto& xi) { system_.body_twist(flat(y), xi); });
  }
  Flat set_body_twist(const Tangent& xi, const Flat& y) const override {
    return changed(y, [&](auto& to) { system_.set_body_twist(tangent(xi), to); });
  }
  Tangent body_acceleration(const Flat& y, const Tangent& wrench) const override {
    return filled([&](auto& rate) { system_.body_acceleration(flat(y), tangent(wrench), rate); });
  }
  Flat retract_in_body(const Flat& y, const Tangent& xi) const override {
    return changed(y, [&](auto& to) { system_.retract_in_body(to, tangent(xi)); });
  }
  Tangent bracket(const Tangent& a, const Tangent& b) const override {
    return filled([&](auto& out) { system_.bracket(tangent(a), tangent(b), out); });
  }
  Flat carry_momentum(const Tangent& theta, const Tangent& impulse, const Flat& y) const override {
    return changed(y, [&](auto& to) { system_.carry_momentum(tangent(theta), tangent(impulse), to); });
  }

  Flat kick(double t, double h, const Flat& y) const override {
    return changed(y, [&](auto& to) { system_.kick(S(t), S(h), to); });
  }
  Flat kick(double t, double h, const Flat& seen, const Flat& y) const override {
    return changed(y, [&](auto& to) { system_.kick(S(t), S(h), flat(seen), to); });
  }
  bool has_free_flow() const override { return Splitting<System>; }
  Flat free_flow(double h, const Flat& y) const override {
    if constexpr (!Splitting<System>) {
      return y;
    } else {
      const auto exact = [](const BodyConstants<S>& body, S duration, Vector3<S>& m) {
        const FreeTop top(body.moments.asDiagonal(), identity_quaternion<double>(), m.cwiseQuotient(body.moments));
        const FreeTop::Motion end = top.at(duration);
        m = end.angular_velocity_body.cwiseProduct(body.moments);
        return end.orientation;
      };
      return changed(y, [&](auto& to) { system_.free_flow(h, to, exact); });
    }
  }

 private:
  template <class To>
  To widened(const Flat& v) const {
    To all(v.size());
    for (Eigen::Index i = 0; i < v.size(); ++i) {
      all[i] = gather<S>([&](int lane) { return v[i] * (1 + (is_lanes<S> ? 0.25 * (lane - lane_) : 0.0)); });
    }
    return all;
  }
  auto flat(const Flat& y) const { return widened<typename System::Flat>(y); }
  auto tangent(const Tangent& xi) const { return widened<typename System::Tangent>(xi); }

  template <class From>
  Flat narrow(const From& all) const {
    Flat v(all.size());
    for (Eigen::Index i = 0; i < v.size(); ++i) {
      if constexpr (is_lanes<S>) v[i] = all[i][lane_];
      else v[i] = double(all[i]);
    }
    return v;
  }

  template <class Change>
  Flat changed(const Flat& y, const Change& change) const {
    auto to = flat(y);
    change(to);
    return narrow(to);
  }
  /// The numbers that fill writes; a number that it leaves out stays 7.
  template <class Fill>
  Tangent filled(const Fill& fill) const {
    typename System::Tangent out = system_.zero_tangent();
    out.setConstant(S(7));
    fill(out);
    return narrow(out);
  }

  std::unique_ptr<polhode::System<S>> owner_;
  const System& system_;
  int lane_;
};

template <class S>
std::unique_ptr<Operations> operations_of(std::unique_ptr<System<S>> erased, int lane = 0) {
  const System<S>& system = *erased;
  return visit_system(system, [&]<class Concrete>(const Concrete& concrete) -> std::unique_ptr<Operations> {
    return std::make_unique<OperationsOf<Concrete>>(std::move(erased), concrete, lane);
  });
}

/// A system on which the laws are tried.
struct Subject {
  std::string name;
  Problem problem;                         ///< problem; for an ensemble that of the lane
  std::unique_ptr<System<double>> plain;   ///< the same problem, for the equations as a textbook writes them
  std::unique_ptr<Operations> operations;  ///< operations under test
  VectorX<double> y;                       ///< an arbitrary state on the manifold
};

/// One body, many bodies and one lane of an ensemble, in this formulation, each in a random motion. All but one in
/// three are under a force that depends on time too.
inline std::vector<Subject> subjects(const Formulation& formulation, std::uint32_t seed) {
  std::vector<Subject> all;
  const auto shaken = [seed]<class S>(std::unique_ptr<System<S>> system) {
    if (seed % 3 != 0) system->add_force(std::make_unique<Shaking<S>>(system->moving()));
    return system;
  };
  const auto add = [&](std::string name, const Problem& problem, std::unique_ptr<Operations> operations) {
    Subject s{std::move(name), problem, shaken(make_system<double>(problem, formulation)), std::move(operations), {}};
    s.y = s.plain->start().y;
    s.plain->project(s.y);
    s.y[s.plain->layout().work()] = 0.5;
    all.push_back(std::move(s));
  };
  for (const NamedProblem& named : all_problems()) {
    const Problem problem = moved(named.problem, seed);
    const bool one = fits_one_body_form(problem);
    add(named.name, problem, operations_of(shaken(make_system<double>(problem, formulation))));
    if (!one) continue;
    std::vector<Problem> lanes;
    for (int k = 0; k < lane_count; ++k) {
      lanes.push_back(moved(named.problem, seed + std::uint32_t(10 * k)));
      lanes.back().bodies[0].inertia *= 1 + 0.5 * k;
      lanes.back().bodies[0].mass *= 1 + 0.25 * k;
    }
    const int lane = int(seed) % lane_count;
    add(named.name + " in lanes", lanes[std::size_t(lane)],
        operations_of(shaken(make_ensemble(lanes, formulation)), lane));
  }
  return all;
}

}  // namespace polhode::laws
