// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/replay/page_data.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>

#include "experiments/study/plot/method_style.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::replay {
namespace {

using Json = nlohmann::ordered_json;
static_assert(std::endian::native == std::endian::little, "typed arrays of a browser are little-endian");

template <class T>
std::string packed(const std::vector<T>& numbers) {
  return base64(std::string_view(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T)));
}

std::vector<float> singles(const std::vector<double>& numbers) { return {numbers.begin(), numbers.end()}; }

/// x, clamped to [−1, 1], as a multiple of 1/32767.
std::int16_t step_of(double x) { return std::int16_t(std::lround(32767 * std::clamp(x, -1.0, 1.0))); }

template <class V>
Json list(const V& v) {
  Json items = Json::array();
  for (Eigen::Index i = 0; i < v.size(); ++i) items.push_back(v[i]);
  return items;
}

Json surface_json(const Surface& surface) {
  std::vector<float> points;
  std::vector<std::int16_t> normals;
  for (const Vector3<float>& x : surface.points) points.insert(points.end(), x.begin(), x.end());
  for (const Vector3<float>& n : surface.normals) {
    for (const float c : n) normals.push_back(step_of(c));
  }
  return {{"points", packed(points)}, {"normals", packed(normals)}, {"corners", packed(surface.corners)}};
}

Json body_json(const SceneBody& body) {
  Json b = {{"name", body.name},
            {"fixed", body.fixed},
            {"position", list(body.start.position)},
            {"orientation", list(quaternion_from_rotation_matrix(body.start.rotation))}};
  if (body.surface) {
    b["surface"] = *body.surface;
    b["inferred"] = body.from_inertia;
    b["center"] = list(body.center_of_mass);
    b["inertia"] = list(body.inertia.reshaped());
  } else {
    b["normal"] = list(body.floor_normal);
    b["offset"] = body.floor_offset;
  }
  return b;
}

Json link_json(const SceneLink& l) {
  return {{"body", l.body},
          {"other", l.other ? Json(*l.other) : Json()},
          {"anchor", list(l.anchor)},
          {"anchorOther", list(l.anchor_other)}};
}

Json joint_json(const SceneJoint& joint) {
  return {{"name", joint.name},          {"ends", link_json(joint.ends)},       {"onPlane", joint.on_plane},
          {"axis", list(joint.axis)},    {"axisOther", list(joint.axis_other)}, {"radius", joint.radius},
          {"normal", list(joint.normal)}};
}

Json scene_json(const Scene& scene) {
  Json bodies = Json::array(), springs = Json::array(), joints = Json::array(), surfaces = Json::array();
  for (const Surface& surface : scene.surfaces) surfaces.push_back(surface_json(surface));
  for (const SceneBody& body : scene.bodies) bodies.push_back(body_json(body));
  for (const SceneLink& s : scene.springs) springs.push_back(link_json(s));
  for (const SceneJoint& j : scene.joints) joints.push_back(joint_json(j));
  return {{"surfaces", surfaces}, {"bodies", bodies}, {"springs", springs}, {"joints", joints}};
}

std::string impacts_packed(const Recording& r) {
  std::vector<float> numbers;
  for (const Impact& i : r.impacts) {
    for (const double x : {i.t, double(i.a), double(i.b), i.point[0], i.point[1], i.point[2], i.normal[0], i.normal[1],
                           i.normal[2], i.impulse.norm()}) {
      numbers.push_back(float(x));
    }
  }
  return packed(numbers);
}

/// The differences of the run from others of the page, except method and step: "orientation matrix, gyroscopic off".
std::string detail_of(const Recording& r, const std::vector<Recording>& all) {
  const auto details = [](const Recording& o) {
    return facts_of(o.config, {RunOption::Role::method, RunOption::Role::size});
  };
  std::string detail;
  const auto own = details(r);
  for (std::size_t k = 0; k < own.size(); ++k) {
    const auto& [name, cell] = own[k];
    if (cell.empty()) continue;
    const auto differs = [&, k](const Recording& o) { return details(o)[k].second != own[k].second; };
    if (std::any_of(all.begin(), all.end(), differs))
      detail += (detail.empty() ? "" : ", ") + name + " " + rounded(cell);
  }
  return detail;
}

/// The dash of a curve as lengths in pixels: gnuplot's "(10,5)"; none for a solid line.
Json dash_json(std::size_t dash) {
  Json lengths = Json::array();
  std::string text(style::dashes[dash % style::dashes.size()].gnuplot);
  if (!text.starts_with('(')) return lengths;
  std::replace(text.begin(), text.end(), ',', ' ');
  std::istringstream numbers(text.substr(1));
  for (double x; numbers >> x;) lengths.push_back(x);
  return lengths;
}

/// The colour and the dash of each run: those of its method in the figures. Further runs of a method have other dashes.
void add_styles(const std::vector<Recording>& recordings, Json& runs) {
  std::vector<std::string> methods;
  for (const Recording& r : recordings) methods.push_back(r.config.integrator);
  std::sort(methods.begin(), methods.end());
  methods.erase(std::unique(methods.begin(), methods.end()), methods.end());
  const std::vector<MethodStyle> styles = styles_of(methods);
  std::vector<std::size_t> met(methods.size(), 0);
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    const auto m = std::size_t(std::lower_bound(methods.begin(), methods.end(), recordings[i].config.integrator) -
                               methods.begin());
    runs[i]["colour"] = html_colour(styles[m]);
    runs[i]["dash"] = dash_json(styles[m].dash + met[m]++);
  }
}

Json run_json(const Recording& r, const std::vector<Recording>& all) {
  std::vector<float> positions;
  std::vector<std::int16_t> orientations, rates;
  double fastest = 0;
  for (const Placement& p : r.placements) fastest = std::max(fastest, p.angular_velocity.cwiseAbs().maxCoeff());
  for (const Placement& p : r.placements) {
    for (const double x : p.position) positions.push_back(float(x));
    const Quaternion<double> q = p.orientation.normalized();
    for (const double c : q) orientations.push_back(step_of(c));
    for (const double w : p.angular_velocity) rates.push_back(step_of(fastest > 0 ? w / fastest : 0));
  }
  std::vector<float> reactions;
  for (const Vector3<double>& force : r.reactions) reactions.insert(reactions.end(), force.begin(), force.end());
  Json facts = Json::array();
  for (const auto& [name, cell] : facts_of(r.config)) {
    if (!cell.empty()) facts.push_back({name, cell});
  }
  facts.push_back({"status", r.status + (r.message.empty() ? "" : ": " + r.message)});
  if (!r.energy_drift_max.empty()) facts.push_back({"energy_drift_max_rel", r.energy_drift_max});
  const char* const momentum = r.momentum == ShownMomentum::angular  ? "angular"
                               : r.momentum == ShownMomentum::linear ? "linear"
                                                                     : "";
  return {{"id", r.id},
          {"label", label_of(r)},
          {"detail", detail_of(r, all)},
          {"status", r.status},
          {"message", r.message},
          {"facts", facts},
          {"moving", r.moving},
          {"instants", r.times.size()},
          {"instantsSeen", r.instants_seen},
          {"impactsSeen", r.impacts_seen},
          {"momentum", momentum},
          {"fastest", fastest},
          {"times", packed(r.times)},
          {"positions", packed(positions)},
          {"orientations", packed(orientations)},
          {"rates", packed(rates)},
          {"reactions", packed(reactions)},
          {"energy", packed(singles(r.energy_drift))},
          {"momentumDrift", r.momentum == ShownMomentum::none ? "" : packed(singles(r.momentum_drift))},
          {"impacts", impacts_packed(r)}};
}

}  // namespace

double bytes_of_instant(const Recording& r) {
  const double series = r.momentum == ShownMomentum::none ? 8 + 4 : 8 + 4 + 4;
  return 4.0 / 3 * (series + double(r.moving) * (3 * 4 + 4 * 2 + 3 * 2) + double(r.joints) * 3 * 4);
}

std::string page_data(const PageWords& words, const std::vector<Recording>& recordings) {
  Json scenes = Json::array(), runs = Json::array();
  for (const Recording& r : recordings) {
    Json scene = scene_json(r.scene);
    const auto known = std::find(scenes.begin(), scenes.end(), scene);
    runs.push_back(run_json(r, recordings));
    runs.back()["scene"] = known - scenes.begin();
    if (known == scenes.end()) scenes.push_back(std::move(scene));
  }
  add_styles(recordings, runs);
  const Json data = {{"scenario", words.scenario},
                     {"title", words.title},
                     {"description", words.description},
                     {"answer", words.answer},
                     {"paragraphs", words.paragraphs},
                     {"madeBy", words.made_by},
                     {"scenes", scenes},
                     {"runs", runs}};
  std::string text = data.dump(-1, ' ', false, Json::error_handler_t::replace), safe;
  for (const char c : text) {
    if (c == '<') safe += "\\u003c";
    else safe += c;
  }
  return safe;
}

}  // namespace polhode::study::replay
