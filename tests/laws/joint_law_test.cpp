// SPDX-License-Identifier: BSD-3-Clause
// The laws of a joint, for every entry of the catalogue between every pair of kinds of bodies: a new joint needs
// nothing here unless its equations hold at the start only for special values of its keys.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/joints/catalogue.hpp"
#include "core/math/portable_random.hpp"
#include "core/system/constraints.hpp"
#include "core/system/joint_projection.hpp"
#include "tests/laws/problems.hpp"

namespace polhode::laws::joint_law_test {
namespace {

using Real = long double;
using Flat = VectorX<Real>;
using Motions = std::vector<BodyMotion<Real>>;

// The bodies of a trial: two free, one pinned with its mass centre off the pivot, one static.
enum Index : std::size_t { a, b, pinned, fixed };

struct Trial {
  std::string name;
  Problem problem;
};

Problem bodies(PortableRandom& random) {
  Problem p;
  for (std::size_t i = 0; i < 4; ++i) {
    Body body;
    body.name = "body" + std::to_string(i);
    body.mass = random.uniform(0.5, 2);
    body.inertia = turned_inertia({0.5, 0.8, 0.4}, random.turn());
    if (i == pinned) {
      body.pinned = true;
      body.center_of_mass = random.uniform_vector(-0.2, 0.2);
    }
    body.fixed = i == fixed;
    BodyStart start;
    start.position = random.uniform_vector(-1, 1);
    start.orientation = random.turn();
    if (i != fixed) start.angular_velocity = random.uniform_vector(-2, 2);
    if (i != pinned && i != fixed) start.velocity = random.uniform_vector(-1, 1);
    p.bodies.push_back(body);
    p.starts.push_back(start);
  }
  p.forces.push_back(force("uniform_gravity", {a, b, pinned}, {{"acceleration", Vector3<double>(0.5, 1, -9.81)}}));
  return p;
}

/// A joint of the kind that is closed at the start: its keys are random, but for those that the start decides.
JointParameters closed(const JointKind& kind, std::vector<std::size_t> ends, const Problem& p, PortableRandom& random,
                       const Values& given = {}) {
  JointParameters joint{"joint", {kind.name, ends, {}}};
  for (const Parameter& key : kind.parameters) {
    ParameterValue value = key.value;
    if (std::holds_alternative<Vector3<double>>(value)) value = random.uniform_vector(-0.5, 0.5);
    else if (key.need == Parameter::Need::required) value = 0.7;
    joint.of.values[key.key] = given.contains(key.key) ? given.at(key.key) : value;
  }
  const auto turn = [&](std::size_t i) { return rotation_matrix<double>(p.starts[i].orientation); };
  const auto place_far_end = [&](const Vector3<double>& x) {
    if (ends.size() == 1) joint.of.values["anchor_world"] = x;
    else
      joint.of.values["anchor_body_2"] = Vector3<double>(turn(ends[1]).transpose() * (x - p.starts[ends[1]].position));
  };
  if (kind.name == "universal") {
    const Vector3<double> axis = turn(ends[0]) * joint.of.vector("axis_body").normalized();
    const Vector3<double> across = axis.unitOrthogonal();
    joint.of.values["axis_body_2"] = ends.size() == 1 ? across : Vector3<double>(turn(ends[1]).transpose() * across);
  }
  if (kind.name == "distance") return joint;  // its length is that of the start
  std::vector<BodyMotion<double>> motions;
  for (std::size_t i = 0; i < p.bodies.size(); ++i) {
    motions.push_back({p.starts[i].position, turn(i), Vector3<double>::Zero(), Vector3<double>::Zero()});
  }
  place_far_end(make_joint<double>(joint, p.starts)->anchor(motions));
  return joint;
}

std::vector<Trial> trials() {
  std::vector<Trial> all;
  std::uint64_t seed = 1;
  for (const JointEntry& entry : joint_catalogue()) {
    // A joint of a pinned body with the world would leave it too few freedoms.
    const std::vector<std::pair<std::string, std::vector<std::size_t>>> ends = {{"free_world", {a}},
                                                                                {"free_free", {a, b}},
                                                                                {"free_pinned", {b, pinned}},
                                                                                {"pinned_free", {pinned, a}},
                                                                                {"free_static", {a, fixed}}};
    for (const auto& [name, indices] : ends) {
      PortableRandom random(++seed);
      Problem p = bodies(random);
      p.joints.push_back(closed(entry.kind, indices, p, random));
      all.push_back({entry.kind.name + "_" + name, p});
    }
  }
  PortableRandom random(99);
  Problem p = bodies(random);
  p.joints.push_back(
      closed(find_joint("rolling")->kind, {a, b}, p, random, {{"axis_body", Vector3<double>(0, 0, 0)}}));  // a sphere
  all.push_back({"rolling_sphere", p});
  return all;
}

class JointLaw : public testing::TestWithParam<Trial> {
 protected:
  /// A system of ω in world axes, so that displacements leave the velocities as they are.
  std::unique_ptr<System<Real>> system_ = make_system<Real>(GetParam().problem, {});
  const Constraints<Real>& constraints() const { return *system_->constraints(); }

  /// A state near the start with the joint neither closed nor at rest.
  Flat drifted(double distance) const {
    Flat y = system_->start().y;
    PortableRandom random(5);
    for (std::size_t i = 0; i < system_->moving(); ++i) {
      const Vector3<double> shift = distance * random.uniform_vector(-1, 1),
                            turn = distance * random.uniform_vector(-1, 1);
      system_->displace(y, i, shift.cast<Real>(), turn.cast<Real>());
    }
    return y;
  }
  /// The state after every body has moved for s (s) with constant v and ω.
  Flat carried(Flat y, Real s) const {
    for (std::size_t i = 0; i < system_->moving(); ++i) {
      const BodyMotion<Real> m = system_->motion_of(y, i);
      system_->displace(y, i, s * m.velocity, s * m.angular_velocity);
    }
    return y;
  }
  std::vector<ConstraintRow<Real>> rows(const Flat& y) const {
    const JointModel<Real>& joint = constraints().joint(0);
    std::vector<ConstraintRow<Real>> all(joint.rows());
    joint.evaluate(motions_of(*system_, y), all);
    return all;
  }
  Real rate(const ConstraintRow<Real>& row, const Flat& y) const {
    const JointModel<Real>& joint = constraints().joint(0);
    const auto of = [&](const Wrench<Real>& w, std::size_t i) {
      const BodyMotion<Real> m = system_->motion_of(y, i);
      return w.force.dot(m.velocity) + w.torque.dot(m.angular_velocity);
    };
    return of(row.first, joint.first()) + (joint.second() ? of(row.second, *joint.second()) : Real(0));
  }
};

constexpr Real small_step = 1e-5L;
constexpr double of_differences = 2e-8;  // central differences in long double

TEST_P(JointLaw, HasAsManyRowsAsItsKindSays) {
  const JointKind& kind = find_joint(GetParam().problem.joints[0].of.kind)->kind;
  EXPECT_EQ(constraints().rows(), std::size_t(kind.rows));
  EXPECT_FALSE(kind.summary.empty());
}

TEST_P(JointLaw, IsClosedAtTheStart) {
  const auto v = constraints().violation(0, motions_of(*system_, system_->start().y));
  EXPECT_LT(std::max(v.position, v.angle), 1e-15);
}

TEST_P(JointLaw, RowsAreTheDerivativeOfTheResidual) {
  const Flat y = drifted(0.05);
  const auto before = rows(carried(y, -small_step)), now = rows(y), after = rows(carried(y, small_step));
  for (std::size_t k = 0; k < now.size(); ++k) {
    if (!now[k].holonomic) continue;
    EXPECT_NEAR(double((after[k].residual - before[k].residual) / (2 * small_step)), double(rate(now[k], y)),
                of_differences)
        << k;
  }
}

TEST_P(JointLaw, GammaIsMinusTheRateOfTheRows) {
  const Flat y = drifted(0.05), back = carried(y, -small_step), on = carried(y, small_step);
  const auto before = rows(back), now = rows(y), after = rows(on);
  for (std::size_t k = 0; k < now.size(); ++k) {
    EXPECT_NEAR(double((rate(after[k], on) - rate(before[k], back)) / (2 * small_step)), double(-now[k].gamma),
                10 * of_differences)
        << k;
  }
}

TEST_P(JointLaw, ReactionsKeepTheVelocityEquations) {
  const Flat y = drifted(0.05);
  Flat dy = Flat::Zero(y.size());
  system_->rate(Real(0), y.data(), dy.data());
  const Flat back = y - small_step * dy, on = y + small_step * dy;
  const auto before = rows(back), after = rows(on);
  for (std::size_t k = 0; k < after.size(); ++k) {
    EXPECT_NEAR(double((rate(after[k], on) - rate(before[k], back)) / (2 * small_step)), 0, 50 * of_differences) << k;
  }
}

TEST_P(JointLaw, ReactionsDoNoWorkAndAddNoMomentum) {
  Flat y = system_->start().y;
  project_joint_velocities(*system_, y);
  const Motions motions = motions_of(*system_, y);
  std::vector<Wrench<Real>> wrenches(motions.size());
  constraints().add_reactions(motions, wrenches);
  Real power = 0, size = 0;
  Vector3<Real> force = Vector3<Real>::Zero(), torque = Vector3<Real>::Zero();
  for (std::size_t i = 0; i < system_->moving(); ++i) {
    const Wrench<Real>& w = wrenches[i];
    power += w.force.dot(motions[i].velocity) + w.torque.dot(motions[i].angular_velocity);
    force += w.force;
    torque += w.torque + motions[i].position.cross(w.force);
    size += w.force.norm() + w.torque.norm();
  }
  // Forces that a static or pinned body passes on to the world are not among the wrenches of a body.
  const auto second = constraints().joint(0).second();
  EXPECT_NEAR(double(power), 0, 1e-15 * double(size));
  EXPECT_NEAR(double(constraints().power()), 0, 1e-15 * double(size));
  if (!second || *second == fixed) return;
  EXPECT_NEAR(double(force.norm()), 0, 1e-15 * double(size));
  EXPECT_NEAR(double(torque.norm()), 0, 1e-14 * double(size));
}

TEST_P(JointLaw, PowerIsThatOfTheReactions) {
  const Flat y = drifted(0.05);
  const Motions motions = motions_of(*system_, y);
  std::vector<Wrench<Real>> wrenches(motions.size());
  constraints().add_reactions(motions, wrenches);
  Real power = 0;
  for (std::size_t i = 0; i < system_->moving(); ++i) {
    power += wrenches[i].force.dot(motions[i].velocity) + wrenches[i].torque.dot(motions[i].angular_velocity);
  }
  EXPECT_NEAR(double(constraints().power()), double(power), 1e-13 * (1 + std::abs(double(power))));
}

TEST_P(JointLaw, ProjectionClosesTheJoint) {
  for (const AngularState state :
       {AngularState::velocity_world, AngularState::velocity_body, AngularState::momentum_world}) {
    const auto system = make_system<double>(GetParam().problem, {.angular_state = state});
    VectorX<double> y = system->start().y;
    PortableRandom random(6);
    for (std::size_t i = 0; i < system->moving(); ++i) {
      const Vector3<double> shift = 0.02 * random.uniform_vector(-1, 1), turn = 0.02 * random.uniform_vector(-1, 1);
      system->displace(y, i, shift, turn);
    }
    const auto open = system->constraints()->violation(0, motions_of(*system, y));
    EXPECT_GT(std::max(open.position, open.angle), 1e-4);
    project_joint_positions(*system, y);
    project_joint_velocities(*system, y);
    const auto v = system->constraints()->violation(0, motions_of(*system, y));
    EXPECT_LT(std::max(v.position, v.angle), 1e-14);
    EXPECT_LT(std::max(v.velocity, v.rate), 1e-14);
  }
}

/// The correction of the velocity by a projection needs the least kinetic energy of all corrections: its impulses are a
/// combination of the rows, so that the correction is orthogonal in the metric of the masses to what the joint leaves
/// free.
TEST_P(JointLaw, ProjectionIsOrthogonalInTheMetricOfTheMasses) {
  const Flat y = drifted(0.05);
  Flat closed = y, other = y;
  project_joint_velocities(*system_, closed);
  PortableRandom random(7);
  for (std::size_t i = 0; i < system_->moving(); ++i) {
    const Vector3<double> j = random.uniform_vector(-1, 1), l = random.uniform_vector(-1, 1);
    system_->apply_impulse(other, i, j.cast<Real>(), l.cast<Real>());
  }
  project_joint_velocities(*system_, other);
  Real product = 0;
  for (std::size_t i = 0; i < system_->moving(); ++i) {
    const BodyMotion<Real> from = system_->motion_of(y, i), to = system_->motion_of(closed, i),
                           free = system_->motion_of(other, i);
    const Matrix3<Real> inertia =
        from.rotation * GetParam().problem.bodies[i].inertia.cast<Real>() * from.rotation.transpose();
    if (i != pinned) {
      product +=
          Real(GetParam().problem.bodies[i].mass) * (to.velocity - from.velocity).dot(free.velocity - to.velocity);
    }
    product +=
        (inertia * (to.angular_velocity - from.angular_velocity)).dot(free.angular_velocity - to.angular_velocity);
  }
  EXPECT_NEAR(double(product), 0, 1e-15);
}

INSTANTIATE_TEST_SUITE_P(Catalogue, JointLaw, testing::ValuesIn(trials()),
                         [](const auto& trial) { return trial.param.name; });

}  // namespace
}  // namespace polhode::laws::joint_law_test
