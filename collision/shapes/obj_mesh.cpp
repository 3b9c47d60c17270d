// SPDX-License-Identifier: BSD-3-Clause
#include "collision/shapes/obj_mesh.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace polhode::inline collision::inline shapes {

namespace {

template <class T>
std::optional<T> whole(std::string_view text) {
  T value{};
  if (!text.empty() && text[0] == '+') text.remove_prefix(1);
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

class Reader {
 public:
  static constexpr std::uintmax_t largest = std::uintmax_t{256} << 20;  // bytes

  explicit Reader(const std::string& path) : path_(path) {
    std::error_code error;
    if (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error)) {
      throw std::invalid_argument(path + ": is no file but a folder, a device or a pipe; name an OBJ file");
    }
    if (std::filesystem::file_size(path, error) > largest && !error) {
      throw std::invalid_argument(path + ": is larger than 256 MiB; give a mesh of fewer vertices");
    }
    file_.open(path);
    if (!file_) throw std::invalid_argument(path + ": cannot be read");
  }

  ObjMesh read() {
    std::string text;
    while (std::getline(file_, text)) {
      ++line_;
      text.resize(std::min(text.size(), text.find('#')));
      if (text.find('\\') != std::string::npos) refuse("a line cannot be continued by a backslash; join the two lines");
      std::istringstream words(text);
      std::string key;
      if (!(words >> key)) continue;
      if (key == "v") vertex(words);
      else if (key == "f") face(words);
      else if (key == "o" || key == "g") piece(words);
      // Lines about appearance (vt, vn, s, usemtl, mtllib, …) are ignored.
    }
    if (mesh_.vertices.empty()) throw std::invalid_argument(path_ + ": has no vertices (lines `v x y z`)");
    std::erase_if(mesh_.pieces, [](const ObjMesh::Piece& p) { return p.faces.empty(); });
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw std::invalid_argument(path_ + ":" + std::to_string(line_) + ": " + why);
  }

  void vertex(std::istringstream& words) {
    Vector3<double> x;
    for (int i = 0; i < 3; ++i) {
      std::string word;
      words >> word;
      const auto value = whole<double>(word);
      if (!value || !std::isfinite(*value)) refuse("a vertex needs three finite numbers, not '" + word + "'");
      x[i] = *value;
    }
    mesh_.vertices.push_back(x);
  }

  void face(std::istringstream& words) {
    ObjMesh::Face face;
    face.line = line_;
    std::string word;
    const auto n = std::int64_t(mesh_.vertices.size());
    while (words >> word) {
      const auto index = whole<std::int64_t>(std::string_view(word).substr(0, word.find('/')));
      if (!index || *index == 0) refuse("a corner of a face needs the number of a vertex, not '" + word + "'");
      const std::int64_t at = *index > 0 ? *index - 1 : n + *index;
      if (at < 0 || at >= n) refuse("vertex " + word + " is not among the " + std::to_string(n) + " above");
      face.loop.push_back(std::uint32_t(at));
    }
    if (face.loop.size() < 3) refuse("a face needs at least 3 corners");
    if (mesh_.pieces.empty()) mesh_.pieces.push_back({"", line_, {}});
    mesh_.pieces.back().faces.push_back(std::move(face));
  }

  void piece(std::istringstream& words) {
    ObjMesh::Piece piece;
    piece.line = line_;
    words >> piece.name;
    mesh_.pieces.push_back(std::move(piece));
  }

  std::string path_;
  std::ifstream file_;
  int line_ = 0;
  ObjMesh mesh_;
};

}  // namespace

ObjMesh read_obj_mesh(const std::string& path) { return Reader(path).read(); }

}  // namespace polhode::collision::shapes
