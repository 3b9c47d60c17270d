// SPDX-License-Identifier: BSD-3-Clause
// Members of RigidBodies that are called once per run or per sample, and the choice of the instantiation.
#include "core/system/rigid_bodies.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <stdexcept>

#include "core/forces/catalogue.hpp"

namespace polhode {

template <class S>
System<S>::System(std::vector<Problem> problems, const Formulation& formulation)
    : problems_(std::move(problems)), formulation_(formulation) {
  const int chart = formulation_.orientation == Orientation::quaternion ? 4 : 9;
  const std::size_t n = problem().moving();
  int q = 0, v = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const bool pinned = problem().bodies[i].pinned;
    Layout::Slot slot;
    if (!pinned) {
      slot.position = q;
      slot.velocity = v;
      q += 3;
      v += 3;
    }
    slot.orientation = q;
    slot.angular = v;
    q += chart;
    v += 3;
    layout_.slots.push_back(slot);
  }
  for (Layout::Slot& slot : layout_.slots) {
    if (slot.velocity >= 0) slot.velocity += q;
    slot.angular += q;
  }
  layout_.configuration_size = q;
  layout_.velocity_size = v;
  for (std::size_t k = 0; k < problem().forces.size(); ++k) {
    if constexpr (is_lanes<S>) {
      add_force(make_force_in_lanes(problems_, k));
    } else {
      add_force(make_force<S>(problem().forces[k], problem().bodies));
    }
  }
}

template <class S>
BodyConstants<S>::BodyConstants(const Body& b)
    : principal(b.inertia.isDiagonal(0)),
      pinned(b.pinned),
      inverse_mass(S(1) / S(b.mass)),
      mass(S(b.mass)),
      inertia(b.inertia.cast<S>()),
      inverse_inertia(inertia.inverse()),
      axes(Matrix3<S>::Identity()),
      center_of_mass(b.center_of_mass.cast<S>()) {
  if (principal) {
    moments = inertia.diagonal();
  } else {
    const Eigen::SelfAdjointEigenSolver<Matrix3<S>> solver(inertia);
    moments = solver.eigenvalues();
    axes = solver.eigenvectors();
    if (axes.determinant() < S(0)) axes.col(2) = -axes.col(2);
  }
  inverse_moments = moments.cwiseInverse();
}

template <class S>
BodyConstants<S> constants_of(const std::vector<Problem>& problems, std::size_t body) {
  return BodyConstants<S>(problems.front().bodies[body]);
}
template <>
BodyConstants<Lanes> constants_of<Lanes>(const std::vector<Problem>& problems, std::size_t body) {
  std::vector<BodyConstants<double>> one;
  for (const Problem& p : problems) one.emplace_back(p.bodies[body]);
  BodyConstants<Lanes> all;
  const auto number = [&](auto member) {
    return gather<Lanes>([&](int lane) { return one[std::size_t(lane)].*member; });
  };
  const auto vector = [&](auto& to, auto member) {
    for (int k = 0; k < to.size(); ++k) {
      to(k) = gather<Lanes>([&](int lane) { return (one[std::size_t(lane)].*member)(k); });
    }
  };
  using C = BodyConstants<double>;
  all.mass = number(&C::mass);
  all.inverse_mass = number(&C::inverse_mass);
  vector(all.inertia, &C::inertia);
  vector(all.inverse_inertia, &C::inverse_inertia);
  vector(all.moments, &C::moments);
  vector(all.inverse_moments, &C::inverse_moments);
  vector(all.axes, &C::axes);
  vector(all.center_of_mass, &C::center_of_mass);
  all.principal = one.front().principal;
  all.pinned = one.front().pinned;
  return all;
}

/// A vector or quaternion of the initial state of a body, gathered over the lanes.
template <class S, class Value, class Member>
Value start_of(const std::vector<Problem>& problems, std::size_t body, Member member) {
  Value v;
  for (int k = 0; k < v.size(); ++k) {
    v[k] = gather<S>([&](int lane) { return (problems[std::size_t(lane)].starts[body].*member)[k]; });
  }
  return v;
}

template <class S, Orientation O, AngularState A, BodyCount N>
RigidBodies<S, O, A, N>::RigidBodies(std::vector<Problem> problems, const Formulation& formulation)
    : Base(std::move(problems), formulation) {
  for (std::size_t i = 0; i < this->moving(); ++i) bodies_.push_back(constants_of<S>(this->problems(), i));
  const std::size_t all = this->problem().bodies.size();
  motions_.resize(all, {Vector::Zero(), Matrix::Identity(), Vector::Zero(), Vector::Zero()});
  wrenches_.resize(all);
  for (std::size_t i = 0; i < all; ++i) {  // constant for static bodies; positions constant for pinned ones
    motions_[i].position = start_of<S, Vector>(this->problems(), i, &BodyStart::position);
    motions_[i].rotation = rotation_matrix<S>(start_of<S, Quaternion<S>>(this->problems(), i, &BodyStart::orientation));
  }
  first_ = bodies_.front();
}

template <class S, Orientation O, AngularState A, BodyCount N>
void RigidBodies<S, O, A, N>::full_rate(S t, const S* y, S* dy) const {
  rate_of<true, true>(t, y, dy);
}
template <class S, Orientation O, AngularState A, BodyCount N>
void RigidBodies<S, O, A, N>::velocity_rate(S t, const S* y, S* dy) const {
  rate_of<false, true>(t, y, dy);
}
template <class S, Orientation O, AngularState A, BodyCount N>
void RigidBodies<S, O, A, N>::kinematic_rate(S t, const S* y, S* dy) const {
  rate_of<true, false>(t, y, dy);
}

template <class S, Orientation O, AngularState A, BodyCount N>
State<S> RigidBodies<S, O, A, N>::start() const {
  State<S> state;
  state.y = VectorX<S>::Zero(this->layout().size());
  S* y = state.y.data();
  for (std::size_t i = 0; i < count(); ++i) {
    const auto of = [&]<class Value>(Value, auto member) { return start_of<S, Value>(this->problems(), i, member); };
    const bool in_body = this->problem().starts[i].angular_velocity_in_body;
    const Layout::Slot s = slot(i);
    const ChartValue c = ChartOf::from_quaternion(of(Quaternion<S>(), &BodyStart::orientation));
    ChartOf::store(c, y + s.orientation);
    const Matrix r = rotation(c);
    Vector a = of(Vector(), &BodyStart::angular_velocity);
    if constexpr (A == AngularState::velocity_body) {
      if (!in_body) a = r.transpose() * a;
    } else if constexpr (A == AngularState::velocity_world) {
      if (in_body) a = r * a;
    } else {
      a = r * body(i).momentum(in_body ? a : Vector(r.transpose() * a));
    }
    store(a, y + s.angular);
    if (!pinned(i)) {
      store(of(Vector(), &BodyStart::position), y + s.position);
      store(of(Vector(), &BodyStart::velocity), y + s.velocity);
    }
  }
  return state;
}

template <class S, Orientation O, AngularState A, BodyCount N>
Measurement<S> RigidBodies<S, O, A, N>::measure(const VectorX<S>& y) const {
  return measure_flat(y.data());
}

template <class S, Orientation O, AngularState A, BodyCount N>
BodySnapshot<S> RigidBodies<S, O, A, N>::snapshot(const VectorX<S>& flat, std::size_t i) const {
  const S* y = flat.data();
  const Constants& b = body(i);
  const Layout::Slot s = slot(i);
  const BodyMotion<S> m = motion(y, i);
  BodySnapshot<S> out;
  out.rotation = m.rotation;
  out.orientation = ChartOf::to_quaternion(ChartOf::load(y + s.orientation));
  out.angular_velocity = m.angular_velocity;
  out.position = m.point(b.center_of_mass);
  out.velocity = m.point_velocity(out.position);
  out.angular_momentum = angular_momentum(b, m.rotation, load(y + s.angular));
  return out;
}

template <class S, Orientation O, AngularState A, BodyCount N>
BodyMotion<S> RigidBodies<S, O, A, N>::motion_of(const VectorX<S>& y, std::size_t i) const {
  return i < count() ? motion(y.data(), i) : motions_[i];
}

template <class S, Orientation O, AngularState A, BodyCount N>
void RigidBodies<S, O, A, N>::apply_impulse(VectorX<S>& flat, std::size_t i, const Vector& impulse,
                                            const Vector& angular_impulse) const {
  S* y = flat.data();
  const Layout::Slot s = slot(i);
  const Matrix r = rotation(ChartOf::load(y + s.orientation));
  store(load(y + s.angular) + angular_state(body(i), r, angular_impulse), y + s.angular);
  if (!pinned(i)) store(load(y + s.velocity) + body(i).inverse_mass * impulse, y + s.velocity);
}

template <class S, Orientation O, AngularState A, BodyCount N>
void RigidBodies<S, O, A, N>::displace(VectorX<S>& flat, std::size_t i, const Vector& shift, const Vector& turn) const {
  S* y = flat.data();
  const Layout::Slot s = slot(i);
  const ChartValue c = ChartOf::load(y + s.orientation);
  const Quaternion<S> q = quaternion_from_rotation_vector<S>(turn);
  const Matrix before = rotation(c);
  const Vector w = angular_velocity_world(body(i), before, load(y + s.angular));
  const ChartValue turned = ChartOf::turned_in_world(c, q);
  ChartOf::store(turned, y + s.orientation);
  if constexpr (A != AngularState::velocity_world) {
    const Matrix after = rotation(turned);
    const Vector in_body = after.transpose() * w;
    store(A == AngularState::velocity_body ? in_body : Vector(after * body(i).momentum(in_body)), y + s.angular);
  }
  if (!pinned(i)) store(load(y + s.position) + shift, y + s.position);
}

template <class S, Orientation O, AngularState A, BodyCount N>
void RigidBodies<S, O, A, N>::project(VectorX<S>& y) const {
  project_flat(y.data());
}

template <class S>
std::unique_ptr<System<S>> make_system(const Problem& problem, const Formulation& formulation) {
  if (!formulation.gyroscopic && formulation.angular_state == AngularState::momentum_world) {
    throw std::invalid_argument(
        "gyroscopic = off makes no sense with angular_state = momentum_world: dL/dt = torque has no gyroscopic term to "
        "leave out; use velocity_world or velocity_body");
  }
  if (problem.moving() == 0) throw std::invalid_argument("the scenario has no moving body");
  const auto build = [&]<Orientation O, AngularState A>() -> std::unique_ptr<System<S>> {
    std::vector<Problem> one = {problem};
    if constexpr (has_one_body_form<S>) {
      if (fits_one_body_form(problem)) {
        return std::make_unique<RigidBodies<S, O, A, BodyCount::one>>(std::move(one), formulation);
      }
    }
    return std::make_unique<RigidBodies<S, O, A, BodyCount::many>>(std::move(one), formulation);
  };
  return in_formulation(formulation, build);
}

std::string lane_key(const System<double>& system) {
  if (system.problem().bodies.size() != 1 || !fits_one_body_form(system.problem())) return {};
  std::string key = system.problem().bodies.front().inertia.isDiagonal(0) ? "principal" : "general";
  if (system.problem().starts.front().angular_velocity_in_body) key += " body";
  for (std::size_t k = 0; k < system.forces().size(); ++k) {
    if (k >= system.problem().forces.size()) return {};  // added by add_force()
    const auto& force = *system.forces()[k];
    key += ' ' + system.problem().forces[k].kind;
    for (const bool fact : {force.does_work(), force.effect_on(0).torque, force.reads_rotation()})
      key += fact ? '1' : '0';
  }
  return key;
}

std::unique_ptr<System<Lanes>> make_ensemble(std::span<const Problem> problems, const Formulation& formulation) {
  if (problems.size() != std::size_t(lane_count))
    throw std::invalid_argument("an ensemble has one problem for each lane");
  return in_formulation(formulation, [&]<Orientation O, AngularState A>() -> std::unique_ptr<System<Lanes>> {
    return std::make_unique<RigidBodies<Lanes, O, A, BodyCount::one>>(
        std::vector<Problem>(problems.begin(), problems.end()), formulation);
  });
}

// Explicit instantiations: the members above are compiled only here.
#define POLHODE_INSTANTIATE(S, N) \
  template class RigidBodies<S, Orientation::quaternion, AngularState::velocity_world, N>; \
  template class RigidBodies<S, Orientation::quaternion, AngularState::velocity_body, N>; \
  template class RigidBodies<S, Orientation::quaternion, AngularState::momentum_world, N>; \
  template class RigidBodies<S, Orientation::matrix, AngularState::velocity_world, N>; \
  template class RigidBodies<S, Orientation::matrix, AngularState::velocity_body, N>; \
  template class RigidBodies<S, Orientation::matrix, AngularState::momentum_world, N>

POLHODE_INSTANTIATE(Lanes, BodyCount::one);
POLHODE_INSTANTIATE(double, BodyCount::one);
POLHODE_INSTANTIATE(double, BodyCount::many);
POLHODE_INSTANTIATE(float, BodyCount::many);
POLHODE_INSTANTIATE(long double, BodyCount::many);

template std::unique_ptr<System<float>> make_system<float>(const Problem&, const Formulation&);
template std::unique_ptr<System<double>> make_system<double>(const Problem&, const Formulation&);
template std::unique_ptr<System<long double>> make_system<long double>(const Problem&, const Formulation&);

}  // namespace polhode
