// SPDX-License-Identifier: BSD-3-Clause
// Files of the user that are no files, have no end or are nested without an end, and what messages quote of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <csignal>
#include <fstream>
#include <functional>
#include <thread>

#include "experiments/study/text/csv_reader.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/legible.hpp"
#include "experiments/study/text/text_file.hpp"
#include "experiments/study/text/toml_value.hpp"
#include "tests/temporary_folder.hpp"

namespace polhode::study::input_files_test {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

std::string refusal_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

class InputFiles : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  std::string file(const std::string& text) const {
    std::ofstream(path("file"), std::ios::binary) << text;
    return path("file");
  }

 private:
  TemporaryFolder folder_;
};

TEST(Legible, KeepsWhatIsLegible) {
  for (const std::string text :
       {"", " ", "a.toml:1:2: mass: -1 kg m² is not…", "two  blanks ", "\U0001F600 \u65e5\u672c"}) {
    EXPECT_EQ(legible(text), text);
    EXPECT_EQ(shortened(text), text);
  }
}

TEST(Legible, SpellsOutWhatATerminalWouldObey) {
  EXPECT_EQ(legible("a\nb\r\x1b[2J\x7f"), "a\\x0ab\\x0d\\x1b[2J\\x7f");
  EXPECT_EQ(legible("\xc2\x9b \xff \xc3( \xe2\x82 \xc0\xaf \xed\xa0\x80 \xf4\x90\x80\x80"),
            "\\xc2\\x9b \\xff \\xc3( \\xe2\\x82 \\xc0\\xaf \\xed\\xa0\\x80 \\xf4\\x90\\x80\\x80");
  EXPECT_EQ(legible(std::string_view("\0", 1)), "\\x00");
}

TEST(Legible, CutsWhatNobodyReads) {
  const std::string name(100'000, 'x'), message = "f.toml:1:1: there is no '" + name + "'; take mass";
  EXPECT_LT(legible(message).size(), 400u);
  EXPECT_THAT(legible(message), StartsWith("f.toml:1:1: there is no 'xxx"));
  EXPECT_THAT(legible(message), EndsWith("xxx'; take mass"));
  EXPECT_THAT(legible(message), HasSubstr("xxx...xxx"));
  EXPECT_EQ(legible(legible(message)), legible(message));
  std::string lines;
  for (int i = 0; i < 5001; ++i) lines += "rk4\n";
  EXPECT_LT(legible(lines).size(), 400u);
  std::string words;
  for (int i = 0; i < 5001; ++i) words += "rk4 ";
  EXPECT_LE(legible(words).size(), 3000u);
  EXPECT_EQ(shortened(name), std::string(40, 'x') + "...");
  std::string letters;
  for (int i = 0; i < 1000; ++i) letters += "ä";
  for (const std::string& start : {std::string(), std::string("x")}) {
    EXPECT_THAT(legible(start + letters), HasSubstr("ä...ä")) << "no half letters";
    EXPECT_THAT(shortened(start + letters), EndsWith("ä...")) << "no half letters";
  }
}

TEST(Legible, EveryInputErrorIs) {
  const std::string what = InputError("no " + std::string(100'000, 'x') + "\n").what();
  EXPECT_LT(what.size(), 400u);
  EXPECT_THAT(what, EndsWith("\\x0a"));
}

TEST_F(InputFiles, ATextIsReadToItsLimit) {
  EXPECT_EQ(read_text(file("abc\n"), 4), "abc\n");
  EXPECT_THAT(refusal_of([&] { read_text(file("abcd\n"), 4); }), EndsWith("file: is larger than 4 bytes; give less"));
  EXPECT_THAT(refusal_of([&] { read_text(path(".")); }), HasSubstr("is a folder"));
  EXPECT_THAT(refusal_of([&] { read_text(path("none")); }), EndsWith("none: no such file, or it cannot be read"));
  EXPECT_THAT(refusal_of([&] { read_text(file(std::string("ab\0c", 4))); }), HasSubstr("file: byte 3 is zero"));
  EXPECT_THAT(refusal_of([&] { read_text("/dev/zero"); }), StartsWith("/dev/zero: byte 1 is zero"));
}

TEST_F(InputFiles, APipeIsReadToItsEndOrItsLimit) {
  const auto before = std::signal(SIGPIPE, SIG_IGN);  // the writer gets it when no reader is left
  const std::string pipe = path("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  for (const bool endless : {false, true}) {
    std::thread writer([&] {
      std::ofstream out(pipe);
      for (int i = 0; out && i < (endless ? 100'000 : 10); ++i) out << "0123456789\n" << std::flush;
    });
    if (endless) EXPECT_THAT(refusal_of([&] { read_text(pipe, 1000); }), HasSubstr("is larger than 1000 bytes"));
    else EXPECT_EQ(read_text(pipe, 1000).size(), 110u);
    writer.join();
  }
  std::signal(SIGPIPE, before);
}

TEST_F(InputFiles, WhatIsNoFileIsWrittenToAndStays) {
  std::filesystem::create_symlink("/dev/full", path("full"));
  EXPECT_THROW(write_text(path("full"), "text"), WriteError);
  EXPECT_TRUE(std::filesystem::is_symlink(path("full")));
  std::filesystem::create_symlink(file("old"), path("link"));
  write_text(path("link"), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(path("link")));
  EXPECT_EQ(read_text(path("file")), "new");
  const std::string pipe = path("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::string arrived;
  std::thread reader([&] { arrived = read_text(pipe); });
  write_text(pipe, "through the pipe");
  reader.join();
  EXPECT_EQ(arrived, "through the pipe");
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
}

TEST_F(InputFiles, ATableHasAnEnd) {
  const auto read = [&](const std::string& name, std::size_t most) {
    CsvReader table(name, most);
    while (table.next()) {
    }
  };
  const std::string rows = "a,b\n1,2\n3,4";
  EXPECT_NO_THROW(read(file(rows), rows.size()));
  EXPECT_THAT(refusal_of([&] { read(file(rows), rows.size() - 1); }),
              HasSubstr("file:3:1: the file is larger than 10 bytes"));
  EXPECT_THAT(refusal_of([&] { read(file("a,b\n1,2\n" + std::string(2 * mebibyte, '1')), 4 * mebibyte); }),
              HasSubstr("file:3:1: a line of more than 1 MiB"));
  EXPECT_THAT(refusal_of([&] { read(file(std::string("a,b\n1,2\0\n", 9)), mebibyte); }),
              HasSubstr("file:2:1: a zero byte"));
  EXPECT_THAT(refusal_of([&] { read(file(std::string("a,b\n1,2\0", 8)), mebibyte); }),
              HasSubstr("file:2:1: a zero byte"));
  EXPECT_THAT(refusal_of([&] { read("/dev/zero", mebibyte); }), HasSubstr("/dev/zero:1:1: a zero byte"));
}

TEST_F(InputFiles, ALineOfATableMayHaveAnyLengthBelowAMebibyte) {
  for (std::size_t buffer = 4096; buffer <= mebibyte; buffer *= 2) {
    for (const std::size_t length : {buffer - 2, buffer - 1, buffer, buffer + 1}) {
      const std::string cell = std::string(length - 3, 'x') + 'y';
      for (const char* end : {"\n3,4\n", "\n3,4", "\n", ""}) {
        CsvReader table(file("a,b\n1," + cell + end));
        if (length >= mebibyte) {
          EXPECT_THAT(refusal_of([&] { table.next(); }), HasSubstr("file:2:1: a line of more than 1 MiB"));
          continue;
        }
        ASSERT_TRUE(table.next());
        EXPECT_TRUE(table.text(1) == cell) << length;
        if (end[0] == '\0' || end[1] == '\0') {
          EXPECT_FALSE(table.next());
        } else {
          ASSERT_TRUE(table.next());
          EXPECT_EQ(table.text(1), "4");
          EXPECT_FALSE(table.next());
        }
      }
    }
  }
}

TEST_F(InputFiles, ATableIsReadByItsNames) {
  CsvReader table(file("z,y,x\n3,2,1\n"));
  const auto places = table.columns({"x", "y", "z"});
  ASSERT_TRUE(table.next());
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(table.integer(places[k]), static_cast<int>(k) + 1);
  EXPECT_THAT(refusal_of([&] { (void)table.columns({"x", "w"}); }), HasSubstr("there is no column w"));
}

std::string times(std::size_t n, const std::string& part) {
  std::string text;
  for (std::size_t i = 0; i < n; ++i) text += part;
  return text;
}

TEST(TomlNesting, WhatIsTooDeepIsRefusedWithItsPlace) {
  constexpr std::size_t n = 100'000;
  for (const std::string& text :
       {"x = 1\n" + times(n, "a.") + "a = 1", "x = 1\n" + times(n, "a . ") + "a = 1",
        "x = 1\n[" + times(n, "a.") + "a]", "x = 1\n[[" + times(n, "a.") + "a]]",
        "x = 1\n" + times(n, "\"=\".") + "a = 1", "x = 1\n" + times(n, "',\"'.") + "a = 1",
        "x = 1\na = " + times(n, "[") + times(n, "]"), "x = 1\n" + times(n, "a = {") + "b = 1" + times(n, "}"),
        "x = 1\na = " + times(60, "{" + times(60, "a.") + "a = ") + "1" + times(60, "}"),
        "x = 1\na = [\n" + times(n, "{a.a = [ # no\n")}) {
    try {
      parse_toml(text);
      ADD_FAILURE() << text.substr(0, 40);
    } catch (const TomlSyntaxError& error) {
      EXPECT_THAT(error.message, HasSubstr("nested more than 100 deep")) << text.substr(0, 40);
      EXPECT_GE(error.place.line, 2) << text.substr(0, 40);
    }
  }
}

TEST(TomlNesting, DotsElsewhereAreNotNesting) {
  for (const std::string& text : {"title = \"" + times(1000, ".") + "\"", "title = '" + times(1000, ".") + "'",
                                  "# " + times(1000, ".") + "\nx = 1", "title = \"\"\"" + times(1000, ".\n") + "\"\"\"",
                                  "title = '''" + times(1000, ".\n\"[") + "'''",
                                  "x = [" + times(1000, "1.5, ") + "2.5]", "x = [" + times(1000, "[1.5, 2.5],\n") + "]",
                                  "x = \"\\\"" + times(1000, ".") + "\"", "x = " + times(90, "[") + times(90, "]")}) {
    EXPECT_NO_THROW(parse_toml(text)) << text.substr(0, 40);
  }
}

}  // namespace
}  // namespace polhode::study::input_files_test
