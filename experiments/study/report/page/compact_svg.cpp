// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/report/page/compact_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <map>
#include <regex>
#include <set>
#include <utility>
#include <vector>

namespace polhode::study::inline report::inline page {
namespace {

/// An element or an attribute of the picture for which this file has no rule.
struct Unknown {};

using Attributes = std::map<std::string, std::string>;

/// An element, or a piece of text, which has no name.
struct Node {
  std::string name, text;
  Attributes attributes;
  std::vector<Node> children;
};

bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

/// Reads what gnuplot writes of XML; entities stay as they are.
class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}

  Node document() {
    Node top;
    children(top);
    for (Node& node : top.children) {
      if (node.name == "svg") return std::move(node);
    }
    throw Unknown{};
  }

 private:
  std::string_view until(std::string_view end) {
    const auto at = text_.find(end);
    if (at == std::string_view::npos) throw Unknown{};
    const auto part = text_.substr(0, at);
    text_.remove_prefix(at + end.size());
    return part;
  }
  bool take(std::string_view start) {
    if (text_.substr(0, start.size()) != start) return false;
    text_.remove_prefix(start.size());
    return true;
  }
  void skip_space() {
    while (!text_.empty() && is_space(text_.front())) text_.remove_prefix(1);
  }
  std::string word() {
    std::size_t n = 0;
    while (n < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[n])) != 0 ||
                                std::string_view("_-:.").find(text_[n]) != std::string_view::npos))
      ++n;
    if (n == 0) throw Unknown{};
    const std::string found(text_.substr(0, n));
    text_.remove_prefix(n);
    return found;
  }

  void children(Node& parent) {
    while (!text_.empty()) {
      if (take("<?")) until("?>");
      else if (take("<!--")) until("-->");
      else if (take("</")) return close(parent);
      else if (take("<")) parent.children.push_back(element());
      else
        parent.children.push_back({"", std::string(text_.substr(0, text_.find('<'))), {}, {}}),
            text_.remove_prefix(parent.children.back().text.size());
    }
    if (!parent.name.empty()) throw Unknown{};
  }
  void close(const Node& parent) {
    if (word() != parent.name) throw Unknown{};
    skip_space();
    if (!take(">")) throw Unknown{};
  }
  Node element() {
    Node node;
    node.name = word();
    for (skip_space(); !take(">"); skip_space()) {
      if (take("/>")) return node;
      const std::string name = word();
      skip_space();
      if (!take("=")) throw Unknown{};
      skip_space();
      const std::string_view quote = take("'") ? "'" : take("\"") ? "\"" : throw Unknown{};
      node.attributes[name] = until(quote);
    }
    children(node);
    return node;
  }

  std::string_view text_;
};

bool blank(const Node& node) {
  return node.name.empty() && node.text.find_first_not_of(" \t\r\n") == std::string::npos;
}

/// The next number of a list of coordinates, in hundredths of a pixel, which are all the decimals that gnuplot writes.
long number_at(const char*& at, const char* end) {
  while (at < end && (is_space(*at) || *at == ',')) ++at;
  double value = 0;
  const auto [stop, error] = std::from_chars(at, end, value);
  if (error != std::errc{}) throw Unknown{};
  at = stop;
  return std::lround(100 * value);
}

long hundredths(const std::string& number) {
  const char* at = number.data();
  return number_at(at, at + number.size());
}

/// A number of hundredths without needless characters: ".5", "-12.25".
std::string shortest(long value) {
  std::string text = fmt::format("{}.{:02}", std::labs(value) / 100, std::labs(value) % 100);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  if (text.size() > 1 && text.starts_with("0.")) text.erase(0, 1);
  return value < 0 ? "-" + text : text;
}

/// "12.00" → "12"; any other text unchanged.
std::string shorter(const std::string& value) {
  static const std::regex number("-?[0-9]+\\.[0-9]{1,2}");
  if (!std::regex_match(value, number)) return value;
  return shortest(hundredths(value));
}

/// "rgb( 51,  51,  51)" → "#333"; any other text unchanged.
std::string short_colour(const std::string& value) {
  static const std::regex rgb("rgb\\( *([0-9]+), *([0-9]+), *([0-9]+)\\)");
  std::string hex = value;
  if (std::smatch found; std::regex_match(value, found, rgb))
    hex = fmt::format("#{:02x}{:02x}{:02x}", std::stoi(found[1]), std::stoi(found[2]), std::stoi(found[3]));
  for (char& c : hex) c = hex.front() == '#' ? static_cast<char>(std::tolower(static_cast<unsigned char>(c))) : c;
  if (hex.size() == 7 && hex[0] == '#' && hex[1] == hex[2] && hex[3] == hex[4] && hex[5] == hex[6])
    return {'#', hex[1], hex[3], hex[5]};
  return hex;
}

/// Points of a path, in hundredths of a pixel.
struct PathPoint {
  long x, y;
};

/// One or more lines as differences, from wherever the pen is.
class Pen {
 public:
  void line(const std::vector<PathPoint>& points, bool closed) {
    out_ += 'm';
    bool first = true;
    for (const PathPoint& point : points) {
      append(point.x - at_.x, first);
      append(point.y - at_.y, false);
      at_ = point;
      first = false;
    }
    if (!closed) return;
    out_ += 'z';
    at_ = points.front();
  }
  const std::string& path() const { return out_; }

 private:
  void append(long difference, bool first) {
    const std::string text = shortest(difference);
    if (!first && text.front() != '-') out_ += ',';
    out_ += text;
  }

  std::string out_;
  PathPoint at_{0, 0};
};

struct Line {
  std::vector<PathPoint> points;
  bool closed = false;
};

/// Lines of a path of absolute moves and lines, which is all that gnuplot writes.
std::vector<Line> lines_of(const std::string& path) {
  std::vector<Line> lines;
  const char *at = path.data(), *end = at + path.size();
  while (at < end) {
    const char c = *at;
    if (is_space(c)) {
      ++at;
      continue;
    }
    if (c == 'M') lines.emplace_back();
    if (lines.empty() || lines.back().closed) throw Unknown{};
    if (c == 'M' || c == 'L' || c == 'Z') ++at;
    if (c == 'Z') {
      lines.back().closed = true;
      continue;
    }
    const long x = number_at(at, end);
    lines.back().points.push_back({x, number_at(at, end)});
  }
  return lines;
}

/// The line around a polygon.
Line polygon_of(const std::string& points) {
  Line line{{}, true};
  const char *at = points.data(), *end = at + points.find_last_not_of(" \t\r\n") + 1;
  while (at < end) {
    const long x = number_at(at, end);
    line.points.push_back({x, number_at(at, end)});
  }
  if (line.points.empty()) throw Unknown{};
  return line;
}

const std::vector<std::string> of_shapes = {
    "fill", "stroke", "stroke-width", "stroke-linecap", "stroke-linejoin", "stroke-dasharray", "shape-rendering"};
const std::vector<std::string> of_texts = {"fill",       "stroke",      "font-family", "font-size",
                                           "font-style", "font-weight", "text-anchor"};

bool is_style(const std::string& name) {
  const auto in = [&](const auto& names) { return std::find(names.begin(), names.end(), name) != names.end(); };
  return name == "color" || in(of_shapes) || in(of_texts);
}

/// The attributes that an element inherits, with its own styles in place of them.
Attributes inherited(Attributes style, const Attributes& own) {
  for (const auto& [name, value] : own) {
    if (is_style(name))
      style[name] = name == "stroke" || name == "fill" || name == "color" ? short_colour(value) : shorter(value);
  }
  return style;
}

/// Throws if a name is neither that of a style nor one of `others`.
void allow(const Attributes& attributes, std::initializer_list<std::string_view> others) {
  for (const auto& [name, value] : attributes) {
    if (!is_style(name) && std::find(others.begin(), others.end(), name) == others.end()) throw Unknown{};
  }
}

/// The picture, element by element in the order in which they are drawn.
class Compact {
 public:
  std::string of(const Node& svg) {
    allow(svg.attributes, {"width", "height", "viewBox", "xmlns", "xmlns:xlink"});
    children(svg, inherited({}, svg.attributes));
    flush();
    std::string out = "<svg xmlns='http://www.w3.org/2000/svg'";
    for (const char* name : {"width", "height", "viewBox"}) {
      const auto found = svg.attributes.find(name);
      if (found == svg.attributes.end()) throw Unknown{};
      out += fmt::format(" {}='{}'", name, found->second);
    }
    out += "><style>";
    for (const auto& [style, name] : classes_) out += fmt::format(".{}{{{}}}", name, style);
    return out + "</style><defs>" + definitions() + "</defs>" + drawn_ + "</svg>";
  }

 private:
  void children(const Node& parent, const Attributes& style) {
    for (const Node& node : parent.children) element(node, style);
  }

  void element(const Node& node, const Attributes& outer) {
    if (blank(node) || node.name == "title" || node.name == "desc") return;
    const Attributes style = inherited(outer, node.attributes);
    if (node.name == "g") group(node, style);
    else if (node.name == "defs") define(node);
    else if (node.name == "path") path(node, style);
    else if (node.name == "polygon") polygon(node, style);
    else if (node.name == "rect") rectangle(node, style);
    else if (node.name == "use") marker(node, style);
    else throw Unknown{};
  }

  void group(const Node& node, const Attributes& style) {
    const auto transform = node.attributes.find("transform");
    if (transform == node.attributes.end()) {
      allow(node.attributes, {"id"});
      return children(node, style);
    }
    allow(node.attributes, {"id", "transform", "style"});
    for (const Node& child : node.children) {
      if (blank(child)) continue;
      if (child.name != "text") throw Unknown{};
      text(child, style, transform->second, filter(node));
    }
  }

  /// The style of words in a box: ";filter:url(#textbox)".
  std::string filter(const Node& group) {
    const auto style = group.attributes.find("style");
    if (style == group.attributes.end()) return {};
    static const std::regex only_a_filter("filter:url\\(#(\\w+)\\)");
    std::smatch found;
    if (!std::regex_match(style->second, found, only_a_filter) || !symbols_.contains(found[1])) throw Unknown{};
    keep(found[1]);
    return ";" + style->second;
  }

  void define(const Node& node) {
    for (const Node& child : node.children) {
      if (blank(child)) continue;
      const auto id = child.attributes.find("id");
      if (id == child.attributes.end()) throw Unknown{};
      symbols_[id->second] = child;
    }
  }

  static std::string styled(const Attributes& style, const std::vector<std::string>& names) {
    static const Attributes defaults = {
        {"stroke", "none"},        {"stroke-linecap", "butt"}, {"stroke-linejoin", "miter"}, {"font-style", "normal"},
        {"font-weight", "normal"}, {"text-anchor", "start"},   {"stroke-dasharray", "none"}, {"stroke-width", "1"}};
    std::string out;
    for (const auto& name : names) {
      const auto found = style.find(name);
      if (found == style.end()) continue;
      std::string value = found->second;
      if (value == "currentColor") value = style.contains("color") ? style.at("color") : "black";
      const auto usual = defaults.find(name);
      if (usual != defaults.end() && usual->second == value) continue;
      if (value.find_first_of("{};<&") != std::string::npos) throw Unknown{};
      out += fmt::format("{}{}:{}{}", out.empty() ? "" : ";", name, value, name == "font-size" ? "px" : "");
    }
    return out;
  }

  /// Name of the class with that style: a, b, ..., z, ba, ...
  const std::string& class_of(const std::string& style) {
    for (const auto& [known, name] : classes_) {
      if (known == style) return name;
    }
    std::string name;
    for (std::size_t k = classes_.size(); name.empty() || k > 0; k /= 26)
      name.insert(name.begin(), static_cast<char>('a' + k % 26));
    return classes_.emplace_back(style, name).second;
  }

  /// Adds lines to those that wait, if they have the same style; consecutive ones become one path.
  void draw(const std::string& style, Line line) {
    if (style != waiting_style_) flush();
    waiting_style_ = style;
    waiting_.push_back(std::move(line));
  }

  void flush() {
    if (waiting_.empty()) return;
    // A line of one point has no corners, or draws its marker twice.
    if (const auto at = waiting_style_.find("marker:");
        at != std::string::npos && waiting_.front().points.size() == 1) {
      waiting_style_.replace(at, 7, "marker-start:");
      waiting_.front().points.push_back(waiting_.front().points.front());
    }
    Pen pen;
    for (const Line& line : waiting_) pen.line(line.points, line.closed);
    drawn_ += fmt::format("<path class='{}' d='{}'/>", class_of(waiting_style_), pen.path());
    waiting_.clear();
  }

  void path(const Node& node, const Attributes& style) {
    allow(node.attributes, {"d", "class", "id"});
    const std::string look = styled(style, of_shapes);
    for (Line& line : lines_of(node.attributes.at("d"))) draw(look, std::move(line));
  }

  void polygon(const Node& node, const Attributes& style) {
    allow(node.attributes, {"points", "id"});
    draw(styled(style, of_shapes), polygon_of(node.attributes.at("points")));
  }

  void rectangle(const Node& node, const Attributes& style) {
    allow(node.attributes, {"x", "y", "width", "height"});
    flush();
    std::string out = fmt::format("<rect class='{}'", class_of(styled(style, of_shapes)));
    for (const char* name : {"x", "y", "width", "height"}) {
      if (const auto found = node.attributes.find(name); found != node.attributes.end() && found->second != "0")
        out += fmt::format(" {}='{}'", name, found->second);
    }
    drawn_ += out + "/>";
  }

  /// A marker of a curve becomes a corner of an invisible line whose corners are drawn as that marker.
  void marker(const Node& node, const Attributes& style) {
    allow(node.attributes, {"xlink:href", "href", "transform"});
    static const std::regex placed("translate\\(([-0-9.]+),([-0-9.]+)\\) scale\\(([0-9.]+)\\)");
    std::smatch found;
    const auto transform = node.attributes.find("transform");
    if (transform == node.attributes.end() || !std::regex_match(transform->second, found, placed)) throw Unknown{};
    const std::string look = fmt::format("<use href='#{}' transform='scale({})' fill='{}' color='{}'/>", symbol(node),
                                         found[3].str(), style.contains("fill") ? style.at("fill") : "black",
                                         style.contains("color") ? style.at("color") : "black");
    keep(symbol(node));
    const auto known = std::find(markers_.begin(), markers_.end(), look);
    const auto number = known - markers_.begin();
    if (known == markers_.end()) markers_.push_back(look);
    const std::string line = fmt::format("fill:none;marker:url(#m{})", number);
    const PathPoint at{hundredths(found[1]), hundredths(found[2])};
    if (line == waiting_style_ && !waiting_.empty()) waiting_.back().points.push_back(at);
    else draw(line, {{at}, false});
  }

  /// The name of the symbol that an element uses.
  std::string symbol(const Node& node) const {
    for (const char* name : {"xlink:href", "href"}) {
      const auto found = node.attributes.find(name);
      if (found == node.attributes.end()) continue;
      const std::string id = found->second.substr(1);
      if (found->second.front() != '#' || !symbols_.contains(id)) throw Unknown{};
      return id;
    }
    throw Unknown{};
  }

  /// Keeps a symbol and those that it is made of.
  void keep(const std::string& id) {
    const Node& node = symbols_.at(id);
    if (kept_.insert(id).second && node.name == "use") keep(symbol(node));
  }

  /// The markers that are used, and the symbols that they are made of.
  std::string definitions() const {
    std::string out;
    for (const std::string& id : kept_) out += written(symbols_.at(id));
    for (std::size_t k = 0; k < markers_.size(); ++k)
      out +=
          fmt::format("<marker id='m{}' overflow='visible' markerUnits='userSpaceOnUse'>{}</marker>", k, markers_[k]);
    return out;
  }

  static std::string written(const Node& node) {
    std::string out = "<" + node.name;
    for (const auto& [name, value] : node.attributes)
      out += fmt::format(" {}={}", name == "xlink:href" ? "href" : name, quoted(value));
    if (node.children.empty()) return out + "/>";
    out += ">";
    for (const Node& child : node.children) {
      if (!blank(child)) out += written(child);
    }
    return out + "</" + node.name + ">";
  }

  static std::string quoted(const std::string& value) {
    return value.find('\'') == std::string::npos ? "'" + value + "'" : "\"" + value + "\"";
  }

  void text(const Node& node, const Attributes& outer, const std::string& transform, const std::string& filter) {
    allow(node.attributes, {"xml:space"});
    const Attributes style = inherited(outer, node.attributes);
    flush();
    std::string out = fmt::format("<text class='{}'", class_of(styled(style, of_texts) + filter));
    static const std::regex moved("translate\\(([-0-9.]+),([-0-9.]+)\\)");
    if (std::smatch found; std::regex_match(transform, found, moved)) {
      out += fmt::format(" x='{}' y='{}'", shortest(hundredths(found[1])), shortest(hundredths(found[2])));
    } else {
      out += fmt::format(" transform={}", quoted(transform));
    }
    if (node.attributes.contains("xml:space")) out += " xml:space='preserve'";
    drawn_ += out + ">" + words_of(node, style) + "</text>";
  }

  static std::string words_of(const Node& node, const Attributes& style) {
    std::string out;
    for (const Node& child : node.children) {
      if (child.name.empty()) {
        out += child.text;
        continue;
      }
      if (child.name != "tspan") throw Unknown{};
      const Attributes own = inherited(style, child.attributes);
      const std::string words = words_of(child, own);
      if (words.empty()) continue;
      std::string attributes;
      for (const auto& [name, value] : child.attributes) {
        const auto known = style.find(name);
        if (known == style.end() || known->second != own.at(name))
          attributes += fmt::format(" {}={}", name, quoted(value));
      }
      out += attributes.empty() ? words : fmt::format("<tspan{}>{}</tspan>", attributes, words);
    }
    return out;
  }

  std::map<std::string, Node> symbols_;
  std::set<std::string> kept_;
  std::vector<std::string> markers_;
  std::vector<std::pair<std::string, std::string>> classes_;
  std::string drawn_, waiting_style_;
  std::vector<Line> waiting_;
};

}  // namespace

std::string compact_svg(const std::string& svg) {
  try {
    return Compact().of(Reader(svg).document());
  } catch (const Unknown&) {
    return svg;
  }
}

std::string svg_address(std::string_view svg) {
  std::string out = "data:image/svg+xml,";
  for (const char c : svg) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0 || std::string_view("-._~:/?@!$'()*+,;=").find(c) != std::string_view::npos) out += c;
    else out += fmt::format("%{:02x}", byte);
  }
  return out;
}

}  // namespace polhode::study::report::page
