// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/impact/impacts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "experiments/study/curves/curves.hpp"
#include "experiments/study/plot/plain_panel.hpp"
#include "experiments/study/record/first_impact.hpp"
#include "experiments/study/statistics/line_fit.hpp"
#include "experiments/study/text/csv.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::impact {
namespace {

/// Errors below these are rounding errors, or errors of the run that replaces the exact solution; s, and relative.
constexpr double time_floor = 1e-11, energy_floor = 1e-14;

/// True if impacts conserve the energy: every pair of bodies that can collide has restitution 1 and no friction.
bool keeps_energy(const Scenario& scenario) {
  const auto& all = scenario.colliders;
  for (std::size_t a = 0; a < scenario.problem.moving(); ++a) {
    for (std::size_t b = a + 1; b < all.size(); ++b) {
      if (!all[a].shape || !all[b].shape) continue;
      if (std::max(all[a].restitution, all[b].restitution) < 1 || all[a].friction * all[b].friction > 0) return false;
    }
  }
  return true;
}

struct Errors {
  const RunRecord* run;
  double step;  ///< step (s) or tolerance
  std::optional<double> time, energy, linear, angular;
};

/// Key of a curve: motion, method, response, timing.
using Key = std::tuple<std::string, std::string, std::string, std::string>;

/// The order of the errors above `floor`: least-squares slope of log error against log step. Absent for fewer than
/// three points.
std::optional<double> order(const std::vector<Errors>& all, std::optional<double> Errors::*error, double floor) {
  std::vector<LinePoint> logs;
  for (const Errors& e : all) {
    if (!(e.*error) || !(*(e.*error) > floor)) continue;
    logs.push_back({std::log(e.step), std::log(*(e.*error))});
  }
  if (logs.size() < 3) return std::nullopt;
  const double slope = fit_line(logs).slope;
  return std::isfinite(slope) ? std::optional(slope) : std::nullopt;
}

/// The analysis:
/// 1. Time of the first impact of each motion, from the run that replaces the exact solution (exact_impacts()).
/// 2. add(): errors of every other run: time of the first impact, energy, momenta.
/// 3. Curves: the errors by motion, method, response and timing, smallest step first.
/// 4. analysis(): sentences, table, impacts.csv and figures.
class Impacts {
 public:
  explicit Impacts(const StudyView& study) {
    for (const RunRecord& run : study.runs) {
      if (is_first_impact_reference(run.config)) exact_[motion(run.config)] = run.result.contact.first_impact;
    }
    for (const RunRecord& run : study.runs) {
      if (!run.config.contact) continue;
      if (run.result.status != "ok") {
        failed_.push_back(fmt::format("{} on {}: {}", run.config.integrator, motion(run.config), run.result.message));
      } else if (!is_first_impact_reference(run.config)) {
        add(run);
      }
    }
    for (auto& [key, errors] : curves_) {
      std::stable_sort(errors.begin(), errors.end(), [](const Errors& a, const Errors& b) { return a.step < b.step; });
      const auto& [where, method, response, timing] = key;
      for (auto [list, name] :
           {std::pair(&motions_, &where), {&methods_, &method}, {&responses_, &response}, {&timings_, &timing}}) {
        if (std::find(list->begin(), list->end(), *name) == list->end()) list->push_back(*name);
      }
    }
  }

  Analysis analysis() const {
    Analysis found{.alone = true, .heading = "Errors of impacts"};
    found.answer.sentences = answer();
    found.sentences = sentences();
    found.method = {
        fmt::format(
            "The time of the first impact is compared with that of {} at a tolerance of {}, with located impacts. The "
            "order "
            "is the slope of the error against the step, by least squares through the logarithms, above {} s and {} of "
            "the energy.",
            first_impact_method, number(first_impact_tolerance), number(time_floor), number(energy_floor)),
        "The error of the energy is the largest distance of kinetic and potential energy from that at the start, over "
        "it, where "
        "every impact is elastic and without friction; elsewhere the drift of the ledger, in which what impacts took "
        "is accounted "
        "for. Semi-implicit Euler’s energy of a falling body is off by ½ m g h v all along its flight."};
    if (curves_.empty()) return found;
    found.tables.push_back({"impacts", table()});
    found.files.push_back({"impacts.csv", csv()});
    found.figures.push_back(
        figure("event_time", "The time of the first impact",
               "The error of the time of the first impact against the step; at the step it is known to a step "
               "at best.",
               {"event_time_error_s", "error of the event's time (s)"}, &Errors::time));
    found.figures.push_back(figure("energy", "The energy", "The largest error of the energy against the step.",
                                   {"energy_error_rel", "energy error / energy"}, &Errors::energy));
    return found;
  }

 private:
  static std::string motion(const RunConfig& c) {
    std::string text = c.scenario;
    for (const Override& o : c.varied) {
      if (!o.value.empty()) text += ", " + o.key + " = " + o.value;
    }
    return text;
  }

  void add(const RunRecord& run) {
    const RunConfig& c = run.config;
    const RunResult& r = run.result;
    Errors e{&run, c.dt ? *c.dt : *c.tolerance,     {},
             {},   r.linear_momentum_drift_max_rel, r.angular_momentum_drift_max_rel};
    const auto exact = exact_.find(motion(c));
    if (exact != exact_.end() && exact->second && r.contact.first_impact)
      e.time = std::abs(*r.contact.first_impact - *exact->second);
    const double scale = std::abs(r.energy_initial.value_or(0));
    if (!keeps_energy(*run.scenario)) e.energy = r.energy_drift_max_rel;
    else if (scale > 0 && r.contact.energy_change_max) e.energy = *r.contact.energy_change_max / scale;
    curves_[{motion(c), c.integrator, c.contact->response, c.contact->impact_timing}].push_back(e);
  }

  static std::string cell(const std::optional<double>& x) { return x ? number(*x) : std::string(); }
  static std::string order_text(const std::optional<double>& p) {
    return p ? fmt::format("{:.2f}", *p) : std::string();
  }

  /// Least and largest error at the smallest step over all motions, methods and responses, with their methods, by
  /// timing: "by 1e-9 s (rk4) to 2e-4 s (heun) with event_located".
  std::vector<std::string> ranges(std::optional<double> Errors::*error, const char* unit) const {
    struct Of {
      double size;
      std::string method;
      std::string text(const char* unit_of) const { return fmt::format("{}{} ({})", number(size), unit_of, method); }
    };
    std::vector<std::string> all;
    for (const std::string& timing : timings_) {
      std::optional<Of> least, most;
      for (const auto& [key, errors] : curves_) {
        const auto& found = errors.front().*error;
        if (std::get<3>(key) != timing || !found) continue;
        if (!least || *found < least->size) least = Of{*found, std::get<1>(key)};
        if (!most || *found > most->size) most = Of{*found, std::get<1>(key)};
      }
      if (least)
        all.push_back(fmt::format("by {} to {} with {}", least->text(unit), most->text(unit),
                                  timing.empty() ? "forces" : timing));
    }
    return all;
  }

  std::vector<std::string> answer() const {
    std::vector<std::string> all;
    if (const auto times = ranges(&Errors::time, " s"); !times.empty())
      all.push_back(fmt::format("At the smallest step the time of the first impact is wrong {}.", words(times)));
    if (const auto energies = ranges(&Errors::energy, ""); !energies.empty())
      all.push_back(fmt::format("The energy is wrong, over its size, {}.", words(energies)));
    return all;
  }

  std::vector<std::string> sentences() const {
    std::vector<std::string> all;
    for (const std::string& where : motions_) {
      for (const std::string& timing : timings_) {
        std::vector<std::string> times, energies;
        for (const auto& curve : curves_) {
          const Key& key = curve.first;
          if (std::get<0>(key) != where || std::get<3>(key) != timing || std::get<2>(key) != responses_.front())
            continue;
          const auto say = [&](std::vector<std::string>& said, std::optional<double> Errors::*error, double floor,
                               const char* unit) {
            const auto& at_smallest_step = curve.second.front().*error;
            if (!at_smallest_step) return;
            const auto p = order(curve.second, error, floor);
            said.push_back(fmt::format("{} {}{}{}", std::get<1>(key), number(*at_smallest_step), unit,
                                       p ? fmt::format(" (order {:.1f})", *p) : std::string()));
          };
          say(times, &Errors::time, time_floor, " s");
          say(energies, &Errors::energy, energy_floor, "");
        }
        if (times.empty() && energies.empty()) continue;
        std::string text = fmt::format("On {} with {}, at the smallest step", where, timing);
        if (!times.empty()) text += fmt::format(", the first impact is wrong by {}", words(times));
        if (!energies.empty())
          text += fmt::format("{} the energy by {} of it", times.empty() ? "," : "; and", words(energies));
        all.push_back(text + ".");
      }
      if (auto text = of_responses(where); !text.empty()) all.push_back(std::move(text));
      if (auto text = of_momenta(where); !text.empty()) all.push_back(std::move(text));
    }
    for (const std::string& failed : failed_) all.push_back("Not carried out: " + failed + ".");
    return all;
  }

  /// Sentence about the largest difference of the energy between responses.
  std::string of_responses(const std::string& where) const {
    if (responses_.size() < 2) return {};
    double apart = 0;
    std::string which;
    for (const auto& [key, errors] : curves_) {
      const auto& [there, method, response, timing] = key;
      const auto first = curves_.find({there, method, responses_.front(), timing});
      if (there != where || first == curves_.end() || first->second.size() != errors.size()) continue;
      for (std::size_t k = 0; k < errors.size(); ++k) {
        if (!errors[k].energy || !first->second[k].energy) continue;
        const double off = std::abs(*errors[k].energy - *first->second[k].energy);
        if (off > apart) apart = off, which = fmt::format("{} ({}, {})", response, method, timing);
      }
    }
    if (apart <= energy_floor)
      return fmt::format("On {} all responses give the same energy, to {} of it.", where, number(energy_floor));
    return fmt::format("On {} responses differ in the energy by {} of it at most: {} from {}.", where, number(apart),
                       which, responses_.front());
  }

  std::string of_momenta(const std::string& where) const {
    std::optional<double> linear, angular;
    const auto raise = [](std::optional<double>& worst, const std::optional<double>& now) {
      if (now && !(worst && *worst >= *now)) worst = now;
    };
    for (const auto& [key, errors] : curves_) {
      for (const Errors& e : errors) {
        if (std::get<0>(key) == where) raise(linear, e.linear), raise(angular, e.angular);
      }
    }
    if (!linear && !angular) return {};
    return fmt::format(
        "On {} the momentum is off by at most {}, and the angular momentum by {}, by whatever method, timing and "
        "response.",
        where, linear ? number(*linear) : "—", angular ? number(*angular) : "—");
  }

  Table table() const {
    Table table{.caption = "Errors of impacts at the smallest step, and the order at which they fall",
                .columns = {{"method", "", Column::Kind::name},
                            {.header = "motion", .kind = Column::Kind::text, .apart = true},
                            {"timing", "", Column::Kind::text},
                            {"response", "", Column::Kind::text},
                            {"smallest step", "s"},
                            {.header = "time", .unit = "s", .best = Column::Best::least},
                            {"order"},
                            {.header = "energy", .best = Column::Best::least},
                            {"order of it"},
                            {.header = "momentum", .best = Column::Best::least},
                            {.header = "angular momentum", .best = Column::Best::least}},
                .rows = {}};
    for (const auto& [key, errors] : curves_) {
      const auto& [where, method, response, timing] = key;
      const Errors& e = errors.front();
      table.rows.push_back({method, where, timing, response, study::rounded(e.step), cell(e.time),
                            order_text(order(errors, &Errors::time, time_floor)), cell(e.energy),
                            order_text(order(errors, &Errors::energy, energy_floor)), cell(e.linear), cell(e.angular)});
    }
    return without_empty_columns(std::move(table));
  }

  std::string csv() const {
    std::string text =
        csv_row({"run", "motion", "integrator", "response", "impact_timing", "dt_s", "tolerance", "event_time_error_s",
                 "energy_error_rel", "linear_momentum_error_rel", "angular_momentum_error_rel"});
    for (const auto& [key, errors] : curves_) {
      const auto& [where, method, response, timing] = key;
      for (const Errors& e : errors) {
        const RunConfig& c = e.run->config;
        text += csv_row({e.run->id, where, method, response, timing, csv_cell(c.dt), csv_cell(c.tolerance),
                         csv_cell(e.time), csv_cell(e.energy), csv_cell(e.linear), csv_cell(e.angular)});
      }
    }
    return text;
  }

  /// One panel for each motion and, if responses differ, for each response.
  Figure figure(const std::string& name, const std::string& title, const std::string& caption, const PlainAxis& axis,
                std::optional<double> Errors::*error) const {
    std::vector<Panel> panels;
    for (const std::string& where : motions_) {
      std::vector<PlainCurve> before;
      for (const std::string& response : responses_) {
        std::vector<PlainCurve> curves;
        for (const auto& [key, errors] : curves_) {
          const auto& [there, method, answer, timing] = key;
          if (there != where || answer != response || !errors.front().run->config.dt) continue;
          PlainCurve curve{fmt::format("{}, {}", method, timing), place(methods_, method), place(timings_, timing)};
          for (const Errors& e : errors) {
            if (e.*error) curve.points.emplace_back(e.step, *(e.*error));
          }
          curves.push_back(std::move(curve));
        }
        if (!before.empty() && same(before, curves)) continue;
        panels.push_back(plain_panel(responses_.size() > 1 ? where + ", " + response : where,
                                     {"dt_s", "step h = dt (s)"}, axis, curves));
        before = std::move(curves);
      }
    }
    return plain_figure(
        name, title,
        caption +
            " Colours are methods, dashes timings. A response that gives the same as the one before has no "
            "panel of its own.",
        methods_, timings_, std::move(panels));
  }

  /// True if the curves differ by at most a hundredth, which is invisible.
  static bool same(const std::vector<PlainCurve>& a, const std::vector<PlainCurve>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const PlainCurve& p, const PlainCurve& q) {
      return std::equal(p.points.begin(), p.points.end(), q.points.begin(), q.points.end(),
                        [](const auto& u, const auto& v) {
                          return u.first == v.first &&
                                 std::abs(u.second - v.second) <= 0.01 * std::max(u.second, v.second) + time_floor;
                        });
    });
  }
  static std::size_t place(const std::vector<std::string>& all, const std::string& one) {
    return std::size_t(std::find(all.begin(), all.end(), one) - all.begin());
  }

  std::map<std::string, std::optional<double>> exact_;  ///< time of the first impact by motion, s
  std::map<Key, std::vector<Errors>> curves_;           ///< smallest step first
  std::vector<std::string> motions_, methods_, responses_, timings_, failed_;
};

}  // namespace

std::vector<RunConfig> exact_impacts(const StudyView& study) {
  std::vector<RunConfig> wanted;
  for (const RunRecord& run : study.runs) {
    if (run.config.contact) wanted.push_back(first_impact_reference(run));
  }
  return wanted;
}

Analysis errors_of_impacts(const StudyView& study) { return Impacts(study).analysis(); }

}  // namespace polhode::study::impact
