// SPDX-License-Identifier: BSD-3-Clause
// Broad phases side by side in one run: ns per box per step at a fixed density, for every one of the catalogue and,
// where Debian's libraries are installed, Bullet's dynamic tree, FCL's two trees and ODE's sweep. The same boxes on the
// same paths, at speeds from none to twice the mean, so that the load of each step is much the same; the steps of all
// take turns, with the cost of passing the boxes to the library. The motion is run twice, and the faster
// counts for each step. Beside the median step stands the mean, which is what a run pays: work that is put off must be
// done some time.
//
// All do the same job: the pairs of each step are counted and compared with ours. Bullet hands over pairs of its fat
// boxes; those whose own boxes overlap are counted after the clock has stopped, which it is not charged for. The
// libraries that work in single precision may differ in a few.
//
//   broad_phase_benchmark [motion [n ...]]   motion: mean path of a step over the mean edge (default: 0.02)
#include "collision/broad_phase.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <string>
#include <unordered_map>
#include <vector>

#include "collision/broad/fat_boxes.hpp"
#include "experiments/broad_phase/flying_boxes.hpp"

#ifdef POLHODE_HAS_BULLET
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#endif
#ifdef POLHODE_HAS_FCL
#include "tests/benchmarks/peers/fcl_trees.hpp"
#endif
#ifdef POLHODE_HAS_ODE
#include <ode/ode.h>
#endif

namespace {

using polhode::Bounds;
using Vector = polhode::Vector3<double>;
using Clock = std::chrono::steady_clock;

using Gas = polhode::study::broad_phase::FlyingBoxes;

constexpr double filling = 0.1;  // share of the space that is filled

/// One way to find the pairs of a step.
class Contender {
 public:
  explicit Contender(std::string called) : name(std::move(called)) {}
  virtual ~Contender() = default;
  virtual std::size_t step(const Gas& gas) = 0;  ///< the number of pairs that it hands over
  /// The number of these that are pairs of boxes that overlap.
  virtual std::size_t true_pairs(const Gas&, std::size_t handed_over) { return handed_over; }
  std::string name;
};

class Ours final : public Contender {
 public:
  explicit Ours(const polhode::BroadPhaseEntry& entry) : Contender(entry.name), phase_(entry.make()) {}
  std::size_t step(const Gas& gas) override {
    phase_->update(gas.bounds());
    return phase_->pairs().size();
  }

 private:
  std::unique_ptr<polhode::BroadPhase> phase_;
};

#ifdef POLHODE_HAS_BULLET
class Bullet final : public Contender {
 public:
  Bullet() : Contender("Bullet btDbvtBroadphase") {}
  std::size_t step(const Gas& gas) override {
    for (std::size_t i = 0; i < gas.bounds().size(); ++i) {
      const btVector3 low = vector(gas.bounds()[i].min()), high = vector(gas.bounds()[i].max());
      if (i == proxies_.size()) {
        proxies_.push_back(broadphase_.createProxy(low, high, 0, nullptr, 1, -1, nullptr));
        number_[proxies_.back()] = i;
      } else {
        broadphase_.setAabb(proxies_[i], low, high, nullptr);
      }
    }
    broadphase_.calculateOverlappingPairs(nullptr);
    return static_cast<std::size_t>(broadphase_.getOverlappingPairCache()->getNumOverlappingPairs());
  }
  std::size_t true_pairs(const Gas& gas, std::size_t) override {
    const btBroadphasePairArray& pairs = broadphase_.getOverlappingPairCache()->getOverlappingPairArray();
    std::size_t count = 0;
    for (int k = 0; k < pairs.size(); ++k) {
      const Bounds &a = gas.bounds()[number_.at(pairs[k].m_pProxy0)], &b = gas.bounds()[number_.at(pairs[k].m_pProxy1)];
      count += (a.min().array() <= b.max().array()).all() && (b.min().array() <= a.max().array()).all();
    }
    return count;
  }

 private:
  static btVector3 vector(const Vector& v) { return {btScalar(v.x()), btScalar(v.y()), btScalar(v.z())}; }
  btDbvtBroadphase broadphase_;
  std::vector<btBroadphaseProxy*> proxies_;
  std::unordered_map<const btBroadphaseProxy*, std::size_t> number_;
};
#endif

#ifdef POLHODE_HAS_FCL
class Fcl final : public Contender {
 public:
  Fcl(const char* called, bool in_array) : Contender(called), in_array_(in_array) {}
  std::size_t step(const Gas& gas) override {
    if (!tree_) tree_ = polhode::peers::fcl_tree(plain(gas.half()), in_array_);
    return tree_->step(plain(gas.centre()));
  }

 private:
  static std::vector<double> plain(const std::vector<Vector>& vectors) {
    std::vector<double> numbers;
    numbers.reserve(3 * vectors.size());
    for (const Vector& v : vectors) numbers.insert(numbers.end(), {v.x(), v.y(), v.z()});
    return numbers;
  }
  bool in_array_;
  std::unique_ptr<polhode::peers::FclTree> tree_;
};
#endif

#ifdef POLHODE_HAS_ODE
class Ode final : public Contender {
 public:
  Ode() : Contender("ODE dSweepAndPruneSpace"), space_(dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ)) {}
  ~Ode() override { dSpaceDestroy(space_); }
  std::size_t step(const Gas& gas) override {
    if (geoms_.empty()) {
      for (const Vector& h : gas.half()) {
        geoms_.push_back(dCreateBox(space_, dReal(2 * h.x()), dReal(2 * h.y()), dReal(2 * h.z())));
      }
    }
    for (std::size_t i = 0; i < geoms_.size(); ++i) {
      const Vector& c = gas.centre()[i];
      dGeomSetPosition(geoms_[i], dReal(c.x()), dReal(c.y()), dReal(c.z()));
    }
    std::size_t pairs = 0;
    dSpaceCollide(space_, &pairs, [](void* data, dGeomID, dGeomID) { ++*static_cast<std::size_t*>(data); });
    return pairs;
  }

 private:
  dSpaceID space_;
  std::vector<dGeomID> geoms_;
};
#endif

std::vector<std::unique_ptr<Contender>> contenders(std::size_t n) {
  std::vector<std::unique_ptr<Contender>> all;
  constexpr std::size_t most_for_all_pairs = 20000;
  for (const auto& entry : polhode::broad_phase_catalogue()) {
    if (entry.name != "all_pairs" || n <= most_for_all_pairs) all.push_back(std::make_unique<Ours>(entry));
  }
#ifdef POLHODE_HAS_BULLET
  all.push_back(std::make_unique<Bullet>());
#endif
#ifdef POLHODE_HAS_FCL
  all.push_back(std::make_unique<Fcl>("FCL DynamicAABBTree", false));
  all.push_back(std::make_unique<Fcl>("FCL DynamicAABBTree_Array", true));
#endif
#ifdef POLHODE_HAS_ODE
  all.push_back(std::make_unique<Ode>());
#endif
  return all;
}

struct Result {
  std::string name;
  double median = 0, mean = 0;  // ns per box and step
  double pairs = 0;             // pairs per box, as handed over
  std::size_t most_wrong = 0;   // true pairs more or fewer than the first one's, in any step
};

struct Measurement {
  std::vector<Result> results;
  double left = 0;  // share of boxes that leave their fat box in a step
};

double median(std::vector<double>& numbers) {
  const auto middle = numbers.begin() + std::ptrdiff_t(numbers.size() / 2);
  std::nth_element(numbers.begin(), middle, numbers.end());
  return *middle;
}

Measurement measure(std::size_t n, double motion) {
  constexpr std::size_t warm = 40, rounds = 2;  // number of steps after which most boxes have left their first margins
  const std::size_t steps = std::clamp<std::size_t>(1000000 / n, 30, 400);
  std::vector<std::vector<double>> ns;  // time of a step per box, for each contender
  Measurement m;
  for (std::size_t round = 0; round < rounds; ++round) {
    Gas gas(n, filling, motion, 1);
    const auto all = contenders(n);
    ns.resize(all.size(), std::vector<double>(steps, std::numeric_limits<double>::infinity()));
    if (round == 0) {
      for (const auto& c : all) m.results.push_back({c->name});
    }
    polhode::broad::FatBoxes fat;
    for (std::size_t k = 0; k < warm + steps; ++k) {
      fat.update(gas.bounds());
      std::size_t expected = 0;
      for (std::size_t c = 0; c < all.size(); ++c) {
        const auto start = Clock::now();
        const std::size_t found = all[c]->step(gas);
        const double s = std::chrono::duration<double>(Clock::now() - start).count();
        const std::size_t truly = all[c]->true_pairs(gas, found);
        if (c == 0) expected = truly;
        Result& r = m.results[c];
        r.most_wrong = std::max(r.most_wrong, truly > expected ? truly - expected : expected - truly);
        if (k < warm) continue;
        ns[c][k - warm] = std::min(ns[c][k - warm], 1e9 * s / double(n));
        r.pairs += double(found) / double(n * steps * rounds);
      }
      if (k >= warm) m.left += double(fat.left().size()) / double(n * steps * rounds);
      gas.step();
    }
  }
  for (std::size_t c = 0; c < ns.size(); ++c) {
    m.results[c].mean = std::accumulate(ns[c].begin(), ns[c].end(), 0.0) / double(steps);
    m.results[c].median = median(ns[c]);
  }
  return m;
}

/// Ours over the best of theirs, by the median step and by the mean.
void print_ratio(const std::vector<Result>& results, const std::string& ours, const std::vector<std::string>& theirs,
                 double goal) {
  const auto best = [&](const std::vector<std::string>& names, double Result::*ns) {
    double least = 0;
    for (const Result& r : results) {
      if (std::find(names.begin(), names.end(), r.name) != names.end() && (least == 0 || r.*ns < least)) least = r.*ns;
    }
    return least;
  };
  const double step = best(theirs, &Result::median), mean = best(theirs, &Result::mean);
  if (step == 0) return;
  std::string names = theirs[0];
  for (std::size_t k = 1; k < theirs.size(); ++k) names += ", " + theirs[k];
  fmt::print("  {} / {}: {:.3f} by the median, {:.3f} by the mean (goal {:.2f})\n", ours, names,
             best({ours}, &Result::median) / step, best({ours}, &Result::mean) / mean, goal);
}

}  // namespace

int main(int argc, char** argv) {
  const double motion = argc > 1 ? std::atof(argv[1]) : 0.02;
  std::vector<std::size_t> counts;
  for (int i = 2; i < argc; ++i) counts.push_back(static_cast<std::size_t>(std::atof(argv[i])));
  if (counts.empty()) counts = {1000, 10000, 100000};
#ifdef POLHODE_HAS_ODE
  dInitODE2(0);
#else
  fmt::print("ODE: skipped, because libode-dev is not installed\n");
#endif
#ifndef POLHODE_HAS_BULLET
  fmt::print("Bullet: skipped, because libbullet-dev is not installed\n");
#endif
#ifndef POLHODE_HAS_FCL
  fmt::print("FCL: skipped, because libfcl-dev is not installed\n");
#endif
  std::map<std::string, std::vector<double>> growth;
  for (const std::size_t n : counts) {
    const auto [results, left] = measure(n, motion);
    fmt::print("n = {}, a step is {} of an edge in the mean; {:.1f} % of our fat boxes are left in a step\n", n, motion,
               100 * left);
    fmt::print("  {:<30} {:>10} {:>10} {:>10} {:>16}\n", "ns per box per step", "median", "mean", "pairs/box",
               "true ones differ");
    for (const Result& r : results) {
      fmt::print("  {:<30} {:10.1f} {:10.1f} {:10.4f} {:16}\n", r.name, r.median, r.mean, r.pairs, r.most_wrong);
    }
    for (const Result& r : results) growth[r.name].push_back(r.mean);
    print_ratio(results, "uniform_grid",
                {"Bullet btDbvtBroadphase", "FCL DynamicAABBTree", "FCL DynamicAABBTree_Array"}, 0.45);
    print_ratio(results, "bvh", {"FCL DynamicAABBTree_Array"}, 0.7);
    print_ratio(results, "sweep_and_prune", {"ODE dSweepAndPruneSpace"}, 0.6);
  }
  if (counts.size() < 2) return 0;
  fmt::print("growth of a step's mean time as a power of n, from the first n to the last that was run\n");
  for (const auto& [name, ns] : growth) {
    if (ns.size() < 2) continue;
    const double ratio = double(counts[ns.size() - 1]) / double(counts[0]);
    fmt::print("  {:<30} {:10.2f}\n", name, 1 + std::log(ns.back() / ns.front()) / std::log(ratio));
  }
  return 0;
}
