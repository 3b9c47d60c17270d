// SPDX-License-Identifier: BSD-3-Clause
// Sources: Goldstein, Poole & Safko, Classical Mechanics, 3rd ed., section 5.7 (p_φ, p_ψ); S. Kowalevski, Acta Math.
// 12 (1889) 177–232; Marsden & Ratiu, Introduction to Mechanics and Symmetry, section 1.4 (Casimirs).
#include "core/system/invariants.hpp"

#include <algorithm>
#include <cmath>

#include "core/forces/catalogue.hpp"
#include "core/problem/catalogue.hpp"

namespace polhode::inline core::inline system {

namespace {

using Vector = Vector3<double>;
using Snapshot = BodySnapshot<double>;

// Properties of the problem.

bool acts_on_first_body(const ForceParameters& f) {
  return std::find(f.bodies.begin(), f.bodies.end(), std::size_t{0}) != f.bodies.end();
}

bool is_gravity(const ForceParameters& f) { return f.kind == "uniform_gravity"; }

/// Sum of all uniform gravities on the first body, world axes, m/s².
Vector gravity(const Problem& problem) {
  Vector g = Vector::Zero();
  for (const ForceParameters& f : problem.forces) {
    if (is_gravity(f) && acts_on_first_body(f)) g += f.vector("acceleration");
  }
  return g;
}

/// Unit vertical vector, world axes: opposite to gravity, +z without gravity.
Vector up(const Problem& problem) {
  const Vector g = gravity(problem);
  return g.isZero(0) ? Vector(Vector::UnitZ()) : Vector(-g.normalized());
}

/// True if a force can exert a torque on the first body about its reference point. `gravity_too` includes gravity.
bool has_torque(const Problem& problem, bool gravity_too) {
  for (const ForceParameters& f : problem.forces) {
    if (is_gravity(f) && !gravity_too) continue;
    if (make_force<double>(f, problem.bodies)->effect_on(0).torque) return true;
  }
  return false;
}

bool equal(double a, double b) { return std::abs(a - b) <= 1e-12 * std::max(std::abs(a), std::abs(b)); }

bool has_principal_axes(const Body& body) { return body.inertia.isDiagonal(0); }

// Refusals: empty if the invariant applies to the problem; otherwise the reason why not.

std::string refuse_unless_alone(const Problem& problem) {
  if (!problem.joints.empty()) return "it is of a body without joints";
  return problem.moving() == 1 ? "" : "it is of the only body that moves";
}

std::string refuse_unless_top(const Problem& problem) {
  if (std::string reason = refuse_unless_alone(problem); !reason.empty()) return reason;
  if (!problem.bodies.front().pinned) return "it is of a body with pinned = true";
  if (has_torque(problem, false)) return "a force besides uniform gravity exerts a torque";
  return "";
}

std::string refuse_p_psi(const Problem& problem) {
  if (std::string reason = refuse_unless_alone(problem); !reason.empty()) return reason;
  const Body& body = problem.bodies.front();
  if (!has_principal_axes(body) || !equal(body.inertia(0, 0), body.inertia(1, 1))) {
    return "it is of a symmetric top, whose inertia is [I1, I1, I3]";
  }
  if (body.center_of_mass.x() != 0 || body.center_of_mass.y() != 0) return "the mass centre is not on body axis 3";
  return has_torque(problem, false) ? "a force besides uniform gravity exerts a torque" : "";
}

std::string refuse_kovalevskaya(const Problem& problem) {
  if (std::string reason = refuse_unless_top(problem); !reason.empty()) return reason;
  const Body& body = problem.bodies.front();
  const double i3 = body.inertia(2, 2);
  if (!has_principal_axes(body) || !equal(body.inertia(0, 0), 2 * i3) || !equal(body.inertia(1, 1), 2 * i3)) {
    return "it is of a top whose inertia is [2, 2, 1] I3";
  }
  if (body.center_of_mass.y() != 0 || body.center_of_mass.z() != 0) return "the mass centre is not on body axis 1";
  return "";
}

std::string refuse_casimir(const Problem& problem) {
  if (std::string reason = refuse_unless_alone(problem); !reason.empty()) return reason;
  return has_torque(problem, true) ? "a force exerts a torque" : "";
}

/// k = m g l/I3, 1/s². l is the signed coordinate of the mass centre along body axis 1, m.
double kovalevskaya_k(const Problem& problem) {
  const Body& body = problem.bodies.front();
  return body.mass * gravity(problem).norm() * body.center_of_mass.x() / body.inertia(2, 2);
}

// Values of the invariants, each a function of the first body's motion and of its angular momentum about the reference
// point, world axes. S: double for one problem, or Lanes for lane_count problems.

using Problems = std::span<const Problem>;

/// The vector of each problem, one in each lane.
template <class S, class OfProblem>
Vector3<S> gathered(Problems problems, const OfProblem& of) {
  Vector3<S> all;
  for (Eigen::Index k = 0; k < 3; ++k) {
    all[k] = gather<S>([&](int lane) { return Vector(of(problems[std::size_t(lane)]))[k]; });
  }
  return all;
}

/// World to body axes.
template <class Body, class S>
Vector3<S> in_body(const Body& body, const Vector3<S>& v) {
  return body.rotation.transpose() * v;
}

template <class S>
struct PPhi {
  Vector3<S> vertical;
  explicit PPhi(Problems problems) : vertical(gathered<S>(problems, up)) {}
  S operator()(const auto&, const Vector3<S>& momentum) const { return vertical.dot(momentum); }
};

template <class S>
struct PPsi {
  Vector3<S> inertia3;
  explicit PPsi(Problems problems)
      : inertia3(gathered<S>(problems, [](const Problem& p) { return p.bodies.front().inertia.row(2); })) {}
  S operator()(const auto& body, const Vector3<S>&) const { return inertia3.dot(in_body(body, body.angular_velocity)); }
};

template <class S>
struct Kovalevskaya {
  Vector3<S> vertical;
  S k;
  explicit Kovalevskaya(Problems problems)
      : vertical(gathered<S>(problems, up)),
        k(gather<S>([&](int lane) { return kovalevskaya_k(problems[std::size_t(lane)]); })) {}
  S operator()(const auto& body, const Vector3<S>&) const {
    const Vector3<S> w = in_body(body, body.angular_velocity), gamma = in_body(body, vertical);
    const S real = w[0] * w[0] - w[1] * w[1] - k * gamma[0];
    const S imaginary = S(2) * w[0] * w[1] - k * gamma[1];
    return real * real + imaginary * imaginary;
  }
};

template <class S>
struct Casimir {
  explicit Casimir(Problems) {}
  S operator()(const auto&, const Vector3<S>& momentum) const { return momentum.norm(); }
};

template <template <class> class Invariant>
double value(const Problem& problem, const Snapshot& s) {
  return Invariant<double>({&problem, 1})(s, s.angular_momentum);
}

template <template <class> class Invariant>
LaneInvariant lanes_of(Problems problems) {
  return Invariant<Lanes>(problems);
}

// Scales of the invariants: magnitude of the terms, which stays positive when the terms cancel.

double momentum_scale(const Problem&, const Snapshot& s) { return s.angular_momentum.norm(); }

double kovalevskaya_scale(const Problem& problem, const Snapshot& s) {
  const double size = in_body(s, s.angular_velocity).squaredNorm() + std::abs(kovalevskaya_k(problem));
  return size * size;
}

}  // namespace

const std::vector<InvariantKind>& invariant_catalogue() {
  static const std::vector<InvariantKind> invariants = {
      {"p_phi", "kg m^2/s",
       "vertical component of a top's angular momentum about its pivot, against gravity or along z", refuse_unless_top,
       value<PPhi>, lanes_of<PPhi>, momentum_scale},
      {"p_psi", "kg m^2/s", "I3 W3, a symmetric top's angular momentum along body axis 3", refuse_p_psi, value<PPsi>,
       lanes_of<PPsi>, momentum_scale},
      {"kovalevskaya", "1/s^4",
       "(W1^2 - W2^2 - k g1)^2 + (2 W1 W2 - k g2)^2, g the vertical in body axes, k = m g l/I3, inertia [2, 2, 1] I3",
       refuse_kovalevskaya, value<Kovalevskaya>, lanes_of<Kovalevskaya>, kovalevskaya_scale},
      {"casimir", "kg m^2/s", "|L| about the mass centre, or the pivot, of a body without torque", refuse_casimir,
       value<Casimir>, lanes_of<Casimir>, momentum_scale},
  };
  return invariants;
}

const InvariantKind* find_invariant(std::string_view name) { return find_entry(invariant_catalogue(), name); }

}  // namespace polhode::core::system
