// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

namespace batten {

/// [px] standard deviation across the line of a point that is known to the pixel only.
inline constexpr float kGuessedSigmaPx = 0.35f;

/// How well the pixels around a point of a line determine its place.
struct PointInformation {
  double gain = 0.0;     ///< [px/grey] > 0. Standard deviation of the place over that of a single pixel.
  double squares = 0.0;  ///< [grey^2] weighted sum of the squares that the model leaves,
  double freedom = 0.0;  ///< and what it is expected to be where the noise of a pixel is 1.
};

/// [px] Standard deviations of the points across their line: the local noise of the grey values (median of the
/// residuals of some 50 points along the line) times the gain, plus the error of the pixel model. A point without
/// information counts as known to the pixel only.
std::vector<float> pointSigmas(const std::vector<std::optional<PointInformation>>&, bool closed);

}  // namespace batten
