// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/model/cubic_outline.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <optional>

#include "core/base/parallel.h"
#include "core/curve/closest_point.h"
#include "core/curve/cubic.h"
#include "core/curve/curvature.h"
#include "core/exchange/model/export_check.h"

namespace batten {
namespace {

constexpr int kSamplesPerCubic = 8;  // where the outline is looked at
// Of a piece's extent: its last cubic ends so near to its end. One of those before it may come near by chance, but not
// to within rounding.
constexpr double kNearEnd = 1e-3, kAtEnd = 1e-5;

/// The end and the start of a loop are one point: written alike, so that closing adds no line. The shift counts.
void closeLoop(CubicOutline& outline) {
  CubicRun& loop = outline.runs.front();
  outline.largestError = std::max(outline.largestError, (loop.end() - loop.start).norm());
  loop.cubics.back()[2] = loop.start;
  outline.closed = true;
}

/// The cubic that ends a piece at `end`: of those that come near it one behind the other, as small ones in a hook of
/// the piece may, the nearest. Nothing if none comes so near.
std::optional<std::size_t> lastWithin(double near, const std::vector<std::array<Vec2, 4>>& cubics, std::size_t first,
                                      const Vec2& end) {
  const auto away = [&](std::size_t i) { return (cubics[i].back() - end).norm(); };
  std::size_t last = first;
  while (last < cubics.size() && away(last) > near) ++last;
  if (last == cubics.size()) return std::nullopt;
  for (std::size_t i = last + 1; i < cubics.size() && away(i) <= near; ++i)
    if (away(i) < away(last)) last = i;
  return last;
}
std::size_t lastOfPiece(const std::vector<std::array<Vec2, 4>>& cubics, std::size_t first, const Vec2& end,
                        double size) {
  for (const double near : {kAtEnd, kNearEnd})
    if (const auto last = lastWithin(near * size, cubics, first, end)) return *last;
  return cubics.size() - 1;
}

}  // namespace

Result<CubicOutline> cubicOutline(const ExportCurve& line, const Eigen::Matrix2d& linear, const Vec2& offset,
                                  const CubicTolerance& within, const RunContext& context) {
  CubicOutline outline;
  std::vector<Result<CubicPath>> paths(line.pieces.size(), cancelled());
  parallelFor(context, static_cast<int>(paths.size()), 1, [&](int begin, int end) {
    for (int i = begin; i < end && !context.isCancelled(); ++i)
      paths[i] = cubicPath(line.pieces[i].curve.mapped(linear, offset), within, context);
  });
  for (std::size_t i = 0; i < line.pieces.size(); ++i) {
    auto& path = paths[i];
    if (!path) return fail(path.error());
    for (std::size_t k = 0; k < path->runs.size(); ++k) {
      CubicRun& run = path->runs[k];
      outline.cubics += static_cast<int>(run.cubics.size());
      if (k == 0 && i > 0 && doMeet(line.pieces[i - 1].curve, line.pieces[i].curve)) {
        outline.largestError = std::max(outline.largestError, (outline.runs.back().end() - run.start).norm());
        std::move(run.cubics.begin(), run.cubics.end(), std::back_inserter(outline.runs.back().cubics));
      } else {
        outline.runs.push_back(std::move(run));
      }
    }
    outline.largestError = std::max(outline.largestError, path->largestError);
    outline.largestJump = std::max(outline.largestJump, path->largestJump);
  }
  if (line.closed && outline.runs.size() == 1 && !outline.runs.front().cubics.empty()) closeLoop(outline);
  return outline;
}

double distanceFromLine(const std::vector<std::array<Vec2, 4>>& cubics, const ExportCurve& line, CancelCheck check) {
  double worst = 0.0;
  std::size_t first = 0;
  for (std::size_t piece = 0; piece < line.pieces.size() && first < cubics.size() && !check.isCancelled(); ++piece) {
    const NurbsCurve& exact = line.pieces[piece].curve;
    const Vec2 start = exact.point(exact.start()), end = exact.point(exact.end());
    const std::size_t last =
        piece + 1 < line.pieces.size() ? lastOfPiece(cubics, first, end, extent(exact)) : cubics.size() - 1;
    std::vector<Vec2> part;
    for (std::size_t i = first; i <= last; ++i) {
      const auto& c = cubics[i];
      for (int k = 0; k <= kSamplesPerCubic; ++k) {
        part.push_back(cubicPoint(c, static_cast<double>(k) / kSamplesPerCubic));
      }
    }
    worst = std::max(
        {worst, deviation(exact, part, true, check).max, (part.front() - start).norm(), (part.back() - end).norm()});
    first = last + 1;
  }
  return first == cubics.size() ? worst : std::numeric_limits<double>::infinity();
}

}  // namespace batten
