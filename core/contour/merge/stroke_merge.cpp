// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/merge/stroke_merge.h"

#include <algorithm>
#include <cmath>

#include "core/base/statistics.h"
#include "core/contour/merge/merged_contour.h"
#include "core/contour/merge/overlap_removal.h"
#include "core/contour/merge/piece_joining.h"
#include "core/contour/merge/stroke_lines.h"
#include "core/contour/merge/stroke_mean.h"
#include "core/contour/merge/stroke_turns.h"
#include "core/polyline/polyline_tools.h"

namespace batten {

namespace {

constexpr double kFirstWidths = 1.5;     // [stroke widths] strokes as near as this are one before others are looked at
constexpr int kMostLevels = 5;           // each of half the distance: the first is a sixteenth
constexpr double kSmoothing = 0.25;      // of the distance
constexpr double kLeastSmoothing = 2.0;  // points
constexpr float kLeastMergedShare = 1e-3f;  // of merged points in the window of the smoothing: less moves nothing
constexpr float kMerged = 1.05f;            // weight of more than one stroke

// Merged lines are smoothed a little before they are merged further: where strokes begin and end they have small steps.
// Lines of one stroke stay.
void smoothMerged(MeanLine& line, double sigma) {
  std::vector<float> merged;
  for (const MeanPoint& p : line.points) merged.push_back(p.weight > kMerged ? 1.0f : 0.0f);
  if (std::find(merged.begin(), merged.end(), 1.0f) == merged.end()) return;
  const std::vector<float> share = smoothValues(merged, line.closed, sigma);
  std::vector<Vec2> at = positionsOf(line);
  const std::vector<Vec2> smooth = smoothPolyline(at, line.closed, sigma);
  for (int i = 0; i < std::ssize(smooth); ++i)
    if (share[i] > kLeastMergedShare) at[i] += std::min(1.0, 2.0 * static_cast<double>(share[i])) * (smooth[i] - at[i]);
  setPositions(line, at);
}

std::vector<MeanLine> mergeWithin(std::vector<MeanLine> strokes, double distancePx, double widestPx,
                                  const RunContext& context) {
  moveToMean(strokes, distancePx, context);
  if (context.isCancelled()) return {};
  std::stable_sort(strokes.begin(), strokes.end(),
                   [](const MeanLine& a, const MeanLine& b) { return a.points.size() > b.points.size(); });
  RemainingLines pieces = removeOverlaps(std::move(strokes), distancePx, context);
  if (context.isCancelled()) return {};
  return joinPieces(std::move(pieces), distancePx, widestPx, context);
}

double penWidth(const std::vector<Contour>& lines) {
  std::vector<float> widths;
  for (const Contour& line : lines) {
    const std::vector<float> own = strokeWidthsOf(line.points);
    widths.insert(widths.end(), own.begin(), own.end());
  }
  if (widths.empty()) return 1.0;
  return std::max(1.0, static_cast<double>(upperMedian(widths)));
}

}  // namespace

std::vector<Contour> mergeStrokes(const std::vector<Contour>& lines, double distancePx, const RunContext& context) {
  const double width = penWidth(lines);
  HandStrokes drawn = strokesOf(lines, distancePx);
  std::vector<MeanLine> means = std::move(drawn.strokes);
  // The nearest first: what then comes near another line and parts from it is seen in full.
  int levels = 1;
  while (levels < kMostLevels && std::ldexp(distancePx, -levels) >= kFirstWidths * width) ++levels;
  for (int level = levels - 1; level >= 0; --level) {
    const double within = std::ldexp(distancePx, -level);
    means = mergeWithin(std::move(means), within, distancePx, context);
    if (context.isCancelled()) return {};
    if (level == 0) break;
    for (MeanLine& line : means) smoothMerged(line, std::max(kLeastSmoothing, kSmoothing * within));
    findContinuations(means, 0.5 * within);
  }
  meetAtTurns(means, drawn.turns, distancePx);
  std::vector<Contour> merged;
  const StrokesBeside strokes(lines, distancePx);
  for (const MeanLine& line : means) {
    merged.push_back(mergedContour(line, lines, strokes, distancePx, context));
    if (context.isCancelled()) return {};
  }
  std::erase_if(merged, [](const Contour& c) { return c.points.size() < 3; });
  return merged;
}

}  // namespace batten
