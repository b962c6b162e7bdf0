// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/base/vec2.h"
#include "core/image/scan.h"

namespace batten::test {

/// `count` open lines side by side, `spacingPx` from middle to middle, about `lengthPx` long, round the middle of the
/// field; bendRadiusPx > 0: arcs round one centre, else straight. Points about 1 px apart.
std::vector<std::vector<Vec2>> hatchLines(const Vec2& middle, double angleDeg, int count, double spacingPx,
                                          double lengthPx, double bendRadiusPx);

/// Coverage of all lines, inked over one another.
std::vector<float> coverageOf(const std::vector<std::vector<Vec2>>& lines, double widthPx, int width, int height);

/// The tooth of the paper under a pencil: where `share` (0..1 at a place) is 1 the coverage becomes
/// coverage * (.75 + .45 grain), grain being normal noise of unit variance and about 2.4 px across; where it is 0 it
/// stays.
void grainCoverage(std::vector<float>& coverage, int width, int height,
                   const std::function<double(double x, double y)>& share, std::uint32_t seed);

/// Coverage on a paper of 235, ink 30, scanned with blur .8 and noise 6.
Scan scanOfLines(std::vector<float> coverage, int width, int height, std::uint32_t seed);

/// How lines side by side were found. A found point belongs to the nearest true line of its direction (30 degrees).
struct DenseScore {
  int drawn = 0;
  int whole = 0;       ///< Covered to 95 % by one found line.
  int inPieces = 0;    ///< Covered by half or more, but not by one.
  int bridges = 0;     ///< Times a found line passes from one true line to another (5 px and more on either).
  double rmsPx = 0.0;  ///< Distance of found points from their line.
};
/// @param tolerancePx farther from every line is on none.
DenseScore scoreDense(const std::vector<std::vector<Vec2>>& truth, const std::vector<std::vector<Vec2>>& found,
                      double tolerancePx, double endsPx);

}  // namespace batten::test
