// SPDX-License-Identifier: BSD-3-Clause
// Makes a film of pictures by ffmpeg: H.264 where it has libx264, else MPEG-4. The same pictures give the same file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "experiments/study/text/child_process.hpp"
#include "experiments/viewer/pictures/picture.hpp"

namespace polhode::viewer::inline pictures {

class Film {
 public:
  /// Pictures of that size, so many a second. Throws std::runtime_error in one line where there is no ffmpeg.
  Film(std::filesystem::path path, int width, int height, int pictures_a_second);
  Film(const Film&) = delete;
  Film& operator=(const Film&) = delete;
  ~Film();  ///< of one that was not finished nothing stays

  /// Throws std::runtime_error with the last line of ffmpeg where it fails.
  void add(const Picture& picture);
  /// The file is there after this, and not before. Throws as add() does.
  void finish();

 private:
  [[noreturn]] void fail(const std::string& printed);
  std::filesystem::path path_, unfinished_;
  int width_, height_;
  std::optional<study::ChildProcess> encoder_;
};

}  // namespace polhode::viewer
