// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/base/cancel_check.h"
#include "core/construct/fair/fair_frame.h"
#include "core/solve/banded_matrix.h"

namespace batten {

/// The offsets of a frame under noise density s0 and a prior for kappa'': J(c) = c'Ac - 2b'c + constant is the
/// penalised chi2.
struct FairPosterior {
  BandedMatrix a;
  Eigen::VectorXd b;
  double constant = 0.0;     ///< [chi2]
  double s0 = 1.0;           ///< [px^2 px] noise density of weight 1.
  BandedMatrix covariance;   ///< A^-1 within the band.
  Eigen::VectorXd mean;      ///< Unconstrained minimum.
  std::vector<double> tau2;  ///< [1/px^6 px] prior density of kappa'' per station of the penalty.
  double objective(const Eigen::VectorXd& c) const { return c.dot(a * c) - 2.0 * b.dot(c) + constant; }
};

/// The candidates for the cut-off wavelength of a piece: ell_k = 24 * 1.15^k px, and what each one costs.
struct CutoffTable {
  static constexpr int kCount = 28;  // up to 1045 px
  static double cutoffPx(int k);
  int blocks = 0;                    ///< Of data.
  std::array<double, kCount> rss{};  ///< [px^2] weighted sum of squared residuals of the blocks.
  std::array<double, kCount> dof{};  ///< Trace of the hat matrix.
  std::array<bool, kCount> valid{};  ///< All is finite, and `dof` below the number of blocks.
};
CutoffTable cutoffTable(const FairFrame&, CancelCheck);

/// Cut-offs per piece and the pooled variance of a block mean: GCV first, then twice argmin rss / sigma^2 + gamma dof.
/// The variance counts four blocks of an ordinary scan besides, so that a short contour cannot be quiet by luck.
struct CutoffChoice {
  std::vector<std::optional<int>> k;  ///< Per table; absent: no table, or no candidate in it.
  double blockVariance = 0.0;         ///< [px^2] Of the mean of a full block.
};
/// @param leastVariance [px^2] per table: what the variance of its blocks is at least: density of the noise per block.
CutoffChoice chooseCutoffs(const std::vector<std::optional<CutoffTable>>&, std::span<const double> leastVariance,
                           double gamma);

/// Local prior by empirical Bayes, starting from the cut-off or from `tau2` (same number of stations).
std::optional<FairPosterior> localPosterior(const FairFrame&, double s0, std::vector<double> tau2, int rounds,
                                            double widthPx, CancelCheck);
/// [1/px^6 px] The prior density that cuts off at this wavelength, the same at every station of the penalty.
std::vector<double> uniformPrior(const FairFrame&, double s0, double cutoffPx);

}  // namespace batten
