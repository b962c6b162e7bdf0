// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace batten {

/// Least-squares polynomial. Ascending powers of f in 0..1; empty where there are too few samples.
std::vector<double> fitPolynomial(std::span<const double> f, std::span<const double> values, int degree);

/// The same, non-decreasing (non-increasing); data of one sign keep it. Empty on failure.
std::vector<double> fitMonotonePolynomial(std::span<const double> f, std::span<const double> values, int degree,
                                          bool increasing);

/// Least-squares polynomial whose value and slope at f = 1 equal those at f = 0: a profile of a closed curve. Degrees 1
/// and 2 leave the constant only (a circle). Ascending powers of f in 0..1; empty where there are too few samples.
std::vector<double> fitPeriodicPolynomial(std::span<const double> f, std::span<const double> values, int degree);

/// Least-squares polynomial with non-decreasing (non-increasing) Bernstein coefficients: monotone for certain, but
/// stiffer than need be. Used where the constraints on a grid do not settle. Ascending powers of f; empty on failure.
/// @pre degree <= kMostBernsteinDegree.
std::vector<double> fitMonotoneBernstein(std::span<const double> f, std::span<const double> values, int degree,
                                         bool increasing);

/// Least-squares polynomial that takes given values at f = 0 and f = 1, monotone (rising or falling, whichever is
/// nearer) if wanted. Ascending powers of f in 0..1; empty on failure.
std::vector<double> fitPinnedPolynomial(std::span<const double> f, std::span<const double> values, int degree,
                                        bool monotone, std::optional<double> start, std::optional<double> end);

/// True when the polynomial (ascending powers) turns back by less than 1e-6 of its range anywhere in 0..1.
bool isMonotonePolynomial(std::span<const double> coefficients);

}  // namespace batten
