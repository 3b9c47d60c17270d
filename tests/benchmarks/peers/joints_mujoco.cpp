// SPDX-License-Identifier: BSD-3-Clause
// Mechanisms in MuJoCo: hinge angles, and soft equality constraints where a hinge closes a loop.
#include <mujoco/mujoco.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include "tests/benchmarks/peers/mechanism.hpp"

namespace polhode::peers {
namespace {

const Hinge& tree_hinge(const Mechanism& m, int body) {
  for (const Hinge& h : m.hinges) {
    if (h.body == body && !h.closes) return h;
  }
  throw std::logic_error("a body hangs on no hinge");
}

void write_body(const Mechanism& m, int body, double x, double y, std::ostream& xml) {
  const PlaneBody& b = m.bodies[std::size_t(body)];
  const Hinge& h = tree_hinge(m, body);
  xml << "<body name='b" << body << "' pos='" << b.x - x << ' ' << b.y - y << " 0'><inertial pos='0 0 0' mass='"
      << b.mass << "' diaginertia='" << b.inertia << ' ' << b.inertia << ' ' << b.inertia
      << "'/><joint type='hinge' axis='0 0 1' pos='" << h.x - b.x << ' ' << h.y - b.y << " 0'/>";
  for (const Hinge& next : m.hinges) {
    if (!next.closes && next.other == body) write_body(m, next.body, b.x, b.y, xml);
  }
  xml << "</body>";
}

std::string model_of(const Mechanism& m, const char* integrator, double h) {
  std::ostringstream xml;
  xml.precision(17);
  xml << "<mujoco><compiler boundmass='0' boundinertia='0' balanceinertia='false'/><option timestep='" << h
      << "' integrator='" << integrator << "' gravity='0 " << -gravity << " 0' tolerance='1e-12'/><worldbody>";
  for (const Hinge& root : m.hinges) {
    if (!root.closes && root.other < 0) write_body(m, root.body, 0, 0, xml);
  }
  xml << "</worldbody><equality>";
  for (const Hinge& close : m.hinges) {
    if (!close.closes) continue;
    const PlaneBody& b = m.bodies[std::size_t(close.body)];
    xml << "<connect body1='b" << close.body << "' anchor='" << close.x - b.x << ' ' << close.y - b.y << " 0'/>";
  }
  xml << "</equality></mujoco>";
  return xml.str();
}

Arrival run(const Mechanism& m, const char* integrator, double h) {
  char path[] = "/tmp/polhode_mechanism_XXXXXX.xml";
  const int file = mkstemps(path, 4);
  const std::string xml = model_of(m, integrator, h);
  if (file < 0 || write(file, xml.data(), xml.size()) != ssize_t(xml.size())) throw std::runtime_error(path);
  close(file);
  char why[1000] = "";
  mjModel* model = mj_loadXML(path, nullptr, why, sizeof why);
  std::remove(path);
  if (!model) throw std::runtime_error(why);
  mjData* data = mj_makeData(model);
  for (std::size_t i = 0; i < m.bodies.size(); ++i) {
    const int id = mj_name2id(model, mjOBJ_BODY, ("b" + std::to_string(i)).c_str());
    const int other = tree_hinge(m, int(i)).other;
    data->qvel[model->jnt_dofadr[model->body_jntadr[id]]] =
        m.bodies[i].spin - (other < 0 ? 0 : m.bodies[std::size_t(other)].spin);
  }
  Arrival a;
  a.steps = steps_of(m, h);
  a.wall = timed([&] {
    for (long k = 0; k < a.steps; ++k) mj_step(model, data);
  });
  mj_kinematics(model, data);
  const int probe = mj_name2id(model, mjOBJ_BODY, ("b" + std::to_string(m.probe)).c_str());
  a.x = data->xpos[3 * probe];
  a.y = data->xpos[3 * probe + 1];
  mj_deleteData(data);
  mj_deleteModel(model);
  return a;
}

}  // namespace

std::vector<Program> mujoco_programs() {
  return {{"MuJoCo", "Euler", false, [](const Mechanism& m, double h) { return run(m, "Euler", h); }},
          {"MuJoCo", "RK4", false, [](const Mechanism& m, double h) { return run(m, "RK4", h); }}};
}

}  // namespace polhode::peers
