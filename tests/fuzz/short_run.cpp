// SPDX-License-Identifier: BSD-3-Clause
// Tries a reader on each file of a corpus and on inputs made from them, the same ones at every run.
//   fuzz_short READER INPUTS FILE|FOLDER...
// Exit status: 0 all were read or refused; 2 bad arguments. An exception that no reader may throw ends the program, and
// the input that led to it stands in READER.crash.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "core/math/portable_random.hpp"
#include "tests/fuzz/readers.hpp"

namespace {

namespace fs = std::filesystem;
using polhode::fuzz::Reader;

std::vector<std::string> texts_of(int count, char** paths) {
  std::vector<fs::path> files;
  for (int i = 0; i < count; ++i) {
    if (!fs::is_directory(paths[i])) {
      files.emplace_back(paths[i]);
      continue;
    }
    for (const auto& entry : fs::directory_iterator(paths[i])) {
      if (entry.is_regular_file()) files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  std::vector<std::string> texts;
  for (const fs::path& path : files) {
    std::ifstream file(path, std::ios::binary);
    texts.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return texts;
}

/// Makes inputs from those of a corpus by a few changes each.
class Mutations {
 public:
  Mutations(const Reader& reader, std::vector<std::string> corpus) : reader_(reader), corpus_(std::move(corpus)) {}

  std::string next() {
    std::string text = corpus_[below(corpus_.size())];
    for (std::size_t changes = 1 + below(4); changes > 0; --changes) change(text);
    return text;
  }

 private:
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_.below(static_cast<int>(n))); }

  void change(std::string& text) {
    const std::size_t at = below(text.size() + 1), rest = text.size() - at;
    const std::size_t length = rest == 0 ? 0 : 1 + below(std::min<std::size_t>(rest, 40));
    switch (below(6)) {
      case 0: text.insert(at, reader_.words[below(reader_.words.size())]); break;
      case 1: text.replace(at, length, reader_.words[below(reader_.words.size())]); break;
      case 2: text.erase(at, length); break;
      case 3: text.insert(at, text.substr(at, length)); break;
      case 4:
        if (rest > 0) text[at] = static_cast<char>(below(256));
        break;
      default: {
        const std::string& other = corpus_[below(corpus_.size())];
        const std::size_t from = below(other.size() + 1);
        text.replace(at, length, other.substr(from, below(200)));
      }
    }
  }

  const Reader& reader_;
  std::vector<std::string> corpus_;
  polhode::PortableRandom random_{1};
};

void try_one(const Reader& reader, const std::string& text) {
  try {
    reader.read(text);
  } catch (...) {
    std::ofstream(std::string(reader.name) + ".crash", std::ios::binary) << text;
    throw;
  }
}

}  // namespace

int main(int argc, char** argv) {
  const Reader* reader = argc > 3 ? polhode::fuzz::find_reader(argv[1]) : nullptr;
  if (!reader) {
    std::fprintf(stderr, "usage: fuzz_short READER INPUTS FILE|FOLDER...; readers:");
    for (const Reader& one : polhode::fuzz::readers()) std::fprintf(stderr, " %s", one.name);
    std::fprintf(stderr, "\n");
    return 2;
  }
  const std::vector<std::string> corpus = texts_of(argc - 3, argv + 3);
  if (corpus.empty()) {
    std::fprintf(stderr, "fuzz_short: the corpus is empty\n");
    return 2;
  }
  for (const std::string& text : corpus) try_one(*reader, text);
  Mutations mutations(*reader, corpus);
  const long inputs = std::atol(argv[2]);
  for (long i = 0; i < inputs; ++i) try_one(*reader, mutations.next());
  std::printf("%s: %zu files and %ld inputs made from them\n", reader->name, corpus.size(), inputs);
  return 0;
}
