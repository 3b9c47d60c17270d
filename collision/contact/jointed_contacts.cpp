// SPDX-License-Identifier: BSD-3-Clause
#include "collision/contact/jointed_contacts.hpp"

#include <algorithm>

#include "collision/response/energy_guard.hpp"
#include "core/system/constraints.hpp"
#include "core/system/joint_projection.hpp"

namespace polhode::inline collision::inline contact {
namespace {

constexpr int most_turns = 500;
constexpr double longest = 1e3;      ///< step along the gradient
constexpr double unresolved = 1e-3;  ///< share of the first change of velocities left where none obey all laws
constexpr double tolerance = 1e-10;  ///< change of velocities at which the iteration ends, over their scale

Vector3<double> relative(std::span<const ImpulseBody> bodies, const ImpulseContact& c) {
  return bodies[c.a].velocity_at(c.point) - bodies[c.b].velocity_at(c.point);
}

/// Work of impulses on contacts whose velocities are those of the bodies before and after, J; `scale` receives the
/// magnitude of its terms, J.
double work(std::span<const ImpulseContact> contacts, std::span<const ImpulseBody> before,
            std::span<const ImpulseBody> after, double& scale) {
  double sum = 0;
  scale = 0;
  for (const ImpulseContact& c : contacts) {
    const Vector3<double> from = relative(before, c), to = relative(after, c);
    sum += 0.5 * c.impulse.dot(from + to);
    scale += 0.5 * c.impulse.norm() * (from.norm() + to.norm());
  }
  return sum;
}

void add(std::span<ImpulseBody> bodies, const std::vector<Wrench<double>>& twists) {
  for (std::size_t i = 0; i < twists.size(); ++i) {
    bodies[i].velocity += twists[i].force;
    bodies[i].angular_velocity += twists[i].torque;
  }
}

}  // namespace

void JointedContacts::resolve(Response& response, const VectorX<double>& y, std::span<ImpulseBody> bodies,
                              std::span<ImpulseContact> contacts, double step) {
  if (!system_.has_joints()) return response.resolve(bodies, contacts, step);
  motions_ = motions_of(system_, y);
  system_.constraints()->evaluate(motions_);
  free_.assign(bodies.begin(), bodies.end());
  twists_.resize(system_.moving());
  if (impulses_.size() == 0) forget();
  const bool bounces = std::any_of(contacts.begin(), contacts.end(), [](const auto& c) { return c.wanted > 0; });
  if (bounces) forget();
  const bool found = find_impulses(response, bodies, contacts, step);
  close_shifts(bodies);
  if (bounces) limit_energy(response, bodies, contacts, step, found);
}

void JointedContacts::forget() {
  if (system_.has_joints()) impulses_.setZero(Eigen::Index(system_.constraints()->rows()));
}

/// M⁻¹ Gᵀ μ: change_.
void JointedContacts::spread(const VectorX<double>& impulses) {
  change_.assign(system_.moving(), {});
  system_.constraints()->add_transposed(impulses, change_);
  system_.constraints()->divide_by_masses(change_);
}

/// The impulses of the joints, and the change_ of the twists by them, after which G u = 0. Returns twice the energy of
/// that change, J.
double JointedContacts::close() {
  system_.constraints()->multiply(twists_, right_);
  right_ = -right_;
  system_.constraints()->solve(right_, multipliers_);
  spread(multipliers_);
  return right_.dot(multipliers_);
}

/// Returns true if velocities were found that obey contacts and joints.
bool JointedContacts::find_impulses(Response& response, std::span<ImpulseBody> bodies,
                                    std::span<ImpulseContact> contacts, double step) {
  double step_length = 1, before = 0, first = 0, at_start = 0;
  for (int n = 0; n < most_turns; ++n) {
    std::copy(free_.begin(), free_.end(), bodies.begin());
    spread(impulses_);
    add(bodies, change_);
    response.resolve(bodies, contacts, step);
    for (std::size_t i = 0; i < twists_.size(); ++i)
      twists_[i] = {bodies[i].velocity - free_[i].velocity, bodies[i].angular_velocity - free_[i].angular_velocity};
    const double size = close();
    add(bodies, change_);
    double scale = 0;
    work(contacts, free_, bodies, scale);
    first = std::max({first, size, scale});
    if (!(size > tolerance * tolerance * first) || n + 1 == most_turns) {
      impulses_ += multipliers_;
      return !(size > unresolved * unresolved * at_start) || n == 0;
    }
    if (n == 0) at_start = size;
    if (n > 0) {
      const double fall = before - before_.dot(multipliers_);
      step_length = fall > 0 ? std::clamp(step_length * before / fall, 1.0, longest) : 1;
    }
    before = size;
    before_ = right_;
    impulses_ += step_length * multipliers_;
  }
  return false;
}

/// The displacements of the response, less what would open the joints.
void JointedContacts::close_shifts(std::span<ImpulseBody> bodies) {
  const bool any = std::any_of(bodies.begin(), bodies.end(),
                               [](const ImpulseBody& b) { return !b.shift.isZero(0) || !b.turn.isZero(0); });
  if (!any) return;
  for (std::size_t i = 0; i < twists_.size(); ++i) twists_[i] = {bodies[i].shift, bodies[i].turn};
  close();
  for (std::size_t i = 0; i < change_.size(); ++i) {
    bodies[i].shift += change_[i].force;
    bodies[i].turn += change_[i].torque;
  }
}

/// The reactions do no work together with the change of G v that they allow, so that the contacts' work is the gain of
/// kinetic energy.
void JointedContacts::limit_energy(Response& response, std::span<ImpulseBody> bodies,
                                   std::span<ImpulseContact> contacts, double step, bool found) {
  double scale = 0;
  const double end = work(contacts, free_, bodies, scale);
  if (found && !(end > 1e-11 * scale)) return;
  forget();
  bouncing_.assign(bodies.begin(), bodies.end());
  of_contacts_.resize(contacts.size());
  std::vector<double> wanted(contacts.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    of_contacts_[i] = contacts[i].impulse;
    wanted[i] = contacts[i].wanted;
    contacts[i].wanted = std::min(wanted[i], 0.0);
  }
  find_impulses(response, bodies, contacts, step);
  const double start = std::min(work(contacts, free_, bodies, scale), 0.0);
  double slope = 0;
  for (std::size_t i = 0; i < contacts.size(); ++i)
    slope += (of_contacts_[i] - contacts[i].impulse).dot(relative(bodies, contacts[i]));
  const double s = found ? share_without_gain(start, slope, end) : 0;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    contacts[i].impulse += s * (of_contacts_[i] - contacts[i].impulse);
    contacts[i].wanted = wanted[i];
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    bodies[i].velocity += s * (bouncing_[i].velocity - bodies[i].velocity);
    bodies[i].angular_velocity += s * (bouncing_[i].angular_velocity - bodies[i].angular_velocity);
    bodies[i].shift = bouncing_[i].shift;
    bodies[i].turn = bouncing_[i].turn;
  }
}

}  // namespace polhode::collision::contact
