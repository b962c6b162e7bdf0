// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/vec2.h"
#include "core/image/scan.h"

namespace batten::test {

/// A rough sketch as it was drawn: strokes, each with the number of the curve that a person says it belongs to.
struct StrokeDrawing {
  struct Stroke {
    int cluster = 0;
    std::vector<Vec2> points;  ///< [px] of the page.
  };
  std::string name;
  double widthPx = 1.0;  ///< Of the pen.
  int pageWidth = 0, pageHeight = 0;
  std::vector<Stroke> strokes;

  /// A file of strokes (`@thickness`, `{ #stroke cluster x y pressure … }`) brought to 4 px a unit, with a margin.
  static std::optional<StrokeDrawing> read(const std::filesystem::path& file);
  /// Black on a white page.
  Scan page() const;
};

/// How far traced curves are the curves meant, by pairs of strokes: two strokes are together if at least half of what
/// the curves have of them is on the same curves.
struct StrokeFigures {
  double f1 = 0.0, precision = 0.0, recall = 0.0;
  int curves = 0, clusters = 0;
  double meanWidths = 0.0, p95Widths = 0.0;  ///< Distance of the curves from the middle of the strokes of each cluster.
  bool isCountRight() const;                 ///< Within 10 %.
};

/// Judges curves of one drawing.
class StrokeJudge {
 public:
  explicit StrokeJudge(const StrokeDrawing& drawing);
  StrokeFigures judge(const std::vector<std::vector<Vec2>>& curvesPx) const;

 private:
  struct Sample {
    Vec2 at, tangent;
    int stroke = 0;
    Vec2 middle = Vec2::Zero();  ///< Of its cluster's strokes there.
  };
  void findMiddles();
  void findHidden();
  /// Precision and recall over pairs, from the share of each stroke on each curve.
  void countPairs(const std::vector<std::map<int, double>>& share, StrokeFigures& figures) const;
  double width_, step_;
  int strokes_ = 0;
  std::vector<int> cluster_;  // by stroke
  std::vector<Sample> samples_;
  std::vector<std::vector<bool>> hidden_;  // pairs of strokes of which one lies over the other
};

}  // namespace batten::test
