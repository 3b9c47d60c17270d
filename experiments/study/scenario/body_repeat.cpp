// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/scenario/body_repeat.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "core/math/portable_random.hpp"
#include "core/math/quaternion.hpp"
#include "experiments/study/scenario/scenario_keys.hpp"
#include "experiments/study/text/value_lists.hpp"

namespace polhode::study::inline scenario {

namespace {

using Counts = std::array<int, 3>;

constexpr double most_bodies = 10'000;

Counts read_counts(const TomlCursor& repeat) {
  constexpr std::string_view must_be = "3 whole numbers from 1, the copies along x, y and z";
  const Vector3<double> n = repeat.vector("copies");
  if (n != n.array().floor().matrix() || !(n.minCoeff() >= 1)) repeat.refuse(must_be);
  if (!(n.prod() <= most_bodies))
    repeat.fail("asks for " + exact(n.prod()) + " copies; it must be at most " + exact(most_bodies));
  return {int(n[0]), int(n[1]), int(n[2])};
}

Vector3<double> read_spacing(const TomlCursor& spacing, const Counts& counts) {
  const Vector3<double> apart = spacing.vector("m");
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (counts[axis] == 1 || apart[Eigen::Index(axis)] != 0) continue;
    spacing.fail("is 0 along " + std::string(1, "xyz"[axis]) + ", where there are " + std::to_string(counts[axis]) +
                 " copies; give the distance from one to the next");
  }
  return apart;
}

/// A turn about a random direction by up to `most` (rad), after the body's own orientation.
Quaternion<double> turned(const Quaternion<double>& q, double most, PortableRandom& random) {
  const Vector3<double> axis = random.direction();
  const double half = 0.5 * random.uniform(-most, most);
  const Quaternion<double> turn(std::cos(half), std::sin(half) * axis[0], std::sin(half) * axis[1],
                                std::sin(half) * axis[2]);
  return product(turn, q);
}

}  // namespace

std::vector<ReadBody> repeated(const TomlCursor& table, std::size_t index, ReadBody body) {
  if (!table.has("repeat")) {
    for (const std::string_view other : {"spacing", "jitter", "jitter_angle"}) {
      if (table.has(other)) body_key(table, other).fail("is of the copies of a body; give repeat = [nx, ny, nz] too");
    }
    return {std::move(body)};
  }
  const Counts counts = read_counts(table.at("repeat", ""));
  const Vector3<double> spacing = read_spacing(body_key(table, "spacing"), counts);
  const double jitter = body_key(table, "jitter").number("m", Parameter::Range::non_negative);
  const TomlCursor angle = body_key(table, "jitter_angle");
  const double jitter_angle = angle.number("rad", Parameter::Range::non_negative);
  if (jitter_angle > std::numbers::pi) angle.refuse("a number from 0 to pi, of rad");
  PortableRandom random(index);
  std::vector<ReadBody> copies;
  for (int z = 0; z < counts[2]; ++z) {
    for (int y = 0; y < counts[1]; ++y) {
      for (int x = 0; x < counts[0]; ++x) {
        ReadBody& copy = copies.emplace_back(body);
        copy.body.name += '_' + std::to_string(copies.size() - 1);
        copy.start.position += spacing.cwiseProduct(Vector3<double>(x, y, z));
        if (jitter > 0) copy.start.position += random.uniform_vector(-jitter, jitter);
        if (!copy.start.position.allFinite())
          table.fail("its copies stand too far away for a number; take a smaller spacing or jitter");
        if (jitter_angle > 0) copy.start.orientation = turned(body.start.orientation, jitter_angle, random);
      }
    }
  }
  return copies;
}

}  // namespace polhode::study::scenario
