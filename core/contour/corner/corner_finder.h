// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <compare>
#include <cstddef>
#include <iterator>
#include <map>
#include <optional>
#include <vector>

#include "core/contour/corner/corner_geometry.h"
#include "core/contour/corner/corner_marks.h"
#include "core/polyline/point_grid.h"

namespace batten {

/// A point of one of the contours of a set.
struct ContourPlace {
  int contour = 0, index = 0;
  auto operator<=>(const ContourPlace&) const = default;  // NOLINT(modernize-use-nullptr): a false alarm
};

/// Finds the corner, or else the point of a line, that a mark stands for. Results for points of a line are kept, so
/// that many marks near one another cost little more than one. @pre the set outlives it.
class CornerFinder {
 public:
  CornerFinder(const ContourSet& set, double snapDistancePx);

  /// Sorts the points of the lines into a grid, so that the time of find() no longer grows with the drawing. Worth
  /// while for more than ten marks or so.
  void sortPoints();

  /// The sharpest corner within the snap distance, without the exact intersection; where nothing turns, the nearest
  /// point. Nothing where no line is as near. @param mark [px]
  std::optional<Corner> find(const Vec2& mark);

  /// Number of points at which the turn of the line has been measured: the measure of the work done.
  std::ptrdiff_t measuredPoints() const { return std::ssize(scores_); }

 private:
  /// A point that a mark may stand for.
  struct Snapped {
    ContourPlace place;
    double distance = 0.0;             ///< [px] from the mark to the turn or the point.
    std::optional<double> score = {};  ///< Of the turn; absent: a point that does not turn.
  };
  struct ScoredPlace {
    ContourPlace place;
    double score = 0.0;
  };

  const Contour& contourOf(const ContourPlace& p) const { return set_.contours[p.contour]; }
  const Vec2& at(const ContourPlace& p) const { return contourOf(p).points[p.index].at; }
  std::vector<ContourPlace> placesNear(const Vec2& mark) const;
  std::optional<Snapped> nearest(const std::vector<ContourPlace>& near, const Vec2& mark) const;
  std::optional<Snapped> sharpest(const std::vector<ContourPlace>& near, const Vec2& mark);
  std::optional<Snapped> sharpestTurn(std::vector<ScoredPlace> turns, const Vec2& mark);
  std::optional<double> turnScore(const ContourPlace&);
  const CornerFix& fixAt(const ContourPlace&);
  static double scoreOf(const std::optional<Snapped>& turn) { return turn ? turn->score.value_or(0.0) : 0.0; }

  const ContourSet& set_;
  double snap_, reach_;                            // [px]
  Vec2 low_ = Vec2::Zero(), high_ = Vec2::Zero();  // [px] corners of the box that holds all sorted points
  std::optional<PointGrid<ContourPlace>> grid_;
  std::map<ContourPlace, std::optional<double>> scores_;
  std::map<ContourPlace, CornerFix> fixes_;
};

}  // namespace batten
