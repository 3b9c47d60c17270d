// SPDX-License-Identifier: BSD-3-Clause
// Three steps, named as Mirtich names them: a volume integral becomes a sum of integrals over faces (the divergence
// theorem), each of these an integral over the face's projection on a coordinate plane, and each of those a sum over
// its edges (Green's theorem).
#include "collision/shapes/polyhedron_mass.hpp"

#include <cmath>

namespace polhode::inline collision::inline shapes {

namespace {

/// Integrals over the projection on the plane of the axes α and β.
struct Projection {
  double one = 0, a = 0, b = 0, aa = 0, ab = 0, bb = 0, aaa = 0, aab = 0, abb = 0, bbb = 0;
};

Projection projection_integrals(const std::vector<Vector3<double>>& x, std::span<const Polytope::Corner> corners, int A,
                                int B) {
  Projection p;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector3<double>&u = x[corners[i].vertex], &v = x[corners[(i + 1) % corners.size()].vertex];
    const double a0 = u[A], b0 = u[B], a1 = v[A], b1 = v[B], da = a1 - a0, db = b1 - b0;
    const double a0_2 = a0 * a0, a0_3 = a0_2 * a0, a0_4 = a0_3 * a0, b0_2 = b0 * b0, b0_3 = b0_2 * b0, b0_4 = b0_3 * b0;
    const double a1_2 = a1 * a1, a1_3 = a1_2 * a1, b1_2 = b1 * b1, b1_3 = b1_2 * b1;
    const double C1 = a1 + a0, Ca = a1 * C1 + a0_2, Caa = a1 * Ca + a0_3, Caaa = a1 * Caa + a0_4;
    const double Cb = b1 * (b1 + b0) + b0_2, Cbb = b1 * Cb + b0_3, Cbbb = b1 * Cbb + b0_4;
    const double Cab = 3 * a1_2 + 2 * a1 * a0 + a0_2, Kab = a1_2 + 2 * a1 * a0 + 3 * a0_2;
    const double Caab = a0 * Cab + 4 * a1_3, Kaab = a1 * Kab + 4 * a0_3;
    const double Cabb = 4 * b1_3 + 3 * b1_2 * b0 + 2 * b1 * b0_2 + b0_3;
    const double Kabb = b1_3 + 2 * b1_2 * b0 + 3 * b1 * b0_2 + 4 * b0_3;
    p.one += db * C1;
    p.a += db * Ca;
    p.aa += db * Caa;
    p.aaa += db * Caaa;
    p.b += da * Cb;
    p.bb += da * Cbb;
    p.bbb += da * Cbbb;
    p.ab += db * (b1 * Cab + b0 * Kab);
    p.aab += db * (b1 * Caab + b0 * Kaab);
    p.abb += da * (a1 * Cabb + a0 * Kabb);
  }
  return {p.one / 2,  p.a / 6,    p.b / -6,   p.aa / 12,   p.ab / 24,
          p.bb / -12, p.aaa / 20, p.aab / 60, p.abb / -60, p.bbb / -20};
}

/// Integrals over the face itself; γ is the axis that the projection leaves out.
struct FaceIntegrals {
  double a, b, c, aa, bb, cc, aaa, bbb, ccc, aab, bbc, cca;
};

FaceIntegrals face_integrals(const Projection& p, double na, double nb, double nc, double w) {
  const double k1 = 1 / nc, k2 = k1 * k1, k3 = k2 * k1, k4 = k3 * k1;
  FaceIntegrals f{};
  f.a = k1 * p.a;
  f.b = k1 * p.b;
  f.c = -k2 * (na * p.a + nb * p.b + w * p.one);
  f.aa = k1 * p.aa;
  f.bb = k1 * p.bb;
  f.cc = k3 * (na * na * p.aa + 2 * na * nb * p.ab + nb * nb * p.bb + w * (2 * (na * p.a + nb * p.b) + w * p.one));
  f.aaa = k1 * p.aaa;
  f.bbb = k1 * p.bbb;
  f.ccc = -k4 * (na * na * na * p.aaa + 3 * na * na * nb * p.aab + 3 * na * nb * nb * p.abb + nb * nb * nb * p.bbb +
                 3 * w * (na * na * p.aa + 2 * na * nb * p.ab + nb * nb * p.bb) +
                 w * w * (3 * (na * p.a + nb * p.b) + w * p.one));
  f.aab = k1 * p.aab;
  f.bbc = -k2 * (na * p.abb + nb * p.bbb + w * p.bb);
  f.cca = k3 * (na * na * p.aaa + 2 * na * nb * p.aab + nb * nb * p.abb + w * (2 * (na * p.aa + nb * p.ab) + w * p.a));
  return f;
}

}  // namespace

// The integrals are taken about the middle of the vertices, in units of their spread, where nothing cancels or
// overflows.
MassProperties polyhedron_mass(const Polytope& polytope) {
  Eigen::AlignedBox3d around;
  for (const Vector3<double>& v : polytope.vertices) around.extend(v);
  const Vector3<double> middle = around.center();
  const double unit = around.sizes().maxCoeff();
  std::vector<Vector3<double>> x;
  for (const Vector3<double>& v : polytope.vertices) x.push_back((v - middle) / unit);

  double T0 = 0;
  Vector3<double> T1 = Vector3<double>::Zero(), T2 = T1, TP = T1;
  for (std::uint32_t k = 0; k < polytope.faces.size(); ++k) {
    const Vector3<double>& n = polytope.faces[k].normal;
    int C = 0;
    n.cwiseAbs().maxCoeff(&C);
    const int A = (C + 1) % 3, B = (C + 2) % 3;
    const auto corners = polytope.corners_of(k);
    const double w = -n.dot(x[corners[0].vertex]);
    const FaceIntegrals f = face_integrals(projection_integrals(x, corners, A, B), n[A], n[B], n[C], w);
    T0 += n[0] * (A == 0 ? f.a : B == 0 ? f.b : f.c);
    T1[A] += n[A] * f.aa;
    T1[B] += n[B] * f.bb;
    T1[C] += n[C] * f.cc;
    T2[A] += n[A] * f.aaa;
    T2[B] += n[B] * f.bbb;
    T2[C] += n[C] * f.ccc;
    TP[A] += n[A] * f.aab;
    TP[B] += n[B] * f.bbc;
    TP[C] += n[C] * f.cca;
  }
  T1 /= 2;
  T2 /= 3;
  TP /= 2;
  const Vector3<double> r = T1 / T0;
  Matrix3<double> inertia;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    inertia(i, i) = T2[j] + T2[k] - T0 * (r[j] * r[j] + r[k] * r[k]);
    inertia(i, j) = inertia(j, i) = -TP[i] + T0 * r[i] * r[j];
  }
  const double volume_unit = unit * unit * unit;
  return {T0 * volume_unit, middle + unit * r, inertia * (volume_unit * unit * unit)};
}

}  // namespace polhode::collision::shapes
