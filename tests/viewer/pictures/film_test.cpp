// SPDX-License-Identifier: BSD-3-Clause
// Films: the same pictures give the same file, and what goes wrong is said in one line.
#include "experiments/viewer/pictures/film.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "tests/temporary_folder.hpp"

namespace polhode::viewer::film_test {
namespace {

namespace fs = std::filesystem;

Picture picture_number(int number, int width, int height) {
  Picture picture{width, height, {}};
  for (int i = 0; i < 3 * width * height; ++i) picture.rgb.push_back(std::uint8_t(i / 5 + 8 * number));
  return picture;
}

bool has_ffmpeg() {
  auto asked = study::ChildProcess::start({"ffmpeg", "-version"}, ".", {});
  return asked && asked->wait().exit_status == 0;
}

std::string film(const fs::path& path, int width, int height) {
  Film film(path, width, height, 25);
  for (int i = 0; i < 12; ++i) film.add(picture_number(i, width, height));
  EXPECT_FALSE(fs::exists(path));
  film.finish();
  std::ifstream file(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), {}};
  fs::remove(path);
  return bytes;
}

class FilmTest : public testing::Test {
 protected:
  fs::path somewhere() const { return folder_.path() / "film.mp4"; }

 private:
  TemporaryFolder folder_;
};

TEST_F(FilmTest, TheSamePicturesGiveTheSameFileOfOddSizesToo) {
  if (!has_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
  const std::string first = film(somewhere(), 161, 93);
  EXPECT_GT(first.size(), 500u);
  EXPECT_EQ(first.substr(4, 4), "ftyp");
  EXPECT_TRUE(first == film(somewhere(), 161, 93));
}

TEST_F(FilmTest, OneThatIsNotFinishedLeavesNothing) {
  if (!has_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
  {
    Film film(somewhere(), 64, 64, 25);
    film.add(picture_number(0, 64, 64));
  }
  EXPECT_FALSE(fs::exists(somewhere()));
  EXPECT_FALSE(fs::exists(somewhere().string() + ".new"));
}

TEST_F(FilmTest, SaysWhatFfmpegSays) {
  if (!has_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
  try {
    Film film("/nowhere/at/all.mp4", 64, 64, 25);
    for (int i = 0; i < 500; ++i) film.add(picture_number(i, 64, 64));
    film.finish();
    FAIL();
  } catch (const std::runtime_error& error) {
    const std::string said = error.what();
    EXPECT_EQ(said.rfind("no film /nowhere/at/all.mp4: ffmpeg failed: ", 0), 0u) << said;
    EXPECT_NE(said.find("No such file or directory"), std::string::npos) << said;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  }
}

TEST_F(FilmTest, WithoutFfmpegOneLineNamesThePackage) {
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", "/nowhere", 1);
  std::string said;
  try {
    Film film(somewhere(), 64, 64, 25);
  } catch (const std::runtime_error& error) {
    said = error.what();
  }
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_NE(said.find("install the package ffmpeg"), std::string::npos) << said;
}

}  // namespace
}  // namespace polhode::viewer::film_test
