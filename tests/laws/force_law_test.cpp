// SPDX-License-Identifier: BSD-3-Clause
// The laws of a force, for every entry of the catalogue: a new force needs a line in samples() below and nothing else.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/forces/catalogue.hpp"
#include "tests/laws/problems.hpp"
#include "tests/laws/random_motion.hpp"

namespace polhode::laws::force_law_test {
namespace {

using Real = long double;
using Vector = Vector3<Real>;
using Matrix = Matrix3<Real>;
using Motions = std::vector<BodyMotion<Real>>;
using Wrenches = std::vector<Wrench<Real>>;

/// One force with all its keys, and which of its vectors live in the world: those turn when the world is turned, and
/// points shift when it is shifted.
struct Sample {
  std::string what;
  ForceParameters force;
  std::vector<std::string> world_directions{};
  std::vector<std::string> world_points{};
  bool galilean = false;  ///< the same to an observer in uniform motion
};

// The bodies of the samples: 0 and 1 free, 2 pinned with its mass centre off the pivot, 3 pinned at its mass centre,
// 4 static.
enum Index : std::size_t { a, b, pinned, pinned_at_center, fixed };

std::vector<Sample> samples() {
  const Vector3<double> end(0.3, -0.2, 0.5), far_end(-0.1, 0.4, 0.2), place(1.5, 0.5, -2), arrow(0.7, -1.1, 0.4);
  const std::string body = "body", world = "world";
  return {
      {"on all",
       force("uniform_gravity", {a, b, pinned, pinned_at_center}, {{"acceleration", arrow}}),
       {"acceleration"},
       {},
       true},
      {"free and free", force("point_gravity", {a, b}, {{"gravitational_constant", 0.7}}), {}, {}, true},
      {"free and pinned", force("point_gravity", {a, pinned}, {{"gravitational_constant", 0.7}})},
      {"pinned and static", force("point_gravity", {pinned, fixed}, {{"gravitational_constant", 0.7}})},
      {"free and static", force("point_gravity", {b, fixed}, {{"gravitational_constant", 0.7}})},
      {"plain", force("spring", {a}, {{"stiffness", 3.0}, {"anchor_world", place}}), {}, {"anchor_world"}},
      {"off centre, damped",
       force(
           "spring", {a},
           {{"stiffness", 3.0}, {"damping", 0.6}, {"rest_length", 1.2}, {"anchor_body", end}, {"anchor_world", place}}),
       {},
       {"anchor_world"}},
      {"free and free at their centres",
       force("spring", {a, b}, {{"stiffness", 3.0}, {"rest_length", 1.2}}),
       {},
       {},
       true},
      {"free and free, off centre, damped",
       force("spring", {b, a},
             {{"stiffness", 3.0},
              {"damping", 0.6},
              {"rest_length", 1.2},
              {"anchor_body", end},
              {"anchor_body_2", far_end}}),
       {},
       {},
       true},
      {"pinned and free", force("spring", {pinned, a}, {{"stiffness", 3.0}, {"damping", 0.6}, {"anchor_body", end}})},
      {"free and pinned",
       force("spring", {a, pinned_at_center}, {{"stiffness", 3.0}, {"rest_length", 1.2}, {"anchor_body_2", far_end}})},
      {"free and static", force("spring", {a, fixed}, {{"stiffness", 3.0}, {"anchor_body_2", far_end}})},
      {"off centre",
       force("damper", {a}, {{"damping", 0.6}, {"anchor_body", end}, {"anchor_world", place}}),
       {},
       {"anchor_world"}},
      {"free and free",
       force("damper", {a, b}, {{"damping", 0.6}, {"anchor_body", end}, {"anchor_body_2", far_end}}),
       {},
       {},
       true},
      {"free and free at their centres", force("damper", {a, b}, {{"damping", 0.6}}), {}, {}, true},
      {"pinned and free", force("damper", {pinned, a}, {{"damping", 0.6}, {"anchor_body", end}})},
      {"linear", force("drag", {a, pinned}, {{"linear", 0.5}})},
      {"all", force("drag", {a, b, pinned}, {{"linear", 0.5}, {"quadratic", 0.3}, {"angular", 0.2}})},
      {"world, at the reference point", force("constant_force", {a, pinned}, {{"force", arrow}}), {"force"}, {}, true},
      {"world, at a point",
       force("constant_force", {a, pinned}, {{"force", arrow}, {"anchor_body", end}}),
       {"force"},
       {},
       true},
      {"thruster",
       force("constant_force", {a, pinned}, {{"force", arrow}, {"frame", body}, {"anchor_body", end}}),
       {},
       {},
       true},
      {"world", force("constant_torque", {a, pinned}, {{"torque", arrow}, {"frame", world}}), {"torque"}, {}, true},
      {"body", force("constant_torque", {a, pinned}, {{"torque", arrow}, {"frame", body}}), {}, {}, true},
  };
}

std::vector<Body> bodies() {
  return {{.name = "a", .mass = 2, .inertia = diagonal(0.5, 0.8, 1.1)},
          {.name = "b", .mass = 0.7, .inertia = diagonal(0.2, 0.3, 0.25)},
          {.name = "pinned",
           .mass = 1.3,
           .inertia = diagonal(2, 3, 2.5),
           .pinned = true,
           .center_of_mass = {0.2, -0.4, 0.3}},
          {.name = "pinned at its centre", .mass = 1.1, .inertia = diagonal(1, 2, 1.5), .pinned = true},
          {.name = "fixed", .mass = 5, .fixed = true}};
}

/// Places far enough from each other, any orientation and velocity; no velocity where there can be none.
template <class S>
std::vector<BodyMotion<S>> random_motions(std::uint32_t seed) {
  const std::vector<Body> all = bodies();
  const std::vector<double> u = random_numbers(all.size() * numbers_per_body, seed);
  std::vector<BodyMotion<S>> motions;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double* x = u.data() + i * numbers_per_body;
    BodyMotion<S> m;
    m.position = Vector3<double>(2 * double(i) + 0.5 * x[0], x[1], x[2]).cast<S>();
    m.rotation = rotation_matrix<S>(Quaternion<double>(x[3], x[4], x[5], x[6]).template cast<S>());
    m.velocity = Vector3<double>(x[7], x[8], x[9]).cast<S>();
    m.angular_velocity = Vector3<double>(2 * x[10], 2 * x[11], 2 * x[12]).cast<S>();
    if (all[i].pinned || all[i].fixed) m.velocity.setZero();
    if (all[i].fixed) m.angular_velocity.setZero();
    motions.push_back(m);
  }
  return motions;
}

constexpr std::uint32_t seeds = 8;
constexpr Real instant = 0.75L;

template <class S>
std::vector<Wrench<S>> wrenches(const ForceModel<S>& force, const std::vector<BodyMotion<S>>& motions) {
  std::vector<Wrench<S>> all(motions.size());
  force.add_wrench(S(instant), motions, all);
  return all;
}

/// The rotation by the vector φ, by the exponential series (|φ| is small).
Matrix turn(const Vector& phi) {
  const Matrix k = skew(phi);
  return Matrix::Identity() + k + k * k / 2 + k * k * k / 6 + k * k * k * k / 24;
}

/// dV/ds where the bodies move by s times (δp, δφ), at s = 0: central differences of order four.
Real slope(const ForceModel<Real>& force, const Motions& start, const std::vector<Vector>& dp,
           const std::vector<Vector>& dphi) {
  const auto at = [&](Real s) {
    Motions m = start;
    for (std::size_t i = 0; i < m.size(); ++i) {
      m[i].position += s * dp[i];
      m[i].rotation = turn(s * dphi[i]) * m[i].rotation;
    }
    return force.potential_energy(m);
  };
  const Real h = 1e-4L;
  return (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
}

class ForceLaw : public testing::TestWithParam<std::string> {
 protected:
  const ForceEntry& entry() const { return *find_force(GetParam()); }

  template <class Check>
  void for_every_sample(const Check& check) const {
    std::size_t found = 0;
    for (const Sample& sample : samples()) {
      if (sample.force.kind != GetParam()) continue;
      ++found;
      SCOPED_TRACE(sample.force.kind + ", " + sample.what);
      check(sample, *make_force<Real>(sample.force, bodies()));
    }
    EXPECT_GT(found, 0u)
        << "the force '" << GetParam()
        << "' of the catalogue has no sample: add a line to samples() in tests/laws/force_law_test.cpp";
  }
};
std::vector<std::string> kinds() {
  std::vector<std::string> names;
  for (const ForceEntry& e : force_catalogue()) names.push_back(e.kind.name);
  return names;
}
INSTANTIATE_TEST_SUITE_P(Catalogue, ForceLaw, testing::ValuesIn(kinds()),
                         [](const auto& param_info) { return param_info.param; });

// Σ (f·v + τ·ω) = −dV/dt + power.
TEST_P(ForceLaw, PowerIsWhatThePotentialDoesNotGive) {
  for_every_sample([](const Sample&, const ForceModel<Real>& force) {
    for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
      const Motions motions = random_motions<Real>(seed);
      const Wrenches w = wrenches(force, motions);
      Real total = 0, scale = 1;
      std::vector<Vector> dp, dphi;
      for (std::size_t i = 0; i < motions.size(); ++i) {
        total += w[i].force.dot(motions[i].velocity) + w[i].torque.dot(motions[i].angular_velocity);
        scale += w[i].force.norm() + w[i].torque.norm();
        dp.push_back(motions[i].velocity);
        dphi.push_back(motions[i].angular_velocity);
      }
      const Real power = force.power(instant, motions);
      EXPECT_NEAR(double(total + slope(force, motions, dp, dphi) - power), 0, 1e-12 * double(scale));
      if (!force.does_work()) {
        EXPECT_EQ(power, 0);
      }
    }
  });
}

// A force that does no work beside its potential is minus the gradient of it, in every direction by itself.
TEST_P(ForceLaw, ConservativeWrenchIsMinusTheGradient) {
  for_every_sample([](const Sample&, const ForceModel<Real>& force) {
    if (force.does_work()) return;
    for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
      const Motions motions = random_motions<Real>(seed);
      const Wrenches w = wrenches(force, motions);
      for (std::size_t i = 0; i < motions.size(); ++i) {
        if (bodies()[i].fixed) continue;
        for (int k = 0; k < 3; ++k) {
          std::vector<Vector> none(motions.size(), Vector::Zero()), unit = none;
          unit[i][k] = 1;
          EXPECT_NEAR(double(w[i].force[k] + slope(force, motions, unit, none)), 0, 1e-12) << "force on body " << i;
          EXPECT_NEAR(double(w[i].torque[k] + slope(force, motions, none, unit)), 0, 1e-12) << "torque on body " << i;
        }
      }
    }
  });
}

// Friction at rest is nothing: what is left of a force with a potential is minus its gradient.
TEST_P(ForceLaw, PowerVanishesAtRest) {
  for_every_sample([](const Sample&, const ForceModel<Real>& force) {
    Motions motions = random_motions<Real>(3);
    for (auto& m : motions) m.velocity = m.angular_velocity = Vector::Zero();
    EXPECT_EQ(force.power(instant, motions), 0);
  });
}

// internal() holds for exactly those forces that give no total force and no total torque about the world's origin.
TEST_P(ForceLaw, InternalForcesBalance) {
  for_every_sample([](const Sample&, const ForceModel<Real>& force) {
    bool balanced = true, exerts = false;
    for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
      const Motions motions = random_motions<Real>(seed);
      const Wrenches w = wrenches(force, motions);
      Vector f = Vector::Zero(), torque = Vector::Zero();
      for (std::size_t i = 0; i < motions.size(); ++i) {
        if (bodies()[i].fixed || bodies()[i].pinned) continue;  // what acts there is lost to the world
        exerts = exerts || !w[i].force.isZero(0);
        f += w[i].force;
        torque += motions[i].position.cross(w[i].force) + w[i].torque;
      }
      balanced = balanced && f.norm() < 1e-16L && torque.norm() < 1e-16L;
    }
    EXPECT_EQ(force.internal(), balanced && exerts);
  });
}

// The effects that effect_on() promises for each body hold in every state: no torque, the same force.
TEST_P(ForceLaw, EffectTellsTheTruth) {
  for_every_sample([](const Sample& sample, const ForceModel<Real>& force) {
    for (std::size_t i = 0; i < bodies().size(); ++i) {
      if (bodies()[i].fixed) continue;  // effects on fixed bodies are never read
      const Effect effect = force.effect_on(i);
      const bool named = std::count(sample.force.bodies.begin(), sample.force.bodies.end(), i) > 0;
      if (!named) {
        EXPECT_FALSE(effect.torque);
        ASSERT_TRUE(effect.constant_force);
        EXPECT_TRUE(effect.constant_force->isZero(0));
      }
      bool torque = false, varies = false;
      const Vector first = wrenches(force, random_motions<Real>(1))[i].force;
      for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
        const Wrench<Real> w = wrenches(force, random_motions<Real>(seed))[i];
        torque = torque || !w.torque.isZero(0);
        varies = varies || !(w.force - first).isZero(1e-17L);
        if (effect.constant_force) {
          EXPECT_LT((w.force - effect.constant_force->cast<Real>()).norm(), 1e-15L) << "body " << i;
        }
      }
      EXPECT_EQ(effect.torque, torque) << "body " << i;
      // A pivot takes up what acts on it: only for free bodies does it matter whether the force is constant.
      if (varies) {
        EXPECT_FALSE(effect.constant_force) << "body " << i;
      }
    }
  });
}

// A wrench that reads no velocity is the same where velocities are no numbers at all.
TEST_P(ForceLaw, ReadsVelocitiesWhereItSaysSo) {
  for_every_sample([](const Sample&, const ForceModel<Real>& force) {
    if (force.reads_velocity()) return;
    const Motions motions = random_motions<Real>(6);
    Motions still = motions;
    for (auto& m : still) {
      m.velocity.setConstant(std::numeric_limits<Real>::quiet_NaN());
      m.angular_velocity.setConstant(std::numeric_limits<Real>::quiet_NaN());
    }
    const Wrenches expected = wrenches(force, motions), w = wrenches(force, still);
    for (std::size_t i = 0; i < motions.size(); ++i) {
      EXPECT_EQ(w[i].force, expected[i].force) << "body " << i;
      EXPECT_EQ(w[i].torque, expected[i].torque) << "body " << i;
    }
  });
}

// A force that reads no rotation is the same where rotations and angular velocities are no numbers at all.
TEST_P(ForceLaw, ReadsRotationsWhereItSaysSo) {
  for_every_sample([](const Sample&, const ForceModel<Real>& force) {
    if (force.reads_rotation()) return;
    const Motions motions = random_motions<Real>(6);
    Motions blind = motions;
    for (auto& m : blind) {
      m.rotation.setConstant(std::numeric_limits<Real>::quiet_NaN());
      m.angular_velocity.setConstant(std::numeric_limits<Real>::quiet_NaN());
    }
    const Wrenches expected = wrenches(force, motions), w = wrenches(force, blind);
    for (std::size_t i = 0; i < motions.size(); ++i) {
      EXPECT_EQ(w[i].force, expected[i].force) << "body " << i;
      EXPECT_EQ(w[i].torque, expected[i].torque) << "body " << i;
    }
    EXPECT_EQ(force.potential_energy(blind), force.potential_energy(motions));
    if (force.does_work()) {
      EXPECT_EQ(force.power(instant, blind), force.power(instant, motions));
    }
  });
}

// A wrench is added to what other forces have left there.
TEST_P(ForceLaw, AddsToTheAccumulators) {
  for_every_sample([](const Sample&, const ForceModel<Real>& force) {
    const Motions motions = random_motions<Real>(2);
    const Wrenches alone = wrenches(force, motions);
    Wrenches w(motions.size(), Wrench<Real>{Vector(1, 2, 3), Vector(-3, 2, 1)});
    force.add_wrench(instant, motions, w);
    for (std::size_t i = 0; i < motions.size(); ++i) {
      EXPECT_LT((w[i].force - alone[i].force - Vector(1, 2, 3)).norm(), 1e-17L);
      EXPECT_LT((w[i].torque - alone[i].torque - Vector(-3, 2, 1)).norm(), 1e-17L);
    }
  });
}

// A list of bodies is one force on each.
TEST_P(ForceLaw, OnSeveralBodiesIsTheSumOfEach) {
  for_every_sample([this](const Sample& sample, const ForceModel<Real>& force) {
    if (entry().kind.max_bodies != 0) return;
    const Motions motions = random_motions<Real>(4);
    const Wrenches all = wrenches(force, motions);
    Wrenches sum(motions.size());
    Real potential = 0, power = 0;
    for (const std::size_t i : sample.force.bodies) {
      ForceParameters one = sample.force;
      one.bodies = {i};
      const auto single = make_force<Real>(one, bodies());
      single->add_wrench(instant, motions, sum);
      potential += single->potential_energy(motions);
      power += single->power(instant, motions);
    }
    for (std::size_t i = 0; i < motions.size(); ++i) {
      EXPECT_LT((all[i].force - sum[i].force).norm() + (all[i].torque - sum[i].torque).norm(), 1e-17L);
    }
    EXPECT_NEAR(double(force.potential_energy(motions) - potential), 0, 1e-17);
    EXPECT_NEAR(double(force.power(instant, motions) - power), 0, 1e-17);
  });
}

// Space has no direction and no centre of its own: turn and shift everything, and the wrench turns with it.
TEST_P(ForceLaw, TurnsAndShiftsWithTheWorld) {
  for_every_sample([](const Sample& sample, const ForceModel<Real>& force) {
    // An exact half-integer rotation keeps the parameters, which are doubles, exact: a third of a turn about (1, 1, 1).
    Matrix r;
    r << 0, 0, 1, 1, 0, 0, 0, 1, 0;
    const Vector shift(0.5L, -2, 4);
    ForceParameters moved_force = sample.force;
    for (const std::string& key : sample.world_directions) {
      moved_force.values[key] = Vector3<double>(r.cast<double>() * sample.force.vector(key));
    }
    for (const std::string& key : sample.world_points) {
      moved_force.values[key] = Vector3<double>(r.cast<double>() * sample.force.vector(key) + shift.cast<double>());
    }
    const auto there = make_force<Real>(moved_force, bodies());
    for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
      const Motions here = random_motions<Real>(seed);
      Motions motions = here;
      for (auto& m : motions) {
        m = {r * m.position + shift, r * m.rotation, r * m.velocity, r * m.angular_velocity};
      }
      const Wrenches expected = wrenches(force, here), w = wrenches(*there, motions);
      for (std::size_t i = 0; i < motions.size(); ++i) {
        EXPECT_LT((w[i].force - r * expected[i].force).norm(), 1e-16L) << "force on body " << i;
        EXPECT_LT((w[i].torque - r * expected[i].torque).norm(), 1e-16L) << "torque on body " << i;
      }
      EXPECT_NEAR(double(there->power(instant, motions) - force.power(instant, here)), 0, 1e-15);
    }
  });
}

// Galileo: where nothing rests, the wrench is the same in uniform motion.
TEST_P(ForceLaw, IsTheSameInUniformMotionWhereNothingRests) {
  for_every_sample([](const Sample& sample, const ForceModel<Real>& force) {
    if (!sample.galilean) return;
    const Motions here = random_motions<Real>(5);
    Motions boosted = here;
    for (auto& m : boosted) m.velocity += Vector(3, -2, 1);
    const Wrenches expected = wrenches(force, here), w = wrenches(force, boosted);
    for (std::size_t i = 0; i < here.size(); ++i) {
      EXPECT_LT((w[i].force - expected[i].force).norm() + (w[i].torque - expected[i].torque).norm(), 1e-17L);
    }
  });
}

template <class S>
void expect_scalar(const Sample& sample, Real tolerance) {
  const auto force = make_force<S>(sample.force, bodies());
  const auto exact = make_force<Real>(sample.force, bodies());
  for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
    const auto motions = random_motions<S>(seed);
    Motions same;
    for (const auto& m : motions) {
      same.push_back({m.position.template cast<Real>(), m.rotation.template cast<Real>(),
                      m.velocity.template cast<Real>(), m.angular_velocity.template cast<Real>()});
    }
    const auto w = wrenches(*force, motions);
    const Wrenches expected = wrenches(*exact, same);
    for (std::size_t i = 0; i < w.size(); ++i) {
      EXPECT_LT((w[i].force.template cast<Real>() - expected[i].force).norm(),
                tolerance * (1 + expected[i].force.norm()));
      EXPECT_LT((w[i].torque.template cast<Real>() - expected[i].torque).norm(),
                tolerance * (1 + expected[i].torque.norm()));
    }
    const Real potential = exact->potential_energy(same), power = exact->power(instant, same);
    EXPECT_LT(std::abs(Real(force->potential_energy(motions)) - potential), tolerance * (1 + std::abs(potential)));
    EXPECT_LT(std::abs(Real(force->power(S(instant), motions)) - power), tolerance * (1 + std::abs(power)));
    EXPECT_EQ(force->does_work(), exact->does_work());
    EXPECT_EQ(force->internal(), exact->internal());
  }
}

TEST_P(ForceLaw, ScalarsAgreeToTheirPrecision) {
  for_every_sample([](const Sample& sample, const ForceModel<Real>&) {
    expect_scalar<float>(sample, 1e-5L);
    expect_scalar<double>(sample, 1e-14L);
  });
}

// The entry of a kind in the catalogue is true of the samples, so that the reader of scenarios checks what is there.
TEST_P(ForceLaw, KindDescribesItsParameters) {
  const ForceKind& kind = entry().kind;
  EXPECT_FALSE(kind.summary.empty());
  EXPECT_GE(kind.min_bodies, 1);
  EXPECT_TRUE(kind.max_bodies == 0 || kind.max_bodies >= kind.min_bodies);
  for (const Parameter& p : kind.parameters) {
    EXPECT_FALSE(p.meaning.empty()) << p.key;
    EXPECT_EQ(p.unit.empty(), std::holds_alternative<std::string>(p.value))
        << p.key << ": numbers have a unit, words none";
    if (const auto* text = std::get_if<std::string>(&p.value)) {
      EXPECT_EQ(std::count(p.choices.begin(), p.choices.end(), *text), 1) << p.key << ": the default is no choice";
    }
  }
  for_every_sample([&](const Sample& sample, const ForceModel<Real>&) {
    EXPECT_EQ(sample.force.values.size(), kind.parameters.size())
        << "the sample names a key that the kind does not have";
    EXPECT_GE(int(sample.force.bodies.size()), kind.min_bodies);
    if (kind.max_bodies != 0) {
      EXPECT_LE(int(sample.force.bodies.size()), kind.max_bodies);
    }
  });
}

// The catalogue itself.
TEST(ForceCatalogue, NamesAreUniqueAndFound) {
  for (const ForceEntry& e : force_catalogue()) EXPECT_EQ(find_force(e.kind.name), &e);
  EXPECT_EQ(find_force("no such force"), nullptr);
  EXPECT_THROW(make_force<double>({"no such force", {0}, {}}, bodies()), std::invalid_argument);
}

// Every sample belongs to a force that still exists.
TEST(ForceCatalogue, EverySampleIsOfTheCatalogue) {
  for (const Sample& s : samples()) EXPECT_NE(find_force(s.force.kind), nullptr) << s.force.kind;
}

// A spring of no length has no direction to push in; nothing may become NaN.
TEST(ForceCatalogue, EndsThatMeetGiveNoNaN) {
  for (const char* kind : {"spring", "damper"}) {
    for (const double rest_length : {0.0, 1.0}) {
      Values values{{"damping", 0.5}};
      if (std::string(kind) == "spring") values.insert({{"stiffness", 2.0}, {"rest_length", rest_length}});
      const auto force = make_force<double>(laws::force(kind, {a, b}, values), bodies());
      auto motions = random_motions<double>(1);
      motions[b].position = motions[a].position;
      for (const auto& w : wrenches(*force, motions)) EXPECT_TRUE(w.force.allFinite() && w.torque.allFinite()) << kind;
      EXPECT_TRUE(std::isfinite(force->power(0, motions))) << kind;
      EXPECT_TRUE(std::isfinite(force->potential_energy(motions))) << kind;
    }
  }
}

}  // namespace
}  // namespace polhode::laws::force_law_test
