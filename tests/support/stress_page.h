// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/image/scan.h"
#include "tests/support/render_page.h"

namespace batten::test {

/// Grey of the empty paper at the middle of a pixel.
using PaperOf = std::function<double(double x, double y)>;

/// How ink lies on a paper and how both are scanned.
struct StressInk {
  double contrast = 20.0;  ///< [grey] ink is this much darker than the paper at the place.
  double noise = 4.0;      ///< [grey] standard deviation, white.
  double blurPx = 1.0;     ///< [px] of the ink; papers bring their own softness.
};

/// A drawing whose lines are known: borders of filled shapes, or the middles of strokes.
struct StressScene {
  std::string name;
  std::vector<float> coverage;
  std::vector<std::vector<Vec2>> lines;  ///< Closed lines repeat their first point; dense, about 1 px.
};

/// A large ellipse, a shape cut by the border of the page, a ring with an island, three shapes, a stroke of 5 px in an
/// S and a letter K of strokes.
std::vector<StressScene> stressScenes(int width, int height);

struct StressPaper {
  std::string name;
  PaperOf grey;
};
/// Gradation, vignette, spot, exponential fall, ripples of slope .4 and .8, then steps and creases: a fold of 59 grey
/// with a sharp edge, one with a dark crease, a soft shadow edge, two crossing folds, a bent shadow edge.
std::vector<StressPaper> stressPapers(int width, int height);

/// A step from 0 to 1 across the straight line through (x0, y0) whose normal points at this angle; `soft` is the
/// standard deviation of its edge.
double stepAcross(double x, double y, double x0, double y0, double normalDeg, double soft);

Scan renderStress(std::vector<float> coverage, int width, int height, const PaperOf&, const StressInk&,
                  std::uint32_t seed);

/// How well lines were found.
struct LineScore {
  double covered = 0.0;  ///< Part of the true lines with a point of a found one within 2 px.
  double falsePx = 0.0;  ///< Length of found lines farther than 3 px from every true one.
  double rmsPx = 0.0;    ///< Of the found points within 3 px: distance from the nearest true line.
  bool passes() const { return covered >= 0.95 && falsePx <= 20.0; }
};
/// @param found polylines of about one point a pixel. What lies within 6 px of the page's border is not judged.
LineScore scoreLines(const std::vector<std::vector<Vec2>>& truth, const std::vector<std::vector<Vec2>>& found,
                     int width, int height);

}  // namespace batten::test
