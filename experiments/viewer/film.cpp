// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/film.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

namespace polhode::viewer {

namespace {

using study::report::ChildProcess;

[[noreturn]] void no_encoder(const std::filesystem::path& path) {
  throw std::runtime_error(
      fmt::format("no film {}: ffmpeg is not installed; install the package ffmpeg, or make a film of the "
                  "PNG pictures elsewhere",
                  path.string()));
}

bool has_x264(const std::filesystem::path& path) {
  auto asked = ChildProcess::start({"ffmpeg", "-hide_banner", "-loglevel", "error", "-encoders"}, ".", {});
  if (!asked) no_encoder(path);
  return asked->wait().printed.find(" libx264 ") != std::string::npos;
}

std::string last_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
  const auto start = text.find_last_of("\n\r");
  return start == std::string::npos ? text : text.substr(start + 1);
}

}  // namespace

Film::Film(std::filesystem::path path, int width, int height, int pictures_a_second)
    : path_(std::move(path)), unfinished_(path_.string() + ".new"), width_(width), height_(height) {
  std::vector<std::string> command = {"ffmpeg", "-hide_banner", "-loglevel", "error", "-nostdin", "-y"};
  const auto add = [&](std::vector<std::string> more) { command.insert(command.end(), more.begin(), more.end()); };
  add({"-f", "rawvideo", "-pix_fmt", "rgb24", "-video_size", fmt::format("{}x{}", width, height)});
  add({"-framerate", std::to_string(pictures_a_second), "-i", "pipe:0"});
  // Halved colours want even edges.
  add({"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p"});
  // With another number of threads libx264 writes other bytes.
  if (has_x264(path_)) {
    add({"-c:v", "libx264", "-preset", "medium", "-crf", "18", "-threads", "4"});
  } else {
    add({"-c:v", "mpeg4", "-q:v", "3", "-threads", "1"});
  }
  add({"-flags", "+bitexact", "-fflags", "+bitexact", "-map_metadata", "-1", "-movflags", "+faststart", "-f", "mp4"});
  add({"file:" + unfinished_.string()});
  auto started = ChildProcess::start(command, ".", {}, ChildProcess::Input::fed);
  if (!started) no_encoder(path_);
  encoder_.emplace(std::move(*started));
}

Film::~Film() {
  if (!encoder_) return;
  encoder_.reset();
  std::error_code ignored;
  std::filesystem::remove(unfinished_, ignored);
}

void Film::fail(const std::string& printed) {
  encoder_.reset();
  std::error_code ignored;
  std::filesystem::remove(unfinished_, ignored);
  const std::string why = last_line(printed);
  throw std::runtime_error(
      fmt::format("no film {}: ffmpeg failed: {}", path_.string(), why.empty() ? "it gives no reason" : why));
}

void Film::add(const Picture& picture) {
  if (picture.width != width_ || picture.height != height_) {
    throw std::runtime_error(fmt::format("no film {}: a picture of {}×{} pixels among those of {}×{}", path_.string(),
                                         picture.width, picture.height, width_, height_));
  }
  if (!encoder_->feed(picture.rgb)) fail(encoder_->wait().printed);
}

void Film::finish() {
  const auto outcome = encoder_->wait();
  if (outcome.exit_status != 0) fail(outcome.printed);
  encoder_.reset();
  std::filesystem::rename(unfinished_, path_);
}

}  // namespace polhode::viewer
