// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/scenario/scenario_override.hpp"

#include <charconv>
#include <functional>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "core/forces/catalogue.hpp"
#include "core/joints/catalogue.hpp"
#include "experiments/study/scenario/scenario_keys.hpp"
#include "experiments/study/text/suggestion.hpp"
#include "experiments/study/text/toml_cursor.hpp"

namespace polhode::study::inline scenario {

namespace {

using Type = TomlValue::Type;

void mark(TomlValue& value, TomlPlace place) {
  value.place = place;
  for (TomlValue& item : value.items) mark(item, place);
  for (TomlEntry& entry : value.entries) {
    entry.key_place = place;
    mark(entry.value, place);
  }
}

/// The parts of a key, which must outlive them.
std::vector<std::string_view> parts_of(std::string_view key) {
  std::vector<std::string_view> parts;
  parts.reserve(4);
  for (;;) {
    const auto dot = key.find('.');
    parts.push_back(key.substr(0, dot));
    if (dot == std::string_view::npos) return parts;
    key.remove_prefix(dot + 1);
  }
}

/// The number in a part, if it is one below `count`.
std::optional<std::size_t> index_in(std::string_view part, std::size_t count) {
  std::size_t i = 0;
  const char* end = part.data() + part.size();
  const auto [stop, error] = std::from_chars(part.data(), end, i);
  if (error != std::errc() || stop != end || i >= count) return std::nullopt;
  return i;
}

/// The number in a text of the form -1.5e-3; other texts are read as TOML. Studies set numbers in most runs, and a
/// document of its own for each takes a third of the time of making the run.
std::optional<double> plain_number(std::string_view text) {
  const auto digits = [&](std::size_t from) {
    std::size_t end = from;
    while (end < text.size() && text[end] >= '0' && text[end] <= '9') ++end;
    return end;
  };
  const std::size_t whole = !text.empty() && text[0] == '-' ? 1 : 0;
  std::size_t end = digits(whole);
  if (end == whole || end - whole > 15 || (text[whole] == '0' && end - whole > 1)) return std::nullopt;
  if (end < text.size() && text[end] == '.') {
    const std::size_t fraction = end + 1;
    end = digits(fraction);
    if (end == fraction) return std::nullopt;
  }
  if (end < text.size() && (text[end] == 'e' || text[end] == 'E')) {
    std::size_t exponent = end + 1;
    if (exponent < text.size() && (text[exponent] == '-' || text[exponent] == '+')) ++exponent;
    end = digits(exponent);
    if (end == exponent) return std::nullopt;
  }
  double number = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
  if (end != text.size() || read.ec != std::errc() || read.ptr != text.data() + text.size()) return std::nullopt;
  return number;
}

/// The keys of forces or joints: `common` and the parameters of the kind, by kind. That of no kind has `common` alone.
using KeysOfKinds = std::map<std::string, std::vector<ScenarioKey>, std::less<>>;
template <class Catalogue>
KeysOfKinds keys_of_kinds(const std::vector<ScenarioKey>& common, const Catalogue& catalogue) {
  KeysOfKinds all = {{"", common}};
  for (const auto& entry : catalogue) {
    std::vector<ScenarioKey>& keys = all[entry.kind.name] = common;
    for (const Parameter& p : entry.kind.parameters) {
      const bool required = p.need == Parameter::Need::required;
      keys.push_back({p.key, required ? std::nullopt : std::optional(to_toml(p.value))});
    }
  }
  return all;
}

/// The keys of an element of one of these lists: of a body, or of a force or joint of its kind. Studies set such keys
/// in each run, so that they are made once.
const std::vector<ScenarioKey>& keys_of(std::string_view list, const TomlValue& element) {
  static const std::vector<ScenarioKey> common = {{"kind", std::nullopt}, {"bodies", std::nullopt}};
  static const std::vector<ScenarioKey> named = {common[0], common[1], {"name", std::nullopt, Decides::never}};
  static const KeysOfKinds of_forces = keys_of_kinds(common, force_catalogue());
  static const KeysOfKinds of_joints = keys_of_kinds(named, joint_catalogue());
  if (list == "body") return body_keys();
  const KeysOfKinds& kinds = list == "force" ? of_forces : of_joints;
  const TomlValue* said = element.find("kind");
  const auto found = kinds.find(said ? std::string_view(said->text) : "");
  return found == kinds.end() ? kinds.at("") : found->second;
}

/// The walk of one override down the tree.
class Walk {
 public:
  Walk(TomlValue& root, const Override& override, int index)
      : root_(root), place_{0, 0, index}, parts_(parts_of(override.key)), value_(parsed(override.value)) {}

  std::string run() {
    if (is_list_of_tables(parts_.front())) {
      into_element(std::string(parts_.front()));
    } else {
      into_table(root_, root_keys(), 0);
    }
    std::string path;
    path.reserve(64);
    for (const std::string_view part : parts_) path.append(path.empty() ? "" : ".").append(part);
    return path;
  }

 private:
  [[noreturn]] void fail(std::string message) const { throw Fault{place_, "", std::move(message)}; }

  TomlValue parsed(const std::string& text) const {
    if (const auto number = plain_number(text)) {
      TomlValue value = TomlValue::of(*number);
      value.place = place_;
      return value;
    }
    try {
      TomlValue line = parse_toml("value = " + text);
      if (line.entries.size() != 1 || line.entries[0].key != "value") fail("'" + text + "' is more than one value");
      mark(line.entries[0].value, place_);
      return std::move(line.entries[0].value);
    } catch (const TomlSyntaxError& error) {
      fail("'" + text + "' is not a TOML value such as 0.5, [1, 0, 0], true or \"world\": " + error.message);
    }
  }

  void into_element(const std::string& list) {
    TomlValue* elements = root_.find(list);
    const std::size_t count = elements && elements->type == Type::list ? elements->items.size() : 0;
    if (parts_.size() < 3) fail("it must name one key of one " + list + ", as in " + list + ".0.KEY");
    const std::string_view said = parts_[1];
    std::optional<std::size_t> index = index_in(said, count);
    for (std::size_t i = 0; list != "force" && !index && i < count; ++i) {
      const TomlValue* name = elements->items[i].find("name");
      if ((name ? name->text : list + std::to_string(i)) == said) index = i;
    }
    if (!index)
      fail("the scenario has no " + list + " '" + std::string(said) + "'; " + they_are(list, elements, count));
    index_ = std::to_string(*index);
    parts_[1] = index_;
    TomlValue& element = elements->items[*index];
    if (element.type != Type::table) fail(list + "." + index_ + " is not a table");
    into_table(element, keys_of(list, element), 2);
  }

  static std::string they_are(const std::string& list, const TomlValue* elements, std::size_t count) {
    if (count == 0) return "it has none";
    std::string text = "it has " + std::to_string(count);
    for (std::size_t i = 0; i < count; ++i) {
      const TomlValue* name = elements->items[i].find(list == "force" ? "kind" : "name");
      text += (i == 0 ? ": " : ", ") + std::to_string(i) + (name ? " (" + name->text + ")" : "");
    }
    return text;
  }

  /// parts_[depth] is a key of this table, and those after it lead into its value.
  void into_table(TomlValue& table, const std::vector<ScenarioKey>& keys, std::size_t depth) {
    const std::string_view name = parts_[depth];
    const ScenarioKey* key = find_key(keys, name);
    if (!key) fail("there is no key '" + std::string(name) + "'" + suggestion(name, "There are", names(keys)));
    const TomlValue* said = root_.find("contact");
    const bool contact = said && said->boolean;
    const bool unread = name == "shape" && !contact && (table.find("inertia") || table.find("point_masses"));
    if (key->decides == Decides::never || (key->decides == Decides::with_contact && !contact) || unread) {
      fail("the " + std::string(name) + " decides nothing about a run" +
           (unread                           ? " while the inertia is given beside it"
            : key->decides == Decides::never ? ""
                                             : " without contact = true"));
    }
    TomlValue* found = table.find(name);
    if (!found && depth + 1 < parts_.size()) {
      if (!key->otherwise)
        fail("the scenario gives no " + std::string(name) + " of which to set a part; " + instead(std::string(name)));
      found = &table.insert(std::string(name), *key->otherwise).value;
    }
    if (found) {
      into_value(*found, depth + 1);
    } else {
      table.insert(std::string(name), std::move(value_));
    }
  }

  static std::string instead(const std::string& name) {
    const char* const text = "write inertia = [I1, I2, I3] in the scenario, or set the whole inertia or the shape";
    return name == "inertia" ? text : "set the whole " + name;
  }

  void into_value(TomlValue& value, std::size_t depth) {
    if (depth == parts_.size()) {
      value = std::move(value_);
      return;
    }
    const std::string_view part = parts_[depth];
    if (value.type == Type::list) {
      const std::optional<std::size_t> index = index_in(part, value.items.size());
      if (!index)
        fail("'" + std::string(part) + "' is not a place in a list of " + std::to_string(value.items.size()) +
             ", from 0");
      into_value(value.items[*index], depth + 1);
    } else if (value.type == Type::table) {
      if (TomlValue* found = value.find(part)) return into_value(*found, depth + 1);
      if (depth + 1 < parts_.size()) fail("there is no '" + std::string(part) + "' of which to set a part");
      value.insert(std::string(part), std::move(value_));
    } else {
      fail("there is nothing below '" + std::string(parts_[depth - 1]) + "'");
    }
  }

  TomlValue& root_;
  TomlPlace place_;
  std::vector<std::string_view> parts_;
  std::string index_;  ///< the second part, if it is the number of an element
  TomlValue value_;
};

}  // namespace

std::string apply_override(TomlValue& root, const Override& override, int index) {
  return Walk(root, override, index).run();
}

void undo_override(TomlValue& tree, const TomlValue& root, std::string_view path) {
  TomlValue* table = &tree;
  const TomlValue* before = &root;
  const std::vector<std::string_view> parts = parts_of(path);
  std::size_t key = 0;
  if (is_list_of_tables(parts[0])) {
    const TomlValue* elements = root.find(parts[0]);
    const std::size_t i = *index_in(parts[1], elements->items.size());
    table = &tree.find(parts[0])->items[i];
    before = &elements->items[i];
    key = 2;
  }
  if (const TomlValue* value = before->find(parts[key])) *table->find(parts[key]) = *value;
  else table->erase(parts[key]);
}

std::optional<TomlValue> value_at(const TomlValue& root, const std::string& path) {
  const std::vector<std::string_view> parts = parts_of(path);
  const TomlValue* at = &root;
  std::vector<ScenarioKey> keys = root_keys();
  std::optional<TomlValue> preset;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const TomlValue* next = nullptr;
    if (at->type == Type::table) {
      next = at->find(parts[i]);
      const ScenarioKey* key = next ? nullptr : find_key(keys, parts[i]);
      if (key && key->otherwise) next = &preset.emplace(*key->otherwise);
    } else if (const auto index = at->type == Type::list ? index_in(parts[i], at->items.size()) : std::nullopt) {
      next = &at->items[*index];
    }
    if (!next) return std::nullopt;
    at = next;
    const bool element = i == 1 && is_list_of_tables(parts[0]);
    keys = element ? keys_of(parts[0], *at) : std::vector<ScenarioKey>{};
  }
  return *at;
}

}  // namespace polhode::study::scenario
