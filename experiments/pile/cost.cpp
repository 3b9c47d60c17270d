// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/pile/cost.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "experiments/study/plot/plain_panel.hpp"
#include "experiments/study/text/csv.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::pile {
namespace {

struct Pile {
  const RunRecord* run;
  std::size_t bodies;
  const RunResult& result() const { return run->result; }
  const ContactMeasures& found() const { return run->result.contact; }
  /// Largest rise of the energy over its magnitude at the start.
  double rise() const { return *found().energy_rise_max / std::abs(*result().energy_initial); }
  double steps_per_second() const { return static_cast<double>(result().steps) / result().seconds; }
};

/// Key of a curve: method, broad phase, narrow phase, response, timing, step.
using Key = std::array<std::string, 6>;
constexpr std::size_t of_response = 3, of_step = 5;
Key key_of(const RunConfig& c) {
  return {c.integrator,        c.contact->broad_phase,   c.contact->narrow_phase,
          c.contact->response, c.contact->impact_timing, fmt::format("h = {} s", number(*c.dt))};
}

/// The analysis:
/// 1. The parts of the key that differ between runs, for the names of curves.
/// 2. Curves: completed runs by key, smallest pile first; other runs with the reason.
/// 3. analysis(): sentences, table, piles.csv, figure; wall times apart in Analysis::timed.
class Piles {
 public:
  explicit Piles(const StudyView& study) {
    std::optional<Key> first;
    for (const RunRecord& run : study.runs) {
      if (!run.config.contact) continue;
      const Key key = key_of(run.config);
      if (!first) first = key;
      for (std::size_t k = 0; k < key.size(); ++k) varies_[k] = varies_[k] || key[k] != (*first)[k];
    }
    for (const RunRecord& run : study.runs) {
      if (!run.config.contact) continue;
      const bool whole =
          run.result.status == "ok" && run.result.energy_initial.value_or(0) != 0 && run.result.contact.energy_rise_max;
      if (whole) curves_[key_of(run.config)].push_back({&run, run.scenario->problem.moving()});
      else
        failed_.push_back(
            fmt::format("{} ({}): {}", run.config.scenario, label(key_of(run.config)), run.result.message));
    }
    for (auto& [key, piles] : curves_) {
      std::stable_sort(piles.begin(), piles.end(), [](const Pile& a, const Pile& b) { return a.bodies < b.bodies; });
      labels_.push_back(label(key));
    }
  }

  Analysis analysis() const {
    Analysis found{.alone = true, .heading = "Piles"};
    found.answer.sentences = answer();
    found.sentences = sentences();
    found.method = {
        "The rise is that of kinetic and potential energy above an earlier value, over the energy at the start. Depths "
        "are looked "
        "at at 100 instants and at the end; the deepest is mostly that of an impact, for which a step of h lets bodies "
        "come "
        "closer by up to v h. Wall times include this measuring."};
    if (curves_.empty()) return found;
    found.tables.push_back({"piles", table()});
    found.files.push_back({"piles.csv", csv()});
    found.figures.push_back(figure());
    found.timed.sentences = timed_sentences();
    found.timed.figures.push_back(timed_figure());
    found.timed.files.push_back({"cost.csv", timed_csv()});
    return found;
  }

 private:
  /// Name of a curve: response, step, and further parts of the key that differ between runs.
  std::string label(const Key& key) const {
    std::string text = key[of_response] + ", " + key[of_step];
    for (std::size_t k = 0; k < key.size(); ++k) {
      if (varies_[k] && k != of_response && k != of_step) text += ", " + key[k];
    }
    return text;
  }
  std::size_t place(const Key& key) const {
    return std::size_t(std::find(labels_.begin(), labels_.end(), label(key)) - labels_.begin());
  }

  std::vector<std::string> answer() const {
    const Pile *most = nullptr, *deepest = nullptr;
    std::size_t least_bodies = 0, most_bodies = 0;
    for (const auto& [key, piles] : curves_) {
      for (const Pile& p : piles) {
        least_bodies = most ? std::min(least_bodies, p.bodies) : p.bodies;
        most_bodies = std::max(most_bodies, p.bodies);
        if (!most || p.rise() > most->rise()) most = &p;
        if (!deepest || p.found().penetration_max > deepest->found().penetration_max) deepest = &p;
      }
    }
    if (!most) return {"No pile was carried out to its end."};
    const std::string range = least_bodies == most_bodies
                                  ? fmt::format("a pile of {} bodies", most_bodies)
                                  : fmt::format("piles of {} to {} bodies", least_bodies, most_bodies);
    const auto which = [&](const Pile& p) {
      return fmt::format("{} bodies, {}", p.bodies, label(key_of(p.run->config)));
    };
    return {fmt::format("In {} the energy never rises by more than {} % of what it was at the start ({}).", range,
                        number(100 * most->rise()), which(*most)),
            fmt::format("Bodies are at most {} m deep in each other ({}).",
                        number(deepest->found().penetration_max.value_or(0)), which(*deepest))};
  }

  std::vector<std::string> sentences() const {
    std::vector<std::string> all;
    for (const auto& [key, piles] : curves_) {
      for (const Pile& p : piles) {
        all.push_back(
            fmt::format("{} bodies ({}): the energy never rises by more than {} % of what it was at the start; bodies "
                        "are at most {} m deep in "
                        "each other, and {} m at the end.",
                        p.bodies, label(key), number(100 * p.rise()), number(p.found().penetration_max.value_or(0)),
                        number(p.found().penetration_end.value_or(0))));
      }
    }
    for (const std::string& failed : failed_) all.push_back("Not carried out: " + failed + ".");
    return all;
  }

  Table table() const {
    Table table{.caption = "Piles: what contact takes from the energy, its rise, and depths",
                .columns = {{.header = "scenario", .kind = Column::Kind::name, .apart = true},
                            {"answer", "", Column::Kind::text},
                            {"bodies"},
                            {.header = "energy rises by", .unit = "%", .best = Column::Best::least},
                            {"lost to impacts", "J"},
                            {"to friction", "J"},
                            {"put in by undoing depth", "J"},
                            {.header = "deepest", .unit = "m", .best = Column::Best::least},
                            {.header = "depth at the end", .unit = "m", .best = Column::Best::least}},
                .rows = {}};
    const auto cell = [](const std::optional<double>& x) { return x ? number(*x) : std::string(); };
    for (const auto& [key, piles] : curves_) {
      for (const Pile& p : piles) {
        const ContactMeasures& c = p.found();
        table.rows.push_back({p.run->config.scenario, label(key), std::to_string(p.bodies), number(100 * p.rise()),
                              cell(c.impact_loss), cell(c.friction_loss), cell(c.penetration_energy),
                              cell(c.penetration_max), cell(c.penetration_end)});
      }
    }
    return table;
  }

  static std::vector<std::string> with_key(const Pile& p, const Key& key, std::vector<std::string> numbers) {
    std::vector<std::string> row = {p.run->id, p.run->config.scenario};
    row.insert(row.end(), key.begin(), key.begin() + of_step);
    row.insert(row.end(), {exact(*p.run->config.dt), std::to_string(p.bodies)});
    row.insert(row.end(), numbers.begin(), numbers.end());
    return row;
  }
  static std::vector<std::string> header(std::vector<std::string> numbers) {
    std::vector<std::string> row = {"run",      "scenario",      "integrator", "broad_phase", "narrow_phase",
                                    "response", "impact_timing", "dt_s",       "bodies"};
    row.insert(row.end(), numbers.begin(), numbers.end());
    return row;
  }

  std::string csv() const {
    std::string text = csv_row(header({"energy_rise_max_rel", "penetration_max_m", "penetration_end_m"}));
    for (const auto& [key, piles] : curves_) {
      for (const Pile& p : piles) {
        text += csv_row(with_key(
            p, key, {exact(p.rise()), csv_cell(p.found().penetration_max), csv_cell(p.found().penetration_end)}));
      }
    }
    return text;
  }

  std::string timed_csv() const {
    std::string text = csv_row(header({"steps_per_s", "wall_per_step_and_body_s"}));
    for (const auto& [key, piles] : curves_) {
      for (const Pile& p : piles) {
        const double rate = p.steps_per_second();
        text += csv_row(with_key(p, key, {exact(rate), exact(1 / (rate * double(p.bodies)))}));
      }
    }
    return text;
  }

  std::vector<std::string> timed_sentences() const {
    std::vector<std::string> all;
    for (const auto& [key, piles] : curves_) {
      for (const Pile& p : piles) {
        all.push_back(
            fmt::format("{} bodies ({}): {} steps per second.", p.bodies, label(key), number(p.steps_per_second())));
      }
    }
    return all;
  }

  template <class Of>
  Panel panel(const char* title, const PlainAxis& axis, const Of& of) const {
    std::vector<PlainCurve> curves;
    for (const auto& [key, piles] : curves_) {
      PlainCurve curve{label(key), place(key), 0};
      for (const Pile& p : piles) {
        if (const std::optional<double> y = of(p)) curve.points.emplace_back(double(p.bodies), *y);
      }
      curves.push_back(std::move(curve));
    }
    return plain_panel(title, {"bodies", "bodies"}, axis, curves);
  }

  Figure figure() const {
    return plain_figure("piles", "Piles against the number of bodies",
                        "Each pile once for each way in which contact is found and answered.", labels_, {""},
                        {panel("How far the energy rises", {"energy_rise_max_rel", "energy rise / energy"},
                               [](const Pile& p) { return std::optional(p.rise()); }),
                         panel("How deep bodies are in each other at most", {"penetration_max_m", "depth (m)"},
                               [](const Pile& p) { return p.found().penetration_max; }),
                         panel("How deep they are at the end", {"penetration_end_m", "depth (m)"},
                               [](const Pile& p) { return p.found().penetration_end; })});
  }

  Figure timed_figure() const {
    return plain_figure("cost_against_bodies", "Steps per second against the number of bodies",
                        "Steps per second of wall time, the measuring included.", labels_, {""},
                        {panel("Steps per second", {"steps_per_s", "steps per second"},
                               [](const Pile& p) { return std::optional(p.steps_per_second()); })});
  }

  std::map<Key, std::vector<Pile>> curves_;
  std::array<bool, std::tuple_size_v<Key>> varies_{};
  std::vector<std::string> labels_, failed_;
};

}  // namespace

Analysis what_piles_cost(const StudyView& study) { return Piles(study).analysis(); }

}  // namespace polhode::study::pile
