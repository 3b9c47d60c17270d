// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/judge/hypothesis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "experiments/judge/other_inertias.hpp"

namespace polhode::study::judge {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// Sets one part of `h` to that of `from`.
void take_part(Hypothesis& h, const Hypothesis& from, Part part) {
  switch (part) {
    case Part::attitude_columns:
      h.reading.transposed = from.reading.transposed;
      h.reading.order = from.reading.order;
      break;
    case Part::rate_frame: h.reading.rates_in_body = from.reading.rates_in_body; break;
    case Part::rate_unit: h.reading.rate_unit = from.reading.rate_unit; break;
    case Part::start: h.start = from.start; break;
    case Part::gyroscopic_term: h.equations.gyroscopic = from.equations.gyroscopic; break;
    case Part::turning:
      h.equations.frame = from.equations.frame;
      h.equations.turning = from.equations.turning;
      break;
    case Part::inertia: h.problem = from.problem; break;
    case Part::clock:
      h.clock = from.clock;
      h.shift = from.shift;
      break;
    case Part::steps: h.steps = from.steps; break;
  }
}

/// Adds hypotheses to a list, each a single change of the plain one.
struct SingleChanges {
  const Hypothesis& plain;
  std::vector<Hypothesis> list = {};

  template <class Change>
  void add(const char* cause, std::string words, Part touched, const Change& change) {
    list.push_back(with_cause(plain, cause, std::move(words), touched));
    change(list.back());
  }
};

void add_wrong_starts(SingleChanges& changes, std::size_t moving) {
  for (const auto& [unit, words] :
       {std::pair{degree, "it starts with the scenario's ω taken for degrees per second"},
        {1 / degree, "it starts with the scenario's ω in degrees per second, taken for radians"}}) {
    changes.add("degrees", words, Part::start, [unit = unit](Hypothesis& h) { h.start.rate_unit = unit; });
  }
  const auto& starts = changes.plain.problem.starts;
  const auto end = starts.begin() + static_cast<std::ptrdiff_t>(moving);
  const bool turned = std::any_of(starts.begin(), end, [](const BodyStart& s) {
    return s.orientation.tail<3>().norm() > 1e-6 * std::abs(s.orientation[0]);
  });
  if (turned) {
    changes.add("omega_frame", "it starts with the scenario's ω in the wrong axes (world and body exchanged)",
                Part::start, [](Hypothesis& h) { h.start.rates_in_body = true; });
    changes.add("transposed", "it starts with the scenario's orientation transposed", Part::start,
                [](Hypothesis& h) { h.start.transposed = true; });
  }
  changes.add("quaternion_order", "it starts with the scenario's quaternion read as x, y, z, w", Part::start,
              [](Hypothesis& h) { h.start.order = Reading::Order::xyzw; });
}

void add_wrong_equations(SingleChanges& changes) {
  using Frame = Equations::Frame;
  changes.add("gyroscopic_sign", "ω × Iω has the wrong sign", Part::gyroscopic_term,
              [](Hypothesis& h) { h.equations.gyroscopic = -1; });
  changes.add("gyroscopic_absent", "ω × Iω is left out", Part::gyroscopic_term,
              [](Hypothesis& h) { h.equations.gyroscopic = 0; });
  for (const auto& [frame, words] :
       {std::pair{Frame::inertia_not_turned,
                  "the inertia is not turned with the body: ω in world axes meets I in body axes"},
        {Frame::body_turns_world, "the attitude is turned by ω in body axes as though in world axes"},
        {Frame::world_turns_body, "the attitude is turned by ω in world axes as though in body axes"}}) {
    changes.add("omega_frame", words, Part::turning, [frame = frame](Hypothesis& h) { h.equations.frame = frame; });
  }
  for (const auto& [factor, cause, words] :
       {std::tuple{2.0, "attitude_rate", "the attitude turns twice as fast as ω, as without the ½ of q̇ = ½ωq"},
        {0.5, "attitude_rate", "the attitude turns half as fast as ω"},
        {degree, "degrees", "the attitude turns by ω π/180, as though ω were in degrees per second"},
        {1 / degree, "degrees", "the attitude turns by ω 180/π, as though degrees were radians"}}) {
    changes.add(cause, words, Part::turning, [factor = factor](Hypothesis& h) { h.equations.turning = factor; });
  }
}

void add_wrong_inertias(SingleChanges& changes, std::size_t moving, bool forces_exert_torques) {
  for (std::size_t i = 0; i < moving; ++i) {
    const Body& body = changes.plain.problem.bodies[i];
    for (const OtherInertia& other : other_inertias(body, forces_exert_torques)) {
      changes.add("inertia", moving > 1 ? fmt::format("{} (body {})", other.words, body.name) : other.words,
                  Part::inertia, [&](Hypothesis& h) { h.problem.bodies[i].inertia = other.inertia; });
    }
  }
}

}  // namespace

Hypothesis with_cause(Hypothesis h, const char* cause, std::string words, Part touched) {
  h.causes.emplace_back(cause);
  h.words.push_back(std::move(words));
  h.touched.insert(touched);
  return h;
}

bool disjoint(const Hypothesis& a, const Hypothesis& b) {
  return std::none_of(a.touched.begin(), a.touched.end(), [&](Part part) { return b.touched.contains(part); });
}

Hypothesis both(const Hypothesis& a, const Hypothesis& b) {
  Hypothesis h = a;
  h.causes.insert(h.causes.end(), b.causes.begin(), b.causes.end());
  h.words.insert(h.words.end(), b.words.begin(), b.words.end());
  h.touched.insert(b.touched.begin(), b.touched.end());
  for (const Part part : b.touched) take_part(h, b, part);
  return h;
}

std::vector<Hypothesis> other_readings(const Hypothesis& plain, const Trajectory& trajectory) {
  SingleChanges changes{plain};
  changes.add("transposed",
              trajectory.has_matrix ? "its rotation matrices are transposed (world to body)"
                                    : "its quaternions are conjugated (world to body)",
              Part::attitude_columns, [](Hypothesis& h) { h.reading.transposed = true; });
  if (!trajectory.has_matrix) {
    changes.add("quaternion_order", "its quaternions stand in the order x, y, z, w", Part::attitude_columns,
                [](Hypothesis& h) { h.reading.order = Reading::Order::xyzw; });
    changes.add("quaternion_order", "its quaternions stand in the order z, w, x, y", Part::attitude_columns,
                [](Hypothesis& h) { h.reading.order = Reading::Order::zwxy; });
  }
  changes.add(
      "omega_frame",
      trajectory.has_angular_velocity ? "its angular velocity is in body axes" : "its angular momentum is in body axes",
      Part::rate_frame, [](Hypothesis& h) { h.reading.rates_in_body = true; });
  if (trajectory.has_angular_velocity) {
    for (const auto& [unit, cause, words] :
         {std::tuple{degree, "degrees", "its angular velocity is in degrees per second"},
          {2 * std::numbers::pi, "revolutions", "its angular velocity is in revolutions per second"},
          {2 * std::numbers::pi / 60, "revolutions", "its angular velocity is in revolutions per minute"}}) {
      changes.add(cause, words, Part::rate_unit, [unit = unit](Hypothesis& h) { h.reading.rate_unit = unit; });
    }
  }
  return std::move(changes.list);
}

std::vector<Hypothesis> other_motions(const Hypothesis& plain, std::size_t moving, bool forces_exert_torques) {
  SingleChanges changes{plain};
  add_wrong_equations(changes);
  add_wrong_starts(changes, moving);
  add_wrong_inertias(changes, moving, forces_exert_torques);
  return std::move(changes.list);
}

}  // namespace polhode::study::judge
