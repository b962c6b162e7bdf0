// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fairing/profile/polynomial_fit.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/curve/bernstein.h"
#include "core/solve/dense_solve.h"
#include "core/solve/nonnegative_least_squares.h"

namespace batten {
namespace {

constexpr int kMonotoneGrid = 200;  // As in 000 VI mended: the slope is bound at these many perimeters.
/// A positive profile stays above this share of the smallest datum: a radius must not reach zero.
constexpr double kPositiveShare = 0.1;

/// Chebyshev polynomials T_0..T_degree of x = 2f - 1: well conditioned where powers of f are not.
void chebyshevRow(double f, int degree, Eigen::Ref<Eigen::RowVectorXd> value) {
  const double x = 2.0 * f - 1.0;
  value[0] = 1.0;
  if (degree >= 1) value[1] = x;
  for (int k = 2; k <= degree; ++k) value[k] = 2.0 * x * value[k - 1] - value[k - 2];
}

/// Derivatives of T_0..T_degree with respect to f.
void chebyshevSlopeRow(double f, int degree, Eigen::Ref<Eigen::RowVectorXd> slope) {
  const double x = 2.0 * f - 1.0;
  // T_k' = k U_{k-1}
  slope[0] = 0.0;
  double before = 0.0, u = 1.0;
  for (int k = 1; k <= degree; ++k) {
    slope[k] = 2.0 * k * u;
    const double next = 2.0 * x * u - before;
    before = u;
    u = next;
  }
}

/// Chebyshev coefficients on x = 2f - 1 to ascending powers of f.
std::vector<double> toPowers(const Eigen::VectorXd& chebyshev) {
  const std::size_t size = chebyshev.size();
  std::vector<double> result(size, 0.0), before(size, 0.0), current(size, 0.0), next(size, 0.0);
  for (std::size_t k = 0; k < size; ++k) {
    std::fill(next.begin(), next.end(), 0.0);
    if (k == 0) {
      next[0] = 1.0;
    } else if (k == 1) {
      next[0] = -1.0;
      next[1] = 2.0;
    } else {
      for (std::size_t i = 0; i < size; ++i) {
        next[i] -= 2.0 * current[i] + before[i];
        if (i + 1 < size) next[i + 1] += 4.0 * current[i];
      }
    }
    for (std::size_t i = 0; i < size; ++i) result[i] += chebyshev[static_cast<Eigen::Index>(k)] * next[i];
    before = current;
    current = next;
  }
  return result;
}

struct Samples {
  Eigen::MatrixXd rows;
  Eigen::VectorXd values;
};

/// Rows of the basis at the samples; empty values where they do not determine a polynomial of this degree.
Samples collect(std::span<const double> f, std::span<const double> values, int degree) {
  const auto count = std::min(std::ssize(f), std::ssize(values));
  Samples s;
  if (degree < 0 || count <= degree) return s;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    if (!std::isfinite(f[i]) || !std::isfinite(values[i])) return s;
  }
  s.rows.resize(count, degree + 1);
  s.values.resize(count);
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    Eigen::RowVectorXd line(degree + 1);
    chebyshevRow(f[i], degree, line);
    s.rows.row(i) = line;
    s.values[i] = values[i];
  }
  return s;
}

double polynomial(std::span<const double> c, double f) {
  double v = 0.0;
  for (std::size_t k = c.size(); k-- > 0;) v = v * f + c[k];
  return v;
}

}  // namespace

std::vector<double> fitPolynomial(std::span<const double> f, std::span<const double> values, int degree) {
  const Samples s = collect(f, values, degree);
  if (s.values.size() == 0) return {};
  const Eigen::VectorXd c = leastSquares(s.rows, s.values);
  if (!c.allFinite()) return {};
  return toPowers(c);
}

std::vector<double> fitMonotonePolynomial(std::span<const double> f, std::span<const double> values, int degree,
                                          bool increasing) {
  const Samples s = collect(f, values, degree);
  if (s.values.size() == 0) return {};
  const double low = s.values.minCoeff(), high = s.values.maxCoeff();
  const double scale = std::max(std::abs(low), std::abs(high));
  if (!(scale > 0.0)) return std::vector<double>(degree + 1, 0.0);
  const double sign = increasing ? 1.0 : -1.0;
  Eigen::MatrixXd g(kMonotoneGrid + 1, degree + 1);
  Eigen::VectorXd h = Eigen::VectorXd::Zero(kMonotoneGrid + 1);
  Eigen::RowVectorXd line(degree + 1);
  for (int i = 0; i < kMonotoneGrid; ++i) {
    chebyshevSlopeRow(static_cast<double>(i) / (kMonotoneGrid - 1), degree, line);
    g.row(i) = sign * line;
  }
  // A monotone polynomial that keeps the sign of the data at its end nearest to zero keeps it everywhere.
  const bool positive = low > 0.0, negative = high < 0.0;
  chebyshevRow((positive == increasing) ? 0.0 : 1.0, degree, line);
  g.row(kMonotoneGrid) = negative ? Eigen::RowVectorXd(-line) : line;
  if (positive) h[kMonotoneGrid] = kPositiveShare * low / scale;
  if (negative) h[kMonotoneGrid] = -kPositiveShare * high / scale;
  if (!positive && !negative) {
    g.row(kMonotoneGrid).setZero();
    h[kMonotoneGrid] = -1.0;
  }
  const auto solved = constrainedLeastSquares(s.rows, s.values / scale, g, h);
  if (solved) {
    std::vector<double> c = toPowers(*solved * scale);
    if (isMonotonePolynomial(c)) return c;
  }
  return fitMonotoneBernstein(f, values, degree, increasing);
}

std::vector<double> fitMonotoneBernstein(std::span<const double> f, std::span<const double> values, int degree,
                                         bool increasing) {
  const Samples s = collect(f, values, degree);
  if (s.values.size() == 0) return {};
  const double scale = s.values.cwiseAbs().maxCoeff();
  if (!(scale > 0.0)) return std::vector<double>(degree + 1, 0.0);
  // Unknowns: the first coefficient as a difference of two non-negative numbers, then the steps between coefficients.
  const Eigen::Index count = s.values.size();
  Eigen::MatrixXd e(count, degree + 2);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto b = bernsteinPolynomials(degree, f[i]);
    e(i, 0) = 1.0;
    e(i, 1) = -1.0;
    double tail = 0.0;
    for (int k = degree; k >= 1; --k) {
      tail += b[k];
      e(i, k + 1) = increasing ? tail : -tail;
    }
  }
  const auto x = nonnegativeLeastSquares(e, s.values / scale);
  if (!x) return {};
  Eigen::VectorXd fitted = e * *x * scale;
  std::vector<double> smooth(fitted.data(), fitted.data() + fitted.size());
  return fitPolynomial(f, smooth, degree);
}

std::vector<double> fitPeriodicPolynomial(std::span<const double> f, std::span<const double> values, int degree) {
  const Samples s = collect(f, values, degree);
  if (s.values.size() == 0) return {};
  Eigen::MatrixXd ends(2, degree + 1);
  Eigen::RowVectorXd a(degree + 1), b(degree + 1);
  chebyshevRow(0.0, degree, a);
  chebyshevRow(1.0, degree, b);
  ends.row(0) = b - a;
  chebyshevSlopeRow(0.0, degree, a);
  chebyshevSlopeRow(1.0, degree, b);
  ends.row(1) = b - a;
  const Eigen::MatrixXd free = nullSpace(ends);
  const Eigen::VectorXd c = free * leastSquares(s.rows * free, s.values);
  if (!c.allFinite()) return {};
  return toPowers(c);
}

std::vector<double> fitPinnedPolynomial(std::span<const double> f, std::span<const double> values, int degree,
                                        bool monotone, std::optional<double> start, std::optional<double> end) {
  constexpr double kPinWeight = 1e3;  // of all samples together: pins are heavy samples, and what the weight leaves of
                                      // them is taken away by a line at the end
  std::vector<double> x(f.begin(), f.end()), y(values.begin(), values.end());
  if (start) x.push_back(0.0), y.push_back(*start);
  if (end) x.push_back(1.0), y.push_back(*end);
  Samples s = collect(x, y, degree);
  if (s.values.size() == 0) return {};
  const double weight = kPinWeight * std::sqrt(static_cast<double>(x.size()));
  for (auto i = static_cast<Eigen::Index>(f.size()); i < s.values.size(); ++i) {
    s.rows.row(i) *= weight;
    s.values[i] *= weight;
  }
  const double scale = std::max(s.values.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min());
  std::vector<double> best;
  double bestError = std::numeric_limits<double>::infinity();
  const auto offer = [&](const Eigen::VectorXd& c) {
    const double error = (s.rows * c - s.values).squaredNorm();
    if (c.allFinite() && error < bestError) bestError = error, best = toPowers(c);
  };
  if (!monotone || degree < 1) {
    offer(leastSquares(s.rows, s.values));
  } else {
    Eigen::MatrixXd g(kMonotoneGrid, degree + 1);
    Eigen::RowVectorXd line(degree + 1);
    for (int i = 0; i < kMonotoneGrid; ++i) {
      chebyshevSlopeRow(static_cast<double>(i) / (kMonotoneGrid - 1), degree, line);
      g.row(i) = line;
    }
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(kMonotoneGrid);
    for (const double sign : {1.0, -1.0}) {
      if (const auto solved = constrainedLeastSquares(s.rows, s.values / scale, sign * g, none)) offer(*solved * scale);
    }
  }
  if (best.empty()) return best;
  const double offStart = start ? *start - best[0] : 0.0, offEnd = end ? *end - polynomial(best, 1.0) : 0.0;
  best[0] += offStart;
  if (best.size() > 1) best[1] += offEnd - offStart;
  return best;
}

bool isMonotonePolynomial(std::span<const double> coefficients) {
  constexpr int kSteps = 1000;  // at which the polynomial is looked at
  double up = 0.0, down = 0.0, before = polynomial(coefficients, 0.0), size = std::abs(before);
  for (int i = 1; i <= kSteps; ++i) {
    const double now = polynomial(coefficients, static_cast<double>(i) / kSteps);
    size = std::max(size, std::abs(now));
    (now > before ? up : down) += std::abs(now - before);
    before = now;
  }
  return std::min(up, down) <= 1e-6 * std::max(up, down) + 1e-12 * size;
}

}  // namespace batten
