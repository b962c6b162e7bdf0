// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/fair/fair_prepare.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

#include "core/base/statistics.h"
#include "core/construct/fair/fair_piece.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr double kGuardOutlinePx = 4.0, kGuardStrokePx = 8.0;  // of line beside a corner, which blur has rounded
constexpr double kGuardShare = 0.1;                            // of the length: short pieces keep most of their points
constexpr double kShortestFairPx = 40.0;                       // below, a low degree says all there is to say
constexpr std::size_t kFewestBlocks = 5;                       // of data: from fewer no cut-off is chosen
constexpr int kGateReach = 5;         // points to either side, whose medians show where a point belongs
constexpr double kCrossingPx = 25.0;  // Gaussian: as long as merged strokes may look like one where they cross
// So that a wrong estimate of the noise does little harm; points that were not placed, in crossings mostly, still hold
// the line together.
constexpr double kLeastWeight = 1.0 / 16.0, kMostWeight = 16.0;

/// [px] Half-width of the bundle at each point; that of a single stroke is 0. Where strokes cross, it is deceptively
/// small.
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

/// Points that differ from their predecessor, about their mean, and what they weigh.
void readPoints(FairPiece& piece, const ConstructPiece& in, std::optional<double> ordinarySigmaPx) {
  std::vector<FairPoint> px;
  const std::vector<float> beside = smoothSpread(in.points, in.closed);
  for (int i = 0; i < std::ssize(in.points); ++i) {
    if (!in.points[i].at.allFinite()) continue;
    const double sigma = in.points[i].sigmaPx.value_or(0.0f);
    const double ratio = sigma > 0.0 && ordinarySigmaPx ? *ordinarySigmaPx / sigma : 1.0;
    FairPoint& p = px.emplace_back();
    p.at = in.points[i].at;
    p.weight = std::clamp(ratio * ratio, kLeastWeight, kMostWeight);
    p.spread = static_cast<double>(beside[i]);
  }
  if (px.empty()) return;
  Vec2 low = px.front().at, high = low, sum = Vec2::Zero();
  for (const FairPoint& p : px) {
    low = low.cwiseMin(p.at);
    high = high.cwiseMax(p.at);
    sum += p.at;
  }
  piece.origin = sum / static_cast<double>(px.size());
  const double same = 1e-9 * (high - low).norm();
  auto& points = piece.data.points;
  for (FairPoint p : px) {
    p.at -= piece.origin;
    if (!points.empty() && (p.at - points.back().at).norm() <= same) continue;
    points.push_back(p);
  }
  while (in.closed && points.size() > 1 && (points.front().at - points.back().at).norm() <= same) points.pop_back();
  piece.data.closed = in.closed;
  if (in.startIsCorner && !in.closed) piece.pins.start = points.front().at;
  if (in.endIsCorner && !in.closed) piece.pins.end = points.back().at;
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
  auto& points = piece.data.points;
  const auto guardFrom = [guardPx](auto first, auto end) {
    const Vec2 corner = first->at;
    first->use = false;
    for (auto p = std::next(first); p != end && (p->at - corner).norm() < guardPx; ++p) p->use = false;
  };
  if (piece.pins.start) guardFrom(points.begin(), points.end());
  if (piece.pins.end) guardFrom(points.rbegin(), points.rend());
}

/// Free ends begin with good points: the curve ends where they do.
void trimFreeEnds(FairPiece& piece) {
  if (piece.data.closed) return;
  auto& points = piece.data.points;
  auto first = points.begin(), last = points.end();
  while (!piece.pins.start && last - first > 2 && !first->use) ++first;
  while (!piece.pins.end && last - first > 2 && !std::prev(last)->use) --last;
  points.erase(last, points.end());
  points.erase(points.begin(), first);
}

}  // namespace

double missAllowedPx(const ConstructPiece& piece) {
  constexpr double kLeastPx = 0.3, kOfWidth = 0.1;
  std::vector<double> widths;
  for (const PiecePoint& p : piece.points)
    if (p.widthPx && std::isfinite(*p.widthPx)) widths.push_back(*p.widthPx);
  return widths.empty() ? kLeastPx : std::max(kLeastPx, kOfWidth * upperMedian(widths));
}

double medianSpacing(const FairData& data) {
  std::vector<double> gaps;
  for (int i = 1; i < std::ssize(data.points); ++i) gaps.push_back((data.points[i].at - data.points[i - 1].at).norm());
  if (gaps.empty()) return 1.0;
  return upperMedian(gaps);
}

void rejectOutliers(FairData& data, double gatePx, double spacing) {
  const int n = static_cast<int>(data.points.size());
  if (n < 2 * kGateReach + 1) return;
  // Half a window of points may lie round a bend that is as sharp as a line can be.
  const double limit = gatePx + 0.5 * kGateReach * spacing;
  const auto at = [&](int i) -> const Vec2& { return data.points[i].at; };
  const auto around = [&](int from, int to) {
    std::vector<Vec2> some;
    for (int j = from; j <= to; ++j) {
      if (data.closed || (j >= 0 && j < n)) some.push_back(at(((j % n) + n) % n));
    }
    return some;
  };
  for (int i = 0; i < n; ++i) {
    if (i >= kGateReach && i + kGateReach < n) {  // the usual case, without medians
      if (awayFromSegment(at(i), at(i - kGateReach), at(i + kGateReach)).norm() <= limit) continue;
    }
    const auto before = around(i - kGateReach, i - 1), after = around(i + 1, i + kGateReach);
    if (before.size() < 3 || after.size() < 3) continue;
    if (awayFromSegment(at(i), median(before), median(after)).norm() > limit) data.points[i].use = false;
  }
}

std::optional<double> ordinarySigma(const ConstructContour& contour) {
  std::vector<float> sigma;
  for (const ConstructPiece& piece : contour.pieces) {
    for (const PiecePoint& p : piece.points) {
      if (p.sigmaPx && *p.sigmaPx > 0.0f && std::isfinite(*p.sigmaPx)) sigma.push_back(*p.sigmaPx);
    }
  }
  if (sigma.empty()) return std::nullopt;
  return upperMedian(sigma);
}

void weighByNoise(FairData& data, const LocalNoise& noise, double measured, double floor, double grain) {
  const double s0 = std::max(measured, floor);
  for (FairPoint& p : data.points) {
    const double there = std::max(measured * noise.at(p.t) / p.weight, grain) + kWanderShare * std::pow(p.spread, 3);
    p.weight = s0 / std::max(there, floor);
  }
}

FairPiece prepareFairPiece(const ConstructPiece& in, bool isStroke, std::optional<double> ordinarySigmaPx,
                           const FairFitOptions& options, CancelCheck check) {
  FairPiece piece;
  readPoints(piece, in, ordinarySigmaPx);
  FairData& data = piece.data;
  if (data.points.size() < 2) return piece;
  double length = 0.0;
  const double spacing = medianSpacing(data);
  data.density = std::min(1.0, 1.0 / std::max(spacing, 1e-9));
  rejectOutliers(data, isStroke ? options.gateStrokePx : options.gateOutlinePx, spacing);
  trimFreeEnds(piece);
  const FairPoint* last = nullptr;
  for (const FairPoint& p : data.points) {
    if (!p.use) continue;
    if (last) length += (p.at - last->at).norm();
    last = &p;
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
