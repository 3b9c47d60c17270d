// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/trajectory/trajectory_rows.hpp"

#include "core/system/constraints.hpp"
#include "core/system/joint_reactions.hpp"

namespace polhode::study::inline trajectory {

std::vector<std::string> trajectory_columns(const System<double>& system) {
  std::vector<std::string> names = {
      "t_s",          "body",         "px_m",         "py_m",           "pz_m",           "qw",
      "qx",           "qy",           "qz",           "vx_m_per_s",     "vy_m_per_s",     "vz_m_per_s",
      "wx_rad_per_s", "wy_rad_per_s", "wz_rad_per_s", "lx_kg_m2_per_s", "ly_kg_m2_per_s", "lz_kg_m2_per_s",
      "energy_J"};
  if (system.formulation().orientation == Orientation::matrix) {
    for (const char* name : {"r11", "r12", "r13", "r21", "r22", "r23", "r31", "r32", "r33"}) names.emplace_back(name);
  }
  return names;
}

std::vector<double> trajectory_row(const System<double>& system, const State<double>& state, std::size_t body,
                                   double energy) {
  const BodySnapshot<double> s = system.snapshot(state.y, body);
  std::vector<double> row = {state.t, static_cast<double>(body)};
  const auto append = [&](const auto& v) {
    for (Eigen::Index i = 0; i < v.size(); ++i) row.push_back(v[i]);
  };
  append(s.position);
  append(s.orientation);
  append(s.velocity);
  append(s.angular_velocity);
  append(s.angular_momentum);
  row.push_back(energy);
  if (system.formulation().orientation == Orientation::matrix) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) row.push_back(s.rotation(i, j));
    }
  }
  return row;
}

std::vector<std::string> energy_columns(const System<double>& system) {
  std::vector<std::string> names = {"t_s",           "kinetic_J",       "potential_J",   "work_J",
                                    "impact_loss_J", "friction_loss_J", "penetration_J", "projection_J"};
  if (system.has_joints()) names.emplace_back("stabilization_J");
  names.emplace_back("drift_J");
  return names;
}

std::vector<double> energy_row(const System<double>& system, const Sample& sample, const ContactLosses& contact,
                               double energy_start) {
  const Measurement<double>& m = sample.seen;
  std::vector<double> row = {sample.t,       m.kinetic,        m.potential,         sample.work,
                             contact.impact, contact.friction, contact.penetration, sample.projection};
  if (system.has_joints()) row.push_back(sample.joint_work);
  row.push_back(sample.ledger(contact.total()) - energy_start);
  return row;
}

std::vector<std::string> reaction_columns() {
  return {"t_s", "joint", "body", "fx_N", "fy_N", "fz_N", "tx_N_m", "ty_N_m", "tz_N_m"};
}

std::vector<std::vector<double>> reaction_rows(const System<double>& system, const State<double>& state,
                                               const VectorX<double>& multipliers) {
  const Constraints<double>& joints = *system.constraints();
  const std::vector<Wrench<double>> reactions = joint_reactions(system, state.t, state.y, multipliers);
  std::vector<std::vector<double>> rows;
  for (std::size_t i = 0; i < joints.count(); ++i) {
    const Wrench<double>& w = reactions[i];
    rows.push_back({state.t, static_cast<double>(i), static_cast<double>(joints.joint(i).first()), w.force[0],
                    w.force[1], w.force[2], w.torque[0], w.torque[1], w.torque[2]});
  }
  return rows;
}

std::vector<std::string> event_columns(bool kind) {
  std::vector<std::string> names = {"t_s"};
  if (kind) names.emplace_back("kind");
  for (const char* n : {"body_a", "body_b", "px_m", "py_m", "pz_m", "nx", "ny", "nz", "impulse_N_s", "energy_lost_J"}) {
    names.emplace_back(n);
  }
  return names;
}

std::vector<double> event_row(const Impact& i) {
  return {i.t,
          static_cast<double>(i.a),
          static_cast<double>(i.b),
          i.point[0],
          i.point[1],
          i.point[2],
          i.normal[0],
          i.normal[1],
          i.normal[2],
          i.impulse.norm(),
          i.energy_lost};
}

std::vector<double> event_row(const Transition& t) {
  return event_row(Impact{.t = t.t, .a = t.a, .b = t.b, .point = t.point, .normal = t.normal});
}

}  // namespace polhode::study::trajectory
