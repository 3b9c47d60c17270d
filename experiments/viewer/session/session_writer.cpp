// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "experiments/study/text/value_lists.hpp"
#include "experiments/viewer/session/segment_options.hpp"
#include "experiments/viewer/session/segment_run.hpp"
#include "experiments/viewer/session/session_record.hpp"

namespace polhode::viewer::inline session {
namespace {

std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') out += '\\';
    if (byte < 0x20 || byte == 0x7f) out += fmt::format("\\u{:04x}", byte);
    else out += c;
  }
  return out + '"';
}

std::string line(std::string_view key, std::string_view text) { return fmt::format("{} = {}\n", key, quoted(text)); }
std::string line(std::string_view key, double x) { return fmt::format("{} = {}\n", key, study::exact(x)); }
std::string line(std::string_view key, bool on) { return fmt::format("{} = {}\n", key, on); }

/// Path of a scenario file relative to the record's folder, so that both can be moved together.
std::string seen_from(const std::filesystem::path& record, const std::string& scenario) {
  if (!is_path(scenario)) return scenario;
  std::error_code error;
  const auto folder = std::filesystem::absolute(record, error).parent_path();
  const std::string path =
      std::filesystem::proximate(std::filesystem::absolute(scenario, error), folder, error).string();
  if (error || path.empty()) return scenario;
  return is_path(path) ? path : "./" + path;
}

}  // namespace

bool is_path(const std::string& scenario) {
  return scenario.find('/') != std::string::npos || scenario.ends_with(".toml");
}

std::int64_t RecordedSegment::steps() const {
  std::int64_t sum = 0;
  for (const SegmentPart& part : parts) sum += part.steps;
  return sum;
}

SessionWriter::SessionWriter(const std::filesystem::path& path, const SessionSetup& setup,
                             const study::Scenario& scenario)
    : path_(path.string()) {
  std::error_code ignored;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), ignored);
  file_ = std::fopen(path_.c_str(), "wb");
  if (!file_) throw std::runtime_error("cannot write " + path_ + ": " + std::strerror(errno));
  std::string text = "# A session of polhode's viewer, as it went; it can be carried out again.\nversion = 1\n";
  text += line("scenario", seen_from(path, setup.scenario)) + line("scenario_digest", digest(scenario.canonical()));
  for (const study::Override& o : setup.overrides) {
    text += "\n[[override]]\n" + line("key", o.key) + line("value", o.value);
  }
  append(text);
}

SessionWriter::~SessionWriter() {
  if (file_) std::fclose(file_);
}

void SessionWriter::begin(SegmentStart from, const Configuration& configuration) {
  std::string text = "\n[[segment]]\n";
  if (from.segment > 0) {
    text += line("from_segment", static_cast<double>(from.segment)) + line("from_step", static_cast<double>(from.step));
  }
  text += line("drive", name(configuration.drive));
  for (const auto& [option, key, if_true] : segment_options()) {
    const std::string said = study::text_of(option->value(configuration.run));
    if (said.empty()) continue;
    if (!if_true.empty()) text += line(key, said == if_true);
    else if (option->kind == study::RunOption::Kind::name) text += line(key, said);
    else text += fmt::format("{} = {}\n", key, said);
  }
  append(text);
}

void SessionWriter::add(const SegmentPart& part) {
  std::string text = "\n[[segment.part]]\n";
  if (part.sizes.empty()) {
    text += line("steps", static_cast<double>(part.steps));
  } else {
    text += "sizes = [";
    for (const double h : part.sizes) text += (text.back() == '[' ? "" : ", ") + study::exact(h);
    text += "]\n";
  }
  append(text + line("digest", part.digest));
}

void SessionWriter::append(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), file_) == text.size() && std::fflush(file_) == 0) return;
  throw std::runtime_error("cannot write " + path_ + ": " + std::strerror(errno));
}

}  // namespace polhode::viewer::session
