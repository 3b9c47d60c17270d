// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report/drawing/scenario_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "experiments/study/report/drawing/marks.hpp"
#include "experiments/study/report/drawing/scenario_words.hpp"
#include "experiments/study/report/drawing/solid.hpp"
#include "experiments/study/scene/body_colours.hpp"
#include "experiments/study/scene/scene.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::inline report::inline drawing {
namespace {

constexpr double width = 520, most_height = 380, least_height = 150;  // size of the picture, without the strip below
constexpr double strip = 44;  // height of the strip below the picture: the bar and the world's axes
constexpr double margin = 34, gravity_margin = 30;
constexpr std::size_t most_named = 8;    // bodies with axes and names
constexpr std::size_t most_ringed = 40;  // bodies with lines on their curved sides
constexpr double smallest_seen = 7;      // size of a body on the page; a smaller one stands in a circle

constexpr const char* style = R"css(
.scene text{font:15px system-ui,"Segoe UI",Roboto,"DejaVu Sans",sans-serif;fill:#1d2126}
.scene .label{paint-order:stroke;stroke:#fff;stroke-width:3px;stroke-linejoin:round}
.scene path,.scene circle{fill:none;stroke:#262c34;stroke-width:1;stroke-linejoin:round;stroke-linecap:round}
.scene .edge{stroke-width:.9}.scene .outline{stroke-width:1.5}.scene .ring{stroke-width:.6;stroke-opacity:.6}
.scene .floor{fill:#eceef1;stroke:#9aa1aa;stroke-width:.8}.scene .near{fill:none;stroke:#9aa1aa;stroke-dasharray:5 4}
.scene .axis{stroke-width:1.1}.scene .hidden{stroke-dasharray:2 3}.scene .bar{stroke-width:1.6}
.scene .spin,.scene .velocity,.scene .force,.scene .gravity{stroke-width:2.4}
.scene .spin{stroke:#a86f00}.scene .velocity{stroke:#b04a00;stroke-dasharray:7 3}.scene .force{stroke:#007353}
.scene .gravity{stroke:#59616b}.scene .attraction{stroke:#59616b;stroke-dasharray:2 4}
.scene .head{stroke-dasharray:none;stroke-width:.5}.scene .round{stroke-dasharray:none;fill:#fff;stroke-width:1.8}
.scene .spin.head{fill:#a86f00}.scene .velocity.head{fill:#b04a00}.scene .force.head{fill:#007353}
.scene .gravity.head{fill:#59616b}.scene text.spin,.scene text.velocity,.scene text.force,.scene text.gravity{font-weight:600}
.scene .spring{stroke:#3c444e;stroke-width:1.3}.scene .anchor{fill:#262c34}.scene .pivot,.scene .joint{fill:#fff}
.scene .rod{stroke:#3c444e;stroke-width:2}
.scene .small{stroke:#59616b;stroke-dasharray:3 3}
.scene .axis.label,.scene .bar.label{stroke:#fff;stroke-width:3px;stroke-dasharray:none;font-size:13px}
.scene .spin.label,.scene .velocity.label,.scene .force.label,.scene .gravity.label{stroke:#fff;stroke-width:3px;stroke-dasharray:none}
)css";

/// The colour of a body, darker where the light falls from aside: "#b7cfe8".
std::string shade(std::size_t body, bool fixed, const Vector3<double>& normal, const View& view) {
  constexpr std::array<std::uint8_t, 3> grey = {206, 209, 214};
  const auto colour = fixed ? grey : body_colour(body);
  const PagePoint across = view.direction(normal);
  const double light = std::clamp(0.62 - 0.36 * across.y() + 0.14 * across.x() * -1, 0.0, 1.0);  // from above, left
  std::string text = "#";
  for (const std::uint8_t c : colour) {
    const double pale = c + 0.45 * (255 - c);  // so that lines and letters stand out
    text += fmt::format("{:02x}", int(std::lround(pale * (0.72 + 0.28 * light))));
  }
  return text;
}

/// The largest number 1, 2 or 5 times a power of ten that is not above x.
double round_length(double x) {
  const double unit = std::pow(10.0, std::floor(std::log10(x)));
  for (const double k : {5.0, 2.0}) {
    if (k * unit <= x) return k * unit;
  }
  return unit;
}

struct Arrow {
  std::size_t body;
  Vector3<double> from, vector;  ///< tail, m; vector in rad/s, m/s, N or N m
  const char *style, *label;
  int heads;
  double scale = 0;  ///< m for a unit of the vector
};

class Drawer {
 public:
  explicit Drawer(const Scenario& scenario)
      : scenario_(scenario),
        problem_(scenario.problem),
        scene_(scene_of(scenario)),
        gravity_(gravity_of(scenario.problem)),
        view_(gravity_.isZero(0) ? Vector3<double>::UnitZ() : Vector3<double>(-gravity_)) {}

  ScenarioDrawing draw() {
    make_pieces();
    make_arrows();
    make_floors();
    fit();
    paint();
    return {finished(), reading()};
  }

 private:
  bool named() const { return problem_.moving() <= most_named; }

  Pose pose(std::size_t i) const { return scene_.bodies[i].start; }

  Vector3<double> world_point(std::size_t body, const Vector3<double>& in_body) const {
    const BodyStart& start = problem_.starts[body];
    return start.position + rotation_matrix(start.orientation) * in_body;
  }

  void make_pieces() {
    std::vector<std::vector<Piece>> pieces;
    for (const Surface& surface : scene_.surfaces) pieces.push_back(pieces_of(surface));
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
      const SceneBody& body = scene_.bodies[i];
      if (!body.surface) continue;
      for (const Piece& piece : pieces[*body.surface]) {
        pieces_.push_back(seen(piece, body.start, view_, scene_.bodies.size() <= most_ringed));
        body_of_piece_.push_back(i);
        for (const auto& x : pieces_.back().points) bodies_.extend(x);
      }
    }
    for (const SceneLink& spring : scene_.springs) {
      for (const auto& end : ends_of(spring)) bodies_.extend(end);
    }
    for (const JointParameters& joint : problem_.joints) {
      for (const auto& end : ends_of(joint)) bodies_.extend(end);
    }
    for (std::size_t i = 0; i < problem_.bodies.size(); ++i) {
      if (problem_.bodies[i].pinned) bodies_.extend(problem_.starts[i].position);
    }
    for (const Vector3<double>& x : corners(bodies_)) seen_points_.push_back(x);
  }

  static std::vector<Vector3<double>> corners(const Eigen::AlignedBox3d& box) {
    std::vector<Vector3<double>> all;
    for (int k = 0; k < 8; ++k) all.push_back(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(k)));
    return all;
  }

  std::array<Vector3<double>, 2> ends_of(const SceneLink& spring) const {
    return {world_point(spring.body, spring.anchor),
            spring.other ? world_point(*spring.other, spring.anchor_other) : spring.anchor_other};
  }

  /// The anchors of a joint, world axes, m.
  std::array<Vector3<double>, 2> ends_of(const JointParameters& joint) const {
    const std::vector<std::size_t>& bodies = joint.of.bodies;
    return {world_point(bodies[0], joint.of.vector("anchor_body")),
            bodies.size() == 2 ? world_point(bodies[1], joint.of.vector("anchor_body_2"))
                               : joint.of.vector("anchor_world")};
  }

  /// Distance by which the surface of a body reaches from its mass centre along a direction, m.
  double reach(std::size_t body, const Vector3<double>& direction) const {
    double most = 0;
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
      if (body_of_piece_[k] != body) continue;
      for (const auto& x : pieces_[k].points) most = std::max(most, direction.dot(x - pose(body).position));
    }
    return most;
  }

  double size_of(std::size_t body) const {
    double most = 0;
    for (int k = 0; k < 3; ++k)
      for (const double sign : {-1.0, 1.0}) most = std::max(most, reach(body, sign * pose(body).rotation.col(k)));
    return most;
  }

  void make_arrows() {
    std::vector<Arrow> spins, velocities, forces, torques;
    for (std::size_t i = 0; i < problem_.moving(); ++i) {
      const BodyStart& start = problem_.starts[i];
      const Vector3<double> spin = start.angular_velocity_in_body
                                       ? Vector3<double>(rotation_matrix(start.orientation) * start.angular_velocity)
                                       : start.angular_velocity;
      if (!spin.isZero(0)) spins.push_back({i, pose(i).position, spin, "spin", "ω", 1});
      if (!start.velocity.isZero(0)) velocities.push_back({i, pose(i).position, start.velocity, "velocity", "v", 1});
    }
    for (const ForceParameters& force : problem_.forces) {
      const bool pull = force.kind == "constant_force", turn = force.kind == "constant_torque";
      for (const std::size_t i : force.bodies) {
        if (!pull && !turn) break;
        Vector3<double> vector = force.vector(pull ? "force" : "torque");
        if (vector.isZero(0)) continue;
        if (force.text("frame") == "body") vector = rotation_matrix(problem_.starts[i].orientation) * vector;
        if (pull) forces.push_back({i, world_point(i, force.vector("anchor_body")), vector, "force", "f", 1});
        else torques.push_back({i, pose(i).position, vector, "force", "τ", 2});
      }
    }
    for (auto* kind : {&spins, &velocities, &forces, &torques}) add_arrows(*kind);
  }

  /// The longest arrow of a kind reaches out of its body.
  void add_arrows(std::vector<Arrow>& arrows) {
    if (arrows.empty()) return;
    const Arrow& longest = *std::max_element(arrows.begin(), arrows.end(), [](const auto& a, const auto& b) {
      return a.vector.squaredNorm() < b.vector.squaredNorm();
    });
    const double most = longest.vector.norm(), radius = 0.5 * bodies_.diagonal().norm();
    const double length =
        std::max(reach(longest.body, longest.vector / most) + 0.75 * size_of(longest.body), 0.4 * radius);
    for (Arrow& arrow : arrows) {
      arrow.scale = length / most;
      seen_points_.push_back(arrow.from + arrow.scale * arrow.vector);
      arrows_.push_back(arrow);
    }
  }

  /// The part of each floor about the bodies, up to the other floors.
  void make_floors() {
    constexpr double furthest = 40;  // radii of all bodies
    Eigen::AlignedBox3d around = bodies_;
    const double radius = 0.5 * bodies_.diagonal().norm();
    std::vector<const SceneBody*> floors;
    for (const SceneBody& body : scene_.bodies) {
      if (body.surface) continue;
      const double height = body.floor_normal.dot(bodies_.center()) - body.floor_offset;
      if (!(std::abs(height) <= furthest * radius)) continue;
      floors.push_back(&body);
      around.extend(Vector3<double>(bodies_.center() - height * body.floor_normal));
    }
    const double pad = 0.3 * radius;
    for (const SceneBody* floor : floors) {
      std::vector<Vector3<double>> polygon = patch(*floor, around, pad);
      for (const SceneBody* other : floors) {
        if (other != floor) polygon = clipped(polygon, *other);
      }
      if (polygon.size() < 3) continue;
      const bool near = floor->floor_normal.dot(view_.toward()) < 0;
      floors_.emplace_back(near, polygon);
      seen_points_.insert(seen_points_.end(), polygon.begin(), polygon.end());
    }
  }

  static std::vector<Vector3<double>> patch(const SceneBody& floor, const Eigen::AlignedBox3d& around, double pad) {
    const Vector3<double>& n = floor.floor_normal;
    const Vector3<double> start = std::abs(n.x()) < 0.9 ? Vector3<double>::UnitX() : Vector3<double>::UnitY();
    const Vector3<double> a = (start - n.dot(start) * n).normalized(), b = n.cross(a);
    Eigen::AlignedBox2d range;
    for (const auto& x : corners(around)) range.extend(PagePoint(a.dot(x), b.dot(x)));
    range.extend(PagePoint(range.min() - PagePoint(pad, pad)));
    range.extend(PagePoint(range.max() + PagePoint(pad, pad)));
    std::vector<Vector3<double>> polygon;
    const auto &low = range.min(), &high = range.max();
    for (const PagePoint& p : {low, PagePoint(high.x(), low.y()), high, PagePoint(low.x(), high.y())})
      polygon.push_back(floor.floor_offset * n + p.x() * a + p.y() * b);
    return polygon;
  }

  /// The part of a polygon that is not in another floor (Sutherland & Hodgman, CACM 17, 1974).
  static std::vector<Vector3<double>> clipped(const std::vector<Vector3<double>>& polygon, const SceneBody& by) {
    std::vector<Vector3<double>> out;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Vector3<double>&from = polygon[k], &to = polygon[(k + 1) % polygon.size()];
      const double a = by.floor_normal.dot(from) - by.floor_offset, b = by.floor_normal.dot(to) - by.floor_offset;
      if (a >= 0) out.push_back(from);
      if ((a < 0) != (b < 0)) out.push_back(from + a / (a - b) * (to - from));
    }
    return out;
  }

  void fit() {
    if (named()) {
      for (std::size_t i = 0; i < problem_.moving(); ++i) {
        for (int k = 0; k < 3; ++k) seen_points_.push_back(tip_of_axis(i, k));
      }
    }
    Eigen::AlignedBox2d box;
    for (const auto& x : seen_points_) box.extend(view_.on_page(x));
    const double right = margin + (gravity_.isZero(0) ? 0 : gravity_margin);
    const PagePoint size = box.sizes().cwiseMax(1e-12 * (1 + box.max().cwiseAbs().maxCoeff()));
    const double scale = std::min((width - margin - right) / size.x(), (most_height - 2 * margin) / size.y());
    height_ = std::max(least_height, scale * size.y() + 2 * margin);
    const PagePoint middle(margin + 0.5 * (width - margin - right), 0.5 * height_);
    view_.fit(scale, middle - scale * box.center());
  }

  Vector3<double> tip_of_axis(std::size_t i, int k) const {
    const Vector3<double> axis = pose(i).rotation.col(k);
    return pose(i).position + (reach(i, axis) + 0.35 * size_of(i)) * axis;
  }

  void paint() {
    const auto polygon = [&](const std::vector<Vector3<double>>& corners) {
      std::vector<PagePoint> points;
      for (const auto& x : corners) points.push_back(view_.on_page(x));
      return points;
    };
    for (const auto& [near, corners] : floors_)
      if (!near) svg_.path(path_of(polygon(corners), true), "class=\"floor\"");
    for (const std::size_t k : painting_order(pieces_, view_)) paint_piece(k);
    for (const auto& [near, corners] : floors_)
      if (near) svg_.path(path_of(polygon(corners), true), "class=\"near\"");
    Marks marks(svg_, width, height_ + strip);
    paint_connections(marks);
    paint_bodies(marks);
    paint_joints(marks);
    for (const Arrow& arrow : arrows_)
      marks.arrow(view_.on_page(arrow.from), view_.scale() * view_.direction(arrow.scale * arrow.vector),
                  arrow.vector.dot(view_.toward()) > 0, arrow.style, named() ? arrow.label : "", arrow.heads);
    paint_strip(marks);
    marks.finish();
  }

  void paint_piece(std::size_t k) {
    const SeenPiece& piece = pieces_[k];
    const std::size_t body = body_of_piece_[k];
    const bool fixed = scene_.bodies[body].fixed;
    const auto points = [&](const SeenPiece::Line& line) {
      std::vector<PagePoint> out;
      for (const auto& x : line) out.push_back(view_.on_page(x));
      return out;
    };
    std::string outline;
    for (const auto& line : piece.outlines) outline += path_of(points(line), true);
    const bool curved = piece.faces.empty() || !piece.rings.empty() || piece.planes.size() < 4;
    if (curved)
      svg_.path(outline, fmt::format("style=\"fill:{};stroke:none\"", shade(body, fixed, view_.toward(), view_)));
    for (const auto& ring : piece.rings) svg_.path(path_of(points(ring), false), "class=\"ring\"");
    for (const auto& face : piece.faces)
      svg_.path(path_of(points(face.corners), true),
                fmt::format("class=\"edge\" style=\"fill:{}\"", shade(body, fixed, face.normal, view_)));
    svg_.path(outline, "class=\"outline\"");
  }

  void paint_connections(Marks& marks) {
    for (const ForceParameters& force : problem_.forces) {
      if (force.kind != "point_gravity") continue;
      svg_.line(view_.on_page(pose(force.bodies[0]).position), view_.on_page(pose(force.bodies[1]).position),
                "class=\"attraction\"");
    }
    std::size_t k = 0;
    for (const ForceParameters& force : problem_.forces) {
      if (force.kind != "spring" && force.kind != "damper") continue;
      const SceneLink& spring = scene_.springs[k++];
      const auto ends = ends_of(spring);
      const PagePoint from = view_.on_page(ends[0]), to = view_.on_page(ends[1]);
      if (force.kind == "spring") marks.spring(from, to);
      else marks.damper(from, to);
      marks.anchor(from, false);
      marks.anchor(to, !spring.other);
    }
  }

  void paint_joints(Marks& marks) {
    for (const JointParameters& joint : problem_.joints) {
      const auto ends = ends_of(joint);
      const PagePoint from = view_.on_page(ends[0]), to = view_.on_page(ends[1]);
      const bool to_world = joint.of.bodies.size() == 1 || problem_.bodies[joint.of.bodies[1]].fixed;
      if (joint.of.kind == "rolling" || joint.of.kind == "planar") continue;  // they hold a body on a plane
      if (joint.of.kind == "distance") {
        svg_.line(from, to, "class=\"rod\"");
        marks.anchor(from, false);
      }
      if (to_world) {
        const PagePoint centre = view_.on_page(pose(joint.of.bodies[0]).position);
        if (joint.of.kind != "distance") svg_.line(to, centre, "class=\"axis hidden\"");
        marks.pivot(to);
      } else {
        marks.joint(to);
      }
    }
  }

  void paint_bodies(Marks& marks) {
    for (std::size_t i = 0; i < problem_.moving(); ++i) {
      const PagePoint centre = view_.on_page(pose(i).position);
      const double seen_size = 2 * size_of(i) * view_.scale();
      if (problem_.bodies[i].pinned) {
        const PagePoint pivot = view_.on_page(problem_.starts[i].position);
        if (!problem_.bodies[i].center_of_mass.isZero(0)) svg_.line(pivot, centre, "class=\"axis hidden\"");
        marks.pivot(pivot);
      }
      if (!named()) continue;
      if (seen_size < smallest_seen) svg_.circle(centre, smallest_seen, "class=\"small\"");
      for (int k = 0; k < 3; ++k) {
        const Vector3<double> axis = pose(i).rotation.col(k);
        const PagePoint by = view_.on_page(tip_of_axis(i, k)) - centre;
        const double inside = reach(i, axis) / (reach(i, axis) + 0.35 * size_of(i));
        if (by.norm() > 14) marks.axis(centre, by, inside, std::to_string(k + 1));
      }
    }
    if (!named() || problem_.bodies.size() == 1) return;
    for (std::size_t i = 0; i < problem_.bodies.size(); ++i) {
      if (!scene_.bodies[i].surface) continue;
      Eigen::AlignedBox2d box;
      for (std::size_t k = 0; k < pieces_.size(); ++k) {
        if (body_of_piece_[k] != i) continue;
        for (const auto& x : pieces_[k].points) box.extend(view_.on_page(x));
      }
      marks.label({box.center().x(), box.max().y()}, {0, 1}, scene_.bodies[i].name, "name");
    }
  }

  /// The bar of lengths, gravity and the world's axes.
  void paint_strip(Marks& marks) {
    const double length = round_length(0.3 * width / view_.scale());
    marks.length_bar({margin, height_ + strip - 18}, length * view_.scale(), exact_number(length) + " m");
    const PagePoint origin(width - 62, height_ + strip - 18);
    for (int k = 0; k < 3; ++k) {
      const PagePoint by = 26 * view_.direction(Vector3<double>::Unit(k));
      marks.axis(origin, by, 0, std::string(1, char('x' + k)));
    }
    if (gravity_.isZero(0)) return;
    const PagePoint down = view_.direction(gravity_.normalized());
    marks.arrow({width - margin, margin}, 44 * down, false, "gravity", "g");
  }

  std::string finished() const {
    std::string words = fmt::format("Drawing of the scenario {} at its start.", scenario_.name);
    for (const std::string& line : first_items(scenario_words(scenario_), 4)) words += " " + line;
    return fmt::format(
        "<svg class=\"scene\" role=\"img\" aria-label=\"{}\" viewBox=\"0 0 {} {}\">\n<title>{}</title>\n<style>{}"
        "</style>\n{}</svg>\n",
        html(words), coordinate(width), coordinate(height_ + strip), html(scenario_.title), style, svg_.elements());
  }

  std::string reading() const {
    std::vector<std::string> parts = {
        "Seen from above and aside, without perspective; bodies are to scale, and the bar "
        "is a length across the line of sight"};
    if (named()) parts.emplace_back("1, 2, 3 are body axes from the mass centre");
    parts.emplace_back("x, y, z those of the world");
    const auto has = [&](std::string_view label) {
      return std::any_of(arrows_.begin(), arrows_.end(), [&](const Arrow& a) { return a.label == label; });
    };
    std::vector<std::string> kinds;
    for (const auto& [label, text] :
         {std::pair("ω", "ω the angular velocity"), std::pair("v", "v (dashed) the velocity"),
          std::pair("f", "f a constant force"), std::pair("τ", "τ a constant torque")}) {
      if (has(label)) kinds.emplace_back(text);
    }
    if (!kinds.empty()) parts.push_back(words(kinds));
    if (arrows_.size() > kinds.size()) parts.emplace_back("arrows of one kind are to scale with each other");
    const auto round = [&](bool toward) {
      return std::any_of(arrows_.begin(), arrows_.end(), [&](const Arrow& a) {
        const bool short_on_page = (view_.scale() * view_.direction(a.scale * a.vector)).norm() < 9;
        return short_on_page && (a.vector.dot(view_.toward()) > 0) == toward;
      });
    };
    if (round(true)) parts.emplace_back("a circle with a dot points to the reader");
    if (round(false)) parts.emplace_back("a circle with a cross points away");
    if (std::any_of(floors_.begin(), floors_.end(), [](const auto& f) { return f.first; }))
      parts.emplace_back("dashed outlines are planes in front");
    return fmt::format("{}.", fmt::join(parts, "; "));
  }

  const Scenario& scenario_;
  const Problem& problem_;
  Scene scene_;
  Vector3<double> gravity_;
  View view_;
  std::vector<SeenPiece> pieces_;
  std::vector<std::size_t> body_of_piece_;
  Eigen::AlignedBox3d bodies_;  ///< around all bodies and springs, m
  std::vector<Arrow> arrows_;
  std::vector<std::pair<bool, std::vector<Vector3<double>>>> floors_;  ///< true for a floor in front; its corners
  std::vector<Vector3<double>> seen_points_;                           ///< points that must be on the page
  double height_ = 0;
  Svg svg_;
};

}  // namespace

ScenarioDrawing drawing_of(const Scenario& scenario) {
  if (scenario.problem.moving() == 0) return {};
  return Drawer(scenario).draw();
}

}  // namespace polhode::study::report::drawing
