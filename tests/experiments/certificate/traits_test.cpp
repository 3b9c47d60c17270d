// SPDX-License-Identifier: BSD-3-Clause
// The measures of a certificate on maps whose traits are known, and on methods whose declaration is changed.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "experiments/certificate/certificate.hpp"
#include "experiments/certificate/order_finding.hpp"
#include "experiments/certificate/symplecticity.hpp"
#include "experiments/study/run/run.hpp"
#include "tests/laws/problems.hpp"
#include "tests/laws/reference_flow.hpp"

namespace polhode::study::certificate::traits_test {
namespace {

using Real = long double;

std::vector<Formulation> formulations() {
  std::vector<Formulation> all;
  for (const auto o : {Orientation::quaternion, Orientation::matrix}) {
    for (const auto a : {AngularState::velocity_world, AngularState::velocity_body, AngularState::momentum_world}) {
      all.push_back({o, a});
    }
  }
  return all;
}

double defect_of(const Problem& problem, const Formulation& f,
                 const std::function<void(const System<Real>&, VectorX<Real>&)>& move) {
  const auto system = make_system<Real>(problem, f);
  const PhaseSpace<Real> space(*system);
  const FlatMap<Real> map = [&](VectorX<Real>& y) {
    move(*system, y);
    return true;
  };
  return symplecticity_defect<Real>(space, map, space.generic(), best_increment<Real>).value_or(-1);
}

void flow(const System<Real>& system, VectorX<Real>& y, Real h) { y = laws::reference_flow(system, y, 0, h, 100); }

// The flow of a system whose forces have a potential is symplectic; with friction it is not.
TEST(Symplecticity, OfTheExactFlowIsRoundOff) {
  const Problem bodies[] = {laws::free_top(), laws::heavy_top(), laws::projectile(false), laws::two_bodies()};
  for (const Problem& problem : bodies) {
    for (const Formulation& f : formulations()) {
      EXPECT_LT(defect_of(problem, f, [](const auto& s, auto& y) { flow(s, y, 0.1L); }), 1e-14);
    }
  }
  EXPECT_GT(defect_of(laws::projectile(true), {}, [](const auto& s, auto& y) { flow(s, y, 0.1L); }), 1e-3);
}

// Likewise on the states at which joints are closed.
TEST(Symplecticity, OfTheExactFlowOfJointedBodiesIsRoundOff) {
  EXPECT_LT(defect_of(laws::jointed_rods(), {}, [](const auto& s, auto& y) { flow(s, y, 0.1L); }), 1e-14);
  const auto euler = [](const System<Real>& s, VectorX<Real>& y) {
    VectorX<Real> rate(y.size());
    s.rate(0, y.data(), rate.data());
    y += 0.01L * rate;
  };
  EXPECT_GT(defect_of(laws::jointed_rods(), {}, euler), 1e-6);
}

// Left and right turns of the whole body lift to symplectic maps; a turn of the attitude alone, which leaves L in the
// world as it is, is none: ⟨π, ξ × ξ⟩ must be in the form for that.
TEST(Symplecticity, TellsALiftedRotationFromATurnOfTheAttitude) {
  const Formulation f{Orientation::quaternion, AngularState::momentum_world};
  const Quaternion<Real> turn = Quaternion<Real>(0.8L, 0.2L, -0.3L, 0.1L).normalized();
  const auto turned = [&](bool lifted) {
    return [&turn, lifted](const System<Real>& system, VectorX<Real>& y) {
      const Layout::Slot& slot = system.layout().slots[0];
      const Quaternion<Real> q = y.segment<4>(slot.orientation);
      y.segment<4>(slot.orientation) = product<Real>(turn, q);
      if (lifted) y.segment<3>(slot.angular) = rotation_matrix<Real>(turn) * Vector3<Real>(y.segment<3>(slot.angular));
    };
  };
  EXPECT_LT(defect_of(laws::heavy_top(), f, turned(true)), 1e-15);
  EXPECT_GT(defect_of(laws::heavy_top(), f, turned(false)), 1e-2);
}

TEST(Symplecticity, OfAScalingIsWhatItScales) {
  // p ← 1.1 p multiplies ω of the translation by 1.1; π stays: the defect is 0.1 of that part.
  const double defect = defect_of(laws::free_top(), {}, [](const System<Real>& system, VectorX<Real>& y) {
    y.segment<3>(system.layout().slots[0].velocity) *= 1.1L;
  });
  EXPECT_GT(defect, 0.03);
  EXPECT_LT(defect, 0.1);
}

TEST(PhaseSpace, GoesThereAndBack) {
  for (const Formulation& f : formulations()) {
    const auto system = make_system<Real>(laws::five_bodies(), f);
    const PhaseSpace<Real> space(*system);
    const auto from = space.start(), to = space.generic();
    const VectorX<Real> by = space.coordinates(from, to);
    EXPECT_GT(by.cwiseAbs().maxCoeff(), 0.1L);
    EXPECT_LT(space.coordinates(to, space.moved(from, by)).cwiseAbs().maxCoeff(), 1e-17L);
    EXPECT_LT(space.coordinates(to, space.point(space.state(to))).cwiseAbs().maxCoeff(), 1e-16L);
  }
}

// Certificates.

StudyView small_study(const std::string& method) {
  StudyView study;
  const auto add = [&](const std::string& name, std::vector<double> steps, double t_end) {
    const Scenario scenario = ScenarioSource::open(name).resolve();
    if (study.scenarios.empty() || study.scenarios.back().name != name) study.scenarios.push_back(scenario);
    for (const double h : steps) {
      RunRecord run{.id = "", .config = {}, .result = {}};
      run.config.scenario = name;
      run.config.integrator = method;
      run.config.dt = h;
      run.config.t_end = t_end;
      run.config.reference = t_end <= 2;
      run.result = carry_out(run.config, scenario, {}, nullptr);
      study.runs.push_back(std::move(run));
    }
  };
  add("hairer_vilmart", {0.1, 0.05, 0.025, 0.0125, 0.00625}, 1);
  add("hairer_vilmart", {0.1}, 100);
  add("lagrange_top", {0.008, 0.004, 0.002, 0.001, 0.0005}, 0.5);
  return study;
}

/// The verdicts of a method as it would declare itself.
std::map<std::string, Finding> verdicts(const std::string& method,
                                        const std::function<void(Declaration&)>& change = {}) {
  const StudyView study = small_study(method);
  IntegratorEntry entry = *find_integrator(method);
  if (change) change(entry.declaration);
  const auto certificates = certify(study, measures_of(study), [&](const std::string&) { return &entry; });
  std::map<std::string, Finding> found;
  for (const Finding& finding : certificates.at(0).findings) found[finding.trait] = finding;
  return found;
}

TEST(Certificate, WhatIsDeclaredRightHolds) {
  const auto splitting = verdicts("mclachlan_reich");
  for (const char* trait : {"order_free", "order_forced", "order_time_dependent", "time_reversibility",
                            "time_reversibility_many", "symplecticity", "angular_momentum", "casimir", "orientation"}) {
    EXPECT_EQ(splitting.at(trait).verdict, TraitVerdict::holds) << trait << ": " << splitting.at(trait).note;
  }
  EXPECT_EQ(splitting.at("energy_free").verdict, TraitVerdict::absent);
  EXPECT_LT(*splitting.at("symplecticity").measured, 1e-14);

  const auto textbook = verdicts("rk4");
  for (const char* trait : {"order_free", "order_forced", "order_time_dependent", "evaluations_per_step"}) {
    EXPECT_EQ(textbook.at(trait).verdict, TraitVerdict::holds) << trait << ": " << textbook.at(trait).note;
  }
  for (const char* trait : {"time_reversibility", "symplecticity", "energy_free", "casimir", "orientation"}) {
    EXPECT_EQ(textbook.at(trait).verdict, TraitVerdict::absent) << trait;
  }
  EXPECT_NE(textbook.at("symplecticity").note.find("h^5"), std::string::npos) << textbook.at("symplecticity").note;
}

TEST(Certificate, AWrongDeclarationDoesNotHold) {
  const auto wrong = verdicts("rk4", [](Declaration& d) {
    d.order = 3;
    d.free_order = 5;
    d.evaluations_per_step = 3;
    d.symmetric = d.symplectic = d.lie_group = true;
    d.conserves_energy = d.conserves_momentum = d.conserves_casimir = true;
  });
  for (const auto& [trait, finding] : wrong) {
    if (trait == "energy_forced") continue;  // nothing is declared of it
    EXPECT_EQ(finding.verdict, TraitVerdict::does_not_hold) << trait << ": " << finding.note;
  }
}

TEST(Certificate, WhatIsNotDeclaredIsSeenToHold) {
  const auto silent = verdicts("mclachlan_reich", [](Declaration& d) {
    d.symmetric = d.symplectic = d.lie_group = false;
    d.conserves_momentum = d.conserves_casimir = false;
  });
  for (const char* trait : {"time_reversibility", "time_reversibility_many", "symplecticity", "angular_momentum",
                            "casimir", "orientation"}) {
    EXPECT_EQ(silent.at(trait).verdict, TraitVerdict::undeclared) << trait;
  }
}

TEST(OrderFinding, CountsWhatTheOrdersTendTo) {
  std::vector<LadderPoint> late, wrong;
  for (int k = 0; k < 7; ++k) {
    const double h = 0.1 * std::pow(0.5, k);
    late.push_back({h, std::pow(h, 4) + 300 * std::pow(h, 5.5), 0});
    wrong.push_back({h, std::pow(h, 4.5), 0});
  }
  const Finding tends = order_finding("order_free", false, 4, late);
  EXPECT_EQ(order_finding("order_free", false, 4, wrong).verdict, TraitVerdict::does_not_hold);
  EXPECT_EQ(order_finding("order_free", false, 3, late).verdict, TraitVerdict::does_not_hold);
  ASSERT_TRUE(tends.measured);
  EXPECT_NE(tends.verdict, TraitVerdict::undecided);
}

}  // namespace
}  // namespace polhode::study::certificate::traits_test
