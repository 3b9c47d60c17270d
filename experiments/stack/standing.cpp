// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/stack/standing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "experiments/study/plot/plain_panel.hpp"
#include "experiments/study/text/csv.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::stack {
namespace {

/// Largest displacement since t = 2 s of a box of 1 m at rest, and largest penetration depth of such boxes that have
/// not sunk in, m.
constexpr double still = 1e-3, shallow = 5e-3;

struct Stack {
  const RunRecord* run;
  std::size_t boxes;
  const ContactMeasures& found() const { return run->result.contact; }
  bool carried_out() const { return run->result.status == "ok"; }
  /// Time at which the first box left its place, s; the duration of the run if none did.
  double stood() const { return found().left_place.value_or(run->result.t_reached); }
};

/// Key of a curve, whose runs differ in the height of the stack.
using Key =
    std::tuple<std::string, std::string, std::string, std::string, double>;  // scenario, method, response, timing, size
Key key_of(const RunConfig& c) {
  return {c.scenario, c.integrator, c.contact->response, c.contact->impact_timing, c.dt ? *c.dt : *c.tolerance};
}

/// The analysis:
/// 1. Curves: completed runs by key, smallest stack first; other runs with the reason.
/// 2. The responses, steps and other parts of the key that occur, for the names of curves.
/// 3. analysis(): sentences, table, standing.csv, figure.
class Standing {
 public:
  explicit Standing(const StudyView& study) {
    for (const RunRecord& run : study.runs) {
      if (!run.config.contact) continue;
      const Stack stack{&run, run.scenario->problem.moving()};
      if (!stack.carried_out()) {
        failed_.push_back(fmt::format("{}: {}", label(key_of(run.config)), run.result.message));
        continue;
      }
      curves_[key_of(run.config)].push_back(stack);
    }
    for (auto& [key, stacks] : curves_) {
      std::stable_sort(stacks.begin(), stacks.end(), [](const Stack& a, const Stack& b) { return a.boxes < b.boxes; });
      remember(responses_, std::get<2>(key));
      remember(steps_, step(key));
      several_timings_ = several_timings_ || std::get<3>(key) != std::get<3>(curves_.begin()->first);
      several_methods_ = several_methods_ || std::get<1>(key) != std::get<1>(curves_.begin()->first);
      several_scenarios_ = several_scenarios_ || std::get<0>(key) != std::get<0>(curves_.begin()->first);
    }
  }

  Analysis analysis() const {
    Analysis found{.alone = true, .heading = "How stacks stand"};
    found.answer.sentences = answer();
    found.sentences = sentences();
    found.method = {fmt::format(
        "A stack stands until the centre of a box is further than a tenth of the box’s radius (half its diagonal) from "
        "where it "
        "started. A stack is called still where no centre moves by more than {} mm after 2 s. Depths are looked at at "
        "100 "
        "instants and at the end; the energy’s rise is that of kinetic and potential energy above an earlier value.",
        number(1000 * still))};
    if (curves_.empty()) return found;
    found.tables.push_back({"standing", table()});
    found.files.push_back({"standing.csv", csv()});
    found.figures.push_back(figure());
    return found;
  }

 private:
  static void remember(std::vector<std::string>& all, const std::string& one) {
    if (std::find(all.begin(), all.end(), one) == all.end()) all.push_back(one);
  }
  static std::size_t place(const std::vector<std::string>& all, const std::string& one) {
    return std::size_t(std::find(all.begin(), all.end(), one) - all.begin());
  }
  static std::string step(const Key& key) { return fmt::format("h = {} s", number(std::get<4>(key))); }

  std::string label(const Key& key) const {
    const auto& [scenario, method, response, timing, size] = key;
    std::string text = response;
    if (several_methods_) text += ", " + method;
    if (several_timings_) text += ", " + timing;
    if (several_scenarios_) text += ", " + scenario;
    return fmt::format("{}, {}", text, step(key));
  }

  /// The highest stack that stands to the end, below which all stand too; 0: none.
  static std::size_t highest_standing(const std::vector<Stack>& stacks) {
    std::size_t highest = 0;
    for (const Stack& s : stacks) {
      if (s.found().left_place) break;
      highest = s.boxes;
    }
    return highest;
  }

  std::vector<std::string> answer() const {
    struct Best {
      std::string response;
      std::size_t boxes = 0, tried = 0;
      std::string step;
    };
    std::vector<Best> all;
    for (const std::string& response : responses_) {
      Best best{response, 0, 0, {}};
      for (const auto& [key, stacks] : curves_) {
        if (std::get<2>(key) != response) continue;
        best.tried = std::max(best.tried, stacks.back().boxes);
        if (const std::size_t boxes = highest_standing(stacks); boxes > best.boxes)
          best.boxes = boxes, best.step = step(key);
      }
      all.push_back(best);
    }
    std::stable_sort(all.begin(), all.end(), [](const Best& a, const Best& b) { return a.boxes > b.boxes; });
    if (all.empty()) return {"No stack was carried out to its end."};
    std::vector<std::string> parts;
    for (const Best& b : all) {
      if (b.boxes == 0) parts.push_back(fmt::format("{} none", b.response));
      else
        parts.push_back(fmt::format("{} up to {} boxes ({}{})", b.response, b.boxes, b.step,
                                    b.boxes == b.tried ? ", the highest that was tried" : ""));
    }
    return {fmt::format("Stacks stand to the end with {}.", words(parts))};
  }

  std::vector<std::string> sentences() const {
    std::vector<std::string> all;
    for (const auto& [key, stacks] : curves_) {
      std::size_t stands = 0, count = 0, still_ones = 0;
      bool standing = true;
      const Stack* first_fallen = nullptr;
      double deepest = 0;
      for (const Stack& s : stacks) {
        standing = standing && !s.found().left_place;
        if (standing) {
          stands = s.boxes;
          deepest = std::max(deepest, s.found().penetration_end.value_or(0));
          ++count;
          if (s.found().displacement_max.value_or(0) <= still) ++still_ones;
        }
        if (!standing && !first_fallen) first_fallen = &s;
      }
      std::string text = fmt::format("{}: ", label(key));
      if (stands == 0) {
        text += "no stack stands to the end";
      } else {
        text += fmt::format(
            "stacks of up to {} stand to the end, {} still, with boxes at most {} mm in each other there{}", stands,
            still_ones == count ? "all" : fmt::format("{} of {}", still_ones, count), number(1000 * deepest),
            deepest > shallow ? fmt::format(", more than {} mm", number(1000 * shallow)) : "");
      }
      if (first_fallen) {
        text +=
            fmt::format("; that of {} leaves its place after {} s", first_fallen->boxes, number(first_fallen->stood()));
      }
      all.push_back(text + ".");
    }
    for (const std::string& failed : failed_) all.push_back("Not carried out: " + failed + ".");
    return all;
  }

  Table table() const {
    Table table{.caption = "Stacks of boxes: how long they stand, what moves and sinks, and the energy",
                .columns = {{"response and step", "", Column::Kind::name},
                            {.header = "boxes", .apart = true, .key = true},
                            {.header = "stands", .unit = "s", .best = Column::Best::greatest},
                            {.header = "moved after 2 s", .unit = "m", .best = Column::Best::least},
                            {.header = "deepest", .unit = "m", .best = Column::Best::least},
                            {.header = "depth at the end", .unit = "m", .best = Column::Best::least},
                            {.header = "energy rises by", .unit = "J", .best = Column::Best::least},
                            {"put in by undoing depth", "J"}},
                .rows = {}};
    const auto cell = [](const std::optional<double>& x) { return x ? number(*x) : std::string(); };
    for (const auto& [key, stacks] : curves_) {
      for (const Stack& s : stacks) {
        const ContactMeasures& c = s.found();
        table.rows.push_back({label(key), std::to_string(s.boxes), (c.left_place ? "" : "≥ ") + number(s.stood()),
                              cell(c.displacement_max), cell(c.penetration_max), cell(c.penetration_end),
                              cell(c.energy_rise_max), cell(c.penetration_energy)});
      }
    }
    return table;
  }

  std::string csv() const {
    std::string text = csv_row({"run", "scenario", "integrator", "response", "impact_timing", "step_s_or_tolerance",
                                "boxes", "left_place_s", "displacement_after_2s_max_m", "penetration_max_m",
                                "penetration_end_m", "energy_rise_max_J"});
    for (const auto& [key, stacks] : curves_) {
      const auto& [scenario, method, response, timing, size] = key;
      for (const Stack& s : stacks) {
        const ContactMeasures& c = s.found();
        text += csv_row({s.run->id, scenario, method, response, timing, exact(size), std::to_string(s.boxes),
                         csv_cell(c.left_place), csv_cell(c.displacement_max), csv_cell(c.penetration_max),
                         csv_cell(c.penetration_end), csv_cell(c.energy_rise_max)});
      }
    }
    return text;
  }

  Figure figure() const {
    struct Shown {
      const char* title;
      PlainAxis axis;
      std::optional<double> (*of)(const Stack&);
    };
    const Shown all[] = {{"How long it stands",
                          {"stands_s", "stands until (s)", Scale::linear},
                          [](const Stack& s) { return std::optional(s.stood()); }},
                         {"How far a centre moves after 2 s",
                          {"displacement_after_2s_max_m", "displacement (m)"},
                          [](const Stack& s) { return s.found().displacement_max; }},
                         {"How deep boxes are in each other at the end",
                          {"penetration_end_m", "depth (m)"},
                          [](const Stack& s) { return s.found().penetration_end; }},
                         {"How far the energy rises", {"energy_rise_max_J", "energy rise (J)"}, [](const Stack& s) {
                            return s.found().energy_rise_max;
                          }}};
    std::vector<Panel> panels;
    for (const Shown& shown : all) {
      std::vector<PlainCurve> curves;
      for (const auto& [key, stacks] : curves_) {
        PlainCurve curve{label(key), place(responses_, std::get<2>(key)), place(steps_, step(key))};
        for (const Stack& s : stacks) {
          if (const auto y = shown.of(s)) curve.points.emplace_back(double(s.boxes), *y);
        }
        curves.push_back(std::move(curve));
      }
      panels.push_back(plain_panel(shown.title, {"boxes", "boxes"}, shown.axis, curves));
    }
    return plain_figure(
        "stacks", "Stacks against their height",
        "Each stack once for each response (colour) and step (dashes). A stack that stands at the end of the run "
        "is drawn there.",
        responses_, steps_, std::move(panels));
  }

  std::map<Key, std::vector<Stack>> curves_;
  std::vector<std::string> responses_, steps_, failed_;
  bool several_methods_ = false, several_timings_ = false, several_scenarios_ = false;
};

}  // namespace

Analysis how_stacks_stand(const StudyView& study) { return Standing(study).analysis(); }

}  // namespace polhode::study::stack
