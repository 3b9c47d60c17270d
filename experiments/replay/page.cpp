// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/replay/page.hpp"

#include <algorithm>
#include <fstream>
#include <map>
#include <stdexcept>

#include "experiments/replay/page_parts.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/notation.hpp"
#include "experiments/study/text/read_file.hpp"

namespace polhode::study::replay {
namespace {

constexpr std::string_view mark = "<meta name=\"generator\" content=\"polhode replay\">";

std::string_view part(std::string_view name) {
  const auto parts = page_parts();
  const auto found = std::find_if(parts.begin(), parts.end(), [&](const PagePart& p) { return p.name == name; });
  if (found == parts.end()) throw std::logic_error("experiments/replay/page/ has no " + std::string(name));
  return found->text;
}

/// The template with each @name@ replaced. Inserted texts are not searched for names.
std::string filled(std::string_view text, const std::map<std::string, std::string, std::less<>>& values) {
  std::string out;
  for (;;) {
    const auto open = text.find('@'), close = text.find('@', open + 1);
    if (close == std::string_view::npos) return out.append(text);
    out += text.substr(0, open);
    out += values.at(std::string(text.substr(open + 1, close - open - 1)));
    text.remove_prefix(close + 1);
  }
}

/// The script with every end tag escaped, so that none ends its element in a page.
std::string inlined(std::string text) {
  for (auto at = text.find("</script"); at != std::string::npos; at = text.find("</script", at))
    text.insert(at + 1, "\\");
  return text;
}

}  // namespace

ThreeJs read_three(const std::filesystem::path& folder) {
  const auto script = [&](const char* name) { return read_file(folder / name); };
  auto library = script("three.min.js");
  if (!library) library = script("build/three.min.js");
  const auto controls = script("examples/js/controls/OrbitControls.js");
  if (!library || !controls) {
    throw InputError((folder / (library ? "examples/js/controls/OrbitControls.js" : "three.min.js")).string() +
                     " is not there: `./run replay` installs three.js (Debian's libjs-three), or name a folder that "
                     "has it with --three");
  }
  // The functions that the page calls exist in this revision only.
  if (library->find("REVISION=\"111\"") == std::string::npos) {
    throw InputError((folder / "three.min.js").string() +
                     " is not revision 111 of three.js, for which the page is written: `./run replay` "
                     "installs that, or name a folder that has it with --three");
  }
  return {inlined(*library), inlined(*controls)};
}

std::string page_of(const PageWords& words, const std::vector<Recording>& recordings, const ThreeJs& three) {
  std::string script;
  for (const char* name : {"motion", "bodies", "joints", "view", "plot", "player"}) script += part(name);
  return filled(part("page"), {{"mark", std::string(mark)},
                               {"title", html(words.title)},
                               {"style", std::string(part("style"))},
                               {"data", page_data(words, recordings)},
                               {"three", three.library},
                               {"controls", three.controls},
                               {"script", inlined(script)}});
}

bool is_replay_page(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string start(512, '\0');
  in.read(start.data(), std::streamsize(start.size()));
  return start.find(mark) != std::string::npos;
}

}  // namespace polhode::study::replay
