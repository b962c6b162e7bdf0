// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/typical/typical_line.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/construct/bezier/bezier_chain.h"
#include "core/construct/fair/fair_fit.h"
#include "core/construct/stations/piece_stations.h"
#include "core/construct/typical/typical_path_geometry.h"
#include "core/curve/arc_length.h"
#include "core/curve/closest_point.h"
#include "core/curve/curvature.h"

namespace batten {

namespace {

/// More points than this are taken together in groups: they say no more, and cost time.
constexpr std::size_t kMostPoints = 400;
/// Largest distance [px] of an end of the stations and one of the fit that are the same place.
constexpr double kAgreePx = 0.05;
/// Distance of the joints along a fair fit, and the shortest one that is taken as a guide.
constexpr double kJointPx = 40.0, kLeastFairPx = 40.0;
constexpr int kFewestIntervals = 8;  // between them, however short the line is: a chain tells its bends by them

/// A closed line is opened after the station whose segment bends least: curvature is least at a joint, never inside a
/// typical curve.
void rotateToStraightest(std::vector<Station>& stations) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < stations.size(); ++i) {
    const double turn = std::abs(angleBetween(stations[i].direction, stations[(i + 1) % stations.size()].direction));
    if (turn < least) {
      least = turn;
      best = i;
    }
  }
  const auto first = static_cast<std::ptrdiff_t>((best + 1) % stations.size());
  std::rotate(stations.begin(), stations.begin() + first, stations.end());
}

}  // namespace

namespace {

/// The line as its true and fair fit shows it; absent where there is none.
std::optional<TypicalLine> lineOnFairFit(const ConstructPiece& piece, bool grows, const RunContext& context) {
  ConstructContour contour;
  contour.pieces = {piece};
  contour.pieces.front().constraints.clear();
  FairFitOptions options;
  options.knotRemovalTolerance = 0.0;
  const auto fitted = fairFit(contour, options, context);
  // With sharp turns it still is the line, but nothing grows through them; a curve that only took its place is none.
  if (!fitted || fitted->size() != 1 || fitted->front().report.why == Termination::Degenerate) return std::nullopt;
  if (grows && !fitted->front().report.note.empty()) return std::nullopt;
  const NurbsCurve& curve = fitted->front().curve;
  const double length = curve.isEmpty() ? 0.0 : ArcLength(curve).total();
  if (!(length > kLeastFairPx)) return std::nullopt;
  // A fit that lost its line is no guide.
  if (!(deviation(curve, positionsOf(piece.points), true).rms < kLostRmsPx)) return std::nullopt;
  TypicalLine line;
  line.closed = piece.closed;
  line.fair = curve;
  const int joints = std::max(kFewestIntervals, static_cast<int>(std::ceil(length / kJointPx))) + 1;
  const auto samples = sampleByArcLength(curve, joints);
  line.origin = samples.front().point;
  line.end = samples.back().point;
  // Where the stations and the fit agree on an end, it is that of the stations, as in the other constructions.
  const std::vector<Station> stations =
      line.closed ? std::vector<Station>{} : usableStations(piece, kFewestClosedStations);
  if (!stations.empty()) {
    const auto agrees = [&](const Vec2& a, const Vec2& b) { return (a - b).norm() < kAgreePx; };
    if (agrees(stations.front().point, line.origin)) line.origin = stations.front().point;
    if (agrees(stations.back().point, line.end)) line.end = stations.back().point;
  }
  for (const CurveSample& s : samples) line.joints.push_back({line.toLine(s.point), s.tangent, s.kappa});
  if (line.closed) {
    line.joints.back() = line.joints.front();
  } else {
    line.joints.front().point = Vec2::Zero();
    line.joints.back().point = line.toLine(line.end);
  }
  return line;
}

/// The line as its stations show it.
TypicalLine lineOnStations(const ConstructPiece& piece, const ConstructParams& params, const RunContext& context) {
  TypicalLine line;
  // A chain needs no closer stations: it goes by the points, and by more joints it only takes longer.
  std::vector<Station> stations = usableStations(piece, kFewestClosedStations);
  if (stations.size() < (piece.closed ? 3u : 2u)) return line;
  if (piece.closed) rotateToStraightest(stations);
  const FairedJoints faired = fairedJoints(givenStations(stations), piece.closed, params.lowPass, context);
  line.origin = stations.front().point;
  line.end = stations.back().point;
  for (const Joint& j : faired.joints) {
    line.joints.push_back({line.toLine(j.point), j.tangent, j.kappa});
  }
  line.closed = piece.closed;
  return line;
}

}  // namespace

TypicalLine typicalLine(const ConstructPiece& piece, const ConstructParams& params, const RunContext& context) {
  auto fair = lineOnFairFit(piece, params.typical == TypicalMode::Growing, context);
  TypicalLine line = fair ? std::move(*fair) : lineOnStations(piece, params, context);
  if (!line.joints.empty()) line.points = pointsAlong(piece, line);
  return line;
}

std::vector<Vec2> pointsAlong(const ConstructPiece& piece, const TypicalLine& line) {
  std::vector<Vec2> all;
  for (const PiecePoint& p : piece.points) {
    if (p.at.allFinite()) all.push_back(line.toLine(p.at));
  }
  if (line.closed && !all.empty()) {
    const auto first = std::min_element(all.begin(), all.end(), [&](const Vec2& a, const Vec2& b) {
      return (a - line.joints.front().point).squaredNorm() < (b - line.joints.front().point).squaredNorm();
    });
    std::rotate(all.begin(), first, all.end());
  }
  if (all.size() < 2 * line.joints.size()) {
    // Hardly more points than joints: the joints are the line.
    all.clear();
    for (const Joint& j : line.joints) all.push_back(j.point);
  }
  const std::size_t group = (all.size() + kMostPoints - 1) / kMostPoints;
  if (group < 2) return all;
  std::vector<Vec2> means;
  std::size_t joint = 0;
  for (std::size_t i = 0; i + group <= all.size(); i += group) {
    Vec2 mean = Vec2::Zero();
    for (std::size_t k = i; k < i + group; ++k) mean += all[k] / static_cast<double>(group);
    while (joint + 1 < line.joints.size() &&
           (line.joints[joint + 1].point - mean).squaredNorm() <= (line.joints[joint].point - mean).squaredNorm()) {
      ++joint;
    }
    // The mean of an arc lies inside it: kappa / 2 times the variance of the arc length.
    const double length =
        (all[i + group - 1] - all[i]).norm() * static_cast<double>(group) / static_cast<double>(group - 1);
    means.push_back(mean - line.joints[joint].kappa * length * length / 24.0 * leftNormal(line.joints[joint].tangent));
  }
  return means;
}

Result<NurbsCurve> pathCurve(const TypicalPath& path, const TypicalLine& line) {
  std::vector<Quintic> pieces;
  for (std::size_t e = 0; e < path.elements.size(); ++e) {
    Quintic& q = pieces.emplace_back(path.quintic(e));
    for (Vec2& p : q) p = line.toPiece(p);
  }
  return joinedQuintics(pieces, 1.0);
}

namespace {

/// Why a segment is no typical curve.
SegmentCause causeOf(double startKappa, double endKappa, double turnRad) {
  constexpr double kStraightTurn = 0.05;  // [rad]
  if (startKappa * endKappa < 0.0 || startKappa * turnRad < 0.0) return SegmentCause::Inflection;
  return std::abs(turnRad) < kStraightTurn ? SegmentCause::Straight : SegmentCause::Even;
}

}  // namespace

std::vector<SegmentNote> segmentNotes(const TypicalPath& path, const TypicalLine& line) {
  std::vector<SegmentNote> notes;
  for (std::size_t e = 0; e < path.elements.size(); ++e) {
    SegmentNote note;
    note.typical = path.elements[e].typical;
    note.startKappa = path.states[e].kappa;
    note.endKappa = path.states[e + 1].kappa;
    note.start = line.toPiece(path.states[e].point);
    note.turnRad = path.states[e + 1].angleRad - path.states[e].angleRad;
    if (!note.typical) note.turnRad = std::remainder(note.turnRad, 2.0 * std::numbers::pi);
    if (!note.typical) note.cause = causeOf(path.states[e].kappa, path.states[e + 1].kappa, note.turnRad);
    if (note.typical) {
      const TypicalCurve curve = path.typical(e);
      note.ratio = curve.ratio;
      note.length = curve.size();
      note.monotone = curve.isMonotone();
    } else {
      note.length = path.hermiteLength(e);
    }
    notes.push_back(note);
  }
  return notes;
}

}  // namespace batten
