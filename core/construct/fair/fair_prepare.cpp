// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/fair/fair_prepare.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/base/statistics.h"
#include "core/construct/fair/fair_piece.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr double kGuardOutlinePx = 4.0, kGuardStrokePx = 8.0;
constexpr double kGuardShare = 0.1;       // of the length: short pieces keep most of their points
constexpr double kShortestFairPx = 40.0;  // below, a low degree says all there is to say
constexpr std::size_t kFewestBlocks = 5;
constexpr int kGateReach = 5;
constexpr double kCrossingPx = 25.0;  // Gaussian: as long as merged strokes may look like one where they cross
// So that a wrong estimate of the noise does little harm; points that were not placed, in crossings mostly, still hold
// the line together.
constexpr double kLeastWeight = 1.0 / 16.0, kMostWeight = 16.0;

/// [px] Half-width of the bundle at each point, 0 where there is none. Where strokes cross, it is deceptively small.
std::vector<float> smoothSpread(const std::vector<PiecePoint>& points, bool closed) {
  std::vector<float> square;
  for (const PiecePoint& p : points) {
    const float s = p.spreadPx.value_or(0.0f);
    square.push_back(std::isfinite(s) ? s * s : 0.0f);
  }
  if (std::ranges::all_of(square, [](float s) { return s == 0.0f; })) return square;
  square = smoothValues(square, closed, kCrossingPx);
  for (float& s : square) s = std::sqrt(std::max(0.0f, s));
  return square;
}

/// Points that differ from their predecessor, in px about their mean, and what they weigh.
void readPoints(FairPiece& piece, const ConstructPiece& in, double pixelMm, double ordinarySigmaPx) {
  std::vector<Vec2> px;
  std::vector<double> weight, spread;
  const std::vector<float> beside = smoothSpread(in.points, in.closed);
  for (int i = 0; i < std::ssize(in.points); ++i) {
    if (!in.points[i].at.allFinite()) continue;
    px.push_back(in.points[i].at / pixelMm);
    const double sigma = in.points[i].sigmaPx.value_or(0.0f);
    const double ratio = sigma > 0.0 && ordinarySigmaPx > 0.0 ? ordinarySigmaPx / sigma : 1.0;
    weight.push_back(std::clamp(ratio * ratio, kLeastWeight, kMostWeight));
    spread.push_back(static_cast<double>(beside[i]));
  }
  if (px.empty()) return;
  Vec2 low = px.front(), high = px.front(), sum = Vec2::Zero();
  for (const Vec2& p : px) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
    sum += p;
  }
  piece.origin = sum / static_cast<double>(px.size());
  const double same = 1e-9 * (high - low).norm();
  auto& points = piece.data.points;
  for (std::size_t i = 0; i < px.size(); ++i) {
    const Vec2 centred = px[i] - piece.origin;
    if (!points.empty() && (centred - points.back()).norm() <= same) continue;
    points.push_back(centred);
    piece.data.weight.push_back(weight[i]);
    piece.data.spread.push_back(spread[i]);
  }
  while (in.closed && points.size() > 1 && (points.front() - points.back()).norm() <= same) {
    points.pop_back();
    piece.data.weight.pop_back();
    piece.data.spread.pop_back();
  }
  piece.data.closed = in.closed;
  piece.data.use.assign(points.size(), 1);
  if (in.startIsCorner && !in.closed) piece.pins.start = points.front();
  if (in.endIsCorner && !in.closed) piece.pins.end = points.back();
}

Vec2 median(const std::vector<Vec2>& p) {
  std::vector<double> x, y;
  for (const Vec2& one : p) {
    x.push_back(one.x());
    y.push_back(one.y());
  }
  return {upperMedian(x), upperMedian(y)};
}

/// Leaves out the points next to corners, where blur has rounded the line.
void guardCorners(FairPiece& piece, double guardPx) {
  auto& data = piece.data;
  const auto n = data.points.size();
  if (piece.pins.start) {
    data.use.front() = 0;
    for (std::size_t i = 1; i < n && (data.points[i] - data.points.front()).norm() < guardPx; ++i) data.use[i] = 0;
  }
  if (piece.pins.end) {
    data.use.back() = 0;
    for (std::size_t i = n - 1; i-- > 0 && (data.points[i] - data.points.back()).norm() < guardPx;) data.use[i] = 0;
  }
}

/// Free ends begin with good points: the curve ends where they do.
void trimFreeEnds(FairPiece& piece) {
  auto& data = piece.data;
  if (data.closed) return;
  std::size_t first = 0, last = data.points.size();
  while (!piece.pins.start && first + 2 < last && !data.use[first]) ++first;
  while (!piece.pins.end && first + 2 < last && !data.use[last - 1]) --last;
  const auto cut = [&](auto& v) {
    v.erase(v.begin() + static_cast<std::ptrdiff_t>(last), v.end());
    v.erase(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(first));
  };
  cut(data.points);
  cut(data.use);
  cut(data.weight);
  cut(data.spread);
}

}  // namespace

double medianSpacing(const std::vector<Vec2>& points) {
  std::vector<double> gaps;
  for (std::size_t i = 1; i < points.size(); ++i) gaps.push_back((points[i] - points[i - 1]).norm());
  if (gaps.empty()) return 1.0;
  return upperMedian(gaps);
}

void rejectOutliers(FairData& data, double gatePx, double spacing) {
  const int n = static_cast<int>(data.points.size());
  if (n < 2 * kGateReach + 1) return;
  // Half a window of points may lie round a bend that is as sharp as a line can be.
  const double limit = gatePx + 0.5 * kGateReach * spacing;
  const std::vector<Vec2> p = data.points;
  const auto around = [&](int from, int to) {
    std::vector<Vec2> some;
    for (int j = from; j <= to; ++j) {
      if (data.closed || (j >= 0 && j < n)) some.push_back(p[((j % n) + n) % n]);
    }
    return some;
  };
  for (int i = 0; i < n; ++i) {
    if (i >= kGateReach && i + kGateReach < n) {  // the usual case, without medians
      const auto at = static_cast<std::size_t>(i);
      if (awayFromSegment(p[at], p[at - kGateReach], p[at + kGateReach]).norm() <= limit) continue;
    }
    const auto before = around(i - kGateReach, i - 1), after = around(i + 1, i + kGateReach);
    if (before.size() < 3 || after.size() < 3) continue;
    if (awayFromSegment(p[i], median(before), median(after)).norm() > limit) {
      data.use[i] = 0;
    }
  }
}

double ordinarySigma(const ConstructContour& contour) {
  std::vector<float> sigma;
  for (const ConstructPiece& piece : contour.pieces) {
    for (const PiecePoint& p : piece.points) {
      if (p.sigmaPx && *p.sigmaPx > 0.0f && std::isfinite(*p.sigmaPx)) sigma.push_back(*p.sigmaPx);
    }
  }
  if (sigma.empty()) return 0.0;
  return upperMedian(sigma);
}

void weighByNoise(FairData& data, const LocalNoise& noise, double measured, double floor) {
  const double s0 = std::max(measured, floor);
  for (std::size_t i = 0; i < data.weight.size(); ++i) {
    const double there = measured * noise.at(data.t[i]) / data.weight[i] + kWanderShare * std::pow(data.spread[i], 3);
    data.weight[i] = s0 / std::max(there, floor);
  }
}

FairPiece prepareFairPiece(const ConstructPiece& in, bool isStroke, double pixelMm, double ordinarySigmaPx,
                           const FairFitOptions& options, CancelCheck check) {
  FairPiece piece;
  readPoints(piece, in, pixelMm, ordinarySigmaPx);
  FairData& data = piece.data;
  if (data.points.size() < 2) return piece;
  double length = 0.0;
  const double spacing = medianSpacing(data.points);
  data.density = std::min(1.0, 1.0 / std::max(spacing, 1e-9));
  rejectOutliers(data, isStroke ? options.gateStrokePx : options.gateOutlinePx, spacing);
  trimFreeEnds(piece);
  const Vec2* last = nullptr;
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    if (!data.use[i]) continue;
    if (last) length += (data.points[i] - *last).norm();
    last = &data.points[i];
  }
  guardCorners(piece, std::min(isStroke ? kGuardStrokePx : kGuardOutlinePx, kGuardShare * length));
  if (length < kShortestFairPx) return piece;
  const auto pilot = fitPilot(data, options, check);
  if (!pilot) return piece;
  FairFrame frame = assembleFrame(*pilot, data, options, 0, check);
  if (frame.blocks.size() < kFewestBlocks) return piece;
  piece.table = cutoffTable(frame, check);
  piece.frame = std::move(frame);
  return piece;
}

}  // namespace batten
