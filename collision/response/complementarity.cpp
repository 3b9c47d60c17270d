// SPDX-License-Identifier: BSD-3-Clause
#include "collision/response/complementarity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace polhode::inline collision::inline response {
namespace {

/// Relative to a diagonal element: the pivot below which a column counts as linearly dependent.
constexpr double dependent = 1e-11;
/// Relative to the terms that cancel in w: the rounding of w.
constexpr double rounding = 1e-13;

}  // namespace

bool Complementarity::factor_row(const Matrix& a, std::size_t row) {
  const auto r = Eigen::Index(row);
  const Eigen::Index i = basis_[row];
  double left = a(i, i);
  for (Eigen::Index k = 0; k < r; ++k) {
    double sum = a(i, basis_[std::size_t(k)]);
    for (Eigen::Index l = 0; l < k; ++l) sum -= lower_(r, l) * lower_(k, l);
    lower_(r, k) = sum / lower_(k, k);
    left -= lower_(r, k) * lower_(r, k);
  }
  if (!(left > dependent * a(i, i))) return false;
  lower_(r, r) = std::sqrt(left);
  return true;
}

/// Adds the column to the basis, unless it depends linearly on the basis. Returns whether it was added.
bool Complementarity::append(const Matrix& a, Eigen::Index i) {
  basis_.push_back(i);
  if (!factor_row(a, basis_.size() - 1)) {
    basis_.pop_back();
    return false;
  }
  carries_[std::size_t(i)] = 1;
  return true;
}

void Complementarity::remove(const Matrix& a, std::size_t place) {
  carries_[std::size_t(basis_[place])] = 0;
  basis_.erase(basis_.begin() + std::ptrdiff_t(place));
  for (std::size_t row = place; row < basis_.size(); ++row) {
    if (factor_row(a, row)) continue;
    // A part of independent columns is independent, but for rounding: let it join again.
    carries_[std::size_t(basis_[row])] = 0;
    basis_.erase(basis_.begin() + std::ptrdiff_t(row--));
  }
}

/// L x = x, and Lᵀ x = x.
void Complementarity::solve_lower(std::size_t count) {
  for (Eigen::Index k = 0; k < Eigen::Index(count); ++k) {
    for (Eigen::Index l = 0; l < k; ++l) x_[k] -= lower_(k, l) * x_[l];
    x_[k] /= lower_(k, k);
  }
}
void Complementarity::solve_upper(std::size_t count) {
  for (Eigen::Index k = Eigen::Index(count) - 1; k >= 0; --k) {
    for (Eigen::Index l = k + 1; l < Eigen::Index(count); ++l) x_[k] -= lower_(l, k) * x_[l];
    x_[k] /= lower_(k, k);
  }
}

/// Makes w zero on the basis, as far as j stays positive; who becomes zero leaves.
void Complementarity::settle(const Matrix& a, const Eigen::Ref<const Eigen::VectorXd>& b,
                             Eigen::Ref<Eigen::VectorXd> j) {
  while (!basis_.empty()) {
    for (std::size_t k = 0; k < basis_.size(); ++k) {
      double others = -b[basis_[k]];
      for (Eigen::Index i = 0; i < j.size(); ++i) {
        if (!carries_[std::size_t(i)] && j[i] != 0) others -= a(basis_[k], i) * j[i];
      }
      x_[Eigen::Index(k)] = others;
    }
    solve_lower(basis_.size());
    solve_upper(basis_.size());
    double reach = 1;
    std::size_t first = basis_.size();
    for (std::size_t k = 0; k < basis_.size(); ++k) {
      const double from = j[basis_[k]], to = x_[Eigen::Index(k)];
      if (to > 0) continue;
      const double share = from / (from - to);
      if (first == basis_.size() || share < reach) {
        reach = from > 0 ? share : 0;
        first = k;
      }
    }
    for (std::size_t k = 0; k < basis_.size(); ++k) {
      double& at = j[basis_[k]];
      at = first == basis_.size() ? x_[Eigen::Index(k)] : std::max(0.0, at + reach * (x_[Eigen::Index(k)] - at));
    }
    if (first == basis_.size()) return;
    j[basis_[first]] = 0;
    remove(a, first);
  }
}

bool Complementarity::solve(const Matrix& a, const Eigen::Ref<const Eigen::VectorXd>& b,
                            Eigen::Ref<Eigen::VectorXd> j) {
  const Eigen::Index size = b.size();
  if (lower_.rows() < size) {
    lower_.resize(size, size);
    x_.resize(size);
  }
  basis_.clear();
  basis_.reserve(std::size_t(size));
  carries_.assign(std::size_t(size), 0);
  barred_.assign(std::size_t(size), 0);
  for (Eigen::Index i = 0; i < size; ++i) {
    if (j[i] > 0 && !append(a, i)) j[i] = 0;
  }
  settle(a, b, j);
  for (Eigen::Index pivot = 0; pivot < 50 * size + 100; ++pivot) {
    Eigen::Index worst = -1;
    double least = 0;
    for (Eigen::Index i = 0; i < size; ++i) {
      if (carries_[std::size_t(i)] || barred_[std::size_t(i)] || !(a(i, i) > 0)) continue;
      double w = b[i], scale = std::abs(b[i]);
      for (Eigen::Index k = 0; k < size; ++k) {
        w += a(i, k) * j[k];
        scale += std::abs(a(i, k)) * j[k];
      }
      if (w < -rounding * scale && w < least) {
        least = w;
        worst = i;
      }
    }
    if (worst < 0) return true;
    bool joined = append(a, worst);
    while (!joined) {
      // It depends on the basis: its impulse takes the place of theirs, until one of them is zero.
      const std::size_t count = basis_.size();
      for (std::size_t k = 0; k < count; ++k) x_[Eigen::Index(k)] = -a(basis_[k], worst);
      solve_lower(count);
      solve_upper(count);
      double reach = std::numeric_limits<double>::infinity();
      std::size_t first = count;
      for (std::size_t k = 0; k < count; ++k) {
        if (!(x_[Eigen::Index(k)] < -dependent)) continue;
        const double share = j[basis_[k]] / -x_[Eigen::Index(k)];
        if (share < reach) {
          reach = share;
          first = k;
        }
      }
      if (first == count) break;
      for (std::size_t k = 0; k < count; ++k) {
        double& at = j[basis_[k]];
        at = std::max(0.0, at + reach * x_[Eigen::Index(k)]);
      }
      j[worst] += reach;
      j[basis_[first]] = 0;
      remove(a, first);
      joined = append(a, worst);
    }
    if (!joined) {
      barred_[std::size_t(worst)] = 1;
      continue;
    }
    const double before = j[worst];
    settle(a, b, j);
    // One that leaves at once gains nothing: rounding brought it in.
    if (before == 0 && j[worst] == 0) {
      barred_[std::size_t(worst)] = 1;
    } else {
      std::fill(barred_.begin(), barred_.end(), std::uint8_t(0));
    }
  }
  return false;
}

}  // namespace polhode::collision::response
