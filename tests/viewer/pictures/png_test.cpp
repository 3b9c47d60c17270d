// SPDX-License-Identifier: BSD-3-Clause
// PNG files say what was written.
#include "experiments/viewer/pictures/png.hpp"

#include <gtest/gtest.h>
#include <png.h>

#include <filesystem>
#include <stdexcept>

#include "tests/temporary_folder.hpp"

namespace polhode::viewer::png_test {
namespace {

namespace fs = std::filesystem;

TEST(Png, ReadsBackAsWritten) {
  Picture picture{37, 23, {}};
  for (int i = 0; i < 37 * 23 * 3; ++i) picture.rgb.push_back(std::uint8_t(i * 7 + i / 256));
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "picture.png";
  write_png(path, picture);
  EXPECT_FALSE(fs::exists(path.string() + ".new"));

  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  ASSERT_TRUE(png_image_begin_read_from_file(&image, path.c_str())) << image.message;
  EXPECT_EQ(image.width, 37u);
  EXPECT_EQ(image.height, 23u);
  image.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> rgb(PNG_IMAGE_SIZE(image));
  ASSERT_TRUE(png_image_finish_read(&image, nullptr, rgb.data(), 0, nullptr)) << image.message;
  EXPECT_TRUE(rgb == picture.rgb);
}

TEST(Png, AnErrorNamesTheFile) {
  const Picture picture{1, 1, {1, 2, 3}};
  try {
    write_png("/nowhere/at/all.png", picture);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "cannot write /nowhere/at/all.png: No such file or directory");
  }
}

}  // namespace
}  // namespace polhode::viewer::png_test
