// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "core/base/run_context.h"
#include "core/base/vec2.h"
#include "core/image/grey_image.h"

namespace batten {

/// A nearly straight course over the page: origin + t * along + (d + bend(t)) * normal, image frame, px.
struct FoldCourse {
  Vec2 origin = Vec2::Zero();  ///< [px]
  Vec2 along = Vec2::UnitX(),
       normal = Vec2::UnitY();   ///< Unit, at right angles; the normal points to the brighter side.
  double from = 0.0, to = 0.0;   ///< t where the course enters and leaves the page.
  std::array<double, 4> bend{};  ///< Cubic in t / max(|from|, |to|).

  /// [px] What t is divided by in `bend`.
  double scale() const;
  /// [px] bend(t) along the normal.
  double bendAt(double t) const;
  Vec2 at(double t, double d) const { return origin + t * along + (d + bendAt(t)) * normal; }
};

/// A step in the grey of the paper from border to border, as a fold or the edge of a shadow makes it: how much darker
/// than the paper on its brighter side every place is. Zero on that side, constant across on the other, a measured
/// profile (with the crease, if it has one) between.
struct PaperFold {
  FoldCourse course;
  double spacing = 16.0;  ///< [px] between stations along the course, the first at course.from.
  int reach = 8;          ///< [px] the profile covers -reach..reach across the course.
  /// How many there are.
  int stations = 0;
  std::vector<float> depth;    ///< [grey, never negative] per station: the step.
  std::vector<float> profile;  ///< [grey, never positive where the step is] stations * taps().

  static constexpr int kTapsPerPx = 2;                     // of the profile across a fold
  int taps() const { return 2 * kTapsPerPx * reach + 1; }  ///< Values of the profile of one station.

  /// What the fold adds to the grey of the paper there.
  double at(double x, double y) const;
  /// Adds the same to the pixel centres of row y.
  void addToRow(int y, float* row, int width) const;
  /// Columns [first, second) of row y outside which no pixel lies within the profile's reach.
  std::pair<int, int> stripOfRow(int y, int width) const;
};

/// The picture without its folds: their darkness is taken out, so that ink stands on one paper. Never above white.
GreyImage withoutFolds(const GreyImage& image, const std::vector<PaperFold>& folds, const RunContext& context);

}  // namespace batten
