// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/store/table_form.hpp"

#include <fmt/format.h>

#include <map>
#include <string_view>
#include <variant>

#include "experiments/study/record/versions.hpp"

namespace polhode::study::inline store {

std::string TableForm::definition() const {
  std::string text = "CREATE TABLE " + name + " (";
  for (std::size_t k = 0; k < columns.size(); ++k) {
    text += fmt::format("{}{} {}{}", k == 0 ? "" : ", ", quoted_name(columns[k].first), columns[k].second,
                        k == 0 ? " PRIMARY KEY" : "");
  }
  return text + ")";
}

void TableForm::check(const Database& db) const {
  std::map<std::string, std::string> missing(columns.begin(), columns.end());
  const std::string& key = columns.front().first;
  const auto refuse = [&](const std::string& what) {
    throw OtherTables(
        fmt::format("{}: its table {} {}, so it is not that of this version of polhode (schema version {})",
                    db.path().string(), name, what, store_version));
  };
  Statement found(db, fmt::format("SELECT name, type, pk, dflt_value FROM pragma_table_info('{}')", name));
  bool is_there = false;
  while (found.step()) {
    is_there = true;
    const Value read_name = found.value(0), read_type = found.value(1), place_in_key = found.value(2);
    const auto *column = std::get_if<std::string_view>(&read_name), *type = std::get_if<std::string_view>(&read_type);
    if (!column || !type) refuse("has a column without a name or a type");
    const std::string text(*column);
    const auto known = missing.find(text);
    if (known == missing.end() && !may_have_more) refuse("has the further column " + text);
    if (known != missing.end() && known->second != *type)
      refuse(fmt::format("has {} as {}, not as {}", text, *type, known->second));
    if (is_integer(place_in_key, 0) == (text == key)) refuse("has another primary key than " + key);
    if (!std::holds_alternative<std::monostate>(found.value(3))) refuse("has a default for " + text);
    if (known != missing.end()) missing.erase(known);
  }
  if (!is_there) refuse("is missing");
  if (missing.contains(key)) refuse("lacks the column " + key);
  if (!missing.empty()) refuse("lacks the column " + missing.begin()->first);
}

}  // namespace polhode::study::store
