// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/judge/diagnosis.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <set>
#include <utility>

#include "core/exact_motion.hpp"
#include "experiments/judge/faulty_motion.hpp"
#include "experiments/study/characteristic_rate.hpp"
#include "experiments/study/report/notation.hpp"
#include "integrators/catalogue.hpp"

namespace polhode::study {
namespace {

using report::number;

constexpr double degree = std::numbers::pi / 180;
constexpr double unknown = std::numeric_limits<double>::infinity();
/// rad: what a program in double precision cannot do better is right.
constexpr double flawless = 1e-7;
/// For each rad of a span, and at most: rows that miss by more do not follow the equations at all.
constexpr double astray_per_rad = 0.1, most_astray = 0.5;
/// rad and relative: an error of the whole run below this needs no cause in the size of the steps.
constexpr double small_error = 0.01;

constexpr double finest_step = 1e-3;  ///< rad, of the first-order steps that are tried

/// A first-order method with so many steps from row to row.
struct Steps {
  FirstOrderStep by;
  int per_row = 0;  ///< 0: the exact motion
};

/// One or two things that may be wrong.
struct Hypothesis {
  std::vector<std::string> causes, words;
  std::set<char> touched;  ///< what it changes: two that change the same are no pair
  Reading reading;         ///< of the rows
  Reading start;           ///< of the numbers of the scenario's start
  Equations equations;
  Problem problem;
  Steps steps;
  double clock = 1, shift = 0;  ///< a row shows the motion at clock t_s + shift
  bool excused = false;         ///< no fault although it may fit
  double miss = unknown;        ///< rad
};

std::string joined(const std::vector<std::string>& parts, const char* between) {
  return fmt::format("{}", fmt::join(parts, between));
}

/// Of two hypotheses that do not touch the same.
Hypothesis both(const Hypothesis& a, const Hypothesis& b) {
  Hypothesis h = a;
  h.causes.insert(h.causes.end(), b.causes.begin(), b.causes.end());
  h.words.insert(h.words.end(), b.words.begin(), b.words.end());
  h.touched.insert(b.touched.begin(), b.touched.end());
  if (b.touched.contains('q')) h.reading.transposed = b.reading.transposed, h.reading.order = b.reading.order;
  if (b.touched.contains('w')) h.reading.rates_in_body = b.reading.rates_in_body;
  if (b.touched.contains('u')) h.reading.rate_unit = b.reading.rate_unit;
  if (b.touched.contains('s')) h.start = b.start;
  if (b.touched.contains('g')) h.equations.gyroscopic = b.equations.gyroscopic;
  if (b.touched.contains('f')) h.equations.frame = b.equations.frame, h.equations.turning = b.equations.turning;
  if (b.touched.contains('i')) h.problem = b.problem;
  if (b.touched.contains('t')) h.clock = b.clock, h.shift = b.shift;
  if (b.touched.contains('m')) h.steps = b.steps;
  return h;
}

bool disjoint(const Hypothesis& a, const Hypothesis& b) {
  return std::none_of(a.touched.begin(), a.touched.end(), [&](char c) { return b.touched.contains(c); });
}

/// The inertias that programs put in the place of the right one, with what they are.
std::vector<std::pair<Matrix3<double>, std::string>> other_inertias(const Body& body) {
  std::vector<std::pair<Matrix3<double>, std::string>> found;
  const Matrix3<double>& right = body.inertia;
  for (const auto& [factor, words] : {std::pair{0.5, "half"}, {2.0, "twice"}, {0.25, "a quarter of"}, {4.0, "four times"}}) {
    found.emplace_back(factor * right, fmt::format("the inertia is {} the scenario's", words));
  }
  const Eigen::SelfAdjointEigenSolver<Matrix3<double>> principal(right);
  const bool diagonal = right.isDiagonal(1e-12);
  const Matrix3<double> axes = diagonal ? Matrix3<double>(Matrix3<double>::Identity()) : principal.eigenvectors();
  const Vector3<double> moments = diagonal ? Vector3<double>(right.diagonal()) : principal.eigenvalues();
  const auto add = [&](const Vector3<double>& m, std::string words) {
    found.emplace_back(axes * m.asDiagonal() * axes.transpose(), std::move(words));
  };
  for (int k = 0; k < 3; ++k) {
    for (const double factor : {0.5, 2.0}) {
      Vector3<double> m = moments;
      m[k] *= factor;
      add(m, fmt::format("the moment of inertia about {} axis {} is {} the scenario's", diagonal ? "body" : "principal",
                         k + 1, factor < 1 ? "half" : "twice"));
    }
  }
  for (const auto& [a, b, c] : {std::tuple{0, 2, 1}, {1, 0, 2}, {2, 1, 0}, {1, 2, 0}, {2, 0, 1}}) {
    add({moments[a], moments[b], moments[c]}, fmt::format("the moments of inertia stand in the order {}, {}, {}", a + 1,
                                                          b + 1, c + 1));
  }
  found.emplace_back(right.inverse() * (right.trace() / right.inverse().trace()), "the inverse of the inertia stands for it");
  if (body.pinned && !body.center_of_mass.isZero(0)) {
    const Vector3<double>& l = body.center_of_mass;
    const Matrix3<double> moved = body.mass * (l.squaredNorm() * Matrix3<double>::Identity() - l * l.transpose());
    found.emplace_back(right - moved, "the inertia is that about the mass centre, not about the pivot");
    found.emplace_back(right + moved, "the inertia is moved from the mass centre to the pivot twice");
  }
  return found;
}

class Trial {
 public:
  Trial(const Trajectory& trajectory, const Scenario& scenario, const TrajectoryScore& plain)
      : raw_(trajectory), scenario_(scenario), plain_score_(plain),
        right_(scenario.problem, {}), exact_(right_.system()) {
    rate_ = characteristic_rate(scenario.problem).value_or(1 / trajectory.times.back());
    choose_spans();
  }

  /// Why nothing can be tried, or empty.
  std::string obstacle() const {
    if (!raw_.has_angular_velocity && !raw_.has_angular_momentum) {
      return "without angular velocity or momentum no reading can be tried";
    }
    if (!scenario_.colliders.empty()) {
      return "what its contacts do is not in the file, so energy, momenta and errors are against a motion without them and "
             "no reading can be tried";
    }
    const System<double>& system = right_.system();
    const bool place_matters = system.forces_exert_torques() && !(raw_.has_position && raw_.has_velocity) &&
                               !exact_.has_position() && any_path();
    if (place_matters) return "without positions and velocities the torques are not known, so no reading can be tried";
    return {};
  }

  Diagnosis run() {
    Hypothesis plain;
    plain.problem = scenario_.problem;
    settle(plain);
    Diagnosis result = judge(plain);
    // Rows that start elsewhere miss every motion that starts as the scenario says: then without the start.
    const double first = miss_of_first(plain);
    if (result.name == "none" || result.name == "unexplained") {
      use_start_ = false;
      settle(plain);
      if (first > 1e-3 && first > naming_factor * plain.miss) {
        Diagnosis elsewhere = judge(plain);
        const std::string words = fmt::format("it starts {} rad away from the scenario's start", number(first));
        if (elsewhere.name == "none") {
          elsewhere.name = "start";
          elsewhere.words = words + " and follows the scenario's equations from there";
        } else if (elsewhere.name != "unexplained") {
          elsewhere.name = "start+" + elsewhere.name;
          elsewhere.words += ", and " + words;
        }
        if (elsewhere.name != "unexplained") return elsewhere;
      }
    }
    if (result.name == "none") check_columns(result);
    return result;
  }

 private:
  /// A free motion is the same with half the inertia; the program's own angular momentum and energy are not.
  void check_columns(Diagnosis& result) const {
    constexpr double least = 1e-3;
    const System<double>& system = right_.system();
    const std::size_t n = raw_.times.size(), stride = std::max<std::size_t>(1, n / 256);
    struct Column {
      const char* what;
      double factor;       ///< of the inertia behind it
      bool in_body;
      double miss = 0;     ///< squared
    };
    std::vector<Column> momenta, energies;
    for (const double factor : {1.0, 0.25, 0.5, 2.0, 4.0}) {
      momenta.push_back({"angular momentum", factor, false});
      energies.push_back({"energy", factor, false});
    }
    momenta.push_back({"angular momentum", 1, true});
    double size_l = 0, size_e = 0;
    for (std::size_t k = 0; k < n; k += stride) {
      const VectorX<double> y = state_of(k, {});
      double rotation = 0;
      for (std::size_t i = 0; i < raw_.moving; ++i) {
        const BodySnapshot<double> body = system.snapshot(y, i);
        const Vector3<double>& l = body.angular_momentum;
        rotation += 0.5 * body.angular_velocity.dot(l);
        size_l += l.squaredNorm();
        const Vector3<double>& own = raw_.bodies[k * raw_.moving + i].angular_momentum;
        for (Column& c : momenta) {
          const Vector3<double> meant = c.in_body ? Vector3<double>(body.rotation.transpose() * l) : Vector3<double>(c.factor * l);
          c.miss += (own - meant).squaredNorm();
        }
      }
      if (!raw_.has_energy) continue;
      size_e += rotation * rotation;
      const double energy = system.measure(y).energy();
      for (Column& c : energies) c.miss += std::pow(raw_.energy[k] - energy - (c.factor - 1) * rotation, 2);
    }
    const auto look = [&](std::vector<Column>& columns, double size) {
      const double plain = columns.front().miss;
      const auto best = std::min_element(columns.begin(), columns.end(), [](const auto& a, const auto& b) { return a.miss < b.miss; });
      if (!(plain > least * least * size) || best->miss * naming_factor * naming_factor > plain) return false;
      result.factor = std::sqrt(plain / std::max(best->miss, 1e-24 * size));
      result.name = best->in_body ? "momentum_frame" : "inertia";
      result.words = best->in_body ? "its angular momentum is in body axes"
                                   : fmt::format("its {} is that of {} times the scenario's inertia, though the motion is right",
                                                 best->what, number(best->factor));
      return true;
    };
    const bool has_l = raw_.has_angular_velocity && raw_.has_angular_momentum;
    if (has_l && look(momenta, size_l)) return;
    const bool knows_energy = (raw_.has_position && raw_.has_velocity) || !any_path() || exact_.has_position();
    if (raw_.has_energy && knows_energy) look(energies, size_e);
  }

  bool any_path() const {
    const auto& bodies = scenario_.problem.bodies;
    for (std::size_t i = 0; i < raw_.moving; ++i) {
      if (!bodies[i].pinned) return true;
    }
    return false;
  }

  void choose_spans() {
    constexpr double long_enough = 0.5, at_first = 2;  // rad
    constexpr std::size_t most = 32, most_first = 12, fewest_first = 3;
    const auto& t = raw_.times;
    const std::size_t n = t.size();
    const auto end_of = [&](std::size_t from) {
      std::size_t to = from + 1;
      while (to + 1 < n && (t[to] - t[from]) * rate_ < long_enough) ++to;
      return to;
    };
    std::size_t last = n - 2;
    while (last > 0 && (t[n - 1] - t[last]) * rate_ < long_enough) --last;
    const std::size_t count = std::min(most, last + 1);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t from = count > 1 ? i * last / (count - 1) : 0;
      spans_.emplace_back(from, end_of(from));
    }
    std::size_t ends = 1;
    while (ends < n && (ends < fewest_first || t[ends] * rate_ <= at_first)) ++ends;
    const std::size_t firsts = std::min(most_first, ends);
    for (std::size_t i = 0; i < firsts; ++i) first_rows_.push_back(firsts > 1 ? i * (ends - 1) / (firsts - 1) : 0);
    span_ = 0;
    for (const auto& [from, to] : spans_) span_ += (t[to] - t[from]) * rate_ / static_cast<double>(spans_.size());
  }

  /// A row as a state, read so.
  VectorX<double> state_of(std::size_t k, const Reading& reading) const {
    const System<double>& system = right_.system();
    VectorX<double> y = system.start().y;
    for (std::size_t i = 0; i < raw_.moving; ++i) {
      const TrajectoryBody& body = raw_.bodies[k * raw_.moving + i];
      const Layout::Slot s = system.layout().slots[i];
      Quaternion<double> q = body.orientation;
      if (raw_.has_matrix) {
        q = quaternion_from_rotation_matrix(body.rotation);
        if (reading.transposed) q = conjugate<double>(q);
      } else {
        q = read_so(body.orientation, reading);
      }
      q.normalize();
      const Matrix3<double> r = rotation_matrix(q);
      Vector3<double> omega = body.angular_velocity * reading.rate_unit;
      if (raw_.has_angular_velocity) {
        if (reading.rates_in_body) omega = (r * omega).eval();
      } else {
        const Vector3<double>& l = body.angular_momentum;
        omega = r * (system.inverse_inertia(i) * (reading.rates_in_body ? l : Vector3<double>(r.transpose() * l)));
      }
      y.segment<4>(s.orientation) = q;
      y.segment<3>(s.angular) = omega;
      if (s.position < 0) continue;
      const auto path = raw_.has_position && raw_.has_velocity ? std::nullopt : exact_.at(raw_.times[k], i).path;
      y.segment<3>(s.position) = raw_.has_position ? body.position : path ? path->position : y.segment<3>(s.position);
      y.segment<3>(s.velocity) = raw_.has_velocity ? body.velocity : path ? path->velocity : y.segment<3>(s.velocity);
    }
    return y;
  }

  /// The scenario's start, its numbers read so.
  VectorX<double> start_of(const Reading& reading) const {
    const System<double>& system = right_.system();
    VectorX<double> y = system.start().y;
    for (std::size_t i = 0; i < raw_.moving; ++i) {
      const BodyStart& start = scenario_.problem.starts[i];
      const Layout::Slot s = system.layout().slots[i];
      const Quaternion<double> q = read_so(start.orientation, reading);
      const bool in_body = start.angular_velocity_in_body != reading.rates_in_body;
      const Vector3<double> omega = start.angular_velocity * reading.rate_unit;
      y.segment<4>(s.orientation) = q.normalized();
      y.segment<3>(s.angular) = in_body ? Vector3<double>(rotation_matrix(q) * omega) : omega;
    }
    return y;
  }

  /// rad
  double distance(const VectorX<double>& a, const VectorX<double>& b) const {
    double sum = 0;
    for (const Layout::Slot& s : right_.system().layout().slots) {
      const Quaternion<double> p = a.segment<4>(s.orientation), q = b.segment<4>(s.orientation);
      sum += std::pow(angle_between(p, q), 2) + (a.segment<3>(s.angular) - b.segment<3>(s.angular)).squaredNorm() / (rate_ * rate_);
    }
    const double d = std::sqrt(sum / static_cast<double>(raw_.moving));
    return d < std::numbers::pi ? d : std::numbers::pi;
  }

  /// From one row to another as the hypothesis says; false where that cannot be followed.
  bool carry(const Hypothesis& h, const FaultyMotion& motion, std::size_t from, std::size_t to, VectorX<double>& y) const {
    const auto& t = raw_.times;
    if (h.steps.per_row == 0) return motion.advance(h.clock * t[from] + h.shift, h.clock * (t[to] - t[from]), y);
    for (std::size_t k = from; k < to; ++k) {
      const double size = (t[k + 1] - t[k]) / h.steps.per_row;
      for (int i = 0; i < h.steps.per_row; ++i) motion.step(t[k] + i * size, size, h.steps.by, y);
    }
    return y.allFinite();
  }

  /// From the scenario's start to the first row.
  bool carry_to_first(const Hypothesis& h, const FaultyMotion& motion, VectorX<double>& y) const {
    const double t = h.clock * raw_.times.front() + h.shift;
    if (h.steps.per_row == 0 || raw_.times.front() == 0) return motion.advance(0, t, y);
    const double size = (raw_.times[1] - raw_.times[0]) / h.steps.per_row;
    const int steps = static_cast<int>(std::clamp(std::round(t / size), 1.0, 1e5));
    for (int i = 0; i < steps; ++i) motion.step(i * t / steps, t / steps, h.steps.by, y);
    return y.allFinite();
  }

  /// Root mean square without the worst tenth.
  static double typical(std::vector<double> misses) {
    std::sort(misses.begin(), misses.end());
    misses.resize(misses.size() - misses.size() / 10);
    double sum = 0;
    for (const double x : misses) sum += x * x;
    return std::sqrt(sum / static_cast<double>(misses.size()));
  }

  double miss_of_first(const Hypothesis& h) const {
    const FaultyMotion motion(h.problem, h.equations);
    VectorX<double> y = start_of(h.start);
    return carry_to_first(h, motion, y) ? distance(y, state_of(0, h.reading)) : std::numbers::pi;
  }

  /// How far the rows are from the motion of a hypothesis, by every `stride`-th span.
  double miss_of(const Hypothesis& h, std::size_t stride = 1) const {
    const FaultyMotion motion(h.problem, h.equations);
    std::vector<double> misses;
    for (std::size_t i = 0; i < spans_.size(); i += stride) {
      const auto [from, to] = spans_[i];
      VectorX<double> y = state_of(from, h.reading);
      misses.push_back(carry(h, motion, from, to, y) ? distance(y, state_of(to, h.reading)) : std::numbers::pi);
    }
    double miss = typical(std::move(misses));
    if (!use_start_) return miss;
    misses.clear();
    VectorX<double> y = start_of(h.start);
    bool followed = carry_to_first(h, motion, y);
    for (std::size_t i = 0; i < first_rows_.size(); ++i) {
      if (i > 0) followed = followed && carry(h, motion, first_rows_[i - 1], first_rows_[i], y);
      misses.push_back(followed ? distance(y, state_of(first_rows_[i], h.reading)) : std::numbers::pi);
    }
    return std::hypot(miss, typical(std::move(misses)));
  }

  void settle(Hypothesis& h) const { h.miss = miss_of(h); }

  // ---- what is tried ----------------------------------------------------------------------------------------------

  std::vector<Hypothesis> readings() const {
    std::vector<Hypothesis> list;
    const auto add = [&](const char* cause, std::string words, char touched, auto&& change) {
      Hypothesis h;
      h.problem = scenario_.problem;
      h.causes = {cause};
      h.words = {std::move(words)};
      h.touched = {touched};
      change(h);
      list.push_back(std::move(h));
    };
    add("transposed", raw_.has_matrix ? "its rotation matrices are transposed (world to body)"
                                      : "its quaternions are conjugated (world to body)",
        'q', [](Hypothesis& h) { h.reading.transposed = true; });
    if (!raw_.has_matrix) {
      add("quaternion_order", "its quaternions stand in the order x, y, z, w", 'q',
          [](Hypothesis& h) { h.reading.order = Reading::Order::xyzw; });
      add("quaternion_order", "its quaternions stand in the order z, w, x, y", 'q',
          [](Hypothesis& h) { h.reading.order = Reading::Order::zwxy; });
    }
    add("omega_frame", raw_.has_angular_velocity ? "its angular velocity is in body axes"
                                                 : "its angular momentum is in body axes",
        'w', [](Hypothesis& h) { h.reading.rates_in_body = true; });
    if (raw_.has_angular_velocity) {
      add("degrees", "its angular velocity is in degrees per second", 'u',
          [](Hypothesis& h) { h.reading.rate_unit = degree; });
      add("revolutions", "its angular velocity is in revolutions per second", 'u',
          [](Hypothesis& h) { h.reading.rate_unit = 2 * std::numbers::pi; });
      add("revolutions", "its angular velocity is in revolutions per minute", 'u',
          [](Hypothesis& h) { h.reading.rate_unit = 2 * std::numbers::pi / 60; });
    }
    return list;
  }

  std::vector<Hypothesis> faults() const {
    std::vector<Hypothesis> list;
    const auto add = [&](const char* cause, std::string words, char touched, auto&& change) {
      Hypothesis h;
      h.problem = scenario_.problem;
      h.causes = {cause};
      h.words = {std::move(words)};
      h.touched = {touched};
      change(h);
      list.push_back(std::move(h));
    };
    add("gyroscopic_sign", "ω × Iω has the wrong sign", 'g', [](Hypothesis& h) { h.equations.gyroscopic = -1; });
    add("gyroscopic_absent", "ω × Iω is left out", 'g', [](Hypothesis& h) { h.equations.gyroscopic = 0; });
    using Frame = Equations::Frame;
    add("omega_frame", "the inertia is not turned with the body: ω in world axes meets I in body axes", 'f',
        [](Hypothesis& h) { h.equations.frame = Frame::inertia_not_turned; });
    add("omega_frame", "the attitude is turned by ω in body axes as though in world axes", 'f',
        [](Hypothesis& h) { h.equations.frame = Frame::body_turns_world; });
    add("omega_frame", "the attitude is turned by ω in world axes as though in body axes", 'f',
        [](Hypothesis& h) { h.equations.frame = Frame::world_turns_body; });
    for (const auto& [factor, cause, words] :
         {std::tuple{2.0, "attitude_rate", "the attitude turns twice as fast as ω, as without the ½ of q̇ = ½ωq"},
          {0.5, "attitude_rate", "the attitude turns half as fast as ω"},
          {degree, "degrees", "the attitude turns by ω π/180, as though ω were in degrees per second"},
          {1 / degree, "degrees", "the attitude turns by ω 180/π, as though degrees were radians"}}) {
      add(cause, words, 'f', [factor = factor](Hypothesis& h) { h.equations.turning = factor; });
    }
    for (const auto& [unit, words] :
         {std::pair{degree, "it starts with the scenario's ω taken for degrees per second"},
          {1 / degree, "it starts with the scenario's ω in degrees per second, taken for radians"}}) {
      add("degrees", words, 's', [unit = unit](Hypothesis& h) { h.start.rate_unit = unit; });
    }
    const auto& starts = scenario_.problem.starts;
    const bool turned = std::any_of(starts.begin(), starts.begin() + static_cast<std::ptrdiff_t>(raw_.moving), [](const BodyStart& s) {
      return s.orientation.tail<3>().norm() > 1e-6 * std::abs(s.orientation[0]);
    });
    if (turned) {
      add("omega_frame", "it starts with the scenario's ω in the wrong axes (world and body exchanged)", 's',
          [](Hypothesis& h) { h.start.rates_in_body = true; });
      add("transposed", "it starts with the scenario's orientation transposed", 's',
          [](Hypothesis& h) { h.start.transposed = true; });
    }
    add("quaternion_order", "it starts with the scenario's quaternion read as x, y, z, w", 's',
        [](Hypothesis& h) { h.start.order = Reading::Order::xyzw; });
    add_inertias(add);
    return list;
  }

  /// Those that make a difference, each once.
  template <class Add>
  void add_inertias(const Add& add) const {
    const bool free = !right_.system().forces_exert_torques();  // then a common factor makes none
    const auto shape = [&](const Matrix3<double>& m) { return free ? Matrix3<double>(m / m.trace()) : m; };
    for (std::size_t i = 0; i < raw_.moving; ++i) {
      const Body& body = scenario_.problem.bodies[i];
      std::vector<Matrix3<double>> seen = {shape(body.inertia)};
      for (const auto& [inertia, words] : other_inertias(body)) {
        const Matrix3<double> it = shape(inertia);
        const bool known = std::any_of(seen.begin(), seen.end(), [&](const auto& m) { return (m - it).norm() < 1e-6 * m.norm(); });
        const Matrix3<double> isotropic = it.trace() / 3 * Matrix3<double>::Identity();
        if (free && (it - isotropic).norm() < 1e-6 * it.norm()) continue;  // has no Ω × IΩ: that is tried already
        if (known || inertia.llt().info() != Eigen::Success) continue;
        seen.push_back(it);
        add("inertia", raw_.moving > 1 ? fmt::format("{} (body {})", words, body.name) : words, 'i',
            [&, m = inertia](Hypothesis& h) { h.problem.bodies[i].inertia = m; });
      }
    }
  }

  /// The best whole number of steps from row to row for each first-order method, and the best of these.
  std::optional<Hypothesis> stepped(const Hypothesis& base) const {
    constexpr std::size_t refined = 6;
    const std::size_t stride = std::max<std::size_t>(1, spans_.size() / 6);
    const auto& t = raw_.times;
    const double row = (t.back() - t.front()) / static_cast<double>(t.size() - 1) * rate_;
    const int most = static_cast<int>(std::clamp(row / finest_step, 1.0, 4096.0));
    std::vector<Hypothesis> tried;
    using Step = FirstOrderStep;
    for (const auto order : {Step::Order::together, Step::Order::velocity_first, Step::Order::attitude_first}) {
      for (const auto state : {Step::State::velocity_world, Step::State::velocity_body, Step::State::momentum_world}) {
        if (state == Step::State::momentum_world && base.equations.gyroscopic != 1) continue;
        for (const auto turn : {Step::Turn::quaternion, Step::Turn::exponential, Step::Turn::matrix}) {
          Hypothesis best = base;
          best.miss = unknown;
          for (int n = 1; n <= most; n *= 2) {
            Hypothesis h = base;
            h.steps = {{state, order, turn}, n};
            h.miss = miss_of(h, stride);
            if (h.miss < best.miss) best = h;
          }
          tried.push_back(std::move(best));
        }
      }
    }
    std::vector<double> misses;
    for (const Hypothesis& h : tried) misses.push_back(h.miss);
    std::nth_element(misses.begin(), misses.begin() + refined - 1, misses.end());
    double least = unknown;
    for (Hypothesis& h : tried) {
      if (h.miss <= misses[refined - 1]) refine(h, most, stride);
      least = std::min(least, h.miss);
    }
    // Some of them are the same in a free motion: the first in the list is the plainest.
    Hypothesis best = *std::find_if(tried.begin(), tried.end(), [&](const auto& h) { return h.miss <= 2 * least + 1e-9; });
    settle(best);
    const double size = row / rate_ / best.steps.per_row;
    Hypothesis only;
    only.problem = base.problem;
    only.causes = {"first_order_step"};
    only.words = {fmt::format("its steps are those of a first-order method, {}, with {} s", best.steps.by.words(), number(size))};
    only.touched = {'m'};
    only.steps = best.steps;
    Hypothesis h = both(base, only);
    h.miss = best.miss;
    return h;
  }

  /// The same with a rotation matrix that no step brings back to a rotation, by the catalogue's methods.
  std::optional<Hypothesis> stepped_as_stored(const Hypothesis& plain) const {
    if (!raw_.has_matrix || !raw_.has_angular_velocity) return std::nullopt;
    const auto& t = raw_.times;
    const std::size_t stride = std::max<std::size_t>(1, spans_.size() / 6);
    const double row = (t.back() - t.front()) / static_cast<double>(t.size() - 1) * rate_;
    const int most = static_cast<int>(std::clamp(row / finest_step, 1.0, 4096.0));
    Hypothesis best = plain;
    best.miss = unknown;
    for (const auto state : {AngularState::velocity_world, AngularState::velocity_body, AngularState::momentum_world}) {
      for (const char* method : {"explicit_euler", "semi_implicit_euler"}) {
        const auto system = make_system<double>(scenario_.problem, {Orientation::matrix, state, true});
        const auto integrator = find_integrator(method)->make(*system, {});
        const auto miss = [&](int n, std::size_t each) { return miss_as_stored(*system, *integrator, n, each); };
        for (int n = 1; n <= most; n = n < 16 ? n + 1 : n + n / 8) {
          const double here = miss(n, stride);
          if (here >= best.miss) continue;
          best.miss = here;
          best.steps.per_row = n;
          best.words = {fmt::format("its steps are those of a first-order method, {} Euler on {} and a rotation matrix "
                                    "that is never brought back to a rotation, with {} s",
                                    method[0] == 'e' ? "explicit" : "semi-implicit",
                                    state == AngularState::velocity_world  ? "ω in world axes"
                                    : state == AngularState::velocity_body ? "ω in body axes"
                                                                           : "L",
                                    number(row / rate_ / n))};
        }
      }
    }
    best.causes = {"first_order_step"};
    best.touched = {'m'};
    return best;
  }

  double miss_as_stored(const System<double>& system, Integrator<double>& integrator, int per_row, std::size_t stride) const {
    const auto& t = raw_.times;
    std::vector<double> misses;
    for (std::size_t k = 0; k < spans_.size(); k += stride) {
      const auto [from, to] = spans_[k];
      State<double> state{t[from], state_as_stored(system, from)};
      bool followed = true;
      for (std::size_t j = from; j < to && followed; ++j) {
        integrator.begin(state);
        followed = integrator.advance(state, (t[j + 1] - t[j]) / per_row, per_row).ok();
        state.t = t[j + 1];
      }
      double sum = 0;
      for (std::size_t i = 0; i < raw_.moving; ++i) {
        const BodySnapshot<double> now = system.snapshot(state.y, i);
        const TrajectoryBody& row = raw_.bodies[to * raw_.moving + i];
        const double size = std::sqrt(2.0 / 3) * row.rotation.norm();  // √2 of a rotation
        sum += (now.rotation - row.rotation).squaredNorm() / (size * size) +
               (now.angular_velocity - row.angular_velocity).squaredNorm() / (rate_ * rate_);
      }
      const double d = std::sqrt(sum / static_cast<double>(raw_.moving));
      misses.push_back(followed && d < std::numbers::pi ? d : std::numbers::pi);
    }
    return typical(std::move(misses));
  }

  /// A row with its matrix as it is.
  VectorX<double> state_as_stored(const System<double>& system, std::size_t k) const {
    VectorX<double> y = system.start().y;
    const VectorX<double> plain = state_of(k, {});
    for (std::size_t i = 0; i < raw_.moving; ++i) {
      const TrajectoryBody& body = raw_.bodies[k * raw_.moving + i];
      const Layout::Slot s = system.layout().slots[i], from = right_.system().layout().slots[i];
      Eigen::Map<Matrix3<double>>{y.data() + s.orientation} = body.rotation;
      Vector3<double> angular = plain.segment<3>(from.angular);
      const AngularState kind = system.formulation().angular_state;
      if (kind != AngularState::velocity_world) angular = (body.rotation.inverse() * angular).eval();
      if (kind == AngularState::momentum_world) {
        angular = (body.rotation.transpose().inverse() * (system.problem().bodies[i].inertia * angular)).eval();
      }
      y.segment<3>(s.angular) = angular;
      if (s.position < 0) continue;
      y.segment<3>(s.position) = plain.segment<3>(from.position);
      y.segment<3>(s.velocity) = plain.segment<3>(from.velocity);
    }
    return y;
  }

  /// The number of steps near the one found: the miss falls to one side of the best and rises on the other.
  void refine(Hypothesis& h, int most, std::size_t stride) const {
    int low = std::max(1, h.steps.per_row / 2), high = std::min(most, 2 * h.steps.per_row);
    Hypothesis trial = h;
    const auto at = [&](int n) {
      trial.steps.per_row = n;
      trial.miss = miss_of(trial, stride);
      if (trial.miss < h.miss) h = trial;
      return trial.miss;
    };
    while (high - low > 6) {
      const int third = (high - low) / 3;
      if (at(low + third) < at(high - third)) high -= third; else low += third;
    }
    for (int n = low; n <= high; ++n) at(n);
  }

  /// The row at t_s shows the motion of another time: the shift that fits best.
  std::optional<Hypothesis> shifted(const Hypothesis& base) const {
    constexpr double reach = 10, grid = 0.2;  // rad
    if (!use_start_ || first_rows_.size() < 3) return std::nullopt;
    const FaultyMotion motion(base.problem, base.equations);
    std::vector<VectorX<double>> at_rows, rows;
    VectorX<double> y = start_of(base.start);
    bool followed = carry_to_first(base, motion, y);
    for (std::size_t i = 0; i < first_rows_.size(); ++i) {
      if (i > 0) followed = followed && carry(base, motion, first_rows_[i - 1], first_rows_[i], y);
      at_rows.push_back(y);
      rows.push_back(state_of(first_rows_[i], base.reading));
    }
    if (!followed) return std::nullopt;
    const auto miss = [&](double shift) {
      std::vector<double> misses;
      for (std::size_t i = 0; i < rows.size(); ++i) {
        VectorX<double> there = at_rows[i];
        misses.push_back(motion.advance(raw_.times[first_rows_[i]], shift, there) ? distance(there, rows[i]) : std::numbers::pi);
      }
      return typical(std::move(misses));
    };
    // The lowest of the valleys: whole turns of a motion that nearly repeats itself are valleys too.
    constexpr int points = static_cast<int>(reach / grid);
    constexpr std::size_t most_valleys = 5;
    std::vector<double> heights;
    for (int k = -points; k <= points; ++k) heights.push_back(miss(k * grid / rate_));
    std::vector<std::size_t> valleys;
    for (std::size_t k = 1; k + 1 < heights.size(); ++k) {
      if (heights[k] <= heights[k - 1] && heights[k] <= heights[k + 1]) valleys.push_back(k);
    }
    std::stable_sort(valleys.begin(), valleys.end(), [&](auto a, auto b) { return heights[a] < heights[b]; });
    valleys.resize(std::min(most_valleys, valleys.size()));
    double shift = 0, least = unknown;
    for (const std::size_t k : valleys) {
      const double middle = (static_cast<double>(k) - points) * grid / rate_;
      const double there = lowest(miss, middle - grid / rate_, middle + grid / rate_);
      if (const double here = miss(there); here < least) shift = there, least = here;
    }
    Hypothesis only;
    only.problem = base.problem;
    only.causes = {"clock_offset"};
    only.words = {fmt::format("its clock is {} by {} s: each row shows the motion of so much {} than its t_s",
                              shift < 0 ? "fast" : "late", number(std::abs(shift), 4), shift < 0 ? "earlier" : "later")};
    only.touched = {'t'};
    only.shift = shift;
    Hypothesis h = both(base, only);
    settle(h);
    return h;
  }

  /// The motion runs faster or slower than t_s: the factor that fits best. A method of second order that turns by x rad in
  /// a step is slow or fast by x²/12 to x²/4, dmv exactly so but for the attitude: what steps as large as the rows are
  /// apart excuse is no sign of a wrong clock, unless the fit is far better than such a method's and the axis moves.
  std::optional<Hypothesis> rescaled(const Hypothesis& base) const {
    constexpr double reach = 0.3, grid = 0.01;
    const auto& t = raw_.times;
    const double row = (t.back() - t.front()) / static_cast<double>(t.size() - 1) * rate_;
    constexpr double least_excusable = 2e-3, most_excusable = 0.08, far_better = 100;
    const double excusable = std::clamp(row * row / 4, least_excusable, most_excusable);
    const std::size_t stride = std::max<std::size_t>(1, spans_.size() / 6);
    Hypothesis h = base;
    const auto miss = [&](double log_clock) {
      h.clock = std::exp(log_clock);
      return miss_of(h, stride);
    };
    double best = 0, least = unknown;
    for (const double unit : {1e-3, 1.0 / 60, 60.0, 1e3}) {
      if (const double here = miss(std::log(unit)); here < least) best = std::log(unit), least = here;
    }
    for (int k = -static_cast<int>(reach / grid); k <= static_cast<int>(reach / grid); ++k) {
      if (const double here = miss(k * grid); here < least) best = k * grid, least = here;
    }
    const double clock = std::exp(lowest(miss, best - grid, best + grid));
    Hypothesis only;
    only.problem = base.problem;
    only.causes = {"clock_rate"};
    only.words = {fmt::format("its clock runs {}: in 1 s of t_s the motion goes on by {} s", clock > 1 ? "slow" : "fast",
                              number(clock, 5))};
    only.touched = {'t'};
    only.clock = clock;
    h = both(base, only);
    settle(h);
    const double off = std::abs(clock - 1);
    h.excused = off <= least_excusable || (off <= excusable && (h.miss * far_better > base.miss || steady(base)));
    return h;
  }

  /// Whether ω hardly changes over the spans: then a turn is all there is to see.
  bool steady(const Hypothesis& h) const {
    constexpr double little = 0.1;  // of the turn
    double changes = 0;
    for (const auto& [from, to] : spans_) {
      const VectorX<double> a = state_of(from, h.reading), b = state_of(to, h.reading);
      for (const Layout::Slot& s : right_.system().layout().slots) {
        changes += (a.segment<3>(s.angular) - b.segment<3>(s.angular)).norm() / rate_;
      }
    }
    return changes < little * span_ * static_cast<double>(spans_.size() * raw_.moving);
  }

  /// The lowest point of a function between two places, by the golden section.
  template <class F>
  static double lowest(const F& f, double low, double high) {
    constexpr double golden = 0.6180339887498949;
    double a = high - golden * (high - low), b = low + golden * (high - low), at_a = f(a), at_b = f(b);
    for (int i = 0; i < 60; ++i) {
      if (at_a <= at_b) {
        high = b, b = a, at_b = at_a;
        a = high - golden * (high - low), at_a = f(a);
      } else {
        low = a, a = b, at_a = at_b;
        b = low + golden * (high - low), at_b = f(b);
      }
    }
    return (low + high) / 2;
  }

  // ---- the verdict ------------------------------------------------------------------------------------------------

  /// Whether the errors of the whole run are large enough to ask for a cause in the size of the steps.
  bool material(double miss) const {
    const RunResult& r = plain_score_.record.result;
    const auto large = [](const std::optional<double>& x) { return x && !(*x < small_error); };
    if (large(r.attitude_error_max) || large(r.energy_drift_max_rel) || large(r.angular_momentum_drift_max_rel)) return true;
    return miss / span_ * rate_ * (raw_.times.back() - raw_.times.front()) > small_error;
  }

  double astray() const { return std::min(astray_per_rad * span_, most_astray); }

  static bool same_causes(const Hypothesis& a, const Hypothesis& b) { return a.causes == b.causes; }

  /// The best hypothesis of a list and the best one with another cause; null where there is none.
  static std::pair<const Hypothesis*, const Hypothesis*> best_two(const std::vector<Hypothesis>& list) {
    const Hypothesis *best = nullptr, *other = nullptr;
    for (const Hypothesis& h : list) {
      if (!best || h.miss < best->miss) best = &h;
    }
    for (const Hypothesis& h : list) {
      if (!same_causes(h, *best) && (!other || h.miss < other->miss)) other = &h;
    }
    return {best, other};
  }

  Diagnosis judge(const Hypothesis& plain) {
    Diagnosis result;
    result.name = "none";
    result.miss = plain.miss;
    result.span = span_;
    if (plain.miss <= flawless) return result;
    std::vector<Hypothesis> single = readings();
    for (auto& h : faults()) single.push_back(std::move(h));
    for (auto& h : single) settle(h);
    for (const auto& fit : {shifted(plain), rescaled(plain)}) {
      if (fit) single.push_back(*fit);
    }
    if (material(plain.miss)) {
      for (const auto& fit : {stepped(plain), stepped_as_stored(plain)}) {
        if (fit) single.push_back(*fit);
      }
    }
    const auto [best, other] = best_two(single);
    const bool explains = best->miss * naming_factor <= plain.miss;
    // Two things at once are looked for where one alone leaves much to explain.
    constexpr double much = 1e-3;
    if (explains ? best->miss > much : plain.miss > astray() || material(plain.miss)) {
      const std::vector<Hypothesis> double_faults = pairs(plain, single, std::min(best->miss, plain.miss));
      if (!double_faults.empty()) {
        const auto [pair, other_pair] = best_two(double_faults);
        if (pair->miss * naming_factor <= std::min(best->miss, plain.miss) && !pair->excused) {
          return named(*pair, other_pair, plain, *best);
        }
      }
    }
    if (explains && !best->excused) return named(*best, other, plain, plain);
    if (explains && std::abs(best->clock - 1) > 2e-3) {
      result.remark = fmt::format("at t_s it is where it should be at {} t_s, by its steps or its clock", number(best->clock, 5));
    }
    if (plain.miss > astray()) result.name = "unexplained";
    return result;
  }

  /// Those that miss by no more than `worst`.
  std::vector<Hypothesis> pairs(const Hypothesis& plain, const std::vector<Hypothesis>& single, double worst) const {
    const std::size_t few = std::max<std::size_t>(1, spans_.size() / 4);
    std::vector<Hypothesis> list;
    const auto fitted = [](const Hypothesis& h) { return h.touched.contains('t') || h.touched.contains('m'); };
    for (std::size_t i = 0; i < single.size(); ++i) {
      if (fitted(single[i])) continue;
      for (std::size_t j = 0; j < i; ++j) {
        if (fitted(single[j]) || !disjoint(single[i], single[j])) continue;
        Hypothesis h = both(single[j], single[i]);
        if (miss_of(h, few) > worst) continue;
        settle(h);
        list.push_back(std::move(h));
      }
    }
    // What must be fitted, beside those single ones that are some help.
    constexpr std::size_t most = 3;
    std::vector<const Hypothesis*> helpful;
    for (const Hypothesis& h : single) {
      if (!fitted(h) && h.miss < plain.miss / 2) helpful.push_back(&h);
    }
    std::stable_sort(helpful.begin(), helpful.end(), [](auto a, auto b) { return a->miss < b->miss; });
    helpful.resize(std::min(most, helpful.size()));
    for (const Hypothesis* h : helpful) {
      for (const auto& fit : {shifted(*h), rescaled(*h), h->touched.contains('f') ? std::nullopt : stepped(*h)}) {
        if (fit) list.push_back(*fit);
      }
    }
    return list;
  }

  /// `simpler`: what it must beat besides.
  Diagnosis named(const Hypothesis& h, const Hypothesis* other, const Hypothesis& plain, const Hypothesis& simpler) const {
    Diagnosis result;
    result.miss = plain.miss;
    result.span = span_;
    const double least = std::max(h.miss, 1e-12);
    result.factor = plain.miss / least;
    const double rival = std::min(other ? other->miss : unknown, simpler.miss);
    result.margin = rival / least;
    const auto name = [](const Hypothesis& of) {
      std::vector<std::string> causes = of.causes;
      causes.erase(std::unique(causes.begin(), causes.end()), causes.end());
      return joined(causes, "+");
    };
    result.name = name(h);
    result.words = joined(h.words, ", and ");
    if (other && *result.margin < naming_factor) {
      result.name += "|" + name(*other);
      result.words = "either " + result.words + ", or " + joined(other->words, ", and ");
      return result;
    }
    if (h.equations.gyroscopic == 1 && h.equations.frame == Equations::Frame::right && h.equations.turning == 1 &&
        !h.touched.contains('i') && !h.touched.contains('s') && !h.touched.contains('m')) {
      result.meant = retimed(read_so(raw_, h.reading), h.clock, h.shift);
    }
    return result;
  }

  const Trajectory& raw_;
  const Scenario& scenario_;
  const TrajectoryScore& plain_score_;
  FaultyMotion right_;
  ExactMotion exact_;
  double rate_ = 1, span_ = 0;  ///< rad/s, rad
  std::vector<std::pair<std::size_t, std::size_t>> spans_;  ///< rows from which and to which
  std::vector<std::size_t> first_rows_;
  bool use_start_ = true;
};

}  // namespace

Diagnosis diagnose(const Trajectory& trajectory, const Scenario& scenario, const TrajectoryScore& plain) {
  Trial trial(trajectory, scenario, plain);
  if (std::string obstacle = trial.obstacle(); !obstacle.empty()) {
    Diagnosis none;
    none.untried = std::move(obstacle);
    return none;
  }
  return trial.run();
}

}  // namespace polhode::study
