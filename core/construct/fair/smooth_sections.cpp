// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/fair/smooth_sections.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

#include "core/construct/fair/fair_join.h"
#include "core/construct/fair/joined_sections.h"
#include "core/construct/nurbs/quintic_nurbs.h"
#include "core/contour/segment/regression_segments.h"
#include "core/curve/curvature.h"
#include "core/curve/knot_operations.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr double kMostLengthRatio = 1.15;  // of a curve to its points: longer, it has a loop of its own
constexpr double kLeastSmoothPx = 24.0;    // between two sharp features; shorter stretches have no fairness to keep
constexpr int kVeryFarCounts = 10;         // points that lie far: as bad as one that lies very far
constexpr int kLoopCounts = 1000;          // the same: as bad as a loop of the curve's own
constexpr double kNoLength = 1e-9;         // of a curve's parameters: what is left beside a cut is rounding
constexpr double kSeamShare = 1e-3;        // of a closed curve: what is nearer to its seam begins or ends there
/// Of a piece that is taken apart at them: nobody draws a line that turns sharply so often from corner to corner.
constexpr int kMostSharpFeatures = 1000;
/// Of a drawn line that becomes a curve at all: scattered points cross the page so often that every place of the curve
/// has hundreds of stretches beside it, which takes minutes.
constexpr int kMostDrawnTurns = 10'000;

/// What lies between two parameters of a fit; of a closed one through its seam where `to` comes before `from`.
Result<ConstructedPiece> stretchOf(const ConstructedPiece& fit, double from, double to, bool closed) {
  const NurbsCurve& c = fit.curve;
  const double start = c.start(), end = c.end(), least = kNoLength * (end - start);
  const auto between = [&](double a, double b) -> Result<NurbsCurve> {
    auto rest =
        a > start + least ? split(c, a).map([](SplitCurve s) { return std::move(s.right); }) : Result<NurbsCurve>(c);
    if (!rest || b > end - least) return rest;
    return split(*rest, b).map([](SplitCurve s) { return std::move(s.left); });
  };
  const double seam = kSeamShare * (end - start);
  if (closed && from > end - seam) from = start;
  if (closed && to < start + seam) to = end;
  ConstructedPiece part{c, fit.report};
  part.report.extrema.clear();
  part.report.noise.clear();
  auto curve = Result<NurbsCurve>(fail(ErrorCode::Numerical, "Nothing lies between."));
  if (from + least < to) {
    addNotes(part.report, fit.report, {from - start, to - start, 0.0});
    curve = between(from, to);
  } else if (closed && from + least < end && to > start + least) {
    addNotes(part.report, fit.report, {from - start, end - start, 0.0});
    addNotes(part.report, fit.report, {0.0, to - start, end - from});
    const auto before = between(from, end), after = between(start, to);
    if (before && after) curve = joinSmoothly(std::array{*before, *after});
  }
  if (!curve) return fail(curve.error());
  const double share = static_cast<double>(curve->controlPointCount()) / c.controlPointCount();
  if (std::optional<int>& full = part.report.fullControlPoints) full = static_cast<int>(std::lround(share * *full));
  part.curve = std::move(*curve);
  return part;
}

// Where the user took a bump out that was drawn, the curve leaves its points because he wants it.
bool isBumpTakenOut(const ConstructPiece& piece) {
  return std::ranges::any_of(piece.constraints, [](const ExtremumConstraint& c) { return !c.keep; });
}

Error tooScattered(std::size_t places) {
  return {
      ErrorCode::NoCurve,
      "it turns sharply at " + std::to_string(places) + " places, at most " + std::to_string(kMostDrawnTurns) +
          " are allowed. Put scattered points in the order in which the line runs, or divide it into several lines.",
      {}};
}

std::string scatteredNote(std::size_t places) {
  return "Too many sharp turns for the fair fit (" + std::to_string(places) + ", at most " +
         std::to_string(kMostSharpFeatures) +
         "): a curve close to the points was used. Put scattered points in the order in which the line runs, and mark "
         "the corners that are meant.";
}

}  // namespace

SmoothSections::SmoothSections(const ConstructPiece& piece, bool isStroke, const FairFitOptions& options)
    : piece_(piece) {
  std::vector<PointRange> sharp = sharpFeatures(piece, isStroke, options);
  if (std::ssize(sharp) > kMostSharpFeatures) {
    scattered_ = sharp.size();
    sharp = {{0, static_cast<int>(piece.points.size()) - 1}};
  }
  sharp_ = united(std::move(sharp), piece, kLeastSmoothPx);
  smooth_ = between(sharp_, piece);
}

std::vector<PiecePoint> SmoothSections::pointsOf(const PointRange& range) const {
  std::vector<PiecePoint> points;
  const int n = static_cast<int>(piece_.points.size());
  for (int i = range.first; i <= range.last; ++i) points.push_back(piece_.points[i % n]);
  return points;
}

std::vector<ConstructPiece> SmoothSections::stretches() const {
  if (sharp_.empty()) return {piece_};
  std::vector<ConstructPiece> pieces;
  for (const PointRange& range : smooth_) {
    ConstructPiece piece;
    piece.points = pointsOf(range);
    piece.grain = piece_.grain;
    piece.startIsCorner = piece_.startIsCorner && range.first == 0;
    piece.endIsCorner = piece_.endIsCorner && range.last + 1 == std::ssize(piece_.points);
    pieces.push_back(std::move(piece));
  }
  for (const ExtremumConstraint& constraint : piece_.constraints) {  // to the stretch with the nearest point
    ConstructPiece* owner = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (ConstructPiece& piece : pieces) {
      for (const PiecePoint& p : piece.points) {
        const double distance = (p.at - constraint.point).squaredNorm();
        if (distance < least) least = distance, owner = &piece;
      }
    }
    if (owner) owner->constraints.push_back(constraint);
  }
  return pieces;
}

bool SmoothSections::check(std::vector<ConstructedPiece> fits, bool lastRound, CancelCheck run) {
  fits_ = std::move(fits);
  const auto pieces = stretches();
  std::vector<PointRange> sharp = sharp_;
  std::vector<OutlierFit> leaving;
  bool more = false;
  for (std::size_t i = 0; i < fits_.size(); ++i) {
    if (isBumpTakenOut(pieces[i])) continue;
    const PointDeviation deviation = pointDeviation(fits_[i].curve, pieces[i], run);
    if (run.isCancelled()) return false;
    const int offset = smooth_[i].first;
    const auto outliers = outlierRanges(deviation, pieces[i], lastRound);
    for (PointRange r : outliers) sharp.push_back({r.first + offset, r.last + offset});
    if (lastRound && !outliers.empty()) leaving.push_back({i, deviation, outliers});
    more = more || !outliers.empty();
  }
  if (!more) return false;
  const int n = static_cast<int>(piece_.points.size());
  for (PointRange& r : sharp) {
    if (r.first >= n) r = {r.first - n, r.last - n};
  }
  sharp_ = united(std::move(sharp), piece_, kLeastSmoothPx);
  if (lastRound) {
    keepNear(leaving, pieces);
  } else {
    smooth_ = between(sharp_, piece_);
  }
  return true;
}

void SmoothSections::keepNear(const std::vector<OutlierFit>& leaving, const std::vector<ConstructPiece>& pieces) {
  std::vector<ConstructedPiece> kept;
  std::vector<PointRange> ranges;
  auto next = leaving.begin();
  for (std::size_t i = 0; i < fits_.size(); ++i) {
    if (next == leaving.end() || next->fit != i) {
      kept.push_back(std::move(fits_[i]));
      ranges.push_back(smooth_[i]);
      continue;
    }
    const ConstructPiece& piece = pieces[i];
    const auto outliers = united(next->outliers, piece, kLeastSmoothPx);
    const std::vector<PointOffset>& at = next->deviation.points;
    const int n = static_cast<int>(at.size());
    for (const PointRange& r : between(outliers, piece)) {
      const bool atStart = !piece.closed && r.first == 0, atEnd = !piece.closed && r.last == n - 1;
      const double from = atStart ? fits_[i].curve.start() : at[r.first % n].parameter;
      const double to = atEnd ? fits_[i].curve.end() : at[r.last % n].parameter;
      auto part = stretchOf(fits_[i], from, to, piece.closed);
      if (!part) continue;  // left to the corner fill
      kept.push_back(std::move(*part));
      ranges.push_back({r.first + smooth_[i].first, r.last + smooth_[i].first});
    }
    ++next;
  }
  fits_ = std::move(kept);
  smooth_ = std::move(ranges);
}

// A fit may end beside its points by what makes none of them an outlier. The corner fill that goes on from there would
// have to turn back to them: beside a sharp feature a fit ends where it is on its points.
void SmoothSections::endOnPoints(CancelCheck run) {
  constexpr double kOffPx = 0.7, kOnPx = 0.35;  // beside the points; on them
  constexpr double kGrainShare = 0.5;           // of the standard deviation of the grain more
  constexpr int kLongestShare = 3;              // of a stretch so much is cut off at most
  const std::vector<ConstructPiece> pieces = stretches();
  const int all = static_cast<int>(piece_.points.size());
  const auto allowed = [&](const PiecePoint& point) {
    return kGrainShare * piece_.grain.sigmaPx + static_cast<double>(point.spreadPx.value_or(0.0f));
  };
  for (std::size_t i = 0; i < fits_.size(); ++i) {
    if (isBumpTakenOut(pieces[i])) continue;
    const NurbsCurve& curve = fits_[i].curve;
    const std::vector<PiecePoint>& points = pieces[i].points;
    const auto isOff = [&](const Vec2& end, const PiecePoint& point) {
      return (end - point.at).norm() > kOffPx + allowed(point);
    };
    const bool isOffAtStart =
        (piece_.closed || smooth_[i].first > 0) && isOff(curve.point(curve.start()), points.front());
    const bool isOffAtEnd =
        (piece_.closed || smooth_[i].last < all - 1) && isOff(curve.point(curve.end()), points.back());
    if (!isOffAtStart && !isOffAtEnd) continue;
    const std::vector<PointOffset> at = pointDeviation(curve, pieces[i], run).points;
    if (run.isCancelled()) return;
    const auto isOn = [&](int k) { return at[k].offPx <= kOnPx + allowed(points[k]); };
    const int n = static_cast<int>(at.size());
    int first = 0, last = n - 1;
    while (isOffAtStart && first < n / kLongestShare && !isOn(first)) ++first;
    while (isOffAtEnd && last > n - 1 - n / kLongestShare && !isOn(last)) --last;
    if (!isOn(first)) first = 0;
    if (!isOn(last)) last = n - 1;
    if (first == 0 && last == n - 1) continue;
    auto part = stretchOf(fits_[i], first > 0 ? at[first].parameter : curve.start(),
                          last < n - 1 ? at[last].parameter : curve.end(), false);
    if (!part) continue;
    fits_[i] = std::move(*part);
    smooth_[i] = {smooth_[i].first + first, smooth_[i].first + last};
  }
}

Result<ConstructedPiece> SmoothSections::throughStations(const RunContext& context) const {
  PieceSet set;
  set.pieces.resize(1);
  Piece& line = set.pieces[0];
  line = Piece{static_cast<const PieceLine&>(piece_)};
  line.lengthPx = polylineLength(positionsOf(line.points), false);
  for (PiecePoint& p : line.points) p.refined = true;
  SegmentParams adaptive;
  adaptive.mode = SegmentMode::Adaptive;
  const auto segments = regressionSegments(set, adaptive, context);
  if (!segments) return fail(segments.error());
  ConstructPiece piece = piece_;
  piece.stations = segments->pieces.at(0).stations;
  auto made = constructQuinticNurbs(piece, ConstructParams{}, context);
  if (!made) return made;
  made->report.why = Termination::Degenerate;
  made->report.note = "The fair fit did not stay on this line; quintic NURBS were used.";
  return made;
}

/// Constraints whose extremum was not kept, or could not be removed.
void SmoothSections::noteUnmet(ConstructReport& report) const {
  report.unmetConstraints.clear();
  for (const ExtremumConstraint& constraint : piece_.constraints) {
    const bool met = std::any_of(report.extrema.begin(), report.extrema.end(), [&](const ExtremumNote& e) {
      return e.constraint == constraint.id && e.kept == constraint.keep;
    });
    if (!met) report.unmetConstraints.push_back(constraint.id);
  }
}

Result<ConstructedPiece> SmoothSections::joined(const RunContext& context) && {
  if (sharp_.empty()) return std::move(fits_.front());
  if (scattered_ && piece_.isDrawn && std::cmp_greater(*scattered_, kMostDrawnTurns))
    return fail(tooScattered(*scattered_));
  auto whole = joinedParts(context);
  if (whole) noteUnmet(whole->report);
  return whole;
}

Result<ConstructedPiece> SmoothSections::joinedParts(const RunContext& context) {
  endOnPoints(context);
  if (context.isCancelled()) return cancelled();
  auto whole = joinSections(piece_, {sharp_, smooth_, fits_}, context);
  if (context.isCancelled()) return cancelled();
  if (whole && scattered_) {
    whole->report.note = scatteredNote(*scattered_);
    return whole;
  }
  const auto farness = [&](const PointDeviation& c) {
    return c.far + kVeryFarCounts * c.veryFar + (c.lengthRatio > kMostLengthRatio ? kLoopCounts : 0);
  };
  std::optional<int> far;
  if (whole) {
    const PointDeviation deviation = pointDeviation(whole->curve, piece_, context);
    if (context.isCancelled()) return cancelled();
    if (deviation.good()) return whole;
    far = farness(deviation);
  }
  auto other = throughStations(context);
  if (!other) return whole;
  if (far && farness(pointDeviation(other->curve, piece_, context)) >= *far) return whole;
  return other;
}

}  // namespace batten
