// SPDX-License-Identifier: BSD-3-Clause
// Reader of study files: what the command line says, as TOML. Each value is brought into the words of the command line,
// so that both are read by the same code.
#include <algorithm>
#include <filesystem>
#include <string_view>

#include "experiments/study/plan/distribution.hpp"
#include "experiments/study/plan/options.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/suggestion.hpp"
#include "experiments/study/text/text_file.hpp"
#include "experiments/study/text/text_hash.hpp"
#include "experiments/study/text/toml_value.hpp"
#include "experiments/study/text/value_lists.hpp"

namespace polhode::study::inline plan {
namespace {

using Type = TomlValue::Type;

/// The value in the syntax of the command line.
std::string as_text(const TomlValue& value, const std::string& where) {
  if (value.type == Type::text) return value.text;
  if (value.type == Type::number) return exact(value.number);
  if (value.type == Type::boolean) return value.boolean ? "true" : "false";
  if (value.type == Type::list) {
    std::string text = "[";
    for (const TomlValue& item : value.items) text += (text.size() > 1 ? ", " : "") + as_text(item, where);
    return text + "]";
  }
  throw InputError(where + "this type of value is not known here; use numbers, texts and lists");
}

/// The values of a key in the syntax of the command line: vectors are separated by ';', others by ','.
std::string as_list(const TomlValue& value, const std::string& where) {
  if (value.type != Type::list) return as_text(value, where);
  if (value.items.empty()) throw InputError(where + "an empty list; give at least one value");
  const char separator = value.items.front().type == Type::list ? ';' : ',';
  std::string text;
  for (const TomlValue& item : value.items)
    text += (text.empty() ? "" : std::string(1, separator)) + as_text(item, where);
  return text;
}

/// The flag of studies with this key; null if there is none.
const RunOption* flag_named(const std::string& key) {
  for (const RunOption* option : options_of_role(RunOption::Role::study)) {
    if (file_key(*option) == key) return option;
  }
  return nullptr;
}

class StudyFileReader {
 public:
  StudyFileReader(const std::string& path, std::uint64_t seed) : path_(path), seed_(seed) {}

  StudyFile run(const std::string& only) {
    const TomlValue file = read_tree();
    if (!file.find("study") && !file.find("defaults")) {
      if (!only.empty()) throw InputError("--study " + path_ + ":" + only + ": the file has no [study." + only + "]");
      file_.studies.push_back(study_of(file, ""));
      return std::move(file_);
    }
    for (const TomlEntry& entry : file.entries) {
      if (entry.key == "study" || entry.key == "defaults") continue;
      throw InputError(label(entry.value, entry.key) +
                       ": it stands beside [study.…]; put it into a study, or into [defaults] for all of them");
    }
    return studies_of(file, only);
  }

  const std::string& hash() const { return hash_; }  ///< hash of the text, set by run()

 private:
  TomlValue read_tree() {
    TomlValue file;
    try {
      const std::string text = read_text(path_);
      hash_ = text_hash(text);
      file = parse_toml(text);
    } catch (const TomlSyntaxError& error) {
      throw InputError(place(error.place) + error.message);
    } catch (const InputError& error) {
      throw InputError(std::string("--study ") + error.what());
    }
    if (file.entries.empty()) {
      throw InputError("--study " + path_ +
                       ": there is nothing in it; it sets axes, such as integrator = [\"rk4\"] and dt = [1e-3, 1e-2]");
    }
    return file;
  }

  std::string place(const TomlPlace& at) const {
    return path_ + ":" + std::to_string(at.line) + ":" + std::to_string(at.column) + ": ";
  }
  std::string label(const TomlValue& value, const std::string& key) const { return place(value.place) + key; }

  const TomlValue& table(const TomlValue& value, const std::string& name, const char* must_be) const {
    if (value.type != Type::table) throw InputError(label(value, name) + ": must be " + must_be);
    return value;
  }

  StudyFile studies_of(const TomlValue& file, const std::string& only) {
    StudyFile& all = file_;
    StudyAxes defaults;
    if (const TomlValue* said = file.find("defaults"))
      defaults = study_of(table(*said, "defaults", "a table of axes"), "defaults.");
    const TomlValue* studies = file.find("study");
    if (!studies)
      throw InputError("--study " + path_ + ": there are defaults and no study; add one, such as [study.first]");
    std::vector<const TomlEntry*> in_order;  // the library sorts them by name
    for (const TomlEntry& entry : table(*studies, "study", "a table of studies, as in [study.first]").entries)
      in_order.push_back(&entry);
    std::sort(in_order.begin(), in_order.end(), [](const TomlEntry* a, const TomlEntry* b) {
      return std::pair(a->key_place.line, a->key_place.column) < std::pair(b->key_place.line, b->key_place.column);
    });
    std::vector<std::string_view> names;
    for (const TomlEntry* entry : in_order) {
      const std::string name = "study." + entry->key;
      names.push_back(entry->key);
      if (!only.empty() && entry->key != only) continue;
      StudyAxes study = study_of(table(entry->value, name, "a table of axes"), name + ".");
      study.name = entry->key;
      add_defaults(study, defaults);
      all.studies.push_back(std::move(study));
    }
    if (all.studies.empty()) {
      throw InputError("--study " + path_ + ": it has no study " + only + suggestion(only, "There are", names));
    }
    all.shared = std::move(defaults.said);
    return std::move(all);
  }

  static void add_defaults(StudyAxes& study, const StudyAxes& defaults) {
    const StudyAxes own = study;
    for (const auto& [key, text] : defaults.axes) {
      if (own.has(key)) continue;
      study.axes[key] = text;
      study.places[key] = defaults.places.at(key);
    }
    for (const auto& [key, text] : defaults.vary) {
      if (own.has(key)) continue;
      study.vary.emplace_back(key, text);
      study.places["vary." + key] = defaults.places.at("vary." + key);
    }
    for (PointTable shared : defaults.tables) {
      std::erase_if(shared.columns, [&](const PointColumn& column) { return own.has(column.key); });
      if (!shared.columns.empty()) study.tables.push_back(std::move(shared));
    }
    study.where.insert(study.where.end(), defaults.where.begin(), defaults.where.end());
    study.settings.insert(defaults.settings.begin(), defaults.settings.end());
  }

  /// Reads the table of a study. `above`: "study.tops.", for messages.
  StudyAxes study_of(const TomlValue& said, const std::string& above) {
    StudyAxes study;
    for (const TomlEntry& entry : said.entries) {
      const TomlValue& value = entry.value;
      const std::string name = above + entry.key;
      if (entry.key == "vary") {
        read_vary(table(value, name, "a table from scenario keys to lists"), name + ".", study);
      } else if (entry.key == "grid") {
        read_grid(table(value, name, "a table of axes"), name + ".", study);
      } else if (entry.key == "curves") {
        read_curves(value, name, above);
      } else if (const RunOption* flag = flag_named(entry.key)) {
        if (value.type != Type::boolean) throw InputError(label(value, name) + ": must be true or false");
        if (value.boolean) study.settings[flag->name] = std::int64_t{1};
      } else if (entry.key == "zip" || entry.key == "random") {
        for (const TomlValue* one : one_or_more(value)) {
          table(*one, name, "a table of keys, or several");
          study.add_table(entry.key == "zip" ? zip_of(*one, name) : random_of(*one, name));
        }
      } else if (entry.key == "cells") {
        for (const TomlValue* file : one_or_more(value)) {
          if (file->type != Type::text) throw InputError(label(*file, name) + ": must be the name of a CSV file");
          const auto path = std::filesystem::path(path_).parent_path() / file->text;  // beside the study file
          study.add_table(table_of_cells(path.string(), label(*file, name)));
        }
      } else if (entry.key == "where") {
        for (const TomlValue* condition : one_or_more(value)) {
          if (condition->type != Type::text)
            throw InputError(label(*condition, name) + ": must be a text such as \"dt < 0.1 and integrator == 'rk4'\"");
          study.where.push_back({condition->text, label(*condition, name)});
        }
      } else {
        read_axis(entry.key, value, above, study);
      }
    }
    return study;
  }

  static std::vector<const TomlValue*> one_or_more(const TomlValue& value) {
    if (value.type != Type::list) return {&value};
    std::vector<const TomlValue*> all;
    for (const TomlValue& item : value.items) all.push_back(&item);
    return all;
  }

  /// Reads the value for --curves. All studies of a file are one list of runs, of which so many keep their curves.
  void read_curves(const TomlValue& value, const std::string& name, const std::string& above) {
    if (above.starts_with("study."))
      throw InputError(label(value, name) + ": it is for all studies of the file; put it into [defaults]");
    if (value.type != Type::text && value.type != Type::number)
      throw InputError(label(value, name) + ": must be \"all\", \"none\" or a number of runs");
    file_.curves = as_text(value, name);
    file_.curves_label = label(value, name);
    if (file_.curves.empty()) throw InputError(file_.curves_label + ": is empty; give all, none or a number of runs");
  }

  void read_grid(const TomlValue& grid, const std::string& above, StudyAxes& study) {
    for (const TomlEntry& entry : grid.entries) read_axis(entry.key, entry.value, above, study);
  }

  /// Calls `read` for each key below a value. A key may be written with or without quotes: "body.0.mass" = 1 and
  /// body.0.mass = 1 are the same.
  template <class Read>
  void each_key(const std::string& key, const TomlValue& value, const Read& read) {
    if (value.type != Type::table || value.find("distribution")) return read(key, value);
    for (const TomlEntry& entry : value.entries) each_key(key + "." + entry.key, entry.value, read);
  }

  void read_axis(const std::string& first, const TomlValue& value, const std::string& above, StudyAxes& study) {
    each_key(first, value, [&](const std::string& written, const TomlValue& said) {
      const std::string named = label(said, above + written), key = axis_key(written, named);
      study.add_axis(key, as_list(said, named + ": "), named);
    });
  }

  void read_vary(const TomlValue& vary, const std::string& above, StudyAxes& study) {
    for (const TomlEntry& entry : vary.entries) {
      each_key(entry.key, entry.value, [&](const std::string& key, const TomlValue& said) {
        const std::string named = label(said, above + key);
        study.add_axis(key, as_list(said, named + ": "), named, true);
      });
    }
  }

  PointTable zip_of(const TomlValue& said, const std::string& name) {
    PointTable zip{.kind = PointTable::Kind::zip, .label = label(said, name), .columns = {}};
    for (const TomlEntry& entry : said.entries) {
      each_key(entry.key, entry.value, [&](const std::string& written, const TomlValue& value) {
        const std::string named = label(value, name + "." + written);
        zip.columns.push_back({axis_key(written, named), as_list(value, named + ": "), named});
      });
    }
    if (zip.columns.empty())
      throw InputError(zip.label + ": it has no key; name at least one, as in dt = [1e-3, 1e-2]");
    return zip;
  }

  double number(const TomlValue& value, const std::string& named) const {
    if (value.type != Type::number) throw InputError(named + ": must be a whole number");
    return value.number;
  }

  PointTable random_of(const TomlValue& said, const std::string& name) {
    PointTable random{.kind = PointTable::Kind::random, .label = label(said, name), .columns = {}, .seed = seed_};
    for (const TomlEntry& entry : said.entries) {
      const std::string own = label(entry.value, name + "." + entry.key);
      if (entry.key == "n") {
        random.n = number_of_points(number(entry.value, own), own);
      } else if (entry.key == "seed") {
        random.seed = seed_from(number(entry.value, own), own);
      } else {
        each_key(entry.key, entry.value, [&](const std::string& written, const TomlValue& value) {
          const std::string named = label(value, name + "." + written);
          random.columns.push_back({axis_key(written, named), distribution_text(value, named), named});
        });
      }
    }
    if (random.n == 0) throw InputError(random.label + ": the number of points is missing; give it, as in n = 1000");
    if (random.columns.empty())
      throw InputError(random.label + ": no key is drawn; name one, as in dt = \"log_uniform(1e-4, 1e-1)\"");
    return random;
  }

  /// A distribution as the command line has it: "uniform(0.5, 3)".
  std::string distribution_text(const TomlValue& value, const std::string& named) const {
    if (value.type == Type::text) return value.text;
    const TomlValue* name = value.type == Type::table ? value.find("distribution") : nullptr;
    if (!name || name->type != Type::text) {
      throw InputError(named +
                       ": must be a distribution, such as \"uniform(0.5, 3)\" or { distribution = \"uniform\", " +
                       "from = 0.5, to = 3 }");
    }
    const auto& kinds = distribution_kinds();
    const auto kind = std::find_if(kinds.begin(), kinds.end(), [&](const auto& k) { return k.name == name->text; });
    if (kind == kinds.end()) return name->text;  // a name that Distribution::parse refuses
    for (const TomlEntry& entry : value.entries) {
      const auto& known = kind->parameters;
      if (entry.key == "distribution" || std::find(known.begin(), known.end(), entry.key) != known.end()) continue;
      throw InputError(label(entry.value, entry.key) + ": no such parameter" +
                       suggestion(entry.key, name->text + " has", known));
    }
    std::string arguments;
    for (const std::string_view parameter : kind->parameters) {
      const TomlValue* given = value.find(parameter);
      if (!given) throw InputError(named + ": " + name->text + " needs its parameter '" + std::string(parameter) + "'");
      const bool list = given->type == Type::list && name->text == "choice";
      for (const TomlValue* one : list ? one_or_more(*given) : std::vector<const TomlValue*>{given})
        arguments += (arguments.empty() ? "" : ", ") + as_text(*one, named + ": ");
    }
    return name->text + "(" + arguments + ")";
  }

  std::string path_, hash_;
  std::uint64_t seed_;
  StudyFile file_;
};

}  // namespace

StudyFile read_study_file(const std::string& path, std::uint64_t seed) {
  const auto colon = path.rfind(':');
  std::error_code ignored;
  const bool whole = colon == std::string::npos || std::filesystem::exists(path, ignored);
  if (!whole && colon + 1 == path.size())
    throw InputError("--study " + path + ": no name stands after the colon; name a study of the file, or leave it out");
  StudyFileReader reader(path.substr(0, whole ? path.size() : colon), seed);
  StudyFile file = reader.run(whole ? "" : path.substr(colon + 1));
  file.path = path;
  file.hash = reader.hash();
  return file;
}

}  // namespace polhode::study::plan
