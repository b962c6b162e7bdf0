// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>

namespace batten {

/// S = a.b / (|a||b|) of two profiles over equal perimeter samples (003 Eq 14). 0 where either is all zero.
double similarity(std::span<const double> a, std::span<const double> b);
/// Mean-centred S. 0 where either is constant.
double pearson(std::span<const double> a, std::span<const double> b);
/// Akaike's criterion for least squares with small-sample correction: n ln(meanSquare) + 2k + 2k(k+1)/(n-k-1), k =
/// degree + 2. Absent where n is too small for the degree (n <= k + 1).
std::optional<double> aicc(double meanSquareResidual, int degree, int effectiveSamples);

}  // namespace batten
