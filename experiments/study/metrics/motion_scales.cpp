// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/metrics/motion_scales.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <exception>
#include <numbers>
#include <optional>
#include <utility>

#include "core/exact/exact_motion.hpp"
#include "core/run/simulate.hpp"
#include "core/system/invariants.hpp"
#include "experiments/study/scenario/narrow_phase_choice.hpp"
#include "experiments/study/setup/run_setup.hpp"

namespace polhode::study::inline metrics {
namespace {

/// Keeps the largest value of each scale over the states of the true motion.
class LargestScales final : public Observer {
 public:
  /// radii: of the moving bodies' shapes, m; empty without contact.
  LargestScales(const System<double>& system, const std::vector<std::string>& invariants,
                std::vector<double> radii = {})
      : system_(system), radii_(std::move(radii)) {
    found_.mass_center = mass_center_of_start(system);
    for (const std::string& name : invariants) kinds_.push_back(find_invariant(name));
    found_.invariants.resize(kinds_.size());
    const Problem& problem = system.problem();
    for (std::size_t i = 0; i < system.moving(); ++i) {
      Vector3<double> force = Vector3<double>::Zero();
      bool constant = true;
      for (const auto& f : system.forces()) {
        const auto part = f->effect_on(i).constant_force;
        constant = constant && part;
        if (part) force += *part;
      }
      steady_.push_back(constant && !force.isZero(0) && !problem.bodies[i].pinned);
    }
  }

  std::size_t on_samples(std::span<const Sample> samples) override { return samples.size(); }
  double next_state() const override { return 0; }
  void on_state(const State<double>& state, const Sample& sample) override { take(state, sample.seen); }

  /// Adds a state. Returns its kinetic energy or its change of the potential energy, whichever is larger, J.
  double take(const State<double>& state, const Measurement<double>& seen) {
    if (!potential_start_) potential_start_ = seen.potential;
    const double energy = std::max(seen.kinetic, std::abs(seen.potential - *potential_start_));
    raise(found_.energy, energy);
    double linear = 0, angular = 0, steady = 0;
    const bool alone = system_.moving() == 1;
    for (std::size_t i = 0; i < system_.moving(); ++i) {
      const Body& body = system_.problem().bodies[i];
      const BodySnapshot<double> now = system_.snapshot(state.y, i);
      const double p = body.mass * now.velocity.norm();
      if (!body.pinned) linear += p;
      angular += now.angular_momentum.norm() + (alone ? 0.0 : p * (now.position - found_.mass_center).norm());
      if (steady_[i]) steady += p * p / (2 * body.mass);
    }
    raise(found_.linear, linear);
    raise(found_.angular, angular);
    raise(found_.steady_terms, steady);
    raise(found_.kinetic_terms, seen.kinetic);
    raise(found_.force_terms, force_terms(state));
    const BodySnapshot<double> first = system_.snapshot(state.y, 0);
    for (std::size_t k = 0; k < kinds_.size(); ++k) {
      raise(found_.invariants[k], kinds_[k]->scale(system_.problem(), first));
    }
    return energy;
  }

  const MotionScales& found() const { return found_; }

 private:
  /// Sets largest to max(largest, x); ignores x if it is not finite.
  static void raise(double& largest, double x) {
    if (std::isfinite(x) && x > largest) largest = x;
  }

  static Vector3<double> mass_center_of_start(const System<double>& system) {
    const State<double> start = system.start();
    Vector3<double> sum = Vector3<double>::Zero();
    double mass = 0;
    for (std::size_t i = 0; i < system.moving(); ++i) {
      const double m = system.problem().bodies[i].mass;
      sum += m * system.snapshot(start.y, i).position;
      mass += m;
    }
    return sum / mass;
  }

  /// The value of MotionScales::force_terms in this state, J.
  double force_terms(const State<double>& state) {
    double sum = 0;
    for (std::size_t i = 0; i < radii_.size(); ++i) {
      if (!(radii_[i] > 0)) continue;
      const BodySnapshot<double> now = system_.snapshot(state.y, i);
      sum += system_.problem().bodies[i].mass * now.velocity.squaredNorm() / 2 * now.position.norm() / radii_[i];
    }
    if (!system_.has_forces()) return sum;
    const std::size_t bodies = system_.problem().bodies.size();
    motions_.clear();
    for (std::size_t i = 0; i < bodies; ++i) motions_.push_back(system_.motion_of(state.y, i));
    for (const auto& force : system_.forces()) {
      wrenches_.assign(bodies, {});
      force->add_wrench(state.t, motions_, wrenches_);
      double moved = 0;
      for (std::size_t i = 0; i < system_.moving(); ++i) {
        moved += wrenches_[i].force.norm() * motions_[i].position.norm() + wrenches_[i].torque.norm();
      }
      sum += std::max(std::abs(force->potential_energy(motions_)), moved);
    }
    return sum;
  }

  const System<double>& system_;
  std::vector<double> radii_;
  std::vector<const InvariantKind*> kinds_;
  /// True for a moving body that is not pinned, if all forces on it are constant with a sum other than zero.
  std::vector<bool> steady_;
  std::optional<double> potential_start_;
  std::vector<BodyMotion<double>> motions_;
  std::vector<Wrench<double>> wrenches_;
  MotionScales found_;
};

/// Formulation of states with exact motions: world-frame angular velocity and quaternions.
constexpr Formulation exact_formulation{};

State<double> exact_state(const ExactMotion& exact, const System<double>& system, double t) {
  State<double> state = system.start();
  state.t = t;
  for (std::size_t i = 0; i < system.moving(); ++i) {
    const Layout::Slot& slot = system.layout().slots[i];
    const ExactMotion::BodyAt now = exact.at(t, i);
    double* y = state.y.data();
    Eigen::Map<Quaternion<double>>{y + slot.orientation} = *now.rotation->orientation;
    Eigen::Map<Vector3<double>>{y + slot.angular} = now.rotation->angular_velocity;
    if (slot.position < 0) continue;
    Eigen::Map<Vector3<double>>{y + slot.position} = now.path->position;
    Eigen::Map<Vector3<double>>{y + slot.velocity} = now.path->velocity;
  }
  return state;
}

/// True if all scales are those of the start. A single body on which nothing acts conserves its energy and its momenta,
/// and so the scales of all invariants: they are |L|, and that of Kovalevskaya's integral is (Ω1² + Ω2²)² of a body
/// that is symmetric about axis 3.
bool has_constant_scales(const System<double>& system) {
  return system.moving() == 1 && !system.has_forces() && system.problem().joints.empty();
}

MotionScales along_exact(const Scenario& scenario, const System<double>& system, const ExactMotion& exact,
                         double t_end) {
  constexpr int samples = 64, bits = 26;
  LargestScales largest(system, scenario.invariants);
  const auto take = [&](double t) {
    const State<double> state = exact_state(exact, system, t);
    return largest.take(state, system.measure(state.y));
  };
  take(0);
  double best = t_end, most = take(t_end);
  // Instants by the golden ratio, which do not coincide with any period of the motion.
  for (int k = 1; k <= samples; ++k) {
    const double place = k / std::numbers::phi, t = t_end * (place - std::floor(place)), energy = take(t);
    if (energy > most) best = t, most = energy;
  }
  const double from = std::max(best - t_end / samples, 0.0), to = std::min(best + t_end / samples, t_end);
  boost::math::tools::brent_find_minima([&](double t) { return -take(t); }, from, to, bits);
  return largest.found();
}

MotionScales along_steps(const Scenario& scenario, const RunConfig& config, const std::atomic<bool>* stop) {
  const auto system = make_system<double>(scenario.problem, formulation_of(config));
  std::optional<ContactSetup> contact;
  std::vector<double> radii;
  if (config.contact) {
    contact.emplace(*system, scenario, *config.contact);
    for (std::size_t i = 0; i < system->moving(); ++i) radii.push_back(contact->scene.radius(i));
  }
  LargestScales largest(*system, scenario.invariants, std::move(radii));
  const auto integrator = integrator_of<double>(config, *system);
  State<double> state = system->start();
  try {
    simulate(*system, *system, *integrator, state, schedule_of(config), largest, stop,
             contact ? contact->model.get() : nullptr);
  } catch (const std::exception&) {  // contact that cannot be resolved: the scales up to it are returned
  }
  return largest.found();
}

/// Sums over the moving bodies.
struct MassAndInertia {
  double mass = 0, inertia = 0;  ///< total mass, kg; sum of the traces of the inertias, kg m²
};
MassAndInertia moving_mass(const Scenario& scenario) {
  MassAndInertia sum;
  for (std::size_t i = 0; i < scenario.problem.moving(); ++i) {
    sum.mass += scenario.problem.bodies[i].mass;
    sum.inertia += scenario.problem.bodies[i].inertia.trace();
  }
  return sum;
}

/// Energies up to it are rounding errors, J.
double no_motion(const MotionScales& scales) { return 1e3 * epsilon(Precision::double_precision) * scales.force_terms; }

MotionScales along_rk4(const Scenario& scenario, double t_end, const std::atomic<bool>* stop) {
  constexpr std::int64_t fewest = 64, most = 1 << 18;
  constexpr double close = 1e-3;
  RunConfig config;
  config.integrator = "rk4";
  config.formulation.angular_state = AngularState::velocity_body;
  config.t_end = t_end;
  if (!scenario.problem.joints.empty()) config.joints.emplace().stabilization = Stabilization::both;
  const MassAndInertia sum = moving_mass(scenario);
  MotionScales coarse;
  bool known = false;
  for (std::int64_t steps = fewest; steps <= most; steps *= 2) {
    config.dt = t_end / static_cast<double>(steps);
    const MotionScales fine = along_steps(scenario, config, stop);
    const auto agree = [](double a, double b, double least) {
      return std::abs(a - b) <= close * b || std::max(a, b) <= least;
    };
    const double least = no_motion(fine);
    const bool settled = known && agree(coarse.energy, fine.energy, least) &&
                         agree(coarse.linear, fine.linear, std::sqrt(2 * sum.mass * least)) &&
                         agree(coarse.angular, fine.angular, std::sqrt(2 * sum.inertia * least));
    coarse = fine;
    if (settled || (stop && *stop)) break;
    known = true;
  }
  return coarse;
}

MotionScales along_contact(const Scenario& scenario, double t_end, const std::atomic<bool>* stop) {
  RunConfig config;
  config.integrator = "semi_implicit_euler";
  config.contact = {"sweep_and_prune", narrow_phase_for(scenario), "sequential_impulses", "time_stepping"};
  config.t_end = t_end;
  config.dt = t_end / steps_of_contact_scales(scenario, t_end);
  return along_steps(scenario, config, stop);
}

MotionScales along_true_motion(const Scenario& scenario, double t_end, const std::atomic<bool>* stop) {
  if (!scenario.colliders.empty()) return along_contact(scenario, t_end, stop);
  const auto system = make_system<double>(scenario.problem, exact_formulation);
  if (has_constant_scales(*system)) {
    LargestScales of_start(*system, scenario.invariants);
    const State<double> start = system->start();
    of_start.take(start, system->measure(start.y));
    return of_start.found();
  }
  if (const ExactMotion exact(*system); exact.is_complete()) return along_exact(scenario, *system, exact, t_end);
  return along_rk4(scenario, t_end, stop);
}

}  // namespace

double MotionScales::energy_round_off(Precision precision, std::int64_t steps) const {
  // Energies are measured in double, whatever the precision of the run.
  const double unit = std::max(epsilon(precision), epsilon(Precision::double_precision)),
               n = static_cast<double>(std::max<std::int64_t>(steps, 1));
  return unit * (std::sqrt(n) * (16 * kinetic_terms + force_terms) + 4 * force_terms + n * steady_terms);
}

double steps_of_contact_scales(const Scenario& scenario, double t_end) {
  constexpr double longest_step = 1.0 / 120;  // s
  constexpr double fewest = 100, most = 20000, most_body_steps = 2e5;
  const double affordable = std::clamp(most_body_steps / static_cast<double>(scenario.problem.moving()), fewest, most);
  return std::clamp(std::ceil(t_end / longest_step), fewest, affordable);
}

MotionScales motion_scales(const Scenario& scenario, double t_end, const std::atomic<bool>* stop) {
  MotionScales scales = along_true_motion(scenario, t_end, stop);
  if (scales.energy <= no_motion(scales)) scales.energy = 0;
  if (scenario.energy_scale) scales.energy = *scenario.energy_scale;
  const auto [mass, inertia] = moving_mass(scenario);
  if (scales.linear == 0) scales.linear = std::sqrt(2 * mass * scales.energy);
  if (scales.angular == 0) scales.angular = std::sqrt(2 * inertia * scales.energy);
  return scales;
}

}  // namespace polhode::study::metrics
