// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/certificate/step_traits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>

#include "experiments/certificate/order_finding.hpp"
#include "experiments/certificate/symplecticity.hpp"
#include "experiments/study/text/notation.hpp"

namespace polhode::study::certificate {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The worst of the findings measure(test_case) over the test cases for which select(test_case) is true.
template <class Select, class Measure>
Finding over_test_cases(const std::string& trait, const Subject& subject, std::span<const TestCase> test_cases,
                        const std::string& none, const Select& select, const Measure& measure) {
  std::vector<Finding> findings;
  std::string refused;
  for (const TestCase& test_case : test_cases) {
    if (!select(test_case)) continue;
    if (const std::string reason = test_case.refusal(subject); !reason.empty()) {
      refused = test_case.name + ": " + reason;
      findings.push_back(not_applicable(trait, refused));
      continue;
    }
    findings.push_back(measure(test_case));
    findings.back().on = test_case.name;
  }
  return findings.empty() ? not_applicable(trait, none) : worst(findings);
}

Finding failed(const std::string& trait, const std::string& why) {
  Finding finding = not_applicable(trait, "a step failed: " + why);
  finding.verdict = TraitVerdict::undecided;
  return finding;
}

IntegratorSettings settings(const Course& course) {
  return {.dt = course.step, .tolerance = course.tolerance, .t_end = course.t_end};
}

constexpr double start_time = 0.3;  // time at which no component of the time-dependent force is 0 or an extremum, s

/// Largest change of a component, over 1 + the largest magnitude of a component of `before`.
double change(const VectorX<double>& now, const VectorX<double>& before) {
  const double away = (now - before).cwiseAbs().maxCoeff() / (1 + before.cwiseAbs().maxCoeff());
  return std::isfinite(away) ? away : infinity;
}

/// Text of the power of h that the defects above a floor follow; empty if they do not follow one.
std::string power_of(std::span<const LadderPoint> defects, double floor) {
  std::vector<LadderPoint> points(defects.begin(), defects.end());
  for (LadderPoint& p : points) p.round_off = floor;
  OrderSettings wide;
  wide.straightness = 0.3;
  const auto estimate = estimate_order(points, wide);
  return estimate.line ? fmt::format("falls as h^{:.1f}", estimate.line->order) : std::string();
}

template <class S>
Finding symplecticity_on(const Subject& subject, const TestCase& test_case, double largest) {
  const std::string trait = "symplecticity";
  const auto system = test_case.system<S>(subject.formulation);
  const PhaseSpace<S> space(*system);
  std::vector<LadderPoint> defects;
  double most = 0;
  for (const double h : {largest, largest / 2, largest / 4, largest / 8}) {
    const auto integrator =
        subject.entry.maker<S>()(*system, {.dt = h, .tolerance = Course().tolerance, .t_end = start_time});
    std::string failure;
    const FlatMap<S> map = [&](VectorX<S>& y) {
      State<S> state{0, y};
      integrator->begin(state);
      const StepResult result = integrator->step(state, h);
      failure = result.failure;
      y = state.y;
      return result.ok();
    };
    // Truncation and round-off of the derivative increase the defect, so that the smaller of two is the better one.
    double least = infinity;
    for (const double part : {1.0, 0.25}) {
      const auto defect = symplecticity_defect<S>(space, map, space.generic(), best_increment<S> * part);
      if (!defect) return failed(trait, failure.empty() ? "no finite numbers" : failure);
      least = std::min(least, *defect);
    }
    most = std::max(most, least);
    defects.push_back({.step = h, .error = least, .round_off = 0});
  }
  const double floor = differentiation_floor<S>;
  Finding finding = kept(trait, subject.declaration().symplectic, most, floor, test_case.name);
  finding.measured = defects.front().error;
  finding.note = power_of(defects, floor);
  return finding;
}

double casimir_of(const System<double>& system, const VectorX<double>& y, std::size_t body) {
  const BodySnapshot<double> now = system.snapshot(y, body);
  return (system.problem().bodies[body].inertia * (now.rotation.transpose() * now.angular_velocity)).norm();
}

/// Advances the state to t_end and calls on_state(state) after every ten steps, until it returns false. Returns the
/// reason for which a step failed; empty: none did.
template <class OnState>
std::string follow(const Subject& subject, Integrator<double>& integrator, State<double>& state, const Course& course,
                   const OnState& on_state) {
  constexpr std::int64_t stride = 10;
  const bool adaptive = subject.declaration().adaptive;
  const auto strides = static_cast<std::int64_t>(std::ceil(course.t_end / course.step / stride * (1 - 1e-12)));
  for (std::int64_t k = 0; adaptive ? state.t < course.t_end : k < strides; ++k) {
    const StepResult result =
        adaptive ? integrator.step(state, course.t_end - state.t)
                 : integrator.advance(state, StepBatch{.h = course.step, .count = stride, .first = k * stride});
    if (!result.ok()) return result.failure;
    if (!on_state(state)) return "";
  }
  return "";
}

/// A force of zero that counts its evaluations.
class Asked final : public ForceModel<double> {
 public:
  explicit Asked(std::int64_t& count) : count_(count) {}
  void add_wrench(double, std::span<const BodyMotion<double>>, std::span<Wrench<double>>) const override { ++count_; }
  Effect effect_on(std::size_t) const override { return {}; }

 private:
  std::int64_t& count_;
};

}  // namespace

Finding time_reversibility(const Subject& subject, std::span<const TestCase> test_cases, double h, int steps) {
  const std::string trait = steps == 1 ? "time_reversibility" : "time_reversibility_many";
  if (subject.declaration().adaptive) {
    return not_applicable(trait, "it chooses its steps: the way back has other ones than the way there");
  }
  const double limit = steps == 1 ? return_limit : many_return_limit;
  return over_test_cases(
      trait, subject, test_cases, "no motion to measure it on", [](const TestCase&) { return true; },
      [&](const TestCase& test_case) {
        const auto system = test_case.system<double>(subject.formulation);
        const PhaseSpace<double> space(*system);
        State<double> state{start_time, space.state(space.generic())};
        const VectorX<double> before = state.y;
        const auto integrator = subject.entry.make(*system, {.dt = h});
        integrator->begin(state);
        for (const double step : {h, -h}) {
          for (int k = 0; k < steps; ++k) {
            const double from = step > 0 ? start_time + k * h : start_time + (steps - k) * h;
            state.t = from;
            if (const StepResult result = integrator->step(state, step); !result.ok()) {
              return failed(trait, result.failure);
            }
          }
        }
        return kept(trait, subject.declaration().symmetric, change(state.y, before), limit, test_case.name);
      });
}

Finding symplecticity(const Subject& subject, std::span<const TestCase> test_cases, double h) {
  const std::string trait = "symplecticity";
  if (subject.declaration().adaptive) {
    return not_applicable(trait, "it chooses its steps, which is no smooth map of the state");
  }
  if (subject.declaration().multi_step) {
    return not_applicable(trait, "its step depends on those before it, which is no map of the state");
  }
  return over_test_cases(
      trait, subject, test_cases, "no motion without forces, or with a potential of all of them",
      [](const TestCase& test_case) { return test_case.free || test_case.conservative; },
      [&](const TestCase& test_case) {
        return subject.entry.make_long_double ? symplecticity_on<long double>(subject, test_case, h)
                                              : symplecticity_on<double>(subject, test_case, h);
      });
}

Finding casimir(const Subject& subject, std::span<const TestCase> test_cases, const Course& course) {
  const std::string trait = "casimir";
  const Declaration& d = subject.declaration();
  // |IΩ|² is a quadratic invariant of Euler's equations.
  const bool declared = d.conserves_casimir ||
                        (d.conserves_quadratics && subject.formulation.angular_state == AngularState::velocity_body);
  return over_test_cases(
      trait, subject, test_cases, "no body without forces", [](const TestCase& test_case) { return test_case.free; },
      [&](const TestCase& test_case) {
        const auto system = test_case.system<double>(subject.formulation);
        State<double> state = system->start();
        const auto integrator = subject.entry.make(*system, settings(course));
        integrator->begin(state);
        std::vector<double> start;
        for (std::size_t i = 0; i < system->moving(); ++i) start.push_back(casimir_of(*system, state.y, i));
        double most = 0;
        const std::string failure = follow(subject, *integrator, state, course, [&](const State<double>& now) {
          for (std::size_t i = 0; i < start.size(); ++i) {
            const double drift = std::abs(casimir_of(*system, now.y, i) - start[i]) / (start[i] > 0 ? start[i] : 1);
            most = std::isfinite(drift) ? std::max(most, drift) : infinity;
          }
          return std::isfinite(most);
        });
        if (!failure.empty() && !(most > kept_limit)) return failed(trait, failure);
        return kept(trait, declared, most, kept_limit, test_case.name);
      });
}

ShakenMotions::ShakenMotions(std::span<const TestCase> test_cases) {
  for (const TestCase& test_case : test_cases) {
    if (!test_case.shaken) continue;
    motions_.push_back(
        {&test_case, std::make_shared<ReferenceMotion>(test_case.problem, true, 1.0, nullptr,
                                                       [](System<long double>& system) { shake(system); })});
  }
}

namespace {

/// The largest error at eight instants of one second. size: step (s) or tolerance.
LadderPoint shaken_error(const Subject& subject, const System<double>& system,
                         const std::shared_ptr<const ReferenceMotion>& reference, double size) {
  constexpr std::int64_t instants = 8;
  const bool adaptive = subject.declaration().adaptive;
  const auto steps =
      static_cast<std::int64_t>(std::ceil(1 / size / instants * (1 - 1e-12)));  // number of steps between two instants
  const double h = 1 / static_cast<double>(instants * steps);
  const auto integrator = subject.entry.make(system, {.dt = h, .tolerance = adaptive ? size : 0, .t_end = 1});
  State<double> state = system.start();
  integrator->begin(state);
  ReferenceMotion::Follower follower(reference);
  double worst = 0;
  std::int64_t taken = 0;
  for (std::int64_t k = 1; k <= instants && std::isfinite(worst); ++k) {
    const double end = static_cast<double>(k) / instants;
    StepResult result;
    if (adaptive) {
      for (; state.t < end && result.ok(); ++taken) result = integrator->step(state, end - state.t);
    } else {
      result = integrator->advance(state, StepBatch{.h = h, .count = steps, .first = (k - 1) * steps});
      taken += steps;
    }
    state.t = end;
    if (!result.ok() || !state.y.allFinite()) {
      worst = infinity;
    } else {
      const auto e = follower.error(system, state);
      worst = std::max({worst, e.position.value_or(0), e.attitude.value_or(0), e.angular_velocity.value_or(0)});
    }
  }
  if (worst < 100 * reference->uncertainty().largest()) worst = 0;
  // Four times the level for a run of the study: forces and angular velocities have larger rounding errors than the
  // attitudes of free bodies.
  const double roundings = std::sqrt(static_cast<double>(std::max<std::int64_t>(taken, 1)));
  return {.step = adaptive ? size : h,
          .error = worst,
          .round_off = 64 * std::numeric_limits<double>::epsilon() * roundings};
}

}  // namespace

Finding ShakenMotions::order(const Subject& subject, std::span<const double> steps,
                             std::span<const double> tolerances) const {
  const std::string trait = "order_time_dependent";
  const bool adaptive = subject.declaration().adaptive;
  std::vector<Finding> findings;
  for (const auto& [test_case, reference] : motions_) {
    if (const std::string reason = test_case->refusal(subject); !reason.empty()) {
      findings.push_back(not_applicable(trait, test_case->name + ": " + reason));
      continue;
    }
    const auto system = test_case->system<double>(subject.formulation);
    std::vector<LadderPoint> ladder;
    for (const double size : adaptive ? tolerances : steps) {
      ladder.push_back(shaken_error(subject, *system, reference, size));
    }
    const int declared = subject.declaration().order;
    findings.push_back(order_finding(trait, adaptive, declared, std::move(ladder)));
    findings.back().on = test_case->name;
  }
  return findings.empty() ? not_applicable(trait, "no motion to shake") : worst(findings);
}

Finding evaluations_per_step(const Subject& subject, std::span<const TestCase> test_cases, const Course& course) {
  const std::string trait = "evaluations_per_step";
  const int declared = subject.declaration().evaluations_per_step;
  constexpr int warm_up = 10, steps = 40;
  const bool any_forced =
      std::any_of(test_cases.begin(), test_cases.end(), [](const TestCase& t) { return !t.free && !t.shaken; });
  return over_test_cases(
      trait, subject, test_cases, "no motion to measure it on",
      [&](const TestCase& test_case) { return !test_case.shaken && test_case.free != any_forced; },
      [&](const TestCase& test_case) {
        std::int64_t asked = 0;
        const auto system = test_case.system<double>(subject.formulation);
        system->add_force(std::make_unique<Asked>(asked));
        State<double> state = system->start();
        const auto integrator = subject.entry.make(*system, settings(course));
        integrator->begin(state);
        for (int k = 0; k < warm_up + steps; ++k) {
          if (k == warm_up) asked = 0;
          const double h = subject.declaration().adaptive ? course.t_end - state.t : course.step;
          if (const StepResult result = integrator->step(state, h); !result.ok()) return failed(trait, result.failure);
        }
        Finding finding = not_applicable(trait, "not constant, by its declaration");
        finding.measured = static_cast<double>(asked) / steps;
        finding.verdict = TraitVerdict::absent;
        if (declared > 0) {
          finding.declared = std::to_string(declared);
          finding.verdict = *finding.measured == declared ? TraitVerdict::holds : TraitVerdict::does_not_hold;
          finding.note.clear();
        }
        return finding;
      });
}

double nanoseconds_per_step(const Subject& subject, std::span<const TestCase> test_cases, const Course& course) {
  using Clock = std::chrono::steady_clock;
  constexpr int repeats = 5;
  constexpr double long_enough = 1e-3;  // shortest time of a batch of steps, s
  const auto test_case =
      std::find_if(test_cases.begin(), test_cases.end(), [&](const TestCase& t) { return t.refusal(subject).empty(); });
  if (test_case == test_cases.end()) return std::numeric_limits<double>::quiet_NaN();
  const auto system = test_case->system<double>(subject.formulation);
  double least = infinity;
  std::int64_t steps = 50;
  for (int k = 0; k < repeats;) {
    const auto integrator = subject.entry.make(*system, settings(course));
    State<double> state = system->start();
    integrator->begin(state);
    std::int64_t taken = 0;
    const auto begin = Clock::now();
    if (subject.declaration().adaptive) {
      while (state.t < course.t_end && taken < steps && integrator->step(state, course.t_end - state.t).ok()) ++taken;
    } else if (integrator->advance(state, course.step, steps).ok()) {
      taken = steps;
    }
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    if (taken == 0) return std::numeric_limits<double>::quiet_NaN();
    if (seconds < long_enough && taken == steps) {
      steps *= 4;
      continue;
    }
    least = std::min(least, seconds / static_cast<double>(taken));
    ++k;
  }
  return least * 1e9;
}

}  // namespace polhode::study::certificate
