// SPDX-License-Identifier: BSD-3-Clause
// Members of RigidBodies that are called once per run or per sample, and the choice of the instantiation.
#include "core/system/rigid_bodies.hpp"

#include <stdexcept>

#include "core/system/visit_system.hpp"

namespace polhode::inline core::inline system {

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
  for (std::size_t i = 0; i < this->problem().bodies.size(); ++i) {  // positions of pinned bodies, all of static ones
    BodyMotion<S>& m = this->motions()[i];
    m.position = start_of<S, Vector>(this->problems(), i, &BodyStart::position);
    m.rotation = rotation_matrix<S>(start_of<S, Quaternion<S>>(this->problems(), i, &BodyStart::orientation));
  }
}

template <class S, Orientation O, AngularState A, BodyCount N>
void RigidBodies<S, O, A, N>::full_rate(S t, const S* y, S* dy) const {
  flat_ode::rate(*this, t, y, dy);
}
template <class S, Orientation O, AngularState A, BodyCount N>
void RigidBodies<S, O, A, N>::velocity_rate(S t, const S* y, S* dy) const {
  flat_ode::acceleration(*this, t, y, dy);
}
template <class S, Orientation O, AngularState A, BodyCount N>
void RigidBodies<S, O, A, N>::kinematic_rate(S t, const S* y, S* dy) const {
  flat_ode::configuration_rate(*this, t, y, dy);
}

template <class S, Orientation O, AngularState A, BodyCount N>
State<S> RigidBodies<S, O, A, N>::start() const {
  State<S> state;
  state.y = VectorX<S>::Zero(this->layout().size());
  S* y = state.y.data();
  for (std::size_t i = 0; i < this->count(); ++i) {
    const auto of = [&]<class Value>(Value, auto member) { return start_of<S, Value>(this->problems(), i, member); };
    const bool in_body = this->problem().starts[i].angular_velocity_in_body;
    const Layout::Slot s = this->slot(i);
    const ChartValue c = ChartOf::from_quaternion(of(Quaternion<S>(), &BodyStart::orientation));
    ChartOf::store(c, y + s.orientation);
    const Matrix r = this->rotation(c);
    Vector a = of(Vector(), &BodyStart::angular_velocity);
    if constexpr (A == AngularState::velocity_body) {
      if (!in_body) a = r.transpose() * a;
    } else if constexpr (A == AngularState::velocity_world) {
      if (in_body) a = r * a;
    } else {
      a = r * this->body(i).momentum(in_body ? a : Vector(r.transpose() * a));
    }
    store_vector(a, y + s.angular);
    if (!this->pinned(i)) {
      store_vector(of(Vector(), &BodyStart::position), y + s.position);
      store_vector(of(Vector(), &BodyStart::velocity), y + s.velocity);
    }
  }
  return state;
}

template <class S, Orientation O, AngularState A, BodyCount N>
POLHODE_FLATTEN Measurement<S> RigidBodies<S, O, A, N>::measure_flat(const S* y) const {
  return measurement::measure(*this, y);
}
template <class S, Orientation O, AngularState A, BodyCount N>
void RigidBodies<S, O, A, N>::project_flat(S* y) const {
  measurement::project(*this, y);
}

template <class S, Orientation O, AngularState A, BodyCount N>
Measurement<S> RigidBodies<S, O, A, N>::measure(const VectorX<S>& y) const {
  return measure_flat(y.data());
}

template <class S, Orientation O, AngularState A, BodyCount N>
POLHODE_FLATTEN BodySnapshot<S> RigidBodies<S, O, A, N>::snapshot(const VectorX<S>& flat, std::size_t i) const {
  const S* y = flat.data();
  const Constants& b = this->body(i);
  const Layout::Slot s = this->slot(i);
  const BodyMotion<S> m = this->motion(y, i);
  BodySnapshot<S> out;
  out.rotation = m.rotation;
  out.orientation = ChartOf::to_quaternion(ChartOf::load(y + s.orientation));
  out.angular_velocity = m.angular_velocity;
  out.position = m.point(b.center_of_mass);
  out.velocity = m.point_velocity(out.position);
  out.angular_momentum = this->angular_momentum(b, m.rotation, load_vector(y + s.angular));
  return out;
}

template <class S, Orientation O, AngularState A, BodyCount N>
BodyMotion<S> RigidBodies<S, O, A, N>::motion_of(const VectorX<S>& y, std::size_t i) const {
  return i < this->count() ? this->motion(y.data(), i) : this->motions()[i];
}

template <class S, Orientation O, AngularState A, BodyCount N>
void RigidBodies<S, O, A, N>::apply_impulse(VectorX<S>& flat, std::size_t i, const Vector& impulse,
                                            const Vector& angular_impulse) const {
  S* y = flat.data();
  const Layout::Slot s = this->slot(i);
  const Matrix r = this->rotation(ChartOf::load(y + s.orientation));
  store_vector(load_vector(y + s.angular) + this->angular_state(this->body(i), r, angular_impulse), y + s.angular);
  if (!this->pinned(i))
    store_vector(load_vector(y + s.velocity) + this->body(i).inverse_mass * impulse, y + s.velocity);
}

template <class S, Orientation O, AngularState A, BodyCount N>
void RigidBodies<S, O, A, N>::displace(VectorX<S>& flat, std::size_t i, const Vector& shift, const Vector& turn) const {
  S* y = flat.data();
  const Layout::Slot s = this->slot(i);
  const ChartValue c = ChartOf::load(y + s.orientation);
  const Quaternion<S> q = quaternion_from_rotation_vector<S>(turn);
  const Matrix before = this->rotation(c);
  const Vector w = this->angular_velocity_world(this->body(i), before, load_vector(y + s.angular));
  const ChartValue turned = ChartOf::turned_in_world(c, q);
  ChartOf::store(turned, y + s.orientation);
  if constexpr (A != AngularState::velocity_world) {
    const Matrix after = this->rotation(turned);
    const Vector in_body = after.transpose() * w;
    store_vector(A == AngularState::velocity_body ? in_body : Vector(after * this->body(i).momentum(in_body)),
                 y + s.angular);
  }
  if (!this->pinned(i)) store_vector(load_vector(y + s.position) + shift, y + s.position);
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

template <class S>
std::shared_ptr<const ManyBodies<S>> many_bodies_form(const System<S>& system) {
  if (const auto* many = dynamic_cast<const ManyBodies<S>*>(&system)) {
    return {std::shared_ptr<const ManyBodies<S>>(), many};
  }
  return in_formulation(system.formulation(), [&]<Orientation O, AngularState A>() {
    auto many = std::make_shared<RigidBodies<S, O, A, BodyCount::many>>(system.problems(), system.formulation());
    for (std::size_t k = system.problem().forces.size(); k < system.forces().size(); ++k) {
      many->add_force(system.forces()[k]);
    }
    return std::shared_ptr<const ManyBodies<S>>(std::move(many));
  });
}

std::string lane_key(const Problem& problem) {
  if (problem.bodies.size() != 1 || !fits_one_body_form(problem)) return {};
  std::string key = problem.bodies.front().inertia.isDiagonal(0) ? "principal" : "general";
  if (problem.starts.front().angular_velocity_in_body) key += " body";
  if (problem.forces.empty()) return key;
  const auto system = make_system<double>(problem, {});
  for (std::size_t k = 0; k < system->forces().size(); ++k) {
    const auto& force = *system->forces()[k];
    key += ' ' + problem.forces[k].kind;
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

// Members that methods call through the concrete type and that are compiled only here. Virtual ones need no mention:
// the functions that make systems instantiate them.
#define POLHODE_INSTANTIATE(S, O, A) \
  template Measurement<S> RigidBodies<S, O, A, BodyCount::one>::measure_flat(const S*) const; \
  template void RigidBodies<S, O, A, BodyCount::one>::project_flat(S*) const
#define POLHODE_INSTANTIATE_CHARTS(S, A) \
  POLHODE_INSTANTIATE(S, Orientation::quaternion, A); \
  POLHODE_INSTANTIATE(S, Orientation::matrix, A)
#define POLHODE_INSTANTIATE_FORMULATIONS(S) \
  POLHODE_INSTANTIATE_CHARTS(S, AngularState::velocity_world); \
  POLHODE_INSTANTIATE_CHARTS(S, AngularState::velocity_body); \
  POLHODE_INSTANTIATE_CHARTS(S, AngularState::momentum_world)

POLHODE_INSTANTIATE_FORMULATIONS(double);
POLHODE_INSTANTIATE_FORMULATIONS(Lanes);

template std::unique_ptr<System<float>> make_system<float>(const Problem&, const Formulation&);
template std::unique_ptr<System<double>> make_system<double>(const Problem&, const Formulation&);
template std::unique_ptr<System<long double>> make_system<long double>(const Problem&, const Formulation&);
template std::shared_ptr<const ManyBodies<float>> many_bodies_form(const System<float>&);
template std::shared_ptr<const ManyBodies<double>> many_bodies_form(const System<double>&);
template std::shared_ptr<const ManyBodies<long double>> many_bodies_form(const System<long double>&);

}  // namespace polhode::core::system
