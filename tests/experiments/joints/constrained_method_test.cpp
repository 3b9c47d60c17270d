// SPDX-License-Identifier: BSD-3-Clause
// Methods that solve the equations of joints themselves, against exact motions and reactions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "tests/experiments/joints/joint_run.hpp"

namespace polhode::study::joints_tests::constrained_method_test {
namespace {

End run_with(const std::string& method, const std::string& scenario, double dt_or_tolerance, double t_end,
             Stabilization stabilization = Stabilization::none) {
  return run(scenario, dt_or_tolerance, t_end, stabilization, AngularState::velocity_world, method);
}

TEST(ConstrainedMethod, PendulumOnARod) {
  const Vector exact(-0.27508746257611686, -0.961419205099125064, 0);
  for (const std::string method : {"ida_index1", "ida_index2", "ida_ggl", "ida_ah"}) {
    SCOPED_TRACE(method);
    const End end = run_with(method, "rod_pendulum", 1e-12, 10);
    EXPECT_LT((end.point(0, Vector::Zero()) - exact).norm(), 1e-8);
    EXPECT_NEAR(reaction(end, 0).norm(), 28.29456720606725, method == "ida_index1" ? 2e-7 : 1e-7);
    EXPECT_LT(end.largest_gap, method == "ida_ggl" || method == "ida_ah" ? 1e-11 : 1e-8);
  }
  const End third = run_with("ida_index3", "rod_pendulum", 1e-12, 10);
  EXPECT_LT((third.point(0, Vector::Zero()) - exact).norm(), 1e-5);
}

/// The largest error of the angles of the squeezer at 0.03 s, and of the forces at the point where three bodies meet.
std::pair<double, double> squeezer_errors(const End& end) {
  const double beta = 15.8107711951537070971, theta = -15.7563710584118394697, gamma = 0.0408222401196458048583,
               phi = -0.534730116342079593770, delta = 0.524409965879954069372, epsilon = 1.04808074104193787307;
  const double angles[] = {beta, beta + theta, gamma, phi + delta, delta, -phi + epsilon, epsilon};
  double worst = 0, worst_force = 0;
  for (std::size_t i = 0; i < 7; ++i) {
    const BodyMotion<double> m = end.motion(i);
    const double angle = std::atan2(m.rotation(1, 0), m.rotation(0, 0));
    worst = std::max(worst, std::abs(std::remainder(angle - angles[i], 2 * std::numbers::pi)));
  }
  const std::pair<const char*, Vector> multipliers[] = {
      {"k3 at P", {199.175348104538628186, -29.7553099749717633244, 0}},
      {"k4 at P", {23.0665436116221511286, 31.4527252757711370754, 0}},
      {"k6 at P", {22.6424947863943785777, 11.6173923526112559068, 0}}};
  for (const auto& [name, force] : multipliers) {
    std::size_t joint = 0;
    while (end.system->constraints()->name(joint) != name) ++joint;
    worst_force = std::max(worst_force, (reaction(end, joint) - force).norm());
  }
  return {worst, worst_force};
}

TEST(ConstrainedMethod, Squeezer) {
  struct Bound {
    const char* method;
    double angle, force;
    Stabilization stabilization = Stabilization::none;
  };
  for (const Bound& b : {Bound{"ida_index1", 1e-8, 1e-6}, Bound{"ida_index2", 1e-8, 1e-6}, Bound{"ida_ggl", 1e-8, 1e-6},
                         Bound{"ida_ah", 1e-8, 1e-6}, Bound{"ida_index3", 1e-5, 1e-2},
                         Bound{"cvode_bdf", 1e-8, 1e-6, Stabilization::both}}) {
    SCOPED_TRACE(b.method);
    const auto [angle, force] = squeezer_errors(run_with(b.method, "squeezer", 1e-12, 0.03, b.stabilization));
    EXPECT_LT(angle, b.angle);
    EXPECT_LT(force, b.force);
  }
}

/// Backward differentiation and ARKODE project onto the joints within their steps.
TEST(ConstrainedMethod, SundialsProjectsWithinItsSteps) {
  for (const std::string method : {"cvode_bdf", "arkode_erk", "arkode_dirk", "cvode_adams"}) {
    SCOPED_TRACE(method);
    const bool native = method != "cvode_adams";
    for (const Stabilization s : {Stabilization::both, Stabilization::none}) {
      Formulation f;
      f.joints.stabilization = s;
      const auto system = make_system<double>(problem_of("double_pendulum"), f);
      const auto integrator = find_integrator(method)->make(*system, {.tolerance = 1e-8, .t_end = 1});
      EXPECT_EQ(integrator->native_projection() != nullptr, native && s == Stabilization::both);
    }
    const End end = run_with(method, "double_pendulum", 1e-8, 1, Stabilization::both);
    EXPECT_LT(end.largest_gap, 1e-13);
    EXPECT_LT(end.largest_drift, native ? 1e-4 : 1e-2) << "a restart after each step loses the history";
    const End other = run_with("rk4", "double_pendulum", 1e-4, 1, Stabilization::both);
    EXPECT_LT((end.point(1, Vector::Zero()) - other.point(1, Vector::Zero())).norm(), native ? 1e-5 : 1e-3);
  }
}

/// The largest error of the reactions of a method over a run, against those that follow from its states.
class WatchReactions final : public Observer {
 public:
  explicit WatchReactions(End& end) : end_(end) {}
  void on_multipliers(std::span<const double> multipliers) override {
    multipliers_ = Eigen::Map<const VectorX<double>>(multipliers.data(), Eigen::Index(multipliers.size()));
  }
  void on_state(const State<double>& state, const Sample&) override {
    end_.state = state;
    end_.multipliers = multipliers_;
    const Vector by_method = reaction(end_, 0);
    end_.multipliers.resize(0);
    worst_ = std::max(worst_, (by_method - reaction(end_, 0)).norm());
  }
  double next_state() const override { return 0; }
  double worst() const { return worst_; }

 private:
  End& end_;
  VectorX<double> multipliers_;
  double worst_ = 0;
};

/// Errors of the pose (m) and the velocity (m/s) of the heavy top at 0.1 s, and of its reaction (N) until then.
struct TopErrors {
  double position, velocity, reaction;
};

TopErrors top_errors(const std::string& method, const SettingValues& chosen, double dt, const End& truth) {
  End end{make_system<double>(problem_of("ball_joint_top"), {}), {}, {}};
  end.state = end.system->start();
  const auto integrator = find_integrator(method)->make(*end.system, {.dt = dt, .t_end = 0.1, .chosen = chosen});
  Schedule schedule;
  schedule.t_end = 0.1;
  schedule.dt = dt;
  WatchReactions watch(end);
  const RunOutcome outcome = simulate<double>(*end.system, *end.system, *integrator, end.state, schedule, watch);
  EXPECT_EQ(outcome.status, RunStatus::ok) << outcome.message;
  return {(end.motion(0).position - truth.motion(0).position).norm(),
          (end.motion(0).velocity - truth.motion(0).velocity).norm(), watch.worst()};
}

/// In index 3 the multipliers of generalized-alpha have order 1 near the start. Perturbed start values and the
/// stabilized index 2 restore order 2 (Arnold, Bruels & Cardona 2015).
TEST(ConstrainedMethod, OrdersOfPoseVelocityAndReaction) {
  const End truth =
      run("ball_joint_top", 1e-13, 0.1, Stabilization::both, AngularState::velocity_body, "odeint_fehlberg78");
  struct Case {
    std::string method;
    SettingValues chosen;
    double of_reaction;
    double of_motion = 2;
  };
  for (const Case& c : {Case{"generalized_alpha_index3", {}, 1},
                        Case{"generalized_alpha_index3", {{"start_values", std::string("perturbed")}}, 2},
                        Case{"generalized_alpha_index2", {}, 2}, Case{"rattle", {}, 1}, Case{"rattle_lie", {}, 1},
                        Case{"shake", {}, 2}, Case{"shake_lie", {}, 2}, Case{"half_explicit4", {}, 2, 4}}) {
    SCOPED_TRACE(c.method + (c.chosen.empty() ? "" : ", perturbed start"));
    const TopErrors coarse = top_errors(c.method, c.chosen, 5e-4, truth),
                    fine = top_errors(c.method, c.chosen, 1.25e-4, truth);
    EXPECT_NEAR(std::log2(coarse.position / fine.position) / 2, c.of_motion, 0.1);
    EXPECT_NEAR(std::log2(coarse.velocity / fine.velocity) / 2, c.of_motion, 0.1);
    EXPECT_NEAR(std::log2(coarse.reaction / fine.reaction) / 2, c.of_reaction, 0.1);
  }
}

}  // namespace
}  // namespace polhode::study::joints_tests::constrained_method_test
