// SPDX-License-Identifier: BSD-3-Clause
// The response `simultaneous`: all contacts of an island at once, by Poisson's hypothesis (Glocker & Pfeiffer,
// "Multiple impacts with friction in rigid multibody systems", 1995; Anitescu & Potra, 1997).
//
// Compression: v'·n >= min(wanted, 0) ⟂ j·n >= 0, with friction. Expansion: each contact gives back ε of its
// compression, and where anything still approaches, a second problem of the same kind adds to it. The normals are a
// linear complementarity problem, solved to the end; friction alternates with it: given the normal impulses, the
// tangential ones by Gauss–Seidel in Coulomb's cone, and again, until neither changes. Where 50 rounds do not settle,
// Gauss–Seidel goes on, normal and tangents of each contact in turn; what it has not settled after 5000 sweeps is drawn
// towards the answer without friction as far as energy demands. Without friction the two phases never give energy: the
// second ends no higher than the impulses of the first taken twice, which give none. Where friction makes them,
// expansion is cut back to what gives none.
//
// Newton's cradle: one ball in sends all out: of three the velocities −1/3, 2/3, 2/3; of five −3/5 and four times 2/5.
// The matrix is dense: cost and memory grow with the square of an island's contacts and more; it is for hundreds.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "collision/response.hpp"
#include "collision/response/complementarity.hpp"
#include "collision/response/contact_frame.hpp"
#include "collision/response/energy_guard.hpp"
#include "collision/response/friction_cone.hpp"
#include "collision/response/islands.hpp"
#include "collision/response/position_correction.hpp"

namespace polhode::inline collision::inline response {
namespace {

using Eigen::Index;

class Simultaneous final : public Response {
 public:
  void resolve(std::span<ImpulseBody> bodies, std::span<ImpulseContact> contacts, double step) override {
    for (ImpulseContact& c : contacts) c.impulse.setZero();
    islands_.build(bodies, contacts);
    for (std::size_t k = 0; k < islands_.count(); ++k) resolve_island(bodies, contacts, islands_.contacts(k));
    if (step != 0) position_correction_.undo(bodies, contacts);
  }

 private:
  static constexpr int most_rounds = 50, most_sweeps = 50, last_sweeps = 5000;
  static constexpr double settled = 1e-13;  ///< change that counts as none, over the largest impulse

  /// A contact in its own axes: number i has the normal i, and the tangents m + 2 i and m + 2 i + 1.
  struct Point {
    ContactFrame frame;
    double friction, wanted, restitution;
    FrictionCone<double> cone;
  };

  void resolve_island(std::span<ImpulseBody> bodies, std::span<ImpulseContact> contacts,
                      std::span<const std::uint32_t> members) {
    const Index m = Index(members.size()), n = 3 * m;
    reserve(n);
    assemble(bodies, contacts, members);
    const auto a = matrix_.topLeftCorner(n, n);
    auto v = velocity_.head(n), x = phase_.head(n), total = total_.head(n);
    auto given = given_.head(m);
    for (Index i = 0; i < m; ++i) {  // share of the compression that a contact gives back
      const ImpulseContact& c = contacts[members[std::size_t(i)]];
      double& e = points_[std::size_t(i)].restitution;
      if (c.wanted < 0) e = 0;
      // The part of the approach that a force has added since is not reflected.
      if (c.approach < 0 && v[i] < c.approach) e *= c.approach / v[i];
    }
    given.setZero();
    const double taken = solve_phase(m);
    total = x;
    for (Index i = 0; i < m; ++i) given[i] = points_[std::size_t(i)].restitution * x[i];
    if ((given.array() > 0).any()) {
      auto between = between_.head(n);
      between = v;
      change_.head(m).noalias() = a.topLeftCorner(m, m) * given;
      const double back = given.dot(v.head(m) + 0.5 * change_.head(m));
      v.noalias() += a.leftCols(m) * given;
      const double gain = taken + back + solve_phase(m);
      x.head(m) += given;
      total += share_without_gain(std::min(taken, 0.0), x.dot(between), gain) * x;
    }
    for (Index i = 0; i < m; ++i) {
      ImpulseContact& c = contacts[members[std::size_t(i)]];
      const ContactFrame& f = points_[std::size_t(i)].frame;
      c.impulse = total[i] * f.normal + total[m + 2 * i] * f.tangent + total[m + 2 * i + 1] * f.bitangent;
      bodies[c.a].push(c.point, c.impulse);
      bodies[c.b].push(c.point, -c.impulse);
    }
  }

  void reserve(Index n) {
    if (matrix_.rows() >= n) return;
    matrix_.resize(n, n);
    for (Eigen::VectorXd* v :
         {&velocity_, &phase_, &total_, &given_, &between_, &change_, &smooth_, &constant_, &last_})
      v->resize(n);
  }

  /// Sets the velocities at the contacts and their response to impulses.
  void assemble(std::span<const ImpulseBody> bodies, std::span<const ImpulseContact> contacts,
                std::span<const std::uint32_t> members) {
    const Index m = Index(members.size());
    points_.clear();
    for (const std::uint32_t number : members) {
      const ImpulseContact& c = contacts[number];
      points_.push_back({contact_frame(c.normal), c.friction, std::min(c.wanted, 0.0), c.restitution, {}});
    }
    const auto store = [&](auto&& column, Index i, const Vector3<double>& u) {
      const ContactFrame& f = points_[std::size_t(i)].frame;
      column[i] = f.normal.dot(u);
      column[m + 2 * i] = f.tangent.dot(u);
      column[m + 2 * i + 1] = f.bitangent.dot(u);
    };
    for (Index j = 0; j < m; ++j) {
      const ImpulseContact& c = contacts[members[std::size_t(j)]];
      const ImpulseBody &a = bodies[c.a], &b = bodies[c.b];
      const ContactFrame& f = points_[std::size_t(j)].frame;
      store(velocity_, j, a.velocity_at(c.point) - b.velocity_at(c.point));
      for (int axis = 0; axis < 3; ++axis) {
        const Vector3<double>& impulse = axis == 0 ? f.normal : axis == 1 ? f.tangent : f.bitangent;
        ImpulseBody pushed_a = a, pushed_b = b;
        pushed_a.velocity.setZero();
        pushed_a.angular_velocity.setZero();
        pushed_b.velocity.setZero();
        pushed_b.angular_velocity.setZero();
        pushed_a.push(c.point, impulse);
        pushed_b.push(c.point, -impulse);
        for (Index i = 0; i < m; ++i) {
          const ImpulseContact& d = contacts[members[std::size_t(i)]];
          Vector3<double> u = Vector3<double>::Zero();
          if (d.a == c.a) u += pushed_a.velocity_at(d.point);
          if (d.a == c.b) u += pushed_b.velocity_at(d.point);
          if (d.b == c.a) u -= pushed_a.velocity_at(d.point);
          if (d.b == c.b) u -= pushed_b.velocity_at(d.point);
          store(matrix_.col(axis == 0 ? j : m + 2 * j + axis - 1), i, u);
        }
      }
    }
    // Symmetric to the last digit, as the pivots take it to be.
    for (Index j = 0; j < 3 * m; ++j) {
      for (Index i = 0; i < j; ++i) matrix_(i, j) = matrix_(j, i) = 0.5 * (matrix_(i, j) + matrix_(j, i));
    }
    for (Index i = 0; i < m; ++i) {
      const Index t = m + 2 * i;
      points_[std::size_t(i)].cone = FrictionCone<double>(matrix_(t, t), matrix_(t, t + 1), matrix_(t + 1, t + 1));
    }
  }

  /// Finds the impulses `phase_` of a phase, in which `given_` normal impulses have been, and the velocities after it.
  /// Gives the gain of kinetic energy.
  double solve_phase(Index m) {
    const Index n = 3 * m;
    const auto a = matrix_.topLeftCorner(n, n);
    auto v = velocity_.head(n), x = phase_.head(n);
    x.setZero();
    solve_normals(m);
    double gain = gain_of(x, n);
    if (std::any_of(points_.begin(), points_.end(), [](const Point& p) { return p.friction > 0; })) {
      smooth_.head(n) = x;
      bool rests = false;
      for (int round = 0; round < most_rounds && !rests; ++round) {
        last_.head(n) = x;
        solve_tangents(m);
        solve_normals(m);
        rests = (x - last_.head(n)).cwiseAbs().maxCoeff() <= settled * x.cwiseAbs().maxCoeff();
      }
      for (int round = 0; round < last_sweeps && !rests; ++round) rests = sweep(m, true);
      for (Index i = 0; i < m; ++i) {
        const double reach = radius(i), length = std::hypot(x[m + 2 * i], x[m + 2 * i + 1]);
        if (length > reach) x.segment(m + 2 * i, 2) *= reach / length;
      }
      const double smooth_gain = gain;
      gain = gain_of(x, n);
      if (gain > 0) {
        change_.head(n).noalias() = a * smooth_.head(n);
        change_.head(n) += v;
        const double slope = (x - smooth_.head(n)).dot(change_.head(n));
        const double s = share_without_gain(std::min(smooth_gain, 0.0), slope, gain);
        x = smooth_.head(n) + s * (x - smooth_.head(n));
        gain = gain_of(x, n);
      }
    }
    v.noalias() += a * x;
    return gain;
  }

  template <class Impulses>
  double gain_of(const Impulses& x, Index n) {
    change_.head(n).noalias() = matrix_.topLeftCorner(n, n) * x;
    return x.dot(velocity_.head(n) + 0.5 * change_.head(n));
  }

  double radius(Index i) const { return points_[std::size_t(i)].friction * (given_[i] + phase_[i]); }

  /// The normal impulses, of the tangential ones.
  void solve_normals(Index m) {
    const auto a = matrix_.topLeftCorner(3 * m, 3 * m);
    auto b = constant_.head(m);
    b.noalias() = a.topRightCorner(m, 2 * m) * phase_.segment(m, 2 * m);
    for (Index i = 0; i < m; ++i) b[i] += velocity_[i] - points_[std::size_t(i)].wanted;
    normals_.solve(a.topLeftCorner(m, m), b, phase_.head(m));
  }

  /// The tangential impulses, of the normal ones.
  void solve_tangents(Index m) {
    for (int n = 0; n < most_sweeps && !sweep(m, false); ++n) continue;
  }

  /// One of Gauss–Seidel, over the tangential impulses, and over the normal ones too. True: hardly anything changed.
  bool sweep(Index m, bool normals) {
    const auto x = phase_.head(3 * m);
    const auto velocity = [&](Index i) { return velocity_[i] + matrix_.col(i).head(3 * m).dot(x); };
    double change = 0;
    const auto set = [&](Index i, double impulse) {
      change = std::max(change, std::abs(impulse - phase_[i]));
      phase_[i] = impulse;
    };
    for (Index i = 0; i < m; ++i) {
      const Point& p = points_[std::size_t(i)];
      if (normals && matrix_(i, i) > 0) set(i, std::max(0.0, phase_[i] + (p.wanted - velocity(i)) / matrix_(i, i)));
      const Index t = m + 2 * i, b = t + 1;
      const Tangential<double> next = p.cone.step({phase_[t], phase_[b]}, {velocity(t), velocity(b)}, radius(i));
      set(t, next.t);
      set(b, next.b);
    }
    return change <= settled * x.cwiseAbs().maxCoeff();
  }

  Islands islands_;
  std::vector<Point> points_;
  Eigen::MatrixXd matrix_;
  Eigen::VectorXd velocity_;  ///< relative velocities at the contacts, m/s
  Eigen::VectorXd phase_;     ///< impulses of the present phase, N s
  Eigen::VectorXd total_;     ///< impulses of both phases, N s
  Eigen::VectorXd given_;     ///< impulses of the expansion, N s
  Eigen::VectorXd between_;   ///< velocities between the phases, m/s
  Eigen::VectorXd change_, smooth_, constant_, last_;
  Complementarity normals_;
  PositionCorrection position_correction_;
};

}  // namespace

ResponseEntry simultaneous() {
  return {
      "simultaneous",
      "Newton–Poisson: compression and expansion, each a complementarity problem of all contacts, with Coulomb's cone",
      [] { return std::unique_ptr<Response>(new Simultaneous); }};
}

}  // namespace polhode::collision::response
