// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/scenario/body_reader.hpp"

#include <algorithm>
#include <cmath>

#include "collision/shapes/shape_catalogue.hpp"
#include "core/problem/inertia.hpp"
#include "experiments/study/scenario/canonical_text.hpp"
#include "experiments/study/scenario/parameter_reader.hpp"
#include "experiments/study/scenario/scenario_keys.hpp"
#include "experiments/study/text/value_lists.hpp"

namespace polhode::study::inline scenario {

namespace {

using Range = Parameter::Range;

// Names.

/// A name stands in tables and in the keys of overrides, so it must not look like a number or hold what separates keys.
std::string read_name(const TomlCursor& body, std::size_t index) {
  if (!body.has("name")) return "body" + std::to_string(index);
  constexpr std::string_view rule = "a text without blanks, commas, dots and quotes that is not a number";
  const TomlCursor cursor = body.at("name", rule);
  const std::string& name = cursor.text(rule);
  const bool number = std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (number || name.find_first_of(" ,.;=\"'") != std::string::npos) cursor.refuse(rule);
  return name;
}

// Matter.

double read_mass(const TomlCursor& mass) {
  const double m = mass.number("kg", Range::positive);
  if (!std::isfinite(1 / m)) mass.refuse("large enough to divide by");
  return m;
}

/// Three principal moments, or a matrix as three rows, kg m².
Matrix3<double> read_inertia(const TomlCursor& inertia) {
  constexpr std::string_view must_be = "3 principal moments, or 3 rows of 3 numbers, of kg m^2";
  if (inertia.list(must_be) != 3) inertia.refuse(must_be);
  if (inertia.value().items[0].type == TomlValue::Type::number) return inertia.vector("kg m^2").asDiagonal();
  Matrix3<double> rows;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const TomlCursor row = inertia.item(static_cast<std::size_t>(i));
    rows.row(i) = row.vector("kg m^2").transpose();
  }
  return rows;
}

/// "[0.1, 0, 0]"
std::string vector_text(const Vector3<double>& v) {
  return "[" + exact(v[0]) + ", " + exact(v[1]) + ", " + exact(v[2]) + "]";
}

/// The entry of the shape's kind.
const ShapeEntry& read_shape_kind(const TomlCursor& shape) {
  const TomlCursor name = shape.at("kind", "the name of a shape");
  const ShapeEntry* entry = find_shape(name.text("the name of a shape"));
  if (entry) return *entry;
  std::vector<std::string_view> known;
  for (const ShapeEntry& other : shape_catalogue()) known.push_back(other.name);
  name.unknown("shape", "There are", known);
}

ShapeParameters read_sizes(const TomlCursor& shape, const ShapeEntry& entry) {
  return {read_parameters(shape, entry.parameters, {"kind"}, "A " + entry.name + " has")};
}

/// Throws where the shape refuses its sizes.
ShapePointer build_shape(const TomlCursor& shape, const ShapeEntry& entry, const ShapeParameters& sizes) {
  try {
    return entry.make(sizes);
  } catch (const std::invalid_argument& error) {
    shape.fail(error.what());
  }
}

Matrix3<double> read_shape(const TomlCursor& shape, double mass) {
  if (shape.value().type != TomlValue::Type::table) shape.refuse("a table such as { kind = \"sphere\", radius = 0.1 }");
  const ShapeEntry& entry = read_shape_kind(shape);
  const ShapeParameters sizes = read_sizes(shape, entry);
  if (entry.moments) return entry.moments(mass, sizes).asDiagonal();
  const ShapePointer built = build_shape(shape, entry, sizes);
  if (!built->finite())
    shape.fail("a " + std::string(built->kind()) + " has no end and no inertia; its body must be static");
  const MassProperties matter = built->mass_properties();
  if (!(matter.centroid.norm() <= 1e-9 * std::cbrt(matter.volume))) {
    shape.fail("has its mass centre at " + vector_text(matter.centroid) +
               " m; it must be at the origin of the body's axes");
  }
  return mass / matter.volume * matter.inertia;
}

std::vector<PointMass> read_point_masses(const TomlCursor& list) {
  std::vector<PointMass> points(list.list("a list of { mass, position }"));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const TomlCursor point = list.item(i);
    point.table("A point mass has", {"mass", "position"});
    const TomlCursor mass = point.at("mass", "a positive number of kg");
    const TomlCursor position = point.at("position", "3 numbers of m, body axes");
    points[i] = {read_mass(mass), position.vector("m")};
  }
  return points;
}

/// Mass, mass centre and inertia from the points, about the origin of their positions.
void take_point_masses(const TomlCursor& table, Body& body) {
  for (const std::string_view other : {"mass", "inertia", "center_of_mass"}) {
    if (!table.has(other)) continue;
    const TomlCursor given = table.at(other, "");
    given.fail("is given beside point_masses, which says it already; leave one of them out");
  }
  const TomlCursor list = table.at("point_masses", "a list");
  const std::vector<PointMass> points = read_point_masses(list);
  body.mass = total_mass(points);
  body.inertia = inertia_of(points);
  body.center_of_mass = mass_center(points);
  double size = 0;
  for (const PointMass& p : points) size = std::max(size, p.position.norm());
  if (body.pinned) return;
  if (!(body.center_of_mass.norm() <= 1e-9 * size)) {
    list.fail("has its mass centre at " + vector_text(body.center_of_mass) +
              " m; it must be at the origin of a body that is not pinned");
  }
  body.center_of_mass.setZero();
}

/// Some published problems have moments that no body has. The equations allow them; the scenario must declare them.
void check_inertia(const TomlCursor& table, std::string_view source, const Body& body) {
  const TomlCursor cursor = table.at(source, "");
  const std::string unusable = equations_inertia_fault(body.inertia);
  if (!unusable.empty()) cursor.fail("the inertia " + unusable);
  if (body_key(table, "unphysical_inertia").boolean()) return;
  const std::string impossible = inertia_fault(body.inertia);
  if (!impossible.empty()) cursor.fail("the inertia " + impossible + "; unphysical_inertia = true lets it pass");
}

/// True if a static body's shape is also read for its inertia, so that errors in it are reported: all shapes but those
/// whose inertia has no formula.
bool has_formula(const TomlCursor& shape) {
  if (shape.value().type != TomlValue::Type::table || !shape.has("kind")) return true;
  const ShapeEntry* entry = find_shape(shape.at("kind", "").text("the name of a shape"));
  return !entry || entry->moments;
}

/// Reads the key `inertia`, or that of the shape; `mass` and `center_of_mass` are already set.
void take_inertia(const TomlCursor& table, Body& body) {
  // A static body needs no inertia, and some shapes have none.
  const bool needed = table.has("shape") && (!body.fixed || has_formula(table.at("shape", "")));
  const Matrix3<double> of_shape =
      needed ? read_shape(table.at("shape", ""), body.mass) : Matrix3<double>(Matrix3<double>::Identity());
  if (table.has("inertia")) {
    body.inertia = read_inertia(table.at("inertia", ""));
    check_inertia(table, "inertia", body);
    // Symmetric to 1e-9 is what was checked; the equations take it to be exact.
    body.inertia = (0.5 * body.inertia + 0.5 * body.inertia.transpose()).eval();
  } else if (needed) {
    body.inertia = inertia_about_point(of_shape, body.mass, body.center_of_mass);
    check_inertia(table, "shape", body);
  } else if (!body.fixed) {
    table.at("inertia", "3 principal moments of kg m^2; or give a shape or point_masses, of which it follows");
  }
}

Vector3<double> read_center(const TomlCursor& table, bool pinned) {
  const TomlCursor cursor = body_key(table, "center_of_mass");
  const Vector3<double> center = cursor.vector("m");
  if (!pinned && !center.isZero(0)) {
    cursor.fail("is for a body with pinned = true; any other has its mass centre at the origin of its axes");
  }
  return center;
}

Body read_matter(const TomlCursor& table, std::size_t index) {
  Body body;
  body.name = read_name(table, index);
  body.pinned = body_key(table, "pinned").boolean();
  const TomlCursor fixed = body_key(table, "static");
  body.fixed = fixed.boolean();
  if (body.pinned && body.fixed) fixed.fail("a body is static or pinned, not both");
  if (table.has("point_masses")) {
    take_point_masses(table, body);
    if (table.has("shape")) read_shape(table.at("shape", ""), body.mass);
    check_inertia(table, "point_masses", body);
    return body;
  }
  if (table.has("mass") || !body.fixed) body.mass = read_mass(table.at("mass", "a positive number of kg"));
  body.center_of_mass = read_center(table, body.pinned);
  take_inertia(table, body);
  return body;
}

// Start.

Quaternion<double> read_orientation(const TomlCursor& orientation) {
  constexpr std::string_view must_be = "a quaternion of 4 numbers w, x, y, z and of length 1";
  if (orientation.list(must_be) != 4) orientation.refuse(must_be);
  Quaternion<double> q;
  for (Eigen::Index i = 0; i < 4; ++i) {
    const TomlCursor component = orientation.item(static_cast<std::size_t>(i));
    q[i] = component.number("");
  }
  const double length = q.norm();
  if (std::abs(length - 1) <= 1e-6) return q;
  orientation.fail("the quaternion has the length " + exact(length) + "; it must be 1 to within 1e-6");
}

/// A vector that must be zero for this body; `why` says so.
Vector3<double> read_motion(const TomlCursor& vector, std::string_view unit, bool moves, std::string_view why) {
  const Vector3<double> v = vector.vector(unit);
  if (!moves && !v.isZero(0)) vector.fail(std::string(why));
  return v;
}

/// The shape of a body that touches nothing, for pictures. Null where the sizes are fit for moments alone.
ShapePointer seen_shape(const TomlCursor& shape) {
  const ShapeEntry* entry = find_shape(shape.at("kind", "the name of a shape").text("the name of a shape"));
  if (!entry) return nullptr;
  const ShapeParameters sizes = read_sizes(shape, *entry);
  try {
    return entry->make(sizes);
  } catch (const std::invalid_argument&) {
    return nullptr;
  }
}

void read_collider(const TomlCursor& table, bool contact, ReadBody& read) {
  const TomlCursor restitution = body_key(table, "restitution");
  Collider& collider = read.collider;
  collider.restitution = restitution.number("", Range::non_negative);
  if (collider.restitution > 1) restitution.refuse("a number from 0 to 1");
  collider.friction = body_key(table, "friction").number("", Range::non_negative);
  if (!table.has("shape")) return;
  const TomlCursor shape = table.at("shape", "");
  if (!contact) {
    read.shape = seen_shape(shape);
    return;
  }
  const ShapeEntry& entry = read_shape_kind(shape);
  const ShapeParameters sizes = read_sizes(shape, entry);
  read.shape = collider.shape = build_shape(shape, entry, sizes);
  if (!collider.shape->finite() && !read.body.fixed) {
    shape.fail("a " + std::string(collider.shape->kind()) + " has no end; its body must be static");
  }
  read.canonical_collider = canonical_collider(collider, sizes.values);
}

}  // namespace

TomlCursor body_key(const TomlCursor& body, std::string_view name) {
  return body.at(name, otherwise(body_keys(), name));
}

BodyStart read_start(const TomlCursor& table, const Body& body) {
  BodyStart start;
  start.position = body_key(table, "position").vector("m");
  start.orientation = read_orientation(body_key(table, "orientation"));
  start.velocity = read_motion(body_key(table, "velocity"), "m/s", !body.fixed && !body.pinned,
                               body.pinned ? "a pinned body has no velocity: its pivot stays where it is; "
                                             "give an angular_velocity"
                                           : "a static body does not move");
  start.angular_velocity =
      read_motion(body_key(table, "angular_velocity"), "rad/s", !body.fixed, "a static body does not move");
  const TomlCursor frame = body_key(table, "angular_velocity_frame");
  constexpr std::string_view frames = "\"world\" or \"body\"";
  const std::string& name = frame.text(frames);
  if (name != "world" && name != "body") frame.refuse(frames);
  start.angular_velocity_in_body = name == "body";
  return start;
}

bool is_of_start(std::string_view key) {
  constexpr std::string_view keys[] = {"position", "orientation", "velocity", "angular_velocity",
                                       "angular_velocity_frame"};
  return std::find(std::begin(keys), std::end(keys), key) != std::end(keys);
}

ReadBody read_body(const TomlCursor& table, std::size_t index, bool contact) {
  static const std::vector<std::string_view> known = names(body_keys());
  table.table("A body has", known);
  ReadBody read;
  read.body = read_matter(table, index);
  read.start = read_start(table, read.body);
  read.has_mass = table.has("mass") || table.has("point_masses");
  read_collider(table, contact, read);
  return read;
}

}  // namespace polhode::study::scenario
