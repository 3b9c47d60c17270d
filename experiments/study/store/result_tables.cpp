// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/store/result_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <variant>

#include "experiments/study/record/run_id.hpp"
#include "experiments/study/store/configurations.hpp"
#include "experiments/study/store/table_form.hpp"
#include "experiments/study/text/value_lists.hpp"

namespace polhode::study::inline store {
namespace {

using NamedNumbers = std::map<std::string, double>;

/// "name=value " of each entry; names are identifiers, values have all digits.
void set_numbers(std::string& text, const NamedNumbers& numbers) {
  text.clear();
  for (const auto& [name, number] : numbers) {
    text += name;
    text += '=';
    add_exact(text, number);
    text += ' ';
  }
}

/// True if numbers_of_text() reads these numbers back.
bool may_be_text(const NamedNumbers& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](const auto& one) {
    return std::isfinite(one.second) && !one.first.empty() && one.first.find_first_of("= ") == std::string::npos;
  });
}

std::optional<NamedNumbers> numbers_of_text(std::string_view text) {
  NamedNumbers numbers;
  while (!text.empty()) {
    const auto equals = text.find('='), end = text.find(' ');
    if (equals == 0 || end == std::string_view::npos || equals >= end) return std::nullopt;
    double x = 0;
    const auto read = std::from_chars(text.data() + equals + 1, text.data() + end, x);
    if (read.ec != std::errc() || read.ptr != text.data() + end || !std::isfinite(x)) return std::nullopt;
    if (!numbers.emplace(text.substr(0, equals), x).second) return std::nullopt;
    text.remove_prefix(end + 1);
  }
  return numbers;
}

bool put_number(const Value& stored, std::optional<double>& number, bool may_be_infinite) {
  number.reset();
  if (std::holds_alternative<std::monostate>(stored)) return true;
  const double* x = std::get_if<double>(&stored);
  if (!x || std::isnan(*x) || (std::isinf(*x) && !may_be_infinite)) return false;
  number = *x;
  return true;
}

bool is_word_of(const Metric& metric, std::string_view word) {
  return metric.words.empty() || std::find(metric.words.begin(), metric.words.end(), word) != metric.words.end();
}

template <class Member>
bool put_value(Member member, const Metric& metric, const Value& stored, RunResult& result) {
  bool sound = false;
  with_value_of(member, metric, result, [&]<class T>(T& value) {
    if constexpr (std::is_same_v<T, std::optional<double>>) {
      sound = put_number(stored, value, metric.may_be_infinite);
    } else if constexpr (std::is_same_v<T, std::int64_t>) {
      const auto* n = std::get_if<std::int64_t>(&stored);
      sound = n && *n >= 0;
      if (sound) value = *n;
    } else if constexpr (std::is_same_v<T, std::string>) {
      const auto* text = std::get_if<std::string_view>(&stored);
      sound = text && is_word_of(metric, *text);
      if (sound) value = *text;
    } else {
      const auto* text = std::get_if<std::string_view>(&stored);
      auto numbers = text ? numbers_of_text(*text) : std::nullopt;
      sound = numbers.has_value();
      if (sound) value = std::move(*numbers);
    }
  });
  return sound;
}

/// Returns false if put_value() would refuse the value.
template <class Member>
bool get_value(Member member, const Metric& metric, const RunResult& result, std::string& text, Value& stored) {
  bool sound = false;
  with_value_of(member, metric, result, [&]<class T>(const T& value) {
    if constexpr (std::is_same_v<T, std::optional<double>>) {
      stored = value ? as_kept(*value) : Value();
      sound = !value || !std::isinf(*value) || metric.may_be_infinite;
    } else if constexpr (std::is_same_v<T, std::int64_t>) {
      stored = value;
      sound = value >= 0;
    } else if constexpr (std::is_same_v<T, std::string>) {
      stored = std::string_view(value);
      sound = is_word_of(metric, value);
    } else {
      set_numbers(text, value);
      stored = std::string_view(text);
      sound = may_be_text(value);
    }
  });
  return sound;
}

ResultColumn metric_column(const Metric& metric) {
  return std::visit(
      [&metric]<class M>(M member) -> ResultColumn {
        const bool whole = std::is_same_v<M, std::int64_t RunResult::*>;
        const bool text = std::is_same_v<M, std::string RunResult::*> || std::is_same_v<M, NamedNumbers RunResult::*>;
        return {.name = metric.column,
                .type = whole  ? "INTEGER"
                        : text ? "TEXT"
                               : "REAL",
                .value = [&metric, member](
                             const RunRecord& record, std::string& room,
                             Value& stored) { return get_value(member, metric, record.result, room, stored); },
                .put = [&metric, member](const Value& stored,
                                         RunResult& result) { return put_value(member, metric, stored, result); },
                .may_be_absent = !whole && !text};
      },
      metric.member);
}

/// Puts a value into a result, into which none was put before. Returns false if no study writes such a value.
bool put(const ResultColumn& column, const Value& value, RunResult& result) {
  return (column.may_be_absent && std::holds_alternative<std::monostate>(value)) || column.put(value, result);
}

/// A number of a run that is always there.
ResultColumn number_column(std::string name, double RunResult::*member) {
  return {.name = std::move(name),
          .type = "REAL",
          .value =
              [member](const RunRecord& record, std::string&, Value& stored) {
                stored = as_kept(record.result.*member);
                return std::isfinite(record.result.*member);
              },
          .put =
              [member](const Value& stored, RunResult& result) {
                const double* x = std::get_if<double>(&stored);
                if (!x || !std::isfinite(*x)) return false;
                result.*member = *x;
                return true;
              }};
}

/// True if the points are a curve against time: finite numbers, the first of which is a time that never decreases.
template <class Point>
bool is_curve(const std::vector<Point>& points) {
  static_assert(std::is_trivially_copyable_v<Point> && sizeof(Point) % sizeof(double) == 0);
  std::vector<double> numbers(points.size() * (sizeof(Point) / sizeof(double)));
  if (!points.empty()) std::memcpy(numbers.data(), points.data(), points.size() * sizeof(Point));
  return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); }) &&
         std::is_sorted(points.begin(), points.end(), [](const Point& a, const Point& b) { return a.t < b.t; });
}

template <class Point>
ResultColumn curve_column(std::string name, std::vector<Point> RunResult::*member) {
  return {.name = std::move(name),
          .type = "BLOB",
          .value =
              [member](const RunRecord& record, std::string&, Value& stored) {
                stored = std::as_bytes(std::span(record.result.*member));
                return is_curve(record.result.*member);
              },
          .put =
              [member](const Value& stored, RunResult& result) {
                const auto* bytes = std::get_if<Blob>(&stored);
                if (!bytes || bytes->size() % sizeof(Point) != 0) return false;
                std::vector<Point> points(bytes->size() / sizeof(Point));
                if (!points.empty()) std::memcpy(points.data(), bytes->data(), bytes->size());
                if (!is_curve(points)) return false;
                result.*member = std::move(points);
                return true;
              }};
}

bool with_curves(const RunResult& result) { return !result.series.empty() || !result.attitude_errors.empty(); }

ResultColumn has_curves_column() {
  return {.name = std::string(has_curves),
          .type = "INTEGER",
          .value =
              [](const RunRecord& record, std::string&, Value& stored) {
                stored = static_cast<std::int64_t>(with_curves(record.result));
                return true;
              },
          .put = [](const Value& stored, RunResult&) { return is_integer(stored, 0) || is_integer(stored, 1); }};
}

/// The key is made anew where the options differ from those of the record before.
ResultColumn configuration_key_column() {
  return {.name = std::string(configuration_column),
          .type = "INTEGER",
          .value =
              [last = RunConfig(), key = std::optional<std::int64_t>()](const RunRecord& record, std::string&,
                                                                        Value& stored) mutable {
                if (!key || !have_same_options(last, record.config)) {
                  last = record.config;
                  key = configuration_key(last);
                }
                stored = *key;
                return true;
              },
          .put = [](const Value& stored, RunResult&) { return std::holds_alternative<std::int64_t>(stored); }};
}

ResultColumn varied_text_column() {
  return {.name = std::string(varied_column),
          .type = "TEXT",
          .value =
              [](const RunRecord& record, std::string& text, Value& stored) {
                set_varied_text(text, record.config);
                stored = std::string_view(text);
                return true;
              },
          .put = [](const Value& stored, RunResult&) { return std::holds_alternative<std::string_view>(stored); }};
}

ResultTable sorted(ResultTable table) {
  std::sort(table.columns.begin(), table.columns.end(),
            [](const ResultColumn& a, const ResultColumn& b) { return a.name < b.name; });
  return table;
}

}  // namespace

ResultTable runs_table(std::span<const Metric> metrics) {
  ResultTable table{.name = "runs", .columns = {}, .has_id = true};
  for (const Metric& metric : metrics) table.columns.push_back(metric_column(metric));
  table.columns.push_back(number_column("t_reached_s", &RunResult::t_reached));
  table.columns.push_back(has_curves_column());
  table.columns.push_back(configuration_key_column());
  table.columns.push_back(varied_text_column());
  return sorted(std::move(table));
}

ResultTable curves_table() {
  return sorted(
      {"curves",
       {curve_column("series", &RunResult::series), curve_column("attitude_errors", &RunResult::attitude_errors)}});
}

ResultTable timings_table() { return {"timings", {number_column("wall_s", &RunResult::seconds)}}; }

std::size_t ResultTable::find(std::string_view column) const {
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (columns[k].name == column) return k;
  }
  throw std::logic_error("the table " + name + " has no column " + std::string(column));
}

std::string ResultTable::definition() const {
  std::string text = "CREATE TABLE " + name + " (number INTEGER PRIMARY KEY";
  if (has_id) text += ", id INTEGER UNIQUE NOT NULL";
  for (const ResultColumn& column : columns) text += fmt::format(", {} {}", quoted_name(column.name), column.type);
  return text + ", checksum INTEGER)";
}

std::string ResultTable::insertion(std::string_view else_do) const {
  std::string names = has_id ? "number, id" : "number", parameters = has_id ? "?,?" : "?";
  for (const ResultColumn& column : columns) {
    names += ", " + quoted_name(column.name);
    parameters += ",?";
  }
  return fmt::format("INSERT OR {} INTO {} ({}, checksum) VALUES ({},?)", else_do, name, names, parameters);
}

void ResultTable::check(const Database& db) const {
  TableForm form{.name = name, .columns = {{"number", "INTEGER"}, {"checksum", "INTEGER"}}};
  if (has_id) form.columns.emplace_back("id", "INTEGER");
  for (const ResultColumn& column : columns) form.columns.emplace_back(column.name, column.type);
  form.check(db);
}

RunKey RunKey::of(const Statement& row, int id, int number) {
  const std::int64_t own = row.integer(number);
  const Value found = row.value(id);
  const auto* sound = std::get_if<std::int64_t>(&found);
  return {sound ? *sound : own, own, sound != nullptr};
}

std::string RunKey::name() const {
  return has_id ? "run " + id_of_number(static_cast<std::uint64_t>(id)) : fmt::format("row {}", number);
}

RowWriter::RowWriter(const ResultTable& table)
    : table_(&table), texts_(table.columns.size()), values_(table.columns.size() + (table.has_id ? 3 : 2)) {}

std::span<const Value> RowWriter::values(std::int64_t number, std::int64_t id, const RunRecord& record) {
  const std::span<Value> columns = std::span(values_).last(texts_.size() + 1).first(texts_.size());
  values_[0] = number;
  if (table_->has_id) values_[1] = id;
  for (std::size_t k = 0; k < texts_.size(); ++k) {
    const ResultColumn& column = table_->columns[k];
    if (!column.value(record, texts_[k], columns[k])) {
      throw std::logic_error("run " + record.id + " has a value of " + table_->name + "." + column.name +
                             " that cannot be stored");
    }
  }
  values_.back() = checksum_of(id, columns);
  return values_;
}

std::int64_t RowWriter::integer(std::size_t column) const {
  return std::get<std::int64_t>(values_[column + (table_->has_id ? 2 : 1)]);
}

RowReader::RowReader(const ResultTable& table, int first)
    : table_(&table), first_(first), values_(table.columns.size()) {}

std::string RowReader::selection(const ResultTable& table) {
  std::string text;
  for (const ResultColumn& column : table.columns) text += table.name + "." + quoted_name(column.name) + ", ";
  return text + table.name + ".checksum";
}

std::string RowReader::read(const Statement& row, std::int64_t id, RunResult& result) {
  std::string damaged;
  for (std::size_t k = 0; k < values_.size(); ++k) {
    const ResultColumn& column = table_->columns[k];
    values_[k] = row.value(first_ + static_cast<int>(k));
    if (!put(column, values_[k], result) && damaged.empty()) damaged = table_->name + "." + column.name;
  }
  if (!damaged.empty()) return damaged;
  const Value checksum = row.value(first_ + size() - 1);
  return is_integer(checksum, checksum_of(id, values_)) ? "" : table_->name + ".checksum";
}

}  // namespace polhode::study::store
