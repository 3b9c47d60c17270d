// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/text_file.hpp"
#include "experiments/study/text/toml_cursor.hpp"
#include "experiments/viewer/session/segment_options.hpp"
#include "experiments/viewer/session/segment_run.hpp"
#include "experiments/viewer/session/session_record.hpp"

namespace polhode::viewer::inline session {
namespace {

using study::TomlCursor;
using Range = TomlCursor::Range;

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

study::OptionValue value_of(const TomlCursor& cursor, const SegmentOption& said) {
  const study::RunOption& option = *said.option;
  if (option.kind == study::RunOption::Kind::number) return cursor.number(option.unit, Range::positive);
  if (option.kind == study::RunOption::Kind::whole) {
    const double x = cursor.number("", Range::positive);
    if (x != std::floor(x) || (option.fault && !option.fault(x).empty()))
      cursor.refuse("a whole number, not too large");
    return static_cast<std::int64_t>(x);
  }
  if (option.takes_all || !option.known) return cursor.text("a name");
  const std::vector<std::string> known = option.known();
  if (!said.if_true.empty()) {
    const bool on = cursor.boolean();
    return *std::find_if(known.begin(), known.end(), [&](const auto& name) { return (name == said.if_true) == on; });
  }
  const std::string& text = cursor.text("one of its names");
  if (std::find(known.begin(), known.end(), text) == known.end())
    cursor.unknown(cursor.path(), "There are", {known.begin(), known.end()});
  return text;
}

/// True if the option is part of RunConfig::contact.
bool is_of_contact(const study::RunOption& option) {
  study::RunConfig with;
  with.contact.emplace();
  return option.value(with) != option.value({});
}

Configuration configuration_of(const TomlCursor& segment) {
  Configuration c;
  c.drive = choice(segment.at("drive", "said for each segment"), {Drive::accumulator, Drive::frame_clock});
  for (const SegmentOption& said : segment_options()) {
    const study::RunOption& option = *said.option;
    bool needed = option.value({}) != study::OptionValue{};
    if (is_of_contact(option)) {
      if (!segment.has("response")) continue;
      needed = option.name != "impact-timing";
    }
    if (!needed && !segment.has(said.key)) continue;
    const TomlCursor cursor = segment.at(said.key, option.takes_all ? "a name" : "said for each segment");
    option.set(c.run, value_of(cursor, said));
  }
  return c;
}

std::vector<std::string_view> keys_of(const std::vector<SegmentOption>& options) {
  std::vector<std::string_view> keys = {"from_segment", "from_step", "drive"};
  for (const SegmentOption& said : options) keys.push_back(said.key);
  keys.push_back("part");
  return keys;
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
  const std::vector<SegmentOption> options = segment_options();  // hold the keys
  cursor.table("A segment has", keys_of(options));
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
  if (said.text("16 hexadecimal digits") != digest(scenario.canonical())) {
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

}  // namespace polhode::viewer::session
