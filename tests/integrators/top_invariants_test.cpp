// SPDX-License-Identifier: BSD-3-Clause
// The invariants of slow heavy tops along RK4.
#include <algorithm>

#include "tests/integrators/motion.hpp"

namespace polhode::by_hand::top_invariants_test {
namespace {

using laws::gyroscopic_formulations;
using laws::label;

struct Drift {
  double energy = 0, p_phi = 0, p_psi = 0, kovalevskaya = 0;  // relative drifts
};
/// The largest drifts over 10 s of RK4 at 1e-4, looked at every 0.05 s. k = mgl/I3.
Drift drift_of_top(const Problem& p, const Formulation& f, double k) {
  Motion run("rk4", p, f);
  const auto values = [&] {
    const BodySnapshot<double> s = run.body();
    const Matrix3<double> to_body = s.rotation.transpose();
    const V3 w = to_body * s.angular_velocity, gamma = to_body.col(2);
    Drift v;
    v.energy = run.energy();
    v.p_phi = s.angular_momentum[2];
    v.p_psi = (to_body * s.angular_momentum)[2];
    v.kovalevskaya =
        std::pow(w[0] * w[0] - w[1] * w[1] - k * gamma[0], 2) + std::pow(2 * w[0] * w[1] - k * gamma[1], 2);
    return v;
  };
  const Drift start = values();
  Drift most;
  const auto keep = [](double& largest, double now, double then) {
    largest = std::max(largest, std::abs(now - then) / std::abs(then));
  };
  for (int n = 0; n < 200; ++n) {
    run.steps(1e-4, 500);
    const Drift v = values();
    keep(most.energy, v.energy, start.energy);
    keep(most.p_phi, v.p_phi, start.p_phi);
    keep(most.p_psi, v.p_psi, start.p_psi);
    keep(most.kovalevskaya, v.kovalevskaya, start.kovalevskaya);
  }
  return most;
}

/// A pinned top with its mass centre at l along the body's axis `axis`; orientation and spin of nothing special.
Problem top(const V3& moments, int axis) {
  Problem p;
  V3 center = V3::Zero();
  center[axis] = 0.4;
  p.bodies.push_back(
      {.name = "top", .mass = 1.5, .inertia = moments.asDiagonal(), .pinned = true, .center_of_mass = center});
  p.starts.push_back({.orientation = Quaternion<double>(0.8, 0.3, -0.4, 0.2).normalized(),
                      .angular_velocity = {1.5, -0.7, 2.5},
                      .angular_velocity_in_body = true});
  p.forces.push_back(laws::force("uniform_gravity", {0}, {{"acceleration", V3(0, 0, -9.81)}}));
  return p;
}
constexpr double top_weight = 1.5 * 9.81 * 0.4;  // weight times lever arm m g l, N m

TEST(Tops, SlowLagrangeKeepsEnergyAndBothMomenta) {
  for (const Formulation& f : gyroscopic_formulations()) {
    const Drift d = drift_of_top(top({0.9, 0.9, 0.4}, 2), f, top_weight / 0.4);
    EXPECT_LT(d.energy, 1e-10) << label(f);
    EXPECT_LT(d.p_phi, 1e-10) << label(f);
    EXPECT_LT(d.p_psi, 1e-10) << label(f);
    EXPECT_GT(d.kovalevskaya, 1e-3) << "which is no invariant here";
  }
}

// J = (2, 2, 1) I3, mass centre along e1.
TEST(Tops, SlowKovalevskayaKeepsHerIntegral) {
  for (const Formulation& f : gyroscopic_formulations()) {
    const Drift d = drift_of_top(top({0.8, 0.8, 0.4}, 0), f, top_weight / 0.4);
    EXPECT_LT(d.energy, 1e-10) << label(f);
    EXPECT_LT(d.p_phi, 1e-10) << label(f);
    EXPECT_LT(d.kovalevskaya, 1e-10) << label(f);
    EXPECT_GT(d.p_psi, 1e-3) << "which is no invariant here";
  }
}

}  // namespace
}  // namespace polhode::by_hand::top_invariants_test
