// SPDX-License-Identifier: BSD-3-Clause
// The textbook schemes against an independent evaluation of the same ten steps in 50 digits: textbook_reference.py,
// from which the numbers of the problem below come.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "integrators/catalogue.hpp"
#include "tests/laws/formulations.hpp"
#include "tests/laws/problems.hpp"

namespace polhode::textbook_test {
namespace {

using laws::force;
using V3 = Vector3<double>;
constexpr double step = 0.05;  // s
constexpr int steps = 10;

Problem box(const std::string& inertia) {
  Matrix3<double> full;
  full << 0.7, 0.1, -0.15, 0.1, 0.9, 0.2, -0.15, 0.2, 0.6;
  Problem p;
  p.bodies.push_back({.name = "box", .mass = 2, .inertia = inertia == "full" ? full : laws::diagonal(0.5, 0.8, 1.1)});
  p.starts.push_back({.position = {0.2, -0.1, 0.4},
                      .orientation = {0.1, 0.7, -0.5, 0.5},
                      .velocity = {0.5, -1, 0.25},
                      .angular_velocity = {1, 2, -1.5}});
  p.forces.push_back(force("uniform_gravity", {0}, {{"acceleration", V3(0, 0, -9.81)}}));
  p.forces.push_back(force("spring", {0},
                           {{"stiffness", 8.0},
                            {"damping", 0.4},
                            {"rest_length", 0.5},
                            {"anchor_body", V3(0.1, 0.25, -0.4)},
                            {"anchor_world", V3(0.5, 0, 2)}}));
  p.forces.push_back(force("constant_torque", {0}, {{"torque", V3(0.3, -0.2, 0.5)}, {"frame", std::string("body")}}));
  return p;
}

/// One line of the table: which run, and the flat state at its end.
struct Row {
  std::string scheme, inertia;
  Formulation formulation;
  VectorX<long double> y;
};

std::vector<Row> table() {
  const std::string path = std::string(POLHODE_TESTS_DIR) + "/integrators/textbook_reference.csv";
  std::ifstream file(path);
  if (!file) ADD_FAILURE() << "cannot read " << path;
  std::vector<Row> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("#") || line.starts_with("scheme,")) continue;
    std::vector<std::string> cells;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    if (cells.size() != 29) ADD_FAILURE() << "a line of " << cells.size() << " cells";
    Row row{cells[0], cells[1], {}, {}};
    const bool matrix = cells[2] == "matrix";
    row.formulation.orientation = matrix ? Orientation::matrix : Orientation::quaternion;
    for (const auto a : {AngularState::velocity_world, AngularState::velocity_body, AngularState::momentum_world}) {
      if (cells[3] == name(a)) row.formulation.angular_state = a;
    }
    row.formulation.gyroscopic = cells[4] == "on";
    row.formulation.rotation_from = cells[5] == "stored" ? RotationFrom::stored : RotationFrom::normalized;
    std::vector<long double> y;
    const auto take = [&](std::size_t cell) { y.push_back(std::strtold(cells[cell].c_str(), nullptr)); };
    for (std::size_t k = 6; k < 9; ++k) take(k);
    if (matrix) {  // the table goes by rows, the state by columns
      for (std::size_t column = 0; column < 3; ++column) {
        for (std::size_t r = 0; r < 3; ++r) take(13 + 3 * r + column);
      }
    } else {
      for (std::size_t k = 9; k < 13; ++k) take(k);
    }
    for (std::size_t k = 22; k < 29; ++k) take(k);
    row.y = Eigen::Map<const VectorX<long double>>(y.data(), Eigen::Index(y.size()));
    rows.push_back(row);
  }
  return rows;
}

template <class S>
VectorX<long double> end_of(const Row& row) {
  const auto system = make_system<S>(box(row.inertia), row.formulation);
  const auto integrator = find_integrator(row.scheme)->maker<S>()(*system, {});
  State<S> state = system->start();
  integrator->begin(state);
  EXPECT_TRUE(integrator->advance(state, step, steps).ok());
  return state.y.template cast<long double>();
}

TEST(TextbookReference, CoversEverySchemeAndFormulation) {
  EXPECT_EQ(table().size(), 4 * 2 * laws::all_formulations().size());
}

TEST(TextbookReference, TenStepsToRoundOff) {
  for (const Row& row : table()) {
    SCOPED_TRACE(row.scheme + ", " + row.inertia + ", " + laws::label(row.formulation));
    const auto error = [&](const VectorX<long double>& y) {
      if (y.size() != row.y.size()) return 1.0;
      return double(((y - row.y).array() / (row.y.array().abs() + 0.1L)).abs().maxCoeff());
    };
    EXPECT_LT(error(end_of<double>(row)), 1e-13);
    // t and h are doubles in every scalar, and so is what the problem gives.
    EXPECT_LT(error(end_of<long double>(row)), 3e-17);
    EXPECT_LT(error(end_of<float>(row)), 5e-5);
  }
}

}  // namespace
}  // namespace polhode::textbook_test
