// SPDX-License-Identifier: BSD-3-Clause
// The integrator that the README writes in full: it compiles as printed and is what it says.
#include "tests/integrators/worked_integrator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

namespace polhode::worked_integrator_test {
namespace {

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(WorkedIntegrator, StandsInTheReadmeAsItIsCompiled) {
  std::string code = text_of(std::string(POLHODE_TESTS_DIR) + "/integrators/worked_integrator.hpp");
  ASSERT_FALSE(code.empty());
  EXPECT_NE(text_of(std::string(POLHODE_TESTS_DIR) + "/../README.md").find(code), std::string::npos);
}

/// |y(1) − exact| on a free top that spins fast enough to show it, against RK4 at a step 20 times smaller.
double error(const IntegratorEntry& entry, const System<double>& system, double h) {
  const auto run = [&](const IntegratorEntry& method, double step, std::int64_t n) {
    const auto integrator = method.make(system, {});
    State<double> state = system.start();
    integrator->begin(state);
    integrator->advance(state, step, n);
    return state.y;
  };
  const auto n = std::lround(1 / h);
  return (run(entry, h, n) - run(*find_integrator("rk4"), h / 20, 20 * n)).norm();
}

TEST(WorkedIntegrator, HasTheOrderItDeclares) {
  Problem problem;
  problem.bodies.resize(1);
  problem.bodies[0].inertia = Vector3<double>(1, 2, 2.5).asDiagonal();
  problem.starts.resize(1);
  problem.starts[0].angular_velocity = {1, 2, 0.5};
  const auto system = make_system<double>(problem, {});
  const IntegratorEntry entry = ralston();
  const double order = std::log2(error(entry, *system, 0.01) / error(entry, *system, 0.005));
  EXPECT_NEAR(order, entry.declaration.order, 0.1);
}

}  // namespace
}  // namespace polhode::worked_integrator_test
