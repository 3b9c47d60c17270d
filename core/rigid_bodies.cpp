// SPDX-License-Identifier: BSD-3-Clause
// The parts of RigidBodies that run once per run or per sample, and the choice of the instantiation.
#include "core/rigid_bodies.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <stdexcept>

#include "core/forces/catalogue.hpp"

namespace polhode {

template <class S>
System<S>::System(Problem problem, const Formulation& formulation)
    : problem_(std::move(problem)), formulation_(formulation) {
  const int chart = formulation_.orientation == Orientation::quaternion ? 4 : 9;
  const std::size_t n = problem_.moving();
  int q = 0, v = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const bool pinned = problem_.bodies[i].pinned;
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
  for (const ForceParameters& f : problem_.forces) add_force(make_force<S>(f, problem_.bodies));
}

template <class S>
BodyConstants<S>::BodyConstants(const Body& b)
    : mass(S(b.mass)),
      inverse_mass(S(1) / S(b.mass)),
      inertia(b.inertia.cast<S>()),
      inverse_inertia(inertia.inverse()),
      axes(Matrix3<S>::Identity()),
      center_of_mass(b.center_of_mass.cast<S>()),
      principal(b.inertia.isDiagonal(0)),
      pinned(b.pinned) {
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

template <class S, Orientation O, AngularState A, BodyCount N>
void RigidBodies<S, O, A, N>::full_rate(S t, const S* y, S* dy) const {
  if constexpr (is_one) flattened_rate(t, y, dy);
  else rate_of<true, true>(t, y, dy);
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
    const BodyStart& b = this->problem().starts[i];
    const Layout::Slot s = slot(i);
    const ChartValue c = ChartOf::from_quaternion(b.orientation.template cast<S>());
    ChartOf::store(c, y + s.orientation);
    const Matrix r = rotation(c);
    Vector a = b.angular_velocity.template cast<S>();
    if constexpr (A == AngularState::velocity_body) {
      if (!b.angular_velocity_in_body) a = r.transpose() * a;
    } else if constexpr (A == AngularState::velocity_world) {
      if (b.angular_velocity_in_body) a = r * a;
    } else {
      a = r * body(i).momentum(b.angular_velocity_in_body ? a : Vector(r.transpose() * a));
    }
    store(a, y + s.angular);
    if (!pinned(i)) {
      store(b.position.template cast<S>(), y + s.position);
      store(b.velocity.template cast<S>(), y + s.velocity);
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
    if constexpr (has_one_body_form<S>) {
      if (fits_one_body_form(problem)) return std::make_unique<RigidBodies<S, O, A, BodyCount::one>>(problem, formulation);
    }
    return std::make_unique<RigidBodies<S, O, A, BodyCount::many>>(problem, formulation);
  };
  const auto build_chart = [&]<Orientation O>() {
    switch (formulation.angular_state) {
      case AngularState::velocity_world: return build.template operator()<O, AngularState::velocity_world>();
      case AngularState::velocity_body: return build.template operator()<O, AngularState::velocity_body>();
      default: return build.template operator()<O, AngularState::momentum_world>();
    }
  };
  return formulation.orientation == Orientation::quaternion
             ? build_chart.template operator()<Orientation::quaternion>()
             : build_chart.template operator()<Orientation::matrix>();
}

// Every instantiation, so that the members above are compiled here and nowhere else.
#define POLHODE_INSTANTIATE(S, N)                                                              \
  template class RigidBodies<S, Orientation::quaternion, AngularState::velocity_world, N>;     \
  template class RigidBodies<S, Orientation::quaternion, AngularState::velocity_body, N>;      \
  template class RigidBodies<S, Orientation::quaternion, AngularState::momentum_world, N>;     \
  template class RigidBodies<S, Orientation::matrix, AngularState::velocity_world, N>;         \
  template class RigidBodies<S, Orientation::matrix, AngularState::velocity_body, N>;          \
  template class RigidBodies<S, Orientation::matrix, AngularState::momentum_world, N>

POLHODE_INSTANTIATE(double, BodyCount::one);
POLHODE_INSTANTIATE(double, BodyCount::many);
POLHODE_INSTANTIATE(float, BodyCount::many);
POLHODE_INSTANTIATE(long double, BodyCount::many);

template std::unique_ptr<System<float>> make_system<float>(const Problem&, const Formulation&);
template std::unique_ptr<System<double>> make_system<double>(const Problem&, const Formulation&);
template std::unique_ptr<System<long double>> make_system<long double>(const Problem&, const Formulation&);

}  // namespace polhode
