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

  struct Grouping {
    int matched = 0;  ///< Meant lines that one found line covers to 90 % and that hold 90 % of it, and no other line.
    int covered = 0;  ///< Meant lines that some found line covers to 90 %, whatever else it runs along.
    int onOne = 0;    ///< Found lines of which 90 % lies on one meant line.
    int divided = 0;  ///< Found lines with two meant lines or more on at least a tenth each.
    std::vector<std::string> unmatched;  ///< For each other meant line its name and what was found on it.
  };
  /// How far the lines found are the lines meant. A line lies on a meant one where it runs between its strokes (or
  /// within 3 px of one), about in their direction; it covers those parts of the strokes that its normals cross.
  Grouping group(const std::vector<std::vector<CurvePoint>>& lines) const;

 private:
  struct Stroke {
    int group = 0;
    std::vector<Vec2> points;
  };
  /// How much of a line lies on a group, and how much of the group it covers; 0..1.
  struct Share {
    double on = 0.0, covers = 0.0;
  };
  /// By group. @param length [px] of the groups.
  std::vector<Share> sharesOf(const std::vector<CurvePoint>& line, const std::vector<double>& length) const;
  struct Facet {
    int stroke = 0;
    std::size_t first = 0;
  };
  struct Crossed {
    double offset = 0.0;
    std::size_t first = 0;
  };
  /// By stroke: where it crosses the normal of a point nearest, within `reachPx`.
  std::map<int, Crossed> crossedAt(const CurvePoint& point, double reachPx) const;
  std::optional<double> offsetAt(const CurvePoint& point) const;
  void fillGrid();
  std::vector<Stroke> strokes_;
  std::map<std::pair<int, int>, std::vector<Facet>> cells_;
  int groups_ = 0;
  std::vector<std::string> names_;
};

}  // namespace batten::test
