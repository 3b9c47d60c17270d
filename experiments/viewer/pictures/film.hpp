// SPDX-License-Identifier: BSD-3-Clause
// Makes a film of pictures with ffmpeg: H.264 if it has libx264, else MPEG-4. Equal pictures give equal files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "experiments/study/text/child_process.hpp"
#include "experiments/viewer/pictures/picture.hpp"

namespace polhode::viewer::inline pictures {

class Film {
 public:
  /// A film of pictures of that size, at that rate (1/s). Throws std::runtime_error (one line) if ffmpeg is not
  /// installed.
  Film(std::filesystem::path path, int width, int height, int pictures_a_second);
  Film(const Film&) = delete;
  Film& operator=(const Film&) = delete;
  ~Film();  ///< deletes a film that was not finished

  /// Adds a picture. Throws std::runtime_error with ffmpeg's last line if it fails.
  void add(const Picture& picture);
  /// Finishes the file, which does not exist before. Throws like add().
  void finish();

 private:
  [[noreturn]] void fail(const std::string& printed);
  std::filesystem::path path_, unfinished_;
  int width_, height_;
  std::optional<study::ChildProcess> encoder_;
};

}  // namespace polhode::viewer::pictures
