// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/pictures/film.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace polhode::viewer::inline pictures {

namespace {

using study::ChildProcess;

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

/// True if the MP4 file is complete: its boxes (ISO/IEC 14496-12, 4.2) end at the end of the file and include the
/// pictures and their index. On a full disk ffmpeg may report success for an incomplete file.
bool is_whole(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  std::uintmax_t at = 0;
  bool pictures = false, index = false;
  std::array<unsigned char, 16> head{};
  while (!error && at + 8 <= size && file.seekg(static_cast<std::streamoff>(at))) {
    file.read(reinterpret_cast<char*>(head.data()),
              static_cast<std::streamsize>(std::min<std::uintmax_t>(16, size - at)));
    file.clear();
    const auto number = [&](std::size_t first, std::size_t bytes) {
      std::uintmax_t n = 0;
      for (std::size_t k = first; k < first + bytes; ++k) n = n << 8 | head[k];
      return n;
    };
    const std::string_view name(reinterpret_cast<const char*>(head.data()) + 4, 4);
    pictures |= name == "mdat";
    index |= name == "moov";
    const std::uintmax_t length = number(0, 4) == 1 ? number(8, 8) : number(0, 4);
    if (length < 8 || length > size - at) return false;
    at += length;
  }
  return !error && at == size && pictures && index;
}

std::string last_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
  const auto start = text.find_last_of("\n\r");
  return start == std::string::npos ? text : text.substr(start + 1);
}

}  // namespace

Film::Film(std::filesystem::path path, int width, int height, int pictures_a_second)
    : path_(std::move(path)), unfinished_(path_.string() + ".new"), width_(width), height_(height) {
  std::vector<std::string> command = {"ffmpeg", "-hide_banner", "-loglevel", "error", "-xerror", "-nostdin", "-y"};
  const auto add = [&](std::vector<std::string> more) { command.insert(command.end(), more.begin(), more.end()); };
  add({"-f", "rawvideo", "-pix_fmt", "rgb24", "-video_size", fmt::format("{}x{}", width, height)});
  add({"-framerate", std::to_string(pictures_a_second), "-i", "pipe:0"});
  // Colours at half the resolution require even width and height.
  add({"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p"});
  // The bytes that libx264 writes depend on the number of threads.
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
  if (!is_whole(unfinished_)) fail(outcome.printed.empty() ? "the file that it wrote is not whole" : outcome.printed);
  encoder_.reset();
  std::filesystem::rename(unfinished_, path_);
}

}  // namespace polhode::viewer::pictures
