// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/plan/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>
#include <set>
#include <span>
#include <stdexcept>
#include <utility>

#include "experiments/study/plan/most_runs.hpp"
#include "experiments/study/plan/product.hpp"
#include "experiments/study/plan/run_order.hpp"
#include "experiments/study/record/run_id.hpp"
#include "experiments/study/record/run_options.hpp"
#include "experiments/study/run/run.hpp"
#include "experiments/study/text/in_order.hpp"
#include "experiments/study/text/input_error.hpp"
#include "experiments/study/text/text_hash.hpp"
#include "integrators/catalogue.hpp"

namespace polhode::study::inline plan {
namespace {

static_assert(sizeof(PlanRow) == 32);

constexpr std::size_t most_values = 24;  // largest number of values of an axis that have runs in Plan::values

double cost_of(const RunConfig& config) {
  if (!config.dt) return 200 * config.t_end * (1 - std::log10(*config.tolerance));
  const int stages = std::max(1, find_integrator(config.integrator)->declaration.evaluations_per_step);
  return config.t_end / *config.dt * (stages + 1);
}

/// Runs of one kind take times in proportion to their cost.
std::string kind_of(const RunConfig& config) {
  return fmt::format("{} {} {}", config.integrator, config.scenario, name(config.precision));
}

/// Adds an empty value for each key that the product of the run does not vary, and sorts the values by `keys`.
void fill_varied(RunConfig& config, const std::vector<std::string>& keys) {
  if (std::equal(keys.begin(), keys.end(), config.varied.begin(), config.varied.end(),
                 [](const std::string& key, const Override& own) { return own.key == key; })) {
    return;
  }
  std::vector<Override> varied;
  varied.reserve(keys.size());
  for (const std::string& key : keys) {
    const auto own =
        std::find_if(config.varied.begin(), config.varied.end(), [&](const Override& o) { return o.key == key; });
    varied.push_back(own == config.varied.end() ? Override{key, ""} : std::move(*own));
  }
  config.varied = std::move(varied);
}

/// Number of the kind among `kinds`, to which it is added.
std::uint16_t number_of_kind(const std::string& kind, std::vector<std::string>& kinds) {
  const auto known = std::find(kinds.begin(), kinds.end(), kind);
  const auto number = static_cast<std::uint16_t>(known - kinds.begin());
  if (known == kinds.end()) kinds.push_back(kind);
  return number;
}

/// What the runs have in common whose configurations differ in the varied keys alone. It takes longer to make than the
/// rest of a draft, and most runs of a large study have it in common with the one before.
struct OptionsOfRuns {
  explicit OptionsOfRuns(const RunConfig& config)
      : numbers(config), kind(kind_of(config)), cost(cost_of(config)), key(sort_key_of_options(config)) {
    if (!config.reference) return;
    RunConfig motion = config;
    motion.reference = false;
    motion_numbers.emplace(motion);
  }

  RunNumbers numbers;
  std::optional<RunNumbers> motion_numbers;  ///< those without --reference, where the configuration has it
  std::string kind;
  double cost;
  std::vector<OptionValue> key;  ///< sort_key_of_options()
};

/// A run on its way into the plan.
struct Draft {
  PlanRow row;                                   ///< the row, whose kind is not yet set
  std::shared_ptr<const OptionsOfRuns> options;  ///< never null
  std::uint64_t motion = 0;                      ///< the id without --reference, which does not change the motion
  std::vector<OptionValue> key;                  ///< sort_key_of_varied()
};

/// Throws std::invalid_argument for an impossible step.
Draft draft_of(const RunConfig& config, const Scenario& scenario, std::shared_ptr<const OptionsOfRuns> options) {
  const std::string canonical = scenario.canonical();
  const std::uint64_t id = options->numbers.of(config.varied, canonical);
  const std::uint64_t motion = options->motion_numbers ? options->motion_numbers->of(config.varied, canonical) : id;
  const bool refused = !refusal(config, scenario).empty();
  const auto cost = static_cast<float>(std::min(options->cost, double{std::numeric_limits<float>::max()}));
  return {{.id = id, .scenario = study::number_of(scenario.name, canonical), .cost = cost, .refused = refused},
          std::move(options),
          motion,
          sort_key_of_varied(config.varied)};
}

/// Puts the rows in this order, of all their numbers, without a second copy of them.
void put_in_order(std::vector<PlanRow>& rows, std::vector<std::uint32_t> order) {
  for (std::uint32_t first = 0; first < order.size(); ++first) {
    const PlanRow of_first = rows[first];
    std::uint32_t place = first;
    while (order[place] != first) {
      rows[place] = rows[order[place]];
      place = std::exchange(order[place], place);
    }
    rows[place] = of_first;
    order[place] = place;
  }
}

/// The rows of a plan in the making.
class Rows {
 public:
  /// `expected`: number of runs, for which room is made.
  explicit Rows(std::size_t expected) : order_(expected) {
    rows_.reserve(expected);
    motions_.reserve(expected);
  }

  bool empty() const { return rows_.empty(); }

  void add(const Draft& draft) {
    rows_.push_back(draft.row);
    rows_.back().kind = number_of_kind(draft.options->kind, kinds_);
    motions_.push_back(draft.motion);
    order_.add(draft.options->key, draft.key);
  }

  /// Puts the rows into the plan, by configuration. Of several runs of the same motion the first one is kept.
  void move_into(Plan& plan) && {
    std::vector<std::uint32_t> numbers(rows_.size());
    std::iota(numbers.begin(), numbers.end(), 0U);
    std::stable_sort(numbers.begin(), numbers.end(), [&](auto a, auto b) { return motions_[a] < motions_[b]; });
    std::vector<bool> again(rows_.size());
    for (std::size_t i = 1; i < numbers.size(); ++i)
      again[numbers[i]] = motions_[numbers[i]] == motions_[numbers[i - 1]];
    motions_ = std::vector<std::uint64_t>();
    numbers = order_.sorted([&](auto a, auto b) { return rows_[a].id < rows_[b].id; });
    const auto dropped = std::stable_partition(numbers.begin(), numbers.end(), [&](auto i) { return !again[i]; });
    const std::span<const std::uint32_t> kept(numbers.begin(), dropped);
    const auto values = order_.values(kept, most_values);
    order_ = RunOrder();
    const std::vector<std::string> columns = sort_columns(plan.varied_keys);
    for (std::size_t k = 0; k < columns.size(); ++k) {  // the last of several values of a column is its text
      Plan::Values& of_column = plan.values[columns[k]] = {values[k].count, {}};
      for (const std::uint32_t i : values[k].runs)
        of_column.runs.push_back(static_cast<std::uint32_t>(std::find(kept.begin(), kept.end(), i) - kept.begin()));
    }
    const std::size_t count = kept.size();
    put_in_order(rows_, std::move(numbers));
    rows_.resize(count);
    plan.rows = std::move(rows_);
    plan.kinds = kinds_;
  }

 private:
  std::vector<PlanRow> rows_;
  std::vector<std::uint64_t> motions_;
  RunOrder order_;
  std::vector<std::string> kinds_;
};

/// Adds what a product of axes has to the plan, besides its runs.
void add_product(Plan& plan, const Product& product) {
  for (const auto& opened : product.opened()) {
    const Scenario& s = *opened->scenario;
    const auto known = std::find_if(plan.scenarios.begin(), plan.scenarios.end(),
                                    [&](const Scenario& other) { return other.name == s.name; });
    if (known == plan.scenarios.end()) plan.scenarios.push_back(s);
    else if (known->canonical() != s.canonical())
      throw InputError("two files are both named " + s.name + ".toml; rename one of them");
    auto& names = plan.scenario_names;
    if (std::find(names.begin(), names.end(), opened->name) == names.end()) names.push_back(opened->name);
    plan.invariants.insert(plan.invariants.end(), s.invariants.begin(), s.invariants.end());
  }
  for (const std::string& key : product.varied_keys()) plan.varied_keys.push_back(key);
  for (const RunOption& option : run_options()) {
    if (option.on_demand && product.study().has(option.name)) plan.named.insert(option.name);
  }
}

void sort_without_duplicates(std::vector<std::string>& all) {
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
}

std::vector<std::uint32_t> numbers_by_id(const std::vector<PlanRow>& rows) {
  std::vector<std::uint32_t> numbers(rows.size());
  std::iota(numbers.begin(), numbers.end(), 0U);
  std::sort(numbers.begin(), numbers.end(), [&](auto a, auto b) { return rows[a].id < rows[b].id; });
  return numbers;
}

/// The study with the defaults of a further product of axes.
StudyAxes further(const Experiment& experiment, const StudyAxes& study, const FurtherAxes& more) {
  StudyAxes other = study;
  for (const auto& [axis, text] : more.defaults) {
    const auto before = experiment.defaults.find(axis), now = study.axes.find(axis);
    const bool given =
        now != study.axes.end() && (before == experiment.defaults.end() || now->second != before->second);
    if (!given && !study.table_with(axis)) other.axes[axis] = text;
  }
  if (!more.vary.empty()) other.vary = more.vary;
  return other;
}

/// Throws InputError if one of the options affects no run.
void refuse_without_effect(const StudyAxes& study, const std::set<std::string>& said,
                           const std::set<std::string>& effective) {
  for (const RunOption& option : run_options()) {
    if (!said.contains(option.name) || effective.contains(option.name)) continue;
    throw InputError(fmt::format("{}: it has no effect, because {}; leave it out, {}", study.label(option.name),
                                 option.no_effect, option.remedy));
  }
}

/// All products of axes of a study.
std::vector<std::shared_ptr<Product>> products_of(const Experiment& experiment, const Options& options,
                                                  const StudyAxes& study, Plan& plan) {
  std::vector<std::shared_ptr<Product>> products;
  products.push_back(std::make_shared<Product>(experiment, study, experiment.reference));
  for (const FurtherAxes& more : experiment.more) {
    if (more.by_default_only && !options.plain) continue;
    const StudyAxes other = further(experiment, study, more);
    plan.further_axes.push_back(other.axes);
    products.push_back(std::make_shared<Product>(experiment, other, more.reference));
  }
  return products;
}

/// True if conditions may leave out cells.
bool with_conditions(const Options& options) {
  return std::any_of(options.studies.begin(), options.studies.end(),
                     [](const StudyAxes& study) { return !study.where.empty(); });
}

/// The products of axes of each study.
using Products = std::vector<std::vector<std::shared_ptr<Product>>>;

/// Adds the runs of these cells of a product, made on several threads. `number`: that of the product. `cell`: gives
/// the k-th of `count` cells. `effective`: the options that affect a run of it are added. Returns the number of cells
/// that the conditions leave out.
std::size_t add_cells(const Product& product, std::uint16_t number, std::size_t count,
                      const std::function<std::uint64_t(std::size_t k)>& cell, const Plan& plan, Rows& rows, int jobs,
                      std::set<std::string>& effective) {
  constexpr std::size_t at_a_time = 1024;
  std::size_t left_out = 0;
  in_order((count + at_a_time - 1) / at_a_time, number_of_threads(jobs), [&](std::size_t part) -> UsePart {
    struct Made {
      std::vector<Draft> drafts;
      Product::Part part;
    };
    const auto made = std::make_shared<Made>();
    std::vector<std::uint64_t> cells;
    for (std::size_t k = part * at_a_time; k < std::min((part + 1) * at_a_time, count); ++k) cells.push_back(cell(k));
    std::shared_ptr<const OptionsOfRuns> options;
    made->part = product.for_each(cells, [&](std::uint64_t at, Product::Run&& run) {
      fill_varied(run.config, plan.varied_keys);
      if (!run.same_options) options = std::make_shared<const OptionsOfRuns>(run.config);
      made->drafts.push_back(draft_of(run.config, *run.scenario, options));
      made->drafts.back().row.product = number;
      made->drafts.back().row.cell = static_cast<std::uint32_t>(at);
      made->drafts.back().row.own_presets = run.own_presets;
    });
    return [&, made] {
      for (const Draft& draft : made->drafts) rows.add(draft);
      left_out += made->part.left_out;
      effective.merge(made->part.effective);
    };
  });
  return left_out;
}

double most_cells(const Products& products) {
  double cells = 0;
  for (const auto& of_study : products) {
    for (const auto& product : of_study) cells += product->most_cells();
  }
  return cells;
}

/// Mean number of bodies of the scenarios, without overrides.
double mean_bodies(const Products& products) {
  double bodies = 0, scenarios = 0;
  for (const auto& of_study : products) {
    for (const auto& product : of_study) {
      for (const auto& opened : product->opened())
        bodies += static_cast<double>(opened->scenario->problem.bodies.size());
      scenarios += static_cast<double>(product->opened().size());
    }
  }
  return bodies / scenarios;
}

void refuse_too_many(double cells) {
  if (cells <= static_cast<double>(most_runs)) return;
  throw InputError(fmt::format("{} runs are more than the 10 million that a study may have; make the axes shorter",
                               cells < 1e15 ? fmt::format("{:.0f}", cells) : fmt::format("{:.2g}", cells)));
}

Products open_products(const Experiment& experiment, const Options& options, Plan& plan) {
  Products products;
  for (const StudyAxes& study : options.studies) products.push_back(products_of(experiment, options, study, plan));
  refuse_too_many(most_cells(products));
  for (const auto& of_study : products) {
    for (const auto& product : of_study) add_product(plan, *product);
  }
  sort_without_duplicates(plan.varied_keys);
  sort_without_duplicates(plan.invariants);
  return products;
}

}  // namespace

PlannedRun Plan::run(std::size_t i, Variants* known) const {
  const PlanRow& row = rows[i];
  PlannedRun run{.id = id_of_number(row.id),
                 .config = {},
                 .scenario = {},
                 .refusal = {},
                 .cost = row.cost,
                 .keeps_curves = row.keeps_curves};
  if (row.product == products_.size()) {
    run.config = further_[row.cell].config;
    run.scenario = further_[row.cell].scenario;
  } else {
    if (row.own_presets) known = nullptr;  // the scenario of another duration has the same number
    Product::Run made = products_[row.product]->run(row.cell, known ? known->find(row.scenario) : nullptr,
                                                    known ? &known->last : nullptr);
    run.config = std::move(made.config);
    run.scenario = std::move(made.scenario);
    fill_varied(run.config, varied_keys);
    if (known) known->add(row.scenario, run.scenario);
  }
  if (row.refused) run.refusal = refusal(run.config, *run.scenario);
  return run;
}

RunConfig Plan::config(std::size_t i, LastOptions* last) const {
  const PlanRow& row = rows[i];
  if (row.own_presets || row.product == products_.size()) return run(i).config;
  RunConfig config = products_[row.product]->config(row.cell, last);
  fill_varied(config, varied_keys);
  return config;
}

std::vector<PlannedRun> Plan::runs() const {
  Variants known(size());
  std::vector<PlannedRun> all;
  for (std::size_t i = 0; i < size(); ++i) all.push_back(run(i, &known));
  return all;
}

std::optional<std::size_t> Plan::find(std::uint64_t id) const {
  const auto found = std::lower_bound(by_id_.begin(), by_id_.end(), id,
                                      [&](std::uint32_t i, std::uint64_t wanted) { return rows[i].id < wanted; });
  if (found == by_id_.end() || rows[*found].id != id) return std::nullopt;
  return *found;
}

Plan make_plan(const Experiment& experiment, const Options& options) {
  Plan plan;
  const Products products = open_products(experiment, options, plan);
  std::set<std::string> effective;
  Rows rows(with_conditions(options) ? 0 : static_cast<std::size_t>(most_cells(products)));
  for (std::size_t i = 0; i < products.size(); ++i) {
    const StudyAxes& study = options.studies[i];
    std::set<std::string> own;
    for (const auto& product : products[i]) {
      product->open();
      StudyCount count{study.name, product->cells(), 0, product->tables()};
      count.left_out = add_cells(*product, static_cast<std::uint16_t>(plan.products_.size()), count.cells,
                                 std::identity(), plan, rows, options.jobs, own);
      if (count.left_out == count.cells) product->refuse_empty();
      plan.studies.push_back(std::move(count));
      plan.products_.push_back(product);
    }
    refuse_without_effect(study, study.said, own);
    effective.merge(own);
  }
  refuse_without_effect(options.studies.front(), options.shared, effective);
  std::move(rows).move_into(plan);
  plan.by_id_ = numbers_by_id(plan.rows);
  if (experiment.one_run && plan.size() != 1) {
    throw InputError(fmt::format("{} makes one run, and this is {}; give each axis one value, or use energy_drift",
                                 experiment.name, plan.size()));
  }
  if (std::all_of(plan.rows.begin(), plan.rows.end(), [](const PlanRow& row) { return row.refused; })) {
    const PlannedRun first = plan.run(0);
    throw InputError(first.config.integrator + " on " + first.config.scenario + ": " + first.refusal);
  }
  TextHash ids;
  for (const PlanRow& row : plan.rows) ids.add(id_of_number(row.id));
  plan.identity = ids.text();
  return plan;
}

double Plan::most_true_motions() const {
  double all = 0;
  for (const auto& product : products_) all += product->most_true_motions();
  return all;
}

std::optional<Plan> glance_at_plan(const Experiment& experiment, const Options& options) {
  constexpr double few = 100'000, most_wanted = 10'000, many_bodies = 4;
  Plan plan;
  const Products products = open_products(experiment, options, plan);
  const double counted = most_cells(products);
  if (counted <= few) return std::nullopt;
  // The time to read a scenario is proportional to the number of its bodies.
  const double wanted = most_wanted * std::min(1.0, many_bodies / mean_bodies(products));
  Rows rows(0);
  std::set<std::string> effective;
  double all = 0, looked_at = 0;
  for (std::size_t i = 0; i < products.size(); ++i) {
    for (const auto& product : products[i]) {
      product->open();
      const std::uint64_t cells = product->cells();
      // One cell of each stretch, at a place of its own, so that no axis is in step with the choice.
      const auto count = static_cast<std::size_t>(
          std::clamp(std::ceil(static_cast<double>(cells) * wanted / counted), 1.0, static_cast<double>(cells)));
      const double stretch = static_cast<double>(cells) / static_cast<double>(count);
      const auto cell = [&](std::size_t k) {
        const double place = static_cast<double>(k + 1) * std::numbers::phi;
        return static_cast<std::uint64_t>((static_cast<double>(k) + place - std::floor(place)) * stretch);
      };
      add_cells(*product, static_cast<std::uint16_t>(plan.products_.size()), count, cell, plan, rows, options.jobs,
                effective);
      plan.studies.push_back({options.studies[i].name, cells, 0, {}});
      plan.products_.push_back(product);
      all += static_cast<double>(cells);
      looked_at += static_cast<double>(count);
    }
  }
  if (rows.empty()) return std::nullopt;  // the conditions leave few cells
  std::move(rows).move_into(plan);
  plan.by_id_ = numbers_by_id(plan.rows);
  plan.runs_of_a_row = all / looked_at;
  return plan;
}

std::size_t widen(Plan& plan, const std::vector<RunConfig>& configs) {
  const auto setting = [](const RunConfig& config) { return std::pair(config.scenario, config.varied); };
  const auto before = [](const auto& a, const auto& b) {
    if (a.first != b.first) return a.first < b.first;
    return std::lexicographical_compare(
        a.second.begin(), a.second.end(), b.second.begin(), b.second.end(),
        [](const Override& x, const Override& y) { return x.key != y.key ? x.key < y.key : x.value < y.value; });
  };
  using Setting = std::pair<std::string, std::vector<Override>>;
  std::map<Setting, std::shared_ptr<const Scenario>, decltype(before)> scenarios(before);
  Variants variants(plan.size());
  RunOrder order;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const PlannedRun run = plan.run(i, &variants);
    scenarios.emplace(setting(run.config), run.scenario);
    order.add(sort_key(run.config));
  }
  std::set<std::uint64_t> added;
  for (const RunConfig& config : configs) {
    const auto like = scenarios.find(setting(config));
    if (like == scenarios.end()) throw std::logic_error("a further run of a scenario that the study does not have");
    const Draft draft = draft_of(config, *like->second, std::make_shared<const OptionsOfRuns>(config));
    PlanRow row = draft.row;
    if (plan.contains(row.id) || !added.insert(row.id).second) continue;
    row.kind = number_of_kind(draft.options->kind, plan.kinds);
    row.product = static_cast<std::uint16_t>(plan.products_.size());
    row.cell = static_cast<std::uint32_t>(plan.further_.size());
    plan.further_.push_back({config, like->second});
    plan.rows.push_back(row);
    order.add(draft.options->key, draft.key);
  }
  if (added.empty()) return 0;
  std::vector<PlanRow> sorted;
  for (const std::uint32_t i : order.sorted([&](auto a, auto b) { return plan.rows[a].id < plan.rows[b].id; }))
    sorted.push_back(plan.rows[i]);
  plan.rows = std::move(sorted);
  plan.by_id_ = numbers_by_id(plan.rows);
  return added.size();
}

}  // namespace polhode::study::plan
