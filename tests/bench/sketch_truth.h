// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/vec2.h"

namespace batten::test {

/// A point of a traced curve, px.
struct CurvePoint {
  Vec2 at = Vec2::Zero();
  Vec2 tangent = Vec2::Zero();  ///< Unit.
};

/// The drawing as it was made: strokes, grouped by the line that they were meant to be.
class SketchTruth {
 public:
  /// The file beside a drawing with the ending .svg, brought to the drawing's size. Nothing if there is none.
  static std::optional<SketchTruth> beside(const std::filesystem::path& drawing, int widthPx, int heightPx);

  struct Figures {
    int groups = 0;
    double medianPx = 0.0, rmsPx = 0.0;  ///< Of the curves from the mean of the strokes of the nearest group.
    double unmatched = 0.0;              ///< 0..1 of the curve points have no stroke within 20 px.
    double covered = 0.0;                ///< 0..1 of the strokes have a curve within 8 px.
  };
  Figures compare(const std::vector<CurvePoint>& curves) const;

 private:
  struct Stroke {
    int group = 0;
    std::vector<Vec2> points;
  };
  struct Facet {
    int stroke = 0;
    std::size_t first = 0;
  };
  std::optional<double> offsetAt(const CurvePoint& point) const;
  void fillGrid();
  std::vector<Stroke> strokes_;
  std::map<std::pair<int, int>, std::vector<Facet>> cells_;
  int groups_ = 0;
};

}  // namespace batten::test
