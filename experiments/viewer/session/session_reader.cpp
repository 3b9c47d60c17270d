// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/text_file.hpp"
#include "experiments/study/text/toml_cursor.hpp"
#include "experiments/viewer/session/segment_run.hpp"
#include "experiments/viewer/session/session_record.hpp"

namespace polhode::viewer {
namespace {

using study::TomlCursor;
using Range = TomlCursor::Range;

const std::vector<std::string_view> segment_keys = {
    "from_segment", "from_step",    "drive",       "integrator",    "dt",         "tolerance",     "order",
    "summation",    "t_end",        "orientation", "angular_state", "gyroscopic", "rotation_from", "normalise",
    "broad_phase",  "narrow_phase", "response",    "impact_timing", "part"};

std::int64_t whole(const TomlCursor& cursor, double most) {
  const double x = cursor.number("", Range::non_negative);
  if (x != std::floor(x) || x > most) cursor.refuse("a whole number, not too large");
  return static_cast<std::int64_t>(x);
}
constexpr double most_steps = 9e15;

template <class T>
T choice(const TomlCursor& cursor, std::initializer_list<T> all) {
  std::vector<std::string_view> known;
  const std::string& said = cursor.text("one of its names");
  for (const T value : all) {
    known.push_back(name(value));
    if (name(value) == said) return value;
  }
  cursor.unknown(cursor.path(), "There are", known);
}

std::string text_of(const TomlCursor& table, std::string_view key) {
  const TomlCursor cursor = table.at(key, "a name");
  return cursor.text("a name");
}

Configuration configuration_of(const TomlCursor& segment) {
  Configuration c;
  study::RunConfig& run = c.run;
  const auto at = [&](std::string_view key) { return segment.at(key, "said for each segment"); };
  c.drive = choice(at("drive"), {Drive::accumulator, Drive::frame_clock});
  run.integrator = text_of(segment, "integrator");
  if (segment.has("dt")) run.dt = at("dt").number("s", Range::positive);
  if (segment.has("tolerance")) run.tolerance = at("tolerance").number("", Range::positive);
  if (segment.has("order")) run.order = static_cast<int>(whole(at("order"), 100));
  if (segment.has("summation"))
    run.summation = choice(at("summation"), {study::Summation::plain, study::Summation::compensated});
  run.t_end = at("t_end").number("s", Range::positive);
  Formulation& f = run.formulation;
  f.orientation = choice(at("orientation"), {Orientation::quaternion, Orientation::matrix});
  f.angular_state = choice(at("angular_state"),
                           {AngularState::velocity_world, AngularState::velocity_body, AngularState::momentum_world});
  f.gyroscopic = at("gyroscopic").boolean();
  f.rotation_from = choice(at("rotation_from"), {RotationFrom::normalised, RotationFrom::stored});
  run.normalise = at("normalise").boolean();
  if (segment.has("response")) {
    run.contact = {text_of(segment, "broad_phase"), text_of(segment, "narrow_phase"), text_of(segment, "response"),
                   segment.has("impact_timing") ? text_of(segment, "impact_timing") : ""};
  }
  return c;
}

SegmentPart part_of(const TomlCursor& cursor, Drive drive) {
  cursor.table("A part has", {"steps", "sizes", "digest"});
  SegmentPart part;
  if (drive == Drive::frame_clock) {
    const TomlCursor sizes = cursor.at("sizes", "a list of seconds");
    part.steps = static_cast<std::int64_t>(sizes.list("a list of seconds"));
    for (std::size_t i = 0; i < std::size_t(part.steps); ++i)
      part.sizes.push_back(sizes.item(i).number("s", Range::positive));
  } else {
    part.steps = whole(cursor.at("steps", "a whole number"), most_steps);
  }
  const TomlCursor said = cursor.at("digest", "16 hexadecimal digits");
  part.digest = said.text("16 hexadecimal digits");
  const auto is_hex = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
  const bool good = part.digest.size() == 16 && std::all_of(part.digest.begin(), part.digest.end(), is_hex);
  if (!good) said.refuse("16 hexadecimal digits");
  return part;
}

SegmentStart start_of(const TomlCursor& cursor, const std::vector<RecordedSegment>& before) {
  if (!cursor.has("from_segment")) return {};
  const TomlCursor segment = cursor.at("from_segment", "a segment before it"),
                   step = cursor.at("from_step", "a whole number");
  SegmentStart from{whole(segment, most_steps), whole(step, most_steps)};
  if (from.segment < 1 || from.segment > static_cast<std::int64_t>(before.size()))
    segment.refuse("a segment before it, from 1");
  if (from.step > before[std::size_t(from.segment - 1)].steps()) step.refuse("a step that this segment came to");
  return from;
}

RecordedSegment segment_of(const TomlCursor& cursor, const study::Scenario& scenario,
                           const std::vector<RecordedSegment>& before) {
  cursor.table("A segment has", segment_keys);
  RecordedSegment segment;
  segment.configuration = configuration_of(cursor);
  segment.configuration.run.scenario = scenario.name;
  segment.from = start_of(cursor, before);
  if (std::string reason = refusal(segment.configuration, scenario); !reason.empty()) cursor.fail(std::move(reason));
  if (!cursor.has("part")) return segment;
  const TomlCursor parts = cursor.at("part", "a list of tables");
  const std::size_t count = parts.list("a list of tables");
  for (std::size_t i = 0; i < count; ++i) segment.parts.push_back(part_of(parts.item(i), segment.configuration.drive));
  if (static_cast<double>(segment.steps()) > most_steps) parts.fail("more steps than can be counted");
  return segment;
}

study::Scenario scenario_of(const TomlCursor& root, const std::string& origin) {
  std::vector<study::Override> overrides;
  if (root.has("override")) {
    const TomlCursor list = root.at("override", "a list of tables");
    const std::size_t count = list.list("a list of tables");
    for (std::size_t i = 0; i < count; ++i) {
      const TomlCursor item = list.item(i);
      item.table("An override has", {"key", "value"});
      const TomlCursor key = item.at("key", "a key of the scenario"), value = item.at("value", "a TOML value as text");
      overrides.push_back({key.text("a key of the scenario"), value.text("a TOML value as text"),
                           origin + ":" + std::to_string(value.value().place.line) + ": " + item.path()});
    }
  }
  const std::string label = origin + ": scenario";
  std::string from = text_of(root, "scenario");
  if (is_path(from)) from = (std::filesystem::path(origin).parent_path() / from).string();
  study::Scenario scenario = study::ScenarioSource::open(from, label).resolve(overrides);
  const TomlCursor said = root.at("scenario_digest", "16 hexadecimal digits");
  if (said.text("16 hexadecimal digits") != digest(scenario.canonical)) {
    said.fail("the scenario is not the one that was recorded; take its old version");
  }
  return scenario;
}

SessionRecord record_of(const TomlCursor& root, const std::string& origin) {
  root.table("A session has", {"version", "scenario", "scenario_digest", "override", "segment"});
  const TomlCursor version = root.at("version", "1");
  if (version.number("") != 1) version.refuse("1");
  SessionRecord record;
  record.scenario = scenario_of(root, origin);
  const TomlCursor segments = root.at("segment", "a list of tables");
  const std::size_t count = segments.list("a list of tables");
  for (std::size_t i = 0; i < count; ++i) {
    record.segments.push_back(segment_of(segments.item(i), record.scenario, record.segments));
  }
  return record;
}

}  // namespace

SessionRecord parse_session(std::string_view text, const std::string& origin) {
  const auto at = [&](study::TomlPlace place) {
    return place.line > 0 ? origin + ":" + std::to_string(place.line) + ":" + std::to_string(place.column) + ": "
                          : origin + ": ";
  };
  try {
    const study::TomlValue root = study::parse_toml(text);
    return record_of(TomlCursor(root), origin);
  } catch (const study::TomlSyntaxError& error) {
    throw study::InputError(at(error.place) + error.message);
  } catch (const study::Fault& fault) {
    const std::string path = fault.path.empty() ? "" : fault.path + ": ";
    throw study::InputError(at(fault.place) + path + fault.message);
  }
}

SessionRecord read_session(const std::string& path) { return parse_session(study::read_text(path), path); }

}  // namespace polhode::viewer
