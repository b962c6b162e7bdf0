// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>

namespace batten {

/// A quadrature rule: sum of weight[i] f(node[i]); nodes ascending.
template <std::size_t N>
struct QuadratureRule {
  std::array<double, N> node{}, weight{};
};

/// The Gauss-Legendre rule of N points on an interval: exact for polynomials of degree 2 N - 1. Computed by the
/// compiler: the roots of the Legendre polynomial from the greatest down, by Newton's method with the roots known
/// divided out (which from the right of all roots converges steadily), and the weights 2 / ((1 - x^2) P'(x)^2).
template <std::size_t N>
constexpr QuadratureRule<N> gaussLegendre(double from = -1.0, double to = 1.0) {
  std::array<long double, N> root{}, slope{};
  for (std::size_t k = 0; k < N; ++k) {
    long double x = 1.0L;
    for (int step = 0; step < 100; ++step) {
      long double p = x, before = 1.0L;  // P_1, P_0
      for (std::size_t n = 2; n <= N; ++n) {
        const auto m = static_cast<long double>(n);
        const long double next = ((2.0L * m - 1.0L) * x * p - (m - 1.0L) * before) / m;
        before = p;
        p = next;
      }
      // At x = 1 the formula of the slope is 0 / 0; its value there is N (N + 1) / 2.
      const auto n = static_cast<long double>(N);
      slope[k] = x == 1.0L ? n * (n + 1.0L) / 2.0L : n * (before - x * p) / (1.0L - x * x);
      long double known = 0.0L;
      for (std::size_t j = 0; j < k; ++j) known += 1.0L / (x - root[j]);
      const long double move = p / (slope[k] - p * known);
      x -= move;
      if (move < 1e-18L && move > -1e-18L) break;
    }
    root[k] = x;
  }
  QuadratureRule<N> rule;
  const long double middle = 0.5L * (static_cast<long double>(from) + to),
                    half = 0.5L * (to - static_cast<long double>(from));
  for (std::size_t k = 0; k < N; ++k) {
    rule.node[N - 1 - k] = static_cast<double>(middle + half * root[k]);
    rule.weight[N - 1 - k] = static_cast<double>(2.0L * half / ((1.0L - root[k] * root[k]) * slope[k] * slope[k]));
  }
  return rule;
}

/// Row k: the coefficients of x^0, x^1, ... of the polynomial of degree N - 1 that is 1 at place k and 0 at the others.
template <std::size_t N>
constexpr std::array<std::array<double, N>, N> lagrangePolynomials(const std::array<double, N>& places) {
  std::array<std::array<double, N>, N> all{};
  for (std::size_t k = 0; k < N; ++k) {
    std::array<double, N>& c = all[k];
    c[0] = 1.0;
    std::size_t degree = 0;
    for (std::size_t j = 0; j < N; ++j) {
      if (j == k) continue;
      const double scale = 1.0 / (places[k] - places[j]);
      for (std::size_t i = ++degree; i > 0; --i) c[i] = scale * (c[i - 1] - places[j] * c[i]);
      c[0] *= -scale * places[j];
    }
  }
  return all;
}

}  // namespace batten
