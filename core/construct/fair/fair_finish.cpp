// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/fair/fair_finish.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "core/construct/fair/fair_piece.h"
#include "core/construct/fair/fair_plateaus.h"
#include "core/construct/fair/fair_prepare.h"
#include "core/construct/fair/fair_structure.h"
#include "core/construct/fair/fair_structure_search.h"
#include "core/construct/fair/fewest_knots.h"
#include "core/construct/fair/sharp_features.h"
#include "core/curve/extremum_indices.h"
#include "core/solve/banded_cholesky.h"

namespace batten {
namespace {

constexpr double kPinPrecisionPx = 1e-3;  // the rest of the way a linear shift does
// of a span: places of the constraints, and closer ones for what they miss
constexpr int kChecksPerSpan = 4, kFineChecksPerSpan = 8;
constexpr int kRefinements = 3;         // times that the frame is laid about the curve anew: each costs a solution
constexpr double kWrongWay = 2e-3;      // [1/diagonal] curvature that may turn back unasked before the frame is refined
constexpr double kLeastNoisePx = 0.02;  // systematic error of edges on perfect pages
constexpr double kResidualSigmas = 6.0;    // points farther off are left out of the report's residuals
constexpr double kKappaShare = 2.0;        // of the share of the noise, for the curvature
constexpr double kLeastMeanWeight = 1e-3;  // [1/px^2] of blocks: fewer points are as good as none
constexpr double kCornerReachPx = 16.0;    // an end may lie this far beyond the curve of the moment
// in the report of the piece:
constexpr const char* kShortNote = "Too short for the fair fit; a low-degree curve was fitted to the points.";
constexpr const char* kPlainNote = "The fair fit could not be solved; a smoothed curve was used.";

/// Back from the frame about the origin, with the corner points to the last digit.
Result<NurbsCurve> placed(const Result<NurbsCurve>& curve, const FairPiece& piece, const ConstructPiece& in) {
  if (!curve) return curve;
  std::vector<Vec2> points(curve->controlPoints().begin(), curve->controlPoints().end());
  for (Vec2& p : points) p += piece.origin;
  if (piece.pins.start) points.front() = in.points.front().at;
  if (piece.pins.end) points.back() = in.points.back().at;
  return NurbsCurve::make(5, {curve->knots().begin(), curve->knots().end()}, std::move(points));
}

class FinishedFit {
 public:
  FinishedFit(FairPiece& piece, const ConstructPiece& in, const FairNoise& noise, const FairFitOptions& options,
              const RunContext& context)
      : piece_(piece),
        in_(in),
        s0_(noise.s0),
        cutoffPx_(noise.cutoffPx),
        willBeCut_(noise.willBeCut),
        options_(options),
        context_(context) {}

  void run() {
    if (!piece_.frame) return simple(kShortNote);
    if (fair() || context_.isCancelled()) return;
    const auto& base = piece_.frame->base;
    const auto [start, end] = pinShifts(base);
    auto curve = placed(base.toNurbs(start, end), piece_, in_);
    if (!curve) return simple(kPlainNote);
    report_ = {};
    noConstraintMet();
    report_.why = Termination::Degenerate;
    report_.note = kPlainNote;
    piece_.result = ConstructedPiece{*curve, report_};
  }

 private:
  void simple(const char* note) {
    auto curve = placed(simpleCurve(piece_.data, piece_.pins, missAllowedPx(in_)), piece_, in_);
    if (!curve) {
      piece_.result = fail(curve.error());
      return;
    }
    report_ = {};
    noConstraintMet();
    report_.why = Termination::Degenerate;
    report_.note = note;
    piece_.result = ConstructedPiece{*curve, report_};
  }

  /// True when a result was set.
  bool fair() {
    if (piece_.rough.size() == 0 || !moveFrame(piece_.rough)) return false;
    auto local = localPosterior(frame_, s0_, uniformPrior(frame_, s0_, cutoffPx_), options_.emRounds,
                                options_.emWidthPx, context_);
    if (!local || context_.isCancelled()) return false;
    if (willBeCut_ && in_.constraints.empty() && leavesItsPoints(local->mean)) return true;
    std::optional<double> circleCost;
    const std::vector<PlacedConstraint> constraints = placedConstraints();
    const bool keeps =
        std::any_of(constraints.begin(), constraints.end(), [](const PlacedConstraint& w) { return w.keep; });
    if (piece_.data.closed && !keeps) {
      const auto fit = fitCircle(blockMeans(frame_));
      if (fit) circleCost = fit->squares / s0_ - local->objective(local->mean);
      if (circleCost && *circleCost < 2.0 * options_.extremumSignificance && circle(*fit)) return true;
    }
    auto found = findStructure(frame_, *local, options_.extremumSignificance, constraints, context_);
    if (!found) return false;
    report_.unmetConstraints = found->unmetConstraints;
    if (!piece_.data.closed && found->structure.extrema.empty() && line(found->objective)) return true;

    if (!moveFrame(found->c)) return false;
    const auto final = localPosterior(frame_, s0_, std::move(local->tau2), 1, options_.emWidthPx, context_);
    if (!final) return false;
    for (FairExtremum& e : found->structure.extrema) e.u = parameterAfter(places_, e.u);
    for (FairExtremum& e : found->dropped) e.u = parameterAfter(places_, e.u);
    return finishCurve(*final, *found, circleCost);
  }

  /// True, and a result was set, when the smoothing alone leaves the points: no structure brings it back.
  bool leavesItsPoints(const Eigen::VectorXd& mean) {
    const auto curve = offsetCurve(frame_.base, mean, context_);
    if (!curve) return false;
    auto nurbs = placed(curve->toNurbs(), piece_, in_);
    if (!nurbs || outlierRanges(pointDeviation(*nurbs, in_, context_), in_, false).empty()) return false;
    report_ = {};
    report_.why = Termination::Degenerate;
    report_.note = kPlainNote;
    piece_.result = ConstructedPiece{std::move(*nurbs), report_};
    return true;
  }

  /// New frame along base + d N, cut to where the piece begins and ends.
  bool moveFrame(const Eigen::VectorXd& d) {
    const UniformQuintic base = frame_.blocks.empty() ? piece_.frame->base : frame_.base;
    FairData& data = piece_.data;
    double from = 0.0, to = base.knots().length;
    if (!data.closed) {
      from = base.footPoint(data.points.front().at, 0.0, kCornerReachPx);
      to = base.footPoint(data.points.back().at, to, kCornerReachPx);
    }
    if (!(to - from > 0.5 * base.knots().length)) return false;
    auto moved = reframe(base, d, from, to, context_);
    if (!moved) return false;
    places_ = std::move(moved->places);
    for (FairPoint& p : data.points) p.t = parameterAfter(places_, p.t);
    frame_ = assembleFrame(moved->curve, data, options_, kChecksPerSpan, context_);
    return !frame_.blocks.empty() && !context_.isCancelled();
  }

  /// The constraints by the parameter of the nearest point.
  std::vector<PlacedConstraint> placedConstraints() const {
    std::vector<PlacedConstraint> placed;
    for (const ExtremumConstraint& constraint : in_.constraints) {
      const Vec2 p = constraint.point - piece_.origin;
      double least = std::numeric_limits<double>::infinity(), u = 0.0;
      for (const FairPoint& point : piece_.data.points) {
        const double distance = (point.at - p).squaredNorm();
        if (point.use && distance < least) least = distance, u = point.t;
      }
      placed.push_back({u, constraint.keep, constraint.id});
    }
    return placed;
  }

  void noConstraintMet() {
    for (const ExtremumConstraint& constraint : in_.constraints) report_.unmetConstraints.push_back(constraint.id);
  }

  bool circle(const CircleFit& fit) {
    const PlaneDerivatives start = frame_.base.at(0.0, 1);
    const bool left = cross(start[0] - fit.centre, start[1]) > 0.0;
    const UniformQuintic curve = circleCurve(fit, start[0], left);
    auto nurbs = placed(curve.toNurbs(), piece_, in_);
    if (!nurbs) return false;
    report_.why = Termination::Exact;
    report_.isCircle = true;
    noConstraintMet();
    // Three parameters: the curvature -1/r varies as the radius does, r +- sqrt(S0 / length).
    const double sigma = std::sqrt(s0_ / meanWeight() / frame_.base.knots().length) / (fit.radius * fit.radius);
    for (const double s : {0.0, curve.knots().length}) report_.noise.push_back({s, sigma});
    for (const FairPoint& p : piece_.data.points) {
      if (p.use) addResidual((p.at - fit.centre).norm() - fit.radius, p.weight);
    }
    piece_.result = ConstructedPiece{*nurbs, report_};
    return true;
  }

  double meanWeight() const {
    double sum = 0.0;
    for (const FairBlock& block : frame_.blocks) sum += block.weight;
    return std::max(kLeastMeanWeight, sum / static_cast<double>(frame_.blocks.size()));
  }

  void addResidual(double e, double weight) {
    if (std::abs(e) * std::sqrt(weight) > kResidualSigmas * std::sqrt(s0_)) return;
    piece_.squares += e * e;
    ++piece_.pointCount;
  }

  bool line(double objective) {
    const auto fit = fitLine(blockMeans(frame_));
    if (!fit || !(fit->squares / s0_ - objective < options_.extremumSignificance)) return false;
    const Vec2 &first = piece_.data.points.front().at, &last = piece_.data.points.back().at;
    auto curve = placed(lineCurve(*fit, first, last, piece_.pins), piece_, in_);
    if (!curve) return false;
    report_.why = Termination::Exact;
    report_.isLine = true;
    for (const FairPoint& p : piece_.data.points) {
      if (p.use) addResidual(cross(fit->direction, p.at - fit->point), p.weight);
    }
    // A parabola's curvature from data of density S0 over the length L: variance 720 S0 / L^5.
    const double length = (last - first).norm();
    const double sigma = std::sqrt(720.0 * s0_ / meanWeight() / std::pow(length, 5));
    for (const double s : {0.0, length}) report_.noise.push_back({s, sigma});
    piece_.result = ConstructedPiece{*curve, report_};
    return true;
  }

  /// What is left between the ends of a curve and the pins.
  struct EndShifts {
    Vec2 start = Vec2::Zero(), end = Vec2::Zero();
  };
  EndShifts pinShifts(const UniformQuintic& curve) const {
    const FairPins& pins = piece_.pins;
    EndShifts shifts;
    if (pins.start) shifts.start = *pins.start - curve.at(0.0, 0)[0];
    if (pins.end) shifts.end = *pins.end - curve.at(curve.knots().length, 0)[0];
    if (pins.start && !pins.end) shifts.end = shifts.start;
    if (pins.end && !pins.start) shifts.start = shifts.end;
    return shifts;
  }

  void pinEnds(FairPosterior& posterior) const {
    const UniformKnots& knots = frame_.base.knots();
    const auto pin = [&](const Vec2& target, double u) {
      const PlaneDerivatives d = frame_.base.at(u, 1);
      const double offset = (target - d[0]).dot(leftNormal(d[1]).normalized());
      const double weight = 1.0 / (kPinPrecisionPx * kPinPrecisionPx);
      posterior.a.addOuter(knots.row(u, 0), weight);
      addTo(posterior.b, knots.row(u, 0), weight * offset);
    };
    if (piece_.pins.start) pin(*piece_.pins.start, 0.0);
    if (piece_.pins.end) pin(*piece_.pins.end, knots.length);
  }

  std::optional<UniformQuintic> structuredCurve(FairPosterior posterior, StructureResult& found) {
    const Eigen::VectorXd start = posterior.mean;
    pinEnds(posterior);
    found.structure.leastSlope.clear();
    auto fit = fitStructure(frame_, posterior, found.structure, start, {}, context_);
    if (!fit) return std::nullopt;
    found.limited = found.limited || !fit->converged;
    auto curve = offsetCurve(frame_.base, fit->c, context_);
    pinned_ = std::move(posterior);
    last_ = std::move(fit);
    return curve;
  }

  /// True if the curvature itself (the programs see it to first order) has more extrema than the structure.
  bool hasMoreExtrema(const UniformQuintic& curve, const FairStructure& structure) const {
    const UniformKnots& knots = curve.knots();
    const int steps = kFineChecksPerSpan * knots.spans, count = steps + (knots.closed ? 0 : 1);
    Vec2 low = curve.at(0.0, 0)[0], high = low;
    std::vector<double> kappa;
    kappa.reserve(count);
    for (int j = 0; j < count && !context_.isCancelled(); ++j) {
      const PlaneDerivatives d = curve.at(j * knots.length / steps, 2);
      low = low.cwiseMin(d[0]);
      high = high.cwiseMax(d[0]);
      kappa.push_back(frameCurvature(d));
    }
    const double least = kWrongWay / (high - low).norm();
    return countExtrema(kappa, least, false) > std::ssize(structure.extrema);
  }

  bool finishCurve(const FairPosterior& posterior, StructureResult& found, std::optional<double> circleCost) {
    auto curve = structuredCurve(posterior, found);
    for (int pass = 0; curve && pass < kRefinements && hasMoreExtrema(*curve, found.structure); ++pass) {
      // About the curve itself, with its own knots, the linear constraints are exact but for a tiny remainder.
      frame_ = assembleFrame(*curve, piece_.data, options_, kFineChecksPerSpan, context_);
      if (context_.isCancelled()) return false;
      last_.reset();
      const auto about = localPosterior(frame_, s0_, posterior.tau2, 0, options_.emWidthPx, context_);
      if (!about || context_.isCancelled()) break;
      auto better = structuredCurve(*about, found);
      if (!better) break;
      curve = std::move(better);
    }
    if (!curve || context_.isCancelled()) return false;
    if (last_) {
      FairStructure structure = found.structure;
      const StructureFit lifted = withoutPlateaus(frame_, pinned_, structure, *last_, context_);
      auto steady = structure.leastSlope.empty() ? std::nullopt : offsetCurve(frame_.base, lifted.c, context_);
      if (steady && !hasMoreExtrema(*steady, structure)) {
        curve = std::move(steady);
        found.structure = std::move(structure);
      }
    }
    const auto [start, end] = pinShifts(*curve);
    auto nurbs = placed(curve->toNurbs(start, end), piece_, in_);
    if (!nurbs) return false;
    report_.fullControlPoints = nurbs->controlPointCount();
    if (auto fewer = withKnotsRemoved(posterior, *curve, start, end)) nurbs = std::move(*fewer);
    report_.why = found.limited ? Termination::IterationLimit : Termination::Converged;
    noteExtrema(found, *curve, circleCost);
    noteNoise(posterior, *curve);
    piece_.squares = frame_.squares;
    piece_.pointCount = frame_.pointCount;
    piece_.result = ConstructedPiece{*nurbs, report_};
    return true;
  }

  /// The same curve with fewer control points, as far as the noise of the edge allows.
  std::optional<Result<NurbsCurve>> withKnotsRemoved(const FairPosterior& posterior, const UniformQuintic& curve,
                                                     const Vec2& start, const Vec2& end) {
    if (!(options_.knotRemovalTolerance > 0.0) || frame_.pointCount == 0 || context_.isCancelled()) return std::nullopt;
    const int stations = kChecksPerSpan * curve.knots().spans + (piece_.data.closed ? 0 : 1);
    const int stride = checkStride(stations);
    // By weight: the calm stretches of an uneven line say how far it may move.
    const double calm = std::max(kLeastNoisePx, std::sqrt(frame_.weightedSquares / frame_.weights));
    std::vector<FewestKnotsLimit> stationLimits;
    for (int i = 0; i < std::ssize(frame_.checks); i += stride) {
      const FrameStation& s = frame_.checks[i];
      stationLimits.push_back({options_.knotRemovalTolerance * std::max(calm, kMeanShare * spreadAt(s.u)),
                               std::sqrt(std::max(0.0, BandedCholesky::quadratic(posterior.covariance, s.kappaRow)))});
    }
    FewestKnotsLimits limits;
    limits.stations = stationLimits;
    limits.perSpan = kChecksPerSpan;
    limits.kappaShare = kKappaShare * options_.knotRemovalTolerance;
    limits.startShift = start;
    limits.endShift = end;
    const auto fewer = withFewestKnots(curve, limits, context_);
    if (!fewer) return std::nullopt;
    auto nurbs = placed(fewer->curve, piece_, in_);
    if (!nurbs) return std::nullopt;
    report_.knotRemovalMovedPx = fewer->movedPx;
    return nurbs;
  }

  /// Every how many check stations leave about `count` of them.
  int checkStride(int count) const { return std::max(1, static_cast<int>(frame_.checks.size()) / count); }

  /// Half the breadth of the strokes at a parameter. The points lie along the curve in order, nearly.
  double spreadAt(double u) const {
    const auto& points = piece_.data.points;
    const auto at = std::ranges::lower_bound(points, u, {}, &FairPoint::t);
    return (at == points.end() ? points.back() : *at).spread;
  }

  void noteExtrema(const StructureResult& found, const UniformQuintic& curve, std::optional<double> circleCost) {
    const auto note = [&](const FairExtremum& e, bool kept) {
      const double cost = e.costKnown || !kept ? e.removalCost : circleCost.value_or(e.removalCost);
      const double u = std::clamp(e.u, 0.0, curve.knots().length);
      ExtremumNote made{curve.arcLength(u), e.kappa, e.maximum, kept, cost};
      made.point = curve.at(u, 0)[0] + piece_.origin;
      made.constraint = e.constraint;
      report_.extrema.push_back(made);
    };
    for (const FairExtremum& e : found.structure.extrema) note(e, true);
    for (const FairExtremum& e : found.dropped) note(e, false);
    std::sort(report_.extrema.begin(), report_.extrema.end(),
              [](const ExtremumNote& a, const ExtremumNote& b) { return a.s < b.s; });
  }

  void noteNoise(const FairPosterior& posterior, const UniformQuintic& curve) {
    const int stride = checkStride(kChecksPerSpan * frame_.base.knots().spans);
    for (int i = 0; i < std::ssize(frame_.checks); i += stride) {
      const FrameStation& s = frame_.checks[i];
      const double variance = BandedCholesky::quadratic(posterior.covariance, s.kappaRow);
      report_.noise.push_back({curve.arcLength(s.u), std::sqrt(std::max(0.0, variance))});
    }
  }

  FairPiece& piece_;
  const ConstructPiece& in_;
  double s0_, cutoffPx_;
  bool willBeCut_;
  const FairFitOptions& options_;
  const RunContext& context_;
  FairFrame frame_;
  std::vector<ParameterPair> places_;  ///< Of the last change of frame.
  FairPosterior pinned_;               ///< With the ends on the pins, and the last fit by it about frame_.
  std::optional<StructureFit> last_;
  ConstructReport report_;
};

}  // namespace

void finishFairPiece(FairPiece& piece, const ConstructPiece& in, const FairNoise& noise, const FairFitOptions& options,
                     const RunContext& context) {
  FinishedFit(piece, in, noise, options, context).run();
}

}  // namespace batten
