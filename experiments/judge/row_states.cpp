// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/judge/row_states.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "experiments/study/scenario/characteristic_rate.hpp"

namespace polhode::study::judge {
namespace {

/// Spans spread evenly over the trajectory. Each is half a radian long, or one row if rows are further apart.
std::vector<std::pair<std::size_t, std::size_t>> spans_of(const std::vector<double>& t, double rate) {
  constexpr double long_enough = 0.5;  // length of a span, rad
  constexpr std::size_t most = 32;
  const std::size_t n = t.size();
  const auto end_of = [&](std::size_t from) {
    std::size_t to = from + 1;
    while (to + 1 < n && (t[to] - t[from]) * rate < long_enough) ++to;
    return to;
  };
  std::size_t last = n - 2;
  while (last > 0 && (t[n - 1] - t[last]) * rate < long_enough) --last;
  const std::size_t count = std::min(most, last + 1);
  std::vector<std::pair<std::size_t, std::size_t>> spans;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t from = count > 1 ? i * last / (count - 1) : 0;
    spans.emplace_back(from, end_of(from));
  }
  return spans;
}

/// Rows spread evenly over the first two radians.
std::vector<std::size_t> first_rows_of(const std::vector<double>& t, double rate) {
  constexpr double at_first = 2;  // rad
  constexpr std::size_t most = 12, fewest = 3;
  std::size_t ends = 1;
  while (ends < t.size() && (ends < fewest || t[ends] * rate <= at_first)) ++ends;
  const std::size_t count = std::min(most, ends);
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < count; ++i) rows.push_back(count > 1 ? i * (ends - 1) / (count - 1) : 0);
  return rows;
}

}  // namespace

RowStates::RowStates(const Trajectory& of, const Scenario& meant)
    : trajectory(of),
      scenario(meant),
      right(meant.problem, {}),
      exact(right.system()),
      rate(characteristic_rate(meant.problem).value_or(1 / of.times.back())),
      spacing((of.times.back() - of.times.front()) / static_cast<double>(of.times.size() - 1) * rate),
      spans(spans_of(of.times, rate)),
      first(first_rows_of(of.times, rate)) {
  for (const auto& [from, to] : spans)
    span += (of.times[to] - of.times[from]) * rate / static_cast<double>(spans.size());
}

VectorX<double> RowStates::state(std::size_t row, const Reading& reading) const {
  const System<double>& system = right.system();
  VectorX<double> y = system.start().y;
  for (std::size_t i = 0; i < trajectory.moving; ++i) {
    const BodySnapshot<double>& body = trajectory.bodies[row * trajectory.moving + i];
    const Layout::Slot s = system.layout().slots[i];
    const Quaternion<double> q = read_so(body.orientation, reading).normalized();
    const Matrix3<double> r = rotation_matrix(q);
    Vector3<double> omega = body.angular_velocity * reading.rate_unit;
    if (trajectory.has_angular_velocity) {
      if (reading.rates_in_body) omega = (r * omega).eval();
    } else {
      const Vector3<double>& l = body.angular_momentum;
      omega = r * (system.inverse_inertia(i) * (reading.rates_in_body ? l : Vector3<double>(r.transpose() * l)));
    }
    y.segment<4>(s.orientation) = q;
    y.segment<3>(s.angular) = omega;
    if (s.position < 0) continue;
    const bool all_there = trajectory.has_position && trajectory.has_velocity;
    const auto path = all_there ? std::nullopt : exact.at(trajectory.times[row], i).path;
    y.segment<3>(s.position) = trajectory.has_position ? body.position
                               : path                  ? path->position
                                                       : y.segment<3>(s.position);
    y.segment<3>(s.velocity) = trajectory.has_velocity ? body.velocity
                               : path                  ? path->velocity
                                                       : y.segment<3>(s.velocity);
  }
  return y;
}

VectorX<double> RowStates::start(const Reading& reading) const {
  const System<double>& system = right.system();
  VectorX<double> y = system.start().y;
  for (std::size_t i = 0; i < trajectory.moving; ++i) {
    const BodyStart& body = scenario.problem.starts[i];
    const Layout::Slot s = system.layout().slots[i];
    const Quaternion<double> q = read_so(body.orientation, reading);
    const bool in_body = body.angular_velocity_in_body != reading.rates_in_body;
    const Vector3<double> omega = body.angular_velocity * reading.rate_unit;
    y.segment<4>(s.orientation) = q.normalized();
    y.segment<3>(s.angular) = in_body ? Vector3<double>(rotation_matrix(q) * omega) : omega;
  }
  return y;
}

double RowStates::distance(const VectorX<double>& a, const VectorX<double>& b) const {
  double sum = 0;
  for (const Layout::Slot& s : right.system().layout().slots) {
    const Quaternion<double> p = a.segment<4>(s.orientation), q = b.segment<4>(s.orientation);
    const Vector3<double> difference = a.segment<3>(s.angular) - b.segment<3>(s.angular);
    sum += std::pow(angle_between(p, q), 2) + difference.squaredNorm() / (rate * rate);
  }
  const double d = std::sqrt(sum / static_cast<double>(trajectory.moving));
  return d < std::numbers::pi ? d : std::numbers::pi;
}

bool RowStates::knows_paths() const {
  const auto& bodies = scenario.problem.bodies;
  const bool all_pinned = std::all_of(bodies.begin(), bodies.begin() + static_cast<std::ptrdiff_t>(trajectory.moving),
                                      [](const Body& body) { return body.pinned; });
  return all_pinned || (trajectory.has_position && trajectory.has_velocity) || exact.has_position();
}

std::size_t RowStates::stride_for(std::size_t count) const { return std::max<std::size_t>(1, spans.size() / count); }

}  // namespace polhode::study::judge
