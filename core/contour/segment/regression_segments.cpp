// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/segment/regression_segments.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/contour/segment/pca_line.h"
#include "core/contour/segment/station_meter.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr int kFewestOpen = 4;              // both ends and two between
constexpr int kFewestGiven = 2;             // that the user may set
constexpr int kFewestClosed = 6;            // every sixth of a turn, on a circle
constexpr int kMostStations = 2000;         // bounds the work of the fit, and what the user may set
constexpr double kSmallestSpacingPx = 8.0;  // of adaptive stations, as of those that the user may set
constexpr double kAdaptiveGrowth = 1.2;     // from try to try: a fifth more than are needed at most
constexpr double kAveragedPx = 5.0;         // the tolerance speaks of the line, not of its noise

void pinEnds(const PieceLine& piece, std::vector<FittedStation>& stations) {
  const auto pin = [](FittedStation& s, const Vec2& corner) {
    const Vec2 shift = corner - s.station.point;
    s.station.point = corner;
    s.station.from += shift;
    s.station.to += shift;
  };
  if (piece.closed || stations.empty()) return;
  if (piece.startIsCorner) pin(stations.front(), piece.points.front().at);
  if (piece.endIsCorner) pin(stations.back(), piece.points.back().at);
}

// Not complete when cancelled.
std::vector<FittedStation> stationsOf(const MeasuredPiece& piece, int count, const RunContext& context) {
  std::vector<FittedStation> stations;
  const double spacing = piece.length() / (piece.closed() ? count : count - 1);
  for (int j = 0; j < count && !context.isCancelled(); ++j)
    stations.push_back(makeStation(piece, j * spacing, spacing));
  pinEnds(piece.piece(), stations);
  return stations;
}

// Normal distance of a point from the parabola of the nearest station; the arc length places the foot.
double parabolaDistance(const MeasuredPiece& piece, const std::vector<FittedStation>& stations, int i) {
  const int n = static_cast<int>(stations.size());
  const double spacing = piece.length() / (piece.closed() ? n : n - 1);
  double s = piece.s(i);
  int j = spacing > 0.0 ? static_cast<int>(std::lround(s / spacing)) : 0;
  if (piece.closed() && j >= n) j -= n, s -= piece.length();
  j = std::clamp(j, 0, n - 1);
  const LocalQuadratic& fit = stations[j].fit;
  const double u = s - stations[j].s;
  const Vec2 tangent = fit.derivative(u);
  const double speed = tangent.norm();
  const Vec2 miss = piece.point(i) - fit.at(u);
  return speed > 0.0 ? cross(tangent, miss) / speed : miss.norm();
}

struct ResidualSummary {
  double rms = 0.0;
  double largestAveraged = 0.0;
};

ResidualSummary residualsOf(const MeasuredPiece& piece, const std::vector<FittedStation>& stations) {
  ResidualSummary summary;
  double square = 0.0, blockSum = 0.0, blockFrom = 0.0;
  int blockCount = 0;
  for (int i = 0; i < piece.count(); ++i) {
    const double e = parabolaDistance(piece, stations, i);
    square += e * e;
    if (piece.s(i) - blockFrom >= kAveragedPx && blockCount > 0) {
      summary.largestAveraged = std::max(summary.largestAveraged, std::abs(blockSum / blockCount));
      blockSum = 0.0;
      blockCount = 0;
      blockFrom = piece.s(i);
    }
    blockSum += e;
    ++blockCount;
  }
  if (piece.count() > 0) summary.rms = std::sqrt(square / piece.count());
  return summary;
}

PieceSegments toSegments(const MeasuredPiece& piece, const std::vector<FittedStation>& stations) {
  PieceSegments result;
  for (const FittedStation& s : stations) result.stations.push_back(s.station);
  result.residualRmsPx = residualsOf(piece, stations).rms;
  return result;
}

int stationCount(const MeasuredPiece& piece, const SegmentParams& params) {
  const int fewest = piece.closed() ? kFewestClosed : kFewestOpen;
  // As groups need two points each: of stations between the points there is nothing to measure, and the curve over them
  // only takes longer.
  const int most = std::min(kMostStations, std::max(fewest, piece.count() / 2));
  if (params.count > 0) return std::clamp(params.count, piece.closed() ? fewest : kFewestGiven, most);
  const double spacings = std::min(piece.length() / params.spacingPx, static_cast<double>(kMostStations));
  return std::clamp(static_cast<int>(std::lround(spacings)) + (piece.closed() ? 0 : 1), fewest, kMostStations);
}

// Not complete when cancelled.
PieceSegments adaptiveSegments(const MeasuredPiece& piece, const SegmentParams& params, const RunContext& context) {
  const int fewest = piece.closed() ? kFewestClosed : kFewestOpen;
  const double finest = std::min(piece.length() / kSmallestSpacingPx, static_cast<double>(kMostStations));
  const int most = std::max(fewest, static_cast<int>(finest));
  int count = fewest;
  for (;;) {
    const std::vector<FittedStation> stations = stationsOf(piece, count, context);
    if (context.isCancelled()) return {};
    if (count >= most || residualsOf(piece, stations).largestAveraged <= params.tolerancePx) {
      return toSegments(piece, stations);
    }
    count = std::min(most, std::max(count + 1, static_cast<int>(count * kAdaptiveGrowth)));
  }
}

/// The points that groups are made of: of a pen stroke those that were drawn, of other lines all.
std::vector<Vec2> groupedPoints(const Piece& piece) {
  if (!piece.isPen) return positionsOf(piece.points);
  std::vector<Vec2> points;
  for (const PiecePoint& p : piece.points) {
    if (p.refined) points.push_back(p.at);
  }
  return points.size() >= 2 ? points : positionsOf(piece.points);
}

PieceSegments groupSegments(const std::vector<Vec2>& points, int groups) {
  PieceSegments result;
  const int n = static_cast<int>(points.size());
  const int k = std::clamp(groups, 1, std::max(1, n / 2));
  const std::vector<int> bounds = groupBoundaries(n, k);
  double square = 0.0;
  for (int g = 0; g < k; ++g) {
    const int from = bounds[g], to = bounds[g + 1];
    const PcaLine line = pcaLine(std::span(points).subspan(from, to - from));
    result.stations.push_back({line.centroid, line.direction, line.from, line.to});
    square += line.residualRms * line.residualRms * (to - from);
  }
  result.residualRmsPx = std::sqrt(square / std::max(1, n));
  return result;
}

// Not complete when cancelled.
PieceSegments segmentsOf(const Piece& piece, const SegmentParams& params, const RunContext& context) {
  if (piece.points.empty()) return {};
  const MeasuredPiece measured(piece);
  if (piece.points.size() < 2 || !(measured.length() > 0.0)) {
    return {{{piece.points.front().at, Vec2::UnitX(), piece.points.front().at, piece.points.front().at}}, 0.0};
  }
  switch (params.mode) {
    case SegmentMode::Stations: {
      const std::vector<FittedStation> stations = stationsOf(measured, stationCount(measured, params), context);
      if (context.isCancelled()) return {};  // there may be none
      return toSegments(measured, stations);
    }
    case SegmentMode::Sturges: {
      const std::vector<Vec2> points = groupedPoints(piece);
      return groupSegments(points, sturgesGroups(static_cast<int>(points.size())));
    }
    case SegmentMode::Count: {
      const double groups = std::min(measured.length() / params.spacingPx, static_cast<double>(kMostStations));
      return groupSegments(groupedPoints(piece), params.count > 0
                                                     ? params.count
                                                     : std::max(kFewestOpen, static_cast<int>(std::lround(groups))));
    }
    case SegmentMode::Adaptive:
      return adaptiveSegments(measured, params, context);
  }
  return {};
}

}  // namespace

std::optional<Error> validate(const SegmentParams& p) {
  const auto bad = [](const char* message) { return Error{ErrorCode::BadParameter, message, {}}; };
  if (p.count != 0 && (p.count < kFewestGiven || p.count > kMostStations))
    return bad("segments.count must be 0 or 2 to 2000.");
  if (!(p.spacingPx >= 8.0 && p.spacingPx <= 400.0)) return bad("segments.spacing must be 8 to 400 px.");
  if (!(p.tolerancePx >= 0.02 && p.tolerancePx <= 5.0)) return bad("segments.tolerance must be 0.02 to 5 px.");
  return std::nullopt;
}

int sturgesGroups(int n) { return n < 1 ? 0 : static_cast<int>(std::bit_width(static_cast<unsigned>(n))); }

std::vector<int> groupBoundaries(int n, int k) {
  std::vector<int> bounds;
  for (int i = 0; i <= k; ++i) bounds.push_back(static_cast<int>(static_cast<std::int64_t>(n) * i / std::max(1, k)));
  return bounds;
}

Result<SegmentSet> regressionSegments(const PieceSet& pieces, const SegmentParams& params, const RunContext& context) {
  if (auto error = validate(params)) return fail(*error);
  SegmentSet set;
  set.pieces.reserve(pieces.pieces.size());
  for (const Piece& piece : pieces.pieces) {
    set.pieces.push_back(segmentsOf(piece, params, context));
    if (context.isCancelled()) return cancelled();
  }
  return set;
}

}  // namespace batten
