// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/intent/intended_lines.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/contour/intent/group_lines.h"
#include "core/contour/intent/merge_shares.h"
#include "core/contour/intent/strip_mean.h"
#include "core/contour/intent/stroke_groups.h"
#include "core/contour/intent/stroke_pieces.h"
#include "core/contour/merge/overdrawn_strokes.h"
#include "core/contour/merge/stroke_merge.h"
#include "core/contour/merge/turn_cuts.h"

namespace batten {
namespace {

constexpr double kLeastScale = 1.5, kMostScale = 20.0;  // [stroke widths]
constexpr double kShortestStroke = 3.0;                 // [stroke widths]
constexpr double kMergedReach = 2.0;                    // and half the scale: from a merged line to its strokes
constexpr int kLeastPlaces = 6;                         // of overdrawn lines: clean drawings have up to 5

// The lines without the gaps that they bridge.
std::vector<Contour> withoutBridges(const std::vector<Contour>& lines, double shortestPx) {
  std::vector<Contour> parts;
  for (const Contour& line : lines) {
    if (line.kind != ContourKind::Centreline || line.points.size() < 3) continue;
    if (line.bridges.empty()) {
      parts.push_back(line);
      continue;
    }
    auto bridges = line.bridges;
    std::sort(bridges.begin(), bridges.end());
    const int n = static_cast<int>(line.points.size());
    int from = line.closed ? bridges.back().second : 0;
    if (line.closed && from >= n) from -= n;
    // On a ring the first stretch begins behind the last bridge.
    int begin = line.closed ? from - n : 0;
    if (line.closed && bridges.back().second >= n) begin = from;
    for (const auto& [first, last] : bridges) {
      if (first > begin) parts.push_back(cutPart(line, begin, first));
      begin = std::max(begin, last);
    }
    if (!line.closed && begin < n - 1) parts.push_back(cutPart(line, begin, n - 1));
  }
  for (Contour& part : parts) part.bridges.clear();
  std::erase_if(parts, [&](const Contour& c) { return c.points.size() < 3 || c.lengthPx < shortestPx; });
  return parts;
}

// [stroke widths] As adviseMerge() would find it; absent: no strokes lie over one another.
std::optional<double> scaleOf(const std::vector<Contour>& lines, double widthPx, const RunContext& context) {
  const auto found = findOverdrawnStrokes(lines, (kMostScale + 1.0) * widthPx, context);
  if (!found) return std::nullopt;
  return std::clamp(found->distancePx / widthPx - 1.0, kLeastScale, kMostScale);
}

// What merging by one distance would make of the lines says much about which pieces are one.
void setMerged(StrokePieceSet& set, const std::vector<Contour>& lines, double widthPx, double scale,
               const RunContext& context) {
  const std::vector<Contour> merged =
      cutAtTurns(mergeStrokes(lines, (scale + 1.0) * widthPx, context), widthPx, context);
  if (context.isCancelled()) return;
  std::vector<Strip> strips;
  for (const StrokePiece& p : set.pieces) strips.push_back(p.strip);
  const auto shares = mergeSharesOf(strips, merged, widthPx, kMergedReach + 0.5 * scale, context);
  for (int i = 0; i < std::ssize(shares); ++i) set.pieces[i].strip.merged = shares[i];
}

}  // namespace

std::optional<std::vector<Contour>> intendedLines(const std::vector<Contour>& lines, double widthPx,
                                                  std::optional<double> scaleWidths, const RunContext& context,
                                                  const GroupingProbe& probe) {
  const std::vector<Contour> strokes = withoutBridges(lines, kShortestStroke * widthPx);
  if (strokes.empty()) return std::nullopt;
  StrokePieceSet set = cutIntoPieces(strokes, widthPx, context);
  if (context.isCancelled()) return std::nullopt;
  std::vector<Strip> strips;
  for (const StrokePiece& p : set.pieces) strips.push_back(p.strip);
  const std::vector<StripPair> seen = findStripPairs(strips, kSideReach, false, context);
  const std::vector<StripPair> all = findStripPairs(strips, kSideReach, true, context);
  const std::optional<double> found = scaleWidths ? scaleWidths : scaleOf(lines, widthPx, context);
  if (context.isCancelled() || (!found && overdrawnPlaces(set, seen) < kLeastPlaces)) return std::nullopt;
  const double scale = std::max(kLeastScale, found.value_or(0.0));
  setMerged(set, lines, widthPx, scale, context);
  if (context.isCancelled()) return std::nullopt;
  const std::vector<bool> areOne = lookOverdrawn(set, all, scale);
  const PieceMeans means(set, all, areOne);
  const auto groups = groupPieces(set, means, seen, scale, context, probe);
  if (probe.pieces != nullptr) *probe.pieces = set;
  if (context.isCancelled()) return std::nullopt;
  auto grouped = linesOfGroups(strokes, set, means, groups, widthPx, context);
  if (context.isCancelled()) return std::nullopt;
  return grouped;
}

}  // namespace batten
