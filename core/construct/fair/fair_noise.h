// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/construct/fair/fair_frame.h"

namespace batten {

/// What the blocks of a piece say of the noise where they are: squares of second differences of neighbouring residuals,
/// in units of what they are expected to be. A fit that misses a feature does so over many blocks and leaves second
/// differences alone.
struct NoiseTrace {
  struct Block {
    double u = 0.0;       ///< Parameter.
    double square = 0.0;  ///< 1 where the noise is the pooled one.
  };
  std::vector<Block> blocks;  ///< Ascending in u.
  double length = 0.0;        ///< [px] of the curve; closed ones go round.
  bool closed = false;
  double blockLength = 8.0;  ///< [px]
};
/// @param c offsets of the fit. @param s0 pooled noise density of weight 1.
NoiseTrace noiseTrace(const FairFrame&, const Eigen::VectorXd& c, double s0);

/// Variance along a piece over what its weights say.
struct LocalNoise {
  struct Place {
    double u = 0.0;       ///< Parameter.
    double factor = 1.0;  ///< [-] Variance over that of the weights.
  };
  std::vector<Place> places;  ///< Ascending in u.
  double at(double u) const;  ///< 1 where nothing is known.
};
/// Local means of the traces (Gaussian, sigma 80 px, outliers held back), each shrunk towards what is usual on the
/// contour by as much as means of so few blocks scatter anyway (James-Stein on logarithms): equal noise stays equal.
/// Scaled so that the pooled noise keeps its meaning.
std::vector<LocalNoise> localNoise(const std::vector<NoiseTrace>&);

}  // namespace batten
