// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/base/vec2.h"

namespace batten::test {

/// One stretch between corners whose exact course is known. Image frame, px (y down).
struct TruthPiece {
  std::vector<Vec2> points;   ///< Dense: about 0.1 px apart.
  std::vector<double> kappa;  ///< [1/px] at the points, in the frame of the points taken as x right, y up.
};

/// A shape whose outline is known exactly.
struct TruthShape {
  std::string name;
  bool closed = true;              ///< The pieces form a loop (always, when it is filled).
  std::vector<TruthPiece> pieces;  ///< One piece without corners: smooth closed.
  std::vector<Vec2> corners;       ///< Where pieces meet.
  double diagonal() const;         ///< Of the bounding box.
  std::vector<Vec2> outline() const;
};

/// A turning point of a curvature profile.
struct ProfileExtremum {
  std::size_t index = 0;
  bool isMaximum = false;
};
/// The extrema of a curvature profile with at least this prominence, in order. Ends are no extrema.
std::vector<ProfileExtremum> extremaOf(const std::vector<double>& kappa, double prominence, bool periodic);
/// Number of extrema of a curvature profile with at least this prominence. The oracle for CurvatureExtremum counts:
/// written without the program's own code.
int countExtrema(const std::vector<double>& kappa, double prominence, bool periodic);

/// The nine shapes of the accuracy tables, filling a page of this size: circle, ellipse, clothoid, log spiral, S curve,
/// superellipse, car outline (4 corners), letter K (11), crown (7).
std::vector<TruthShape> truthShapes(int widthPx, int heightPx);
TruthShape truthShape(const std::string& name, int widthPx, int heightPx);

}  // namespace batten::test
