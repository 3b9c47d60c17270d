// SPDX-License-Identifier: BSD-3-Clause
// The cost of `gjk` beside FCL's signed distance and libccd, on the same pairs in one run: the median of rounds in
// which all take turns. A library that the build did not find is skipped.
// Like for like: FCL's signed distance with witness points is libccd's GJK, and its EPA where the shapes overlap
// (GST_LIBCCD, FCL's default, with its default tolerances); ours gives distance, normal and witness points to
// round-off. libccd's boolean (ccdGJKIntersect) gives yes or no, as does ours; its ccdGJKPenetration depth, direction
// and position. Cold and warm are the same pairs; warm ones have moved a hundredth of a metre and of a radian since the
// last question, and use the memory of the pair. The peers have no memory of a pair.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "collision/narrow_phase.hpp"
#include "collision/shapes/box.hpp"
#include "collision/shapes/convex_hull.hpp"
#include "core/math/portable_random.hpp"

#ifdef POLHODE_HAS_FCL
#include "tests/benchmarks/peers/fcl.hpp"
#endif
#ifdef POLHODE_HAS_CCD
#include <ccd/ccd.h>
#include <ccd/quat.h>
#endif

namespace {

using namespace polhode;
using ShapePair = std::pair<ShapePointer, ShapePointer>;

constexpr int pair_count = 512, rounds = 21;

struct Placed {
  ShapePointer a, b;
  Pose at_a, at_b;
};

Pose placed(PortableRandom& random, double spread) { return {spread * random.uniform_vector(0, 1), random.rotation()}; }

ShapePointer random_box(PortableRandom& random) { return std::make_shared<Box>(random.uniform_vector(0.2, 1.2)); }

ShapePointer random_hull(PortableRandom& random) {
  std::vector<Vector3<double>> points;
  for (int i = 0; i < 32; ++i) points.push_back(random.direction());
  return std::make_shared<ConvexHull>(points);
}

/// Pairs that overlap, that do not, or both as they come.
std::vector<Placed> pairs(ShapePointer (*make)(PortableRandom&), int overlapping) {
  PortableRandom random(7);
  const auto narrow = find_narrow_phase("gjk")->make();
  std::vector<Placed> found;
  while (found.size() < pair_count) {
    const Placed p = {make(random), make(random), placed(random, 2.5), placed(random, 2.5)};
    const bool touch = narrow->overlap(*p.a, p.at_a, *p.b, p.at_b);
    if (overlapping < 0 || touch == (overlapping > 0)) found.push_back(p);
  }
  return found;
}

struct Rival {
  std::string name;
  std::function<void()> all_pairs;
  std::vector<double> ns{};
};

double median(std::vector<double> x) {
  std::nth_element(x.begin(), x.begin() + std::ptrdiff_t(x.size() / 2), x.end());
  return x[x.size() / 2];
}

/// Times the rivals in turns; prints each beside the last one, the peer.
void race(const std::string& question, std::vector<Rival> rivals) {
  for (int round = 0; round < rounds; ++round) {
    for (Rival& r : rivals) {
      const auto start = std::chrono::steady_clock::now();
      r.all_pairs();
      const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - start;
      r.ns.push_back(took.count() / pair_count);
    }
  }
  const double peer = median(rivals.back().ns);
  for (const Rival& r : rivals) {
    std::printf("%-34s %-14s %9.0f ns  %.3f\n", question.c_str(), r.name.c_str(), median(r.ns), median(r.ns) / peer);
  }
}

const NarrowPhase& ours() {
  static const auto narrow = find_narrow_phase("gjk")->make();
  return *narrow;
}

void distances(const std::vector<Placed>& pairs) {
  for (const Placed& p : pairs) benchmark::DoNotOptimize(ours().distance(*p.a, p.at_a, *p.b, p.at_b));
}
[[maybe_unused]] void overlaps(const std::vector<Placed>& pairs) {  // raced against libccd alone
  for (const Placed& p : pairs) benchmark::DoNotOptimize(ours().overlap(*p.a, p.at_a, *p.b, p.at_b));
}

/// Every call finds the pairs a hundredth of a metre and of a radian further on, there and back.
struct Coherent {
  std::vector<Placed> there, back;
  std::vector<PairMemory> memories;
  bool forth = false;

  explicit Coherent(const std::vector<Placed>& pairs) : there(pairs), back(pairs), memories(pairs.size()) {
    const Matrix3<double> turn = rotation_matrix(quaternion_from_rotation_vector<double>({0.004, -0.007, 0.006}));
    for (Placed& p : back) {
      p.at_b.rotation = turn * p.at_b.rotation;
      p.at_b.position += Vector3<double>(0.005, 0.004, -0.007);
    }
  }
  void operator()() {
    forth = !forth;
    const auto& now = forth ? there : back;
    for (std::size_t i = 0; i < now.size(); ++i) {
      const Placed& p = now[i];
      benchmark::DoNotOptimize(ours().distance(*p.a, p.at_a, *p.b, p.at_b, &memories[i]));
    }
  }
};

#ifdef POLHODE_HAS_FCL
peers::FclShape fcl_shape(const Shape& shape, const Pose& at) {
  peers::FclShape peer;
  for (int i = 0; i < 3; ++i) {
    peer.position[i] = at.position[i];
    for (int j = 0; j < 3; ++j) peer.rotation[3 * i + j] = at.rotation(i, j);
  }
  if (shape.tag() == ShapeTag::box) {
    const Vector3<double>& h = static_cast<const Box&>(shape).half_extents();
    peer.half_extents.assign(h.begin(), h.end());
    return peer;
  }
  const Polytope& p = static_cast<const ConvexHull&>(shape).polytope();
  for (const Vector3<double>& v : p.vertices) peer.vertices.insert(peer.vertices.end(), v.begin(), v.end());
  for (std::uint32_t f = 0; f < p.faces.size(); ++f) {
    peer.faces.push_back(int(p.faces[f].count));
    for (const Polytope::Corner& corner : p.corners_of(f)) peer.faces.push_back(int(corner.vertex));
  }
  peer.face_count = int(p.faces.size());
  return peer;
}

std::function<void()> fcl_distances(const std::vector<Placed>& pairs) {
  auto peer = std::make_shared<peers::FclPairs>();
  for (const Placed& p : pairs) peer->add(fcl_shape(*p.a, p.at_a), fcl_shape(*p.b, p.at_b));
  return [peer] { benchmark::DoNotOptimize(peer->distances()); };
}
#endif

#ifdef POLHODE_HAS_CCD
struct CcdBox {
  ccd_vec3_t half, position;
  ccd_quat_t rotation, inverse;
};

CcdBox ccd_box(const Shape& shape, const Pose& at) {
  CcdBox box;
  const Vector3<double>& h = static_cast<const Box&>(shape).half_extents();
  const Quaternion<double> q = quaternion_from_rotation_matrix<double>(at.rotation);
  ccdVec3Set(&box.half, h[0], h[1], h[2]);
  ccdVec3Set(&box.position, at.position[0], at.position[1], at.position[2]);
  ccdQuatSet(&box.rotation, q[1], q[2], q[3], q[0]);
  ccdQuatInvert2(&box.inverse, &box.rotation);
  return box;
}

void ccd_support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* v) {
  const auto* box = static_cast<const CcdBox*>(object);
  ccd_vec3_t d;
  ccdVec3Copy(&d, direction);
  ccdQuatRotVec(&d, &box->inverse);
  ccdVec3Set(v, std::copysign(ccdVec3X(&box->half), ccdVec3X(&d)), std::copysign(ccdVec3Y(&box->half), ccdVec3Y(&d)),
             std::copysign(ccdVec3Z(&box->half), ccdVec3Z(&d)));
  ccdQuatRotVec(v, &box->rotation);
  ccdVec3Add(v, &box->position);
}

std::function<void()> ccd_questions(const std::vector<Placed>& pairs, bool depth) {
  auto boxes = std::make_shared<std::vector<std::pair<CcdBox, CcdBox>>>();
  for (const Placed& p : pairs) boxes->push_back({ccd_box(*p.a, p.at_a), ccd_box(*p.b, p.at_b)});
  return [boxes, depth] {
    ccd_t ccd;
    CCD_INIT(&ccd);
    ccd.support1 = ccd.support2 = ccd_support;
    ccd.max_iterations = 100;
    ccd.epa_tolerance = 1e-9;
    for (const auto& [a, b] : *boxes) {
      ccd_real_t d = 0;
      ccd_vec3_t direction, position;
      if (depth) benchmark::DoNotOptimize(ccdGJKPenetration(&a, &b, &ccd, &d, &direction, &position));
      else benchmark::DoNotOptimize(ccdGJKIntersect(&a, &b, &ccd));
    }
  };
}
#endif

/// Questions to gjk and to the peers that the build found; the last rival is the one that ratios refer to.
void questions(const std::string& what, ShapePointer (*make)(PortableRandom&)) {
  for (const int overlapping : {0, 1, -1}) {
    const std::string set = what + (overlapping < 0 ? ", mixed" : overlapping ? ", overlapping" : ", apart");
    const auto p = pairs(make, overlapping);
    std::vector<Rival> rivals = {{"gjk cold", [&] { distances(p); }}, {"gjk warm", Coherent(p)}};
#ifdef POLHODE_HAS_FCL
    rivals.push_back({"FCL", fcl_distances(p)});
#endif
    race("signed distance, " + set, std::move(rivals));
#ifdef POLHODE_HAS_CCD
    if (what != "boxes") continue;
    race("overlap, " + set, {{"gjk", [&] { overlaps(p); }}, {"libccd", ccd_questions(p, false)}});
    if (overlapping == 1)
      race("depth, " + set, {{"gjk", [&] { distances(p); }}, {"libccd GJK+EPA", ccd_questions(p, true)}});
#endif
  }
}

}  // namespace

int main() {
#ifndef POLHODE_HAS_FCL
  std::puts("FCL skipped, because the build found no libfcl-dev");
#endif
#ifndef POLHODE_HAS_CCD
  std::puts("libccd skipped, because the build found no libccd-dev");
#endif
  std::puts(
      "median per pair, and its ratio to the last of each group; distances are signed, with normal and witness "
      "points;\n"
      "FCL's is by libccd, its default; libccd's overlap is ccdGJKIntersect, its depth ccdGJKPenetration");
  questions("boxes", random_box);
  questions("hulls of 32 points", random_hull);
}
