// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/base/vec2.h"

namespace batten::test {

/// An open line whose course is known exactly. Unit: px, points 0.25 px apart.
struct OpenTruth {
  std::string name;
  std::vector<Vec2> points;
  std::vector<double> kappa;  ///< At the points.
};

/// The lines that all constructions are measured on: ellipse quarter, clothoid, S curve, log spiral, car roof with
/// inflections.
std::vector<OpenTruth> openTruths();

/// Every fourth point of the line (1 px apart) with white noise of this standard deviation in both coordinates.
std::vector<Vec2> noisyPoints(const OpenTruth& truth, double noisePx, unsigned seed);

}  // namespace batten::test
