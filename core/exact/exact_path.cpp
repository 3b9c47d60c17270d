// SPDX-License-Identifier: BSD-3-Clause
#include "core/exact/exact_path.hpp"

#include <limits>
#include <optional>
#include <vector>

#include "core/exact/kepler_motion.hpp"
#include "core/exact/linear_motion.hpp"

namespace polhode::inline core::inline exact {
namespace {

using Vector = Vector3<double>;

/// The forces on a mass centre: the sum of the constant forces (N) and the list of the varying forces.
struct Forces {
  Vector constant = Vector::Zero();
  std::vector<const ForceParameters*> varying;
  bool all_known = true;  ///< false: some varying force was added with add_force()

  Forces(const System<double>& system, std::size_t body) {
    for (std::size_t k = 0; k < system.forces().size(); ++k) {
      const auto f = system.forces()[k]->effect_on(body).constant_force;
      if (f) constant += *f;
      else if (k < system.problem().forces.size()) varying.push_back(&system.problem().forces[k]);
      else all_known = false;
    }
  }
};

/// Fixed end point (world axes, m) of a two-ended force whose other end is the mass centre of the body. Absent if the
/// force has no such ends.
std::optional<Vector> fixed_end(const Problem& problem, const ForceParameters& f, std::size_t body) {
  if (f.bodies[0] != body || !f.vector("anchor_body").isZero(0)) return std::nullopt;
  if (f.bodies.size() == 1) return f.vector("anchor_world");
  const std::size_t other = f.bodies[1];
  if (!problem.bodies[other].fixed) return std::nullopt;
  const BodyStart& start = problem.starts[other];
  return Vector(start.position + rotation_matrix(start.orientation) * f.vector("anchor_body_2"));
}

ExactPath oscillator(const Problem& problem, const Forces& forces, std::size_t body) {
  const double mass = problem.bodies[body].mass;
  const Vector p = problem.starts[body].position, v = problem.starts[body].velocity;
  double stiffness = 0, damping = 0;
  Vector force = forces.constant;
  for (const ForceParameters* f : forces.varying) {
    if (f->kind == "drag" && f->number("quadratic") == 0) {
      damping += f->number("linear");
    } else if (f->kind == "spring" || f->kind == "damper") {
      const auto end = fixed_end(problem, *f, body);
      const bool spring = f->kind == "spring";
      if (!end || (spring && (f->number("rest_length") != 0 || f->number("damping") != 0))) return {};
      if (spring) {
        stiffness += f->number("stiffness");
        force += f->number("stiffness") * (*end - p);
      } else {
        damping += f->number("damping");
      }
    } else {
      return {};
    }
  }
  const LinearMotion motion(stiffness / mass, damping / mass);
  return [=, a = Vector(force / mass)](double t) -> PathAt {
    const LinearMotion::Response r = motion.at(t);
    return {p + r.by_velocity * v + r.by_acceleration * a, r.rate_by_velocity * v + r.by_velocity * a};
  };
}

ExactPath kepler(const System<double>& system, const Forces& forces, std::size_t body) {
  const Problem& problem = system.problem();
  const ForceParameters& pull = *forces.varying[0];
  const std::size_t other = pull.bodies[0] == body ? pull.bodies[1] : pull.bodies[0];
  const Body &one = problem.bodies[body], &two = problem.bodies[other];
  const BodyStart &p = problem.starts[body], &q = problem.starts[other];
  const double gravitational_constant = pull.number("gravitational_constant");
  const Vector apart = p.position - q.position;
  if (one.pinned || two.pinned || !(gravitational_constant > 0) || apart.isZero(0)) return {};
  if (two.fixed) {
    if (!forces.constant.isZero(0)) return {};
    return [motion = KeplerMotion(gravitational_constant * two.mass, apart, p.velocity), at = q.position](double t) {
      const KeplerMotion::Motion m = motion.at(t);
      return PathAt{at + m.position, m.velocity};
    };
  }
  const Forces on_other(system, other);
  const Vector a = forces.constant / one.mass, b = on_other.constant / two.mass;
  const bool alike = (a - b).norm() <= 4 * std::numeric_limits<double>::epsilon() * a.norm();
  if (!on_other.all_known || on_other.varying.size() != 1 || !alike) return {};
  const double total = one.mass + two.mass, share = two.mass / total;
  const Vector center = (one.mass * p.position + two.mass * q.position) / total;
  const Vector drift = (one.mass * p.velocity + two.mass * q.velocity) / total;
  return [=, motion = KeplerMotion(gravitational_constant * total, apart, p.velocity - q.velocity)](double t) {
    const KeplerMotion::Motion m = motion.at(t);
    return PathAt{center + t * (drift + t / 2 * a) + share * m.position, drift + t * a + share * m.velocity};
  };
}

}  // namespace

ExactPath exact_path(const System<double>& system, std::size_t body) {
  const Forces forces(system, body);
  if (!forces.all_known || system.problem().bodies[body].pinned) return {};
  if (forces.varying.size() == 1 && forces.varying[0]->kind == "point_gravity") return kepler(system, forces, body);
  return oscillator(system.problem(), forces, body);
}

}  // namespace polhode::core::exact
