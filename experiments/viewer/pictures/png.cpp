// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/pictures/png.hpp"

#include <png.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>

namespace polhode::viewer::inline pictures {

void write_png(const std::filesystem::path& path, const Picture& picture) {
  const std::string temporary = path.string() + ".new";
  const auto fail = [&](const std::string& why) {
    std::remove(temporary.c_str());
    throw std::runtime_error("cannot write " + path.string() + ": " + why);
  };
  std::FILE* file = std::fopen(temporary.c_str(), "wb");
  if (!file) fail(std::strerror(errno));

  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width);
  image.height = static_cast<png_uint_32>(picture.height);
  image.format = PNG_FORMAT_RGB;
  image.flags = PNG_IMAGE_FLAG_FAST;
  const bool written = png_image_write_to_stdio(&image, file, 0, picture.rgb.data(), 0, nullptr) != 0;
  const std::string reason = written ? "" : image.message;
  png_image_free(&image);
  const bool closed = std::fclose(file) == 0;
  if (!written) fail(reason);
  if (!closed || std::rename(temporary.c_str(), path.c_str()) != 0) fail(std::strerror(errno));
}

}  // namespace polhode::viewer::pictures
