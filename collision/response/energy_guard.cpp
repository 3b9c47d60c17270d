// SPDX-License-Identifier: BSD-3-Clause
#include "collision/response/energy_guard.hpp"

#include <algorithm>
#include <cmath>

namespace polhode::inline collision::inline response {
namespace {

Vector3<double> relative(std::span<const ImpulseBody> bodies, const ImpulseContact& c) {
  return bodies[c.a].velocity_at(c.point) - bodies[c.b].velocity_at(c.point);
}

void push(std::span<ImpulseBody> bodies, const ImpulseContact& c, const Vector3<double>& impulse) {
  bodies[c.a].push(c.point, impulse);
  bodies[c.b].push(c.point, -impulse);
}

}  // namespace

double share_without_gain(double start, double slope, double end) {
  if (!(end > 0)) return 1;
  // q s² + slope s + start = 0 with start <= 0 < end: one root in [0, 1), in the form that does not cancel.
  const double q = end - start - slope, root = std::sqrt(std::max(0.0, slope * slope - 4 * q * start));
  const double s = slope <= 0 ? (root - slope) / (2 * q) : -2 * start / (slope + root);
  return std::isfinite(s) ? std::clamp(s, 0.0, 1.0) : 0;
}

bool EnergyGuard::gains(std::span<const ImpulseBody> bodies, std::span<const ImpulseContact> contacts) {
  islands_.build(bodies, contacts);
  after_.assign(bodies.begin(), bodies.end());
  for (const ImpulseContact& c : contacts) push(after_, c, c.impulse);
  gaining_.clear();
  for (std::uint32_t k = 0; k < islands_.count(); ++k) {
    Gain gain;
    for (const std::uint32_t i : islands_.contacts(k)) {
      const ImpulseContact& c = contacts[i];
      const Vector3<double> before = relative(bodies, c), after = relative(after_, c);
      gain.energy += 0.5 * c.impulse.dot(before + after);
      gain.scale += 0.5 * c.impulse.norm() * (before.norm() + after.norm());
    }
    if (gain.rises()) gaining_.push_back(k);
  }
  return !gaining_.empty();
}

void EnergyGuard::limit(std::span<const ImpulseBody> bodies, std::span<ImpulseContact> contacts,
                        std::span<const Vector3<double>> reference) {
  after_reference_.assign(bodies.begin(), bodies.end());
  for (std::size_t i = 0; i < contacts.size(); ++i) push(after_reference_, contacts[i], reference[i]);
  for (const std::uint32_t k : gaining_) {
    double end = 0, start = 0, slope = 0, slope_from_rest = 0;
    for (const std::uint32_t i : islands_.contacts(k)) {
      const ImpulseContact& c = contacts[i];
      const Vector3<double> before = relative(bodies, c), after = relative(after_, c),
                            there = relative(after_reference_, c);
      end += 0.5 * c.impulse.dot(before + after);
      start += 0.5 * reference[i].dot(before + there);
      slope += (c.impulse - reference[i]).dot(there);
      slope_from_rest += c.impulse.dot(before);
    }
    const bool takes = start <= 0;
    const double s = takes ? share_without_gain(start, slope, end) : share_without_gain(0, slope_from_rest, end);
    for (const std::uint32_t i : islands_.contacts(k)) {
      const Vector3<double> from = takes ? reference[i] : Vector3<double>::Zero();
      contacts[i].impulse = from + s * (contacts[i].impulse - from);
    }
  }
}

}  // namespace polhode::collision::response
