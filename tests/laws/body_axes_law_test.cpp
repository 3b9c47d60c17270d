// SPDX-License-Identifier: BSD-3-Clause
// The primitives of a system in body axes: one mechanics, whatever the formulation.
#include <gtest/gtest.h>

#include "core/system/rigid_bodies.hpp"
#include "tests/laws/formulations.hpp"
#include "tests/laws/problems.hpp"

namespace polhode::laws {
namespace {

// The primitives in body axes against the snapshot, the flat right-hand side and the momentum in the world.
TEST(BodyAxesLaw, IsTheSameMechanicsInEveryFormulation) {
  for (const Problem& problem : {box_on_spring(), five_bodies()}) {
    for (const Formulation& f : gyroscopic_formulations()) {
      SCOPED_TRACE(label(f));
      const auto erased = make_system<double>(problem, f);
      visit_system(*erased, [&](const auto& system) {
        auto y = system.zero();
        y = system.start().y;
        auto twist = system.zero_tangent(), wrench = twist, rate = twist, momentum = twist, after = twist,
             ahead = twist;
        system.body_twist(y, twist);
        const BodySnapshot<double> body = system.snapshot(y, 0);
        const Vector3<double> w = body.rotation.transpose() * body.angular_velocity;
        EXPECT_LT((twist.template segment<3>(3) - w).norm(), 1e-14);
        EXPECT_EQ((twist.template head<3>()), body.velocity);

        auto other = y;
        system.set_body_twist(rate, other);
        system.set_body_twist(twist, other);
        EXPECT_LT((other - y).cwiseAbs().maxCoeff(), 1e-14);

        // Its rate under the wrench: a central difference along the flow.
        system.wrench(0, y, wrench);
        system.body_acceleration(y, wrench, rate);
        auto flow = y;
        system.rate(0.0, y, flow);
        const double d = 1e-6;
        other = y + d * flow;
        system.body_twist(other, ahead);
        other = y - d * flow;
        system.body_twist(other, after);
        EXPECT_LT(((ahead - after) / (2 * d) - rate).cwiseAbs().maxCoeff(), 1e-8);

        system.momentum(y, momentum);
        other = y;
        auto moved = y;
        rate = 0.3 * twist;
        system.carry_momentum(rate, wrench, other);
        system.retract_in_body(moved, rate);
        EXPECT_EQ(system.configuration_part(other), system.configuration_part(moved));
        system.momentum(other, after);
        EXPECT_LT((after - momentum - wrench).cwiseAbs().maxCoeff(), 1e-13);

        system.bracket(twist, wrench, after);
        const Vector3<double> a = twist.template segment<3>(3), b = wrench.template segment<3>(3);
        EXPECT_EQ((after.template segment<3>(3)), a.cross(b));
        EXPECT_EQ((after.template head<3>()), Vector3<double>::Zero());
      });
    }
  }
}

}  // namespace
}  // namespace polhode::laws
