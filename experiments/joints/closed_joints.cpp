// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/joints/closed_joints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/system/joint_projection.hpp"
#include "core/system/joint_reactions.hpp"
#include "experiments/study/curves/curves.hpp"
#include "experiments/study/plot/plain_panel.hpp"
#include "experiments/study/text/csv.hpp"
#include "experiments/study/text/notation.hpp"
#include "integrators/catalogue.hpp"

namespace polhode::study::joints {
namespace {

constexpr double closed = 1e-12;         // largest opening of a joint that is closed to round-off, m
constexpr double right_reaction = 1e-3;  // error of a reaction, over the largest force at the start

/// The largest force at the start, N: of a joint, or of all forces on a body.
double force_at_start(const Scenario& scenario) {
  const auto system = make_system<double>(scenario.problem, {});
  const State<double> start = system->start();
  std::vector<Wrench<double>> wrenches(scenario.problem.bodies.size());
  const auto motions = motions_of(*system, start.y);
  for (const auto& force : system->forces()) force->add_wrench(0, motions, wrenches);
  double largest = 0;
  for (const Wrench<double>& w : wrenches) largest = std::max(largest, w.force.norm());
  for (const Wrench<double>& w : joint_reactions(*system, 0.0, start.y)) largest = std::max(largest, w.force.norm());
  return largest;
}

const JointMeasures& found(const RunRecord& run) { return run.result.joints; }
double evaluations(const RunRecord& run) { return static_cast<double>(run.result.evaluations); }

/// Energy that the joints and projection have put in, J.
std::optional<double> put_in(const RunRecord& run) {
  const JointMeasures& j = found(run);
  if (!j.work && !j.projection) return {};
  return j.work.value_or(0) + j.projection.value_or(0);
}

/// The analysis:
/// 1. Curves: runs of jointed scenarios that differ only in the step or the tolerance.
/// 2. cheapest(): the least number of right-hand sides with which the reactions of a curve are right.
/// 3. analysis(): sentences, the table of the finest run of each curve, joints.csv with all runs, two figures.
class HeldJoints {
 public:
  explicit HeldJoints(const StudyView& study) : grouping_(group(study)) {
    for (const Curve& curve : grouping_.curves) {
      if (curve.runs.front()->config.joints) curves_.push_back(&curve);
    }
  }

  Analysis analysis() const {
    Analysis a{.alone = true, .heading = "How joints hold"};
    if (curves_.empty()) {
      a.answer.sentences = {"No scenario has joints."};
      return a;
    }
    a.answer.sentences = {openings(), reactions()};
    a.sentences = failures();
    a.method = {
        "Joints are looked at at 1000 instants of a run, velocities and reactions at 50 of these, against the exact "
        "motion or a proven reference. A method with multipliers of its own is judged by these; the reactions of any "
        "other are those that follow from its states. The table has the run of each method with the smallest step or "
        "tolerance; joints.csv has all.",
        fmt::format(
            "Reactions are called right where no force of a joint is off by more than {} of the largest force at the "
            "start, of a joint or on a body. Energy put in: the work of the joints, which is not zero where G v is "
            "not, and what "
            "projection adds.",
            number(right_reaction))};
    a.tables.push_back({"joints", table()});
    a.files.push_back({"joints.csv", csv()});
    a.figures.push_back(figure("joint_reactions", "Error of the forces of joints against right-hand sides",
                               {"joint_reaction_error_max_N", "error of a force (N)"},
                               [](const RunRecord& run) { return found(run).reaction_error_max; }));
    a.figures.push_back(figure("joint_positions", "Error of the position against right-hand sides",
                               {"position_error_max_m", "position error (m)"},
                               [](const RunRecord& run) { return run.result.position_error_max; }));
    return a;
  }

 private:
  /// "rattle", "rk4 (both)", "rk4 (matrix, both)".
  std::string label(const Curve& curve) const {
    const std::string& method = grouping_.methods[curve.method_index];
    const bool solves_joints = find_integrator(method)->declaration.solves_joints();
    std::string details = grouping_.variants[curve.variant_index];
    const std::string key = "stabilization ";
    if (const std::size_t at = details.find(key); at != std::string::npos) {
      const std::size_t end = std::min(details.find(',', at), details.size());
      if (!solves_joints) details.erase(at, key.size());
      else if (at == 0) details.erase(0, std::min(end + 2, details.size()));
      else details.erase(at - 2, end - (at - 2));
    }
    return details.empty() ? method : fmt::format("{} ({})", method, details);
  }
  const std::string& scenario(const Curve& curve) const { return grouping_.cases[curve.case_index].scenario; }

  /// The completed run with the smallest step or tolerance; null: none.
  static const RunRecord* finest(const Curve& curve) {
    const auto run = std::find_if(curve.runs.rbegin(), curve.runs.rend(), [](const auto* r) { return completed(*r); });
    return run == curve.runs.rend() ? nullptr : *run;
  }

  std::string openings() const {
    std::map<std::string, double> widest;  // widest opening for each label, at the smallest step or tolerance
    for (const Curve* curve : curves_) {
      const RunRecord* run = finest(*curve);
      if (!run || !found(*run).gap_max) continue;
      double& worst = widest[label(*curve)];
      worst = std::max(worst, *found(*run).gap_max);
    }
    if (widest.empty()) return "No run was carried out to its end.";
    std::vector<std::string> tight;
    for (const auto& [name, gap] : widest) {
      if (gap < closed) tight.push_back(name);
    }
    const auto by_gap = [](const auto& a, const auto& b) { return a.second < b.second; };
    const auto most = std::max_element(widest.begin(), widest.end(), by_gap);
    const std::string opened = fmt::format("{} lets them open most, by {} m", most->first, number(most->second));
    if (tight.empty()) return fmt::format("No method closes all joints to {} m; {}.", number(closed), opened);
    if (tight.size() == widest.size()) return fmt::format("Every method closes the joints to {} m.", number(closed));
    return fmt::format("Joints stay closed to {} m with {}; {}.", number(closed), words(tight), opened);
  }

  /// The run of the curve with right reactions and the fewest right-hand sides; null: none.
  static const RunRecord* cheapest(const Curve& curve) {
    const double limit = right_reaction * force_at_start(*curve.runs.front()->scenario);
    const RunRecord* best = nullptr;
    for (const RunRecord* run : curve.runs) {
      const auto error = found(*run).reaction_error_max;
      if (!completed(*run) || !error || !(*error <= limit)) continue;
      if (!best || evaluations(*run) < evaluations(*best)) best = run;
    }
    return best;
  }

  std::string reactions() const {
    struct Best {
      std::string name;
      const RunRecord* run = nullptr;
    };
    std::vector<std::pair<std::string, Best>> all;  // best runs by case, in their order
    for (const Curve* curve : curves_) {
      const std::string place = grouping_.cases[curve->case_index].label();
      auto at = std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.first == place; });
      if (at == all.end()) at = all.insert(all.end(), {place, {}});
      const RunRecord* run = cheapest(*curve);
      if (!run || (at->second.run && evaluations(*at->second.run) <= evaluations(*run))) continue;
      at->second = {label(*curve), run};
    }
    std::vector<std::string> parts;
    for (const auto& [place, best] : all) {
      if (!best.run) parts.push_back("no method on " + place);
      else
        parts.push_back(fmt::format("{} on {} ({} right-hand sides)", best.name, place, best.run->result.evaluations));
    }
    return fmt::format("Forces of joints right to {} of the largest force at the start cost least with {}.",
                       number(right_reaction), words(parts));
  }

  std::vector<std::string> failures() const {
    std::vector<std::string> all;
    for (const Curve* curve : curves_) {
      for (const RunRecord* run : curve->runs) {
        if (completed(*run) || run->result.status == "refused") continue;
        all.push_back(
            fmt::format("{} on {} at {}: {}.", label(*curve), scenario(*curve), step_label(*run), run->result.message));
      }
    }
    return all;
  }

  Table table() const {
    Table table{.caption = "Joints: how far they open, and the errors of motion and reactions",
                .columns = {{"scenario", "", Column::Kind::name},
                            {"method", "", Column::Kind::name},
                            {.header = "at", .apart = true, .key = true},
                            {.header = "right-hand sides"},
                            {.header = "joints open by", .unit = "m", .best = Column::Best::least},
                            {.header = "part at", .unit = "m/s", .best = Column::Best::least},
                            {.header = "position off by", .unit = "m", .best = Column::Best::least},
                            {.header = "velocity off by", .unit = "m/s", .best = Column::Best::least},
                            {.header = "force off by", .unit = "N", .best = Column::Best::least},
                            {"put in", "J"}},
                .rows = {}};
    const auto cell = [](const std::optional<double>& x) { return x ? number(*x) : std::string(); };
    for (const Curve* curve : curves_) {
      const RunRecord* run = finest(*curve);
      if (!run) continue;
      const JointMeasures& j = found(*run);
      table.rows.push_back({grouping_.cases[curve->case_index].label(), label(*curve), step_label(*run),
                            std::to_string(run->result.evaluations), cell(j.gap_max), cell(j.velocity_max),
                            cell(run->result.position_error_max), cell(j.speed_error_max), cell(j.reaction_error_max),
                            cell(put_in(*run))});
    }
    return table;
  }

  std::string csv() const {
    std::string text = csv_row({"run", "scenario", "integrator", "stabilization", "step_s_or_tolerance", "status",
                                "evaluations", "joint_gap_max_m", "joint_velocity_max_m_per_s", "position_error_max_m",
                                "velocity_error_max_m_per_s", "joint_reaction_error_max_N", "put_in_J"});
    for (const Curve* curve : curves_) {
      for (const RunRecord* run : curve->runs) {
        const RunConfig& c = run->config;
        const JointMeasures& j = found(*run);
        const std::string size = c.dt ? exact(*c.dt) : c.tolerance ? exact(*c.tolerance) : std::string();
        text += csv_row({run->id, c.scenario, c.integrator, std::string(name(c.joints->stabilization)), size,
                         run->result.status, std::to_string(run->result.evaluations), csv_cell(j.gap_max),
                         csv_cell(j.velocity_max), csv_cell(run->result.position_error_max),
                         csv_cell(j.speed_error_max), csv_cell(j.reaction_error_max), csv_cell(put_in(*run))});
      }
    }
    return text;
  }

  template <class Value>
  Figure figure(std::string file, std::string title, const PlainAxis& axis, const Value& value) const {
    std::vector<Panel> panels;
    for (std::size_t k = 0; k < grouping_.cases.size(); ++k) {
      std::vector<PlainCurve> plain;
      for (const Curve* curve : curves_) {
        if (curve->case_index != k) continue;
        PlainCurve one{label(*curve), curve->method_index, curve->variant_index};
        for (const RunRecord* run : curve->runs) {
          const auto y = completed(*run) ? value(*run) : std::nullopt;
          if (y && run->result.evaluations > 0) one.points.emplace_back(evaluations(*run), *y);
        }
        std::sort(one.points.begin(), one.points.end());
        plain.push_back(std::move(one));
      }
      panels.push_back(plain_panel(grouping_.cases[k].label(), {"evaluations", "right-hand sides"}, axis, plain));
    }
    return plain_figure(std::move(file), std::move(title), "Each method at several steps or tolerances.",
                        grouping_.methods, grouping_.variants, std::move(panels));
  }

  Grouping grouping_;
  std::vector<const Curve*> curves_;
};

}  // namespace

Analysis how_joints_hold(const StudyView& study) { return HeldJoints(study).analysis(); }

}  // namespace polhode::study::joints
