// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/query/selection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <variant>

#include "experiments/study/query/row_parts.hpp"
#include "experiments/study/query/stored_run.hpp"
#include "experiments/study/record/metric_table.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/text/value_lists.hpp"

namespace polhode::study::inline query {
namespace {

/// A text is not copied: the value must outlive what is returned.
WhereValue for_where(const OptionValue& value) {
  if (const auto* n = std::get_if<std::int64_t>(&value)) return static_cast<double>(*n);
  if (const auto* x = std::get_if<double>(&value)) return *x;
  if (const auto* text = std::get_if<std::string>(&value)) return std::string_view(*text);
  return {};
}

WhereValue for_where(const Value& value) {
  if (const auto* n = std::get_if<std::int64_t>(&value)) return static_cast<double>(*n);
  if (const auto* x = std::get_if<double>(&value)) return *x;
  if (const auto* text = std::get_if<std::string_view>(&value)) return *text;
  return {};
}

/// Conditions with their keys found among the columns. What depends on the configuration alone is read once for each.
class Filter {
 public:
  Filter(const RunColumns& columns, std::span<const Where> conditions) {
    for (const Where& condition : conditions) {
      Bound& bound = conditions_.emplace_back();
      bound.where = &condition;
      for (const std::string& key : condition.keys())
        bound.keys.push_back(columns.find(key, condition.label() + ": " + key));
      bound.by_configuration = std::all_of(bound.keys.begin(), bound.keys.end(),
                                           [](const RunColumn& c) { return c.of == RunColumn::Of::option; });
    }
  }

  void add_columns(std::set<std::size_t>& chosen) const {
    for (const Bound& bound : conditions_) {
      for (const RunColumn& key : bound.keys) {
        if (key.in_store()) chosen.insert(key.index);
      }
    }
  }

  /// `stored(index)`: the value in a column of the store.
  template <class Stored>
  bool holds(const RunPlace& run, CellReader& cells, const Stored& stored) {
    for (Bound& bound : conditions_) {
      const auto [at, is_new] = bound.known.try_emplace({run.store, run.configuration});
      Known& known = at->second;
      if (is_new) {
        known.values.resize(bound.keys.size());
        known.held.resize(bound.keys.size());
        for (std::size_t k = 0; k < bound.keys.size(); ++k) {
          if (bound.keys[k].of == RunColumn::Of::option)
            known.values[k] = for_where(known.held[k] = cells.value(bound.keys[k], run, {}));
        }
        if (bound.by_configuration) known.holds = bound.where->holds(known.values);
      }
      if (bound.by_configuration) {
        if (!known.holds) return false;
        continue;
      }
      for (std::size_t k = 0; k < bound.keys.size(); ++k) {
        const RunColumn& key = bound.keys[k];
        if (key.of == RunColumn::Of::metric) known.values[k] = for_where(stored(key.index));
        else if (key.of != RunColumn::Of::option)
          known.values[k] =
              for_where(known.held[k] = cells.value(key, run, key.in_store() ? stored(key.index) : Value()));
      }
      if (!bound.where->holds(known.values)) return false;
    }
    return true;
  }

 private:
  struct Known {
    std::vector<WhereValue> values;  ///< those of options stay
    std::vector<OptionValue> held;   ///< values that hold the texts of these
    bool holds = false;
  };
  struct HashOfKey {
    std::size_t operator()(const std::pair<const OpenStore*, std::int64_t>& key) const {
      return std::hash<const OpenStore*>()(key.first) ^ static_cast<std::size_t>(key.second);
    }
  };
  struct Bound {
    const Where* where = nullptr;
    std::vector<RunColumn> keys;
    bool by_configuration = false;
    std::unordered_map<std::pair<const OpenStore*, std::int64_t>, Known, HashOfKey> known;
  };
  std::vector<Bound> conditions_;
};

/// What was chosen in a part of a store.
struct Chosen {
  explicit Chosen(std::size_t sort_keys) : sort_values(sort_keys) {}

  std::vector<Hit> hits;            ///< Hit::varied is an index in `varied`
  std::vector<std::string> varied;  ///< texts of `runs.varied`
  std::vector<std::vector<OptionValue>> sort_values;

  /// The index of a text. Neighbours mostly have the same one or one of their own.
  std::uint32_t number_of(std::string_view text) {
    if (varied.empty() || varied.back() != text) varied.emplace_back(text);
    return static_cast<std::uint32_t>(varied.size() - 1);
  }
};

/// The position of each item in the ascending order of the items; equal items have equal ranks.
template <class Item>
std::vector<std::uint32_t> ranks(const std::vector<Item>& items) {
  std::vector<std::uint32_t> order(items.size()), rank(items.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return items[a] < items[b]; });
  for (std::size_t k = 1; k < order.size(); ++k)
    rank[order[k]] = rank[order[k - 1]] + (items[order[k - 1]] < items[order[k]] ? 1 : 0);
  return rank;
}

std::vector<OptionValue> sort_key_of(const Configuration& configuration) {
  try {
    return sort_key(config_of(configuration, ""));
  } catch (const NotReproduced&) {
    return {};
  }
}

/// The ranks of texts of `runs.varied` in the order of runs.csv: value by value, numbers as numbers.
std::vector<std::uint32_t> ranks_of_varied(const SelectedRuns& selection) {
  std::vector<std::vector<std::pair<OptionValue, std::string>>> keys;
  for (const std::string& text : selection.varied) {
    auto& key = keys.emplace_back(selection.varied_keys.size());
    for (Override& one : varied_of(text)) {
      const auto at = std::lower_bound(selection.varied_keys.begin(), selection.varied_keys.end(), one.key);
      auto& value = key[static_cast<std::size_t>(at - selection.varied_keys.begin())];
      if (const auto x = to_number(one.value)) value.first = *x;
      else value.first = one.value;
      value.second = std::move(one.value);
    }
  }
  return ranks(keys);
}

}  // namespace

int compare(const OptionValue& a, const OptionValue& b) {
  const auto number = [](const OptionValue& v) -> std::optional<double> {
    if (const auto* n = std::get_if<std::int64_t>(&v)) return static_cast<double>(*n);
    if (const auto* x = std::get_if<double>(&v)) return *x;
    return std::nullopt;
  };
  const auto kind = [&](const OptionValue& v) {
    return std::holds_alternative<std::monostate>(v) ? 2 : number(v) ? 0 : 1;
  };
  if (kind(a) != kind(b)) return kind(a) - kind(b);
  if (kind(a) == 0) return *number(a) < *number(b) ? -1 : *number(a) > *number(b) ? 1 : 0;
  return kind(a) == 2 ? 0 : std::get<std::string>(a).compare(std::get<std::string>(b));
}

SelectedRuns select(const ResultStores& stores, const RunColumns& columns, std::span<const Where> conditions,
                    std::span<const SortKey> sort, Order wanted_order) {
  const Filter filter(columns, conditions);
  const std::size_t at_configuration = columns.index(configuration_column), at_varied = columns.index(varied_column);
  std::set<std::size_t> wanted = {at_configuration, at_varied};
  filter.add_columns(wanted);
  for (const SortKey& key : sort) {
    if (key.column.in_store()) wanted.insert(key.column.index);
  }
  const std::vector<std::size_t> chosen(wanted.begin(), wanted.end());
  std::map<std::size_t, std::size_t> places;  // index in the store to that in `chosen`
  for (std::size_t k = 0; k < chosen.size(); ++k) places[chosen[k]] = k;
  std::vector<std::size_t> place_of(*wanted.rbegin() + 1);
  for (const auto& [index, place] : places) place_of[index] = place;

  SelectedRuns selection;
  std::unordered_map<std::string, std::uint32_t> known_varied;
  std::vector<std::vector<OptionValue>> sort_values(sort.size());  // values by sort key and hit
  for (std::size_t s = 0; s < stores.all().size(); ++s) {
    const OpenStore& open = *stores.all()[s];
    for_each_part(open, [&](const RowPart& of_rows) -> UsePart {
      const auto part = std::make_shared<Chosen>(sort.size());
      Filter own = filter;
      CellReader cells;
      of_rows.rows.scan(chosen, of_rows.after, of_rows.last, [&](const RunRows::Part& row) {
        const auto stored = [&](std::size_t index) -> const Value& { return row.values[place_of[index]]; };
        const auto* configuration = std::get_if<std::int64_t>(&stored(at_configuration));
        const auto* varied = std::get_if<std::string_view>(&stored(at_varied));
        const RunPlace run{&open, row.id, configuration ? *configuration : 0, varied ? *varied : std::string_view()};
        if (!own.holds(run, cells, stored)) return;
        part->hits.push_back(
            {static_cast<std::uint32_t>(s), part->number_of(run.varied), row.number, row.id, run.configuration});
        for (std::size_t k = 0; k < sort.size(); ++k) {
          const RunColumn& column = sort[k].column;
          part->sort_values[k].push_back(cells.value(column, run, column.in_store() ? stored(column.index) : Value()));
        }
      });
      return [&, part] {
        std::vector<std::uint32_t> number_of;  // those of the part's texts among all
        for (std::string& text : part->varied) {
          const auto [at, is_new] =
              known_varied.try_emplace(std::move(text), static_cast<std::uint32_t>(selection.varied.size()));
          if (is_new) selection.varied.push_back(at->first);
          number_of.push_back(at->second);
        }
        for (Hit& hit : part->hits) {
          hit.varied = number_of[hit.varied];
          selection.hits.push_back(hit);
        }
        for (std::size_t k = 0; k < sort.size(); ++k)
          std::move(part->sort_values[k].begin(), part->sort_values[k].end(), std::back_inserter(sort_values[k]));
      };
    });
  }

  std::set<std::string> keys;
  for (std::string& text : selection.varied) {
    try {
      for (const Override& one : varied_of(text)) keys.insert(one.key);
    } catch (const NotReproduced&) {
      text.clear();  // the row is damaged, which is found when it is read
    }
  }
  selection.varied_keys.assign(keys.begin(), keys.end());

  std::map<std::int64_t, std::vector<OptionValue>> sort_keys;
  std::vector<std::uint32_t> folder_of(stores.all().size());
  for (std::size_t s = 0; s < stores.all().size(); ++s) {
    const bool same = s > 0 && stores.all()[s]->folder == stores.all()[s - 1]->folder;
    folder_of[s] = s == 0 ? 0 : folder_of[s - 1] + (same ? 0 : 1);
    for (const auto& [key, configuration] : stores.all()[s]->configurations)
      sort_keys.try_emplace(key, sort_key_of(configuration));
  }
  std::vector<std::vector<OptionValue>> in_order;
  std::unordered_map<std::int64_t, std::uint32_t> configuration_ranks;
  for (const auto& [key, values] : sort_keys) in_order.push_back(values);
  const std::vector<std::uint32_t> rank_of_configuration = ranks(in_order), rank_of_varied = ranks_of_varied(selection);
  std::size_t k = 0;
  for (const auto& [key, values] : sort_keys) configuration_ranks[key] = rank_of_configuration[k++];

  const std::vector<Hit> hits = std::move(selection.hits);
  std::vector<std::uint32_t> order(hits.size()), ranks_of_hits;
  for (const Hit& hit : hits) {
    const auto found = configuration_ranks.find(hit.configuration);
    ranks_of_hits.push_back(found == configuration_ranks.end() ? 0 : found->second);
  }
  std::iota(order.begin(), order.end(), 0U);
  const bool once = folder_of.empty() || folder_of.back() + 1 == folder_of.size();  // no run stands in two stores
  const bool as_stored = wanted_order == Order::stored && once;
  const auto before = [&](std::uint32_t i, std::uint32_t j) {
    for (std::size_t key = 0; key < sort.size(); ++key) {
      const OptionValue &a = sort_values[key][i], &b = sort_values[key][j];
      const int sign = compare(a, b);
      if (sign == 0) continue;
      const bool absent = a == OptionValue() || b == OptionValue();
      return sort[key].descending && !absent ? sign > 0 : sign < 0;
    }
    const Hit &a = hits[i], &b = hits[j];
    const auto key = [&](const Hit& hit, std::uint32_t at) {
      return std::tuple(folder_of[hit.store], ranks_of_hits[at], rank_of_varied[hit.varied],
                        static_cast<std::uint64_t>(hit.id), hit.store, hit.number);
    };
    return key(a, i) < key(b, j);
  };
  if (!as_stored) std::sort(order.begin(), order.end(), before);
  selection.hits.reserve(hits.size());
  for (const std::uint32_t i : order) {
    const Hit* last = selection.hits.empty() ? nullptr : &selection.hits.back();
    if (!last || last->id != hits[i].id || folder_of[last->store] != folder_of[hits[i].store]) ++selection.runs;
    selection.hits.push_back(hits[i]);
  }
  return selection;
}

RunReader::RunReader(const ResultStores& stores, Connections connections)
    : stores_(&stores), connections_(connections), own_(stores.all().size()), rows_(stores.all().size()) {}

bool RunReader::are_one_run(const Hit& a, const Hit& b) const {
  return a.id == b.id && stores_->all()[a.store]->folder == stores_->all()[b.store]->folder;
}

RunRows& RunReader::rows_of(std::size_t store) {
  std::unique_ptr<RunRows>& rows = rows_[store];
  if (!rows) {
    const OpenStore& open = *stores_->all()[store];
    if (connections_ == Connections::own)
      own_[store] = std::make_unique<Store>(open.file.parent_path(), metric_table(), Access::read);
    rows = std::make_unique<RunRows>(own_[store] ? *own_[store] : open.store);
  }
  return *rows;
}

std::vector<std::size_t> RunReader::parts(const SelectedRuns& selection, std::size_t length) const {
  const std::vector<Hit>& hits = selection.hits;
  std::vector<std::size_t> begins = {0};
  while (hits.size() - begins.back() > length) {
    std::size_t next = begins.back() + length;
    while (next < hits.size() && are_one_run(hits[next - 1], hits[next])) ++next;
    begins.push_back(next);
  }
  if (begins.back() < hits.size()) begins.push_back(hits.size());
  return begins;
}

Damage RunReader::read(const SelectedRuns& selection, const std::function<bool(const CheckedRow&)>& use) {
  return read(selection, 0, selection.hits.size(), use);
}

Damage RunReader::read(const SelectedRuns& selection, std::size_t first, std::size_t end,
                       const std::function<bool(const CheckedRow&)>& use) {
  Damage damage;
  for (std::size_t k = first; k < end;) {
    bool shown = false;
    std::string why;
    const std::size_t first_of_run = k;
    for (; k < end && are_one_run(selection.hits[k], selection.hits[first_of_run]); ++k) {
      if (shown) continue;
      const Hit& hit = selection.hits[k];
      const OpenStore& open = *stores_->all()[hit.store];
      const RunRows::Row row = rows_of(hit.store).at(hit.number);
      const bool known = open.configurations.contains(hit.configuration);
      shown = row.damage.empty() && known;
      if (!shown) {
        why = fmt::format("{} of {}: {}", row.run.name(), open.file.string(),
                          row.damage.empty() ? "runs.configuration" : row.damage);
      } else if (!use({{&open, row.run.id, hit.configuration, selection.varied[hit.varied]}, row.values})) {
        return damage;
      }
    }
    if (!shown) damage.add({1, why});
  }
  return damage;
}

}  // namespace polhode::study::query
