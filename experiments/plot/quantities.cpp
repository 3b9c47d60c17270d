// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/plot/quantities.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <string_view>

#include "core/exact/exact_motion.hpp"
#include "core/math/quaternion.hpp"
#include "experiments/study/metrics/polhode_error.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/suggestion.hpp"

namespace polhode::study::plot_program {
namespace {

std::vector<double> components_of(const Vector3<double>& v) { return {v[0], v[1], v[2]}; }

/// Components 1, 2, 3 of a vector: "ω₁ (rad/s)", column "omega_1_rad_per_s".
std::vector<Component> three(const std::string& symbol, const std::string& column, const std::string& unit,
                             const std::string& unit_column, const std::array<std::string, 3>& places) {
  std::vector<Component> all;
  for (const std::string& place : places) {
    const std::string number = place == "₁" ? "1" : place == "₂" ? "2" : place == "₃" ? "3" : place;
    all.push_back({symbol + place + " (" + unit + ")", column + "_" + number + "_" + unit_column});
  }
  return all;
}
const std::array<std::string, 3> in_body = {"₁", "₂", "₃"}, in_world = {"x", "y", "z"};

using OfBody = std::vector<double> (*)(const BodySnapshot<double>&);

/// A measure of the snapshot of one body.
std::function<Measure(const System<double>&, std::size_t)> of_body(OfBody of) {
  return [of](const System<double>& system, std::size_t body) -> Measure {
    return [&system, body, of](const Instant& at) { return of(system.snapshot(at.state.y, body)); };
  };
}

using OfSample = std::vector<double> (*)(const Instant&);
std::function<Measure(const System<double>&, std::size_t)> of_all(OfSample of) {
  return [of](const System<double>&, std::size_t) -> Measure { return of; };
}

/// Kinetic energy of the mass centres, J; 0 of pinned bodies, which turn about their pivot.
double kinetic_of_translation(const System<double>& system, const State<double>& state) {
  double sum = 0;
  for (std::size_t i = 0; i < system.moving(); ++i) {
    const Body& body = system.problem().bodies[i];
    if (!body.pinned) sum += 0.5 * body.mass * system.snapshot(state.y, i).velocity.squaredNorm();
  }
  return sum;
}

Measure parts_of_energy(const System<double>& system, std::size_t) {
  return [&system](const Instant& at) -> std::vector<double> {
    const double translation = kinetic_of_translation(system, at.state);
    const double gone = at.contact.total() - at.sample.work - at.sample.joint_work - at.sample.projection;
    return {at.sample.seen.kinetic - translation, translation, at.sample.seen.potential, gone};
  };
}

Measure attitude_error(const System<double>& system, std::size_t body) {
  const auto exact = std::make_shared<const ExactMotion>(system);
  if (!exact->has_attitude()) return {};
  return [&system, body, exact](const Instant& at) -> std::vector<double> {
    const Quaternion<double> is = system.snapshot(at.state.y, body).orientation;
    const auto known = exact->at(at.state.t, body).rotation;
    return {known && known->orientation ? angle_between(is, *known->orientation) : 0};
  };
}

Measure polhode_error(const System<double>& system, std::size_t) {
  const auto exact = PolhodeError::of(system);
  if (!exact) return {};
  const auto error = std::make_shared<PolhodeError>(*exact);
  return [&system, error](const Instant& at) -> std::vector<double> {
    const auto found = error->at(at.state.t, system.snapshot(at.state.y, 0));
    return {std::abs(found.phase_rad), found.off};
  };
}

std::vector<double> omega_in_body(const BodySnapshot<double>& s) {
  return components_of(s.rotation.transpose() * s.angular_velocity);
}
std::vector<double> omega_in_world(const BodySnapshot<double>& s) { return components_of(s.angular_velocity); }

const std::vector<PlotQuantity>& table() {
  using enum Drawn;
  static const std::vector<PlotQuantity> all = {
      {.name = "energy",
       .shows = "kinetic, potential and total energy",
       .components = {{"kinetic energy (J)", "kinetic_J"},
                      {"potential energy (J)", "potential_J"},
                      {"total energy (J)", "total_J"}},
       .measure = of_all([](const Instant& at) -> std::vector<double> {
         return {at.sample.seen.kinetic, at.sample.seen.potential, at.sample.seen.energy()};
       })},
      {.name = "energy_drift",
       .shows = "the error of the energy: its balance with work and contact, less that at the start",
       .scale = Scale::symlog,
       .components = {{"energy drift (J)", "energy_drift_J"}},
       .measure = of_all([](const Instant& at) -> std::vector<double> {
         return {at.sample.ledger(at.contact.total()) - at.ledger_start};
       })},
      {.name = "ledger",
       .shows = "energy of rotation and of translation, potential, and losses in contact less the work of other "
                "forces: stacked, with impacts",
       .drawn = stacked,
       .components = {{"kinetic, rotation", "rotation_J"},
                      {"kinetic, translation", "translation_J"},
                      {"potential", "potential_J"},
                      {"losses − work of forces", "losses_less_work_J"}},
       .measure = parts_of_energy},
      {.name = "omega",
       .shows = "angular velocity in body axes",
       .components = three("ω", "omega", "rad/s", "rad_per_s", in_body),
       .of_a_body = true,
       .measure = of_body(omega_in_body)},
      {.name = "omega_world",
       .shows = "angular velocity in world axes",
       .components = three("ω", "omega", "rad/s", "rad_per_s", in_world),
       .of_a_body = true,
       .measure = of_body(omega_in_world)},
      {.name = "angular_momentum",
       .shows = "total angular momentum in world axes",
       .components = three("L", "angular_momentum", "kg m²/s", "kg_m2_per_s", in_world),
       .measure = of_all([](const Instant& at) { return components_of(at.sample.seen.angular_momentum); })},
      {.name = "linear_momentum",
       .shows = "total linear momentum in world axes",
       .components = three("p", "linear_momentum", "kg m/s", "kg_m_per_s", in_world),
       .measure = of_all([](const Instant& at) { return components_of(at.sample.seen.linear_momentum); })},
      {.name = "position",
       .shows = "mass centre in world axes",
       .components = three("", "position", "m", "m", in_world),
       .of_a_body = true,
       .measure = of_body([](const BodySnapshot<double>& s) { return components_of(s.position); })},
      {.name = "velocity",
       .shows = "velocity of the mass centre in world axes",
       .components = three("v", "velocity", "m/s", "m_per_s", in_world),
       .of_a_body = true,
       .measure = of_body([](const BodySnapshot<double>& s) { return components_of(s.velocity); })},
      {.name = "attitude_error",
       .shows = "angle between the orientation and that of the exact motion",
       .scale = Scale::logarithmic,
       .components = {{"attitude error (rad)", "attitude_error_rad"}},
       .of_a_body = true,
       .measure = attitude_error},
      {.name = "polhode_error",
       .shows = "error of a free body's angular momentum along its polhode, |ω(0)| times a time, and off it",
       .scale = Scale::logarithmic,
       .components = {{"phase (rad)", "phase_rad"}, {"off the polhode (relative)", "off_rel"}},
       .measure = polhode_error},
      {.name = "phase",
       .shows = "phase portraits: the components of ω in body axes against each other",
       .drawn = portrait,
       .components = three("ω", "omega", "rad/s", "rad_per_s", in_body),
       .of_a_body = true,
       .measure = of_body(omega_in_body)},
      {.name = "polhode",
       .shows = "ω in principal axes, on the ellipsoid of all ω with the energy of the start",
       .drawn = polhode,
       .components = three("ω", "omega", "rad/s", "rad_per_s", in_body),
       .of_a_body = true,
       .measure = of_body(omega_in_body)},
      {.name = "herpolhode",
       .shows = "ω in the world, about the angular momentum of the start",
       .drawn = herpolhode,
       .components = three("ω", "omega", "rad/s", "rad_per_s", in_world),
       .of_a_body = true,
       .measure = of_body(omega_in_world)},
      {.name = "events",
       .shows = "impacts and ends of sliding against time, by the bodies that touch",
       .drawn = events},
  };
  return all;
}

}  // namespace

std::span<const PlotQuantity> plot_quantities() { return table(); }

const PlotQuantity& quantity_named(const std::string& name) {
  std::vector<std::string_view> known;
  for (const PlotQuantity& quantity : table()) {
    if (quantity.name == name) return quantity;
    known.push_back(quantity.name);
  }
  throw InputError("--quantity: no quantity '" + name + "'" + suggestion(name, "There are", known));
}

}  // namespace polhode::study::plot_program
