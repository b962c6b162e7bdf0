// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/light/light_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/construct/light/end_hooks.h"
#include "core/construct/light/exact_shape.h"
#include "core/construct/light/held_ends.h"
#include "core/construct/light/light_check.h"
#include "core/curve/curvature.h"

namespace batten {
namespace {

// control points of a curve that bends: lines come before, in exact()
constexpr int kFewestOpenPoints = 3, kFewestClosedPoints = 4;
constexpr int kMostSpanDegree = 7;  // of a curve of one span
// Times the prominence of an extremum: where the curvature of a piece rises by less in all, no direction is asked of
// it. The piece may be a side of a shape ten times its size, and extrema are counted by the size of the shape.
constexpr double kLeastRise = 0.1;
constexpr double kOrder = 9.0;           // a fit of c points errs by about c to the power of minus this
constexpr double kMostGrowth = 1.6;      // of the number of points from one try to the next
constexpr double kWorkPerPoint = 60.0;   // iterations times spans, about 0.01 ms each, per point that may be spared
constexpr int kCheckRounds = 4;          // of one fit, while the strict check finds a little missing
constexpr double kNearly = 1.3;          // tolerances: more than a little
constexpr double kHopeless = 5.0;        // tolerances after the first phase: no other start will do
constexpr double kAskedLess = 0.98;      // of the tolerance over what was missed: the next round's
constexpr double kMoreSignMargin = 5.0;  // times the margin of the signs, in the next round
constexpr double kMoreSigns = 3.0;       // their weight then
constexpr int kLightQuintic = 5, kLightCubic = 3;  // degrees of splines
constexpr double kCalmShare = 0.75;  // of the curvature that an end may have more: beside it the curves differ, too
constexpr int kWorthCalmEnds = 5;    // control points more for ends without hooks: a quintic span of their own
constexpr double kMoreWorkForCalmEnds = 3.0;  // times kWorkPerPoint: ends that are held make a fit harder

LightSign signOf(bool isPositive) { return isPositive ? LightSign::Positive : LightSign::Negative; }

class LightSearch {
 public:
  LightSearch(const NurbsCurve& dense, const LightReference& reference, const LightOptions& options,
              const LightTask& task, const RunContext& context)
      : dense_(dense), reference_(reference), options_(options), task_(task), context_(context) {
    if (!task.keepStructure) {
      bounds_ = {options.tolerance, std::numeric_limits<int>::max(), std::numeric_limits<int>::max()};
      return;
    }
    result_.report.ranked = rankedExtrema(reference, kRankedProminence / reference.diagonal());
    const auto kept = structure();
    changes_ = static_cast<int>(kept.size());
    const double rise = reference.samples().back().kappa - reference.samples().front().kappa;
    if (!kept.empty()) {
      firstSlope_ = signOf(kept.front().maximum);
    } else if (!reference.isClosed() && std::abs(rise) > kLeastRise * lightProminence(reference)) {
      firstSlope_ = signOf(rise > 0.0);
    }
    const double least = lightProminence(reference);
    for (const LightSample& sample : reference.samples()) {
      if (std::abs(sample.kappa) <= least) continue;
      firstKappa_ = signOf(sample.kappa > 0.0);
      break;
    }
    bounds_ = {options.tolerance, changes_, countInflections(reference, least)};
  }

  LightCurve run() {
    result_.report.pointsBefore = free(dense_.controlPointCount(), dense_.degree());
    result_.report.extremaAsked = changes_;
    if (task_.forms != LightForms::Quintic && exact()) return std::move(result_);
    if (!rising() && !isTooMuch_ && !spare_.curve.isEmpty()) result_ = withEffort(std::move(spare_));
    if (result_.curve.isEmpty()) {
      result_ = withEffort(std::move(result_));
      if (isTooMuch_) return tooManyPoints(dense_);
      result_.curve = dense_;
      result_.report.kind = LightKind::Dense;
      result_.report.points = result_.report.pointsBefore;
      result_.report.obstacle = mostWork_ <= 0.0 || mayGoOn() ? LightObstacle::Structure : LightObstacle::Effort;
    }
    return std::move(result_);
  }

 private:
  double denseProminence() const { return kExtremumProminence / std::max(extent(dense_), reference_.diagonal()); }

  /// The significant extrema. Where they are more than are counted, those go that move the curve least and by less than
  /// the tolerance: others might be seen in the light curve that are too low to be seen in the dense one.
  std::vector<RankedExtremum> structure() const {
    double least = options_.significance * options_.tolerance;
    auto kept = significantExtrema(result_.report.ranked, least);
    const std::size_t counted = rankedExtrema(reference_, denseProminence()).size();
    while (kept.size() > counted) {
      std::optional<double> next;
      for (const RankedExtremum& one : kept)
        if (one.removal && (!next || *one.removal < *next)) next = one.removal;
      if (!next || *next >= options_.tolerance) break;
      least = std::nextafter(*next, options_.tolerance);
      kept = significantExtrema(kept, least);
    }
    return kept;
  }

  /// As few extrema as are asked for, and no more than are counted of the dense curve.
  int mostExtrema() {
    if (!counted_) counted_ = curvatureCounts(dense_, denseProminence(), reference_.isClosed(), context_).extrema;
    return std::min(changes_, *counted_);
  }

  int free(int controlPoints, int degree) const {
    return reference_.isClosed() ? controlPoints - degree : controlPoints;
  }

  bool exact() {
    const auto line = exactLine(reference_, options_.tolerance);
    if (line && isHeld(*line)) return take(*line, LightKind::Line, 2);
    if (task_.forms == LightForms::UpToQuintic || task_.forms == LightForms::UpToCubic) return false;
    const auto arc = exactArc(reference_, options_.tolerance);
    return arc && isHeld(*arc) && take(*arc, LightKind::Arc, 3);
  }

  bool isHeld(const NurbsCurve& curve) const {
    return reference_.isClosed() || endsAreHeld(curve, reference_, options_.start, options_.end);
  }

  /// Counts from the fewest possible up, farther where the last try was far off; back to the smallest one that is
  /// enough.
  bool rising() {
    const int changes = changes_ + (changes_ > 0 ? 3 : 0);
    int fewest = reference_.isClosed() ? std::max(kFewestClosedPoints, changes_) : std::max(kFewestOpenPoints, changes);
    if (task_.forms == LightForms::Quintic) fewest = std::max(fewest, kLightQuintic + 1);
    fewest = std::max(fewest, task_.fewestPoints);
    const int most = task_.mostPoints.value_or(result_.report.pointsBefore - 1);
    mostWork_ = (task_.calm.any() ? kMoreWorkForCalmEnds : 1.0) * kWorkPerPoint * (most - fewest + 1);
    int failed = fewest - 1;
    for (int count = fewest; count <= most && mayGoOn(); count = nextCount(count, most)) {
      if (isBeyond(failed)) return false;
      if (withPoints(count)) return goBack(failed);
      failed = count;
    }
    return false;
  }
  /// Fewer points than those of the curve that was found, and more than those that failed.
  bool goBack(int failed) {
    LightCurve best = std::move(result_);
    while (best.report.points - failed > 1 && mayGoOn()) {
      if (isBeyond(failed)) return false;
      const int between = (best.report.points + failed) / 2;
      result_ = withEffort(LightCurve{{}, best.report});
      if (withPoints(between)) {
        best = std::move(result_);
      } else {
        failed = between;
      }
    }
    result_ = withEffort(std::move(best));
    return true;
  }
  /// Whether no curve of so few control points as are wanted can come any more.
  bool isBeyond(int failed) {
    isTooMuch_ =
        failed >= options_.mostPoints && (spare_.curve.isEmpty() || spare_.report.points > options_.mostPoints);
    return isTooMuch_;
  }
  int nextCount(int count, int most) const {
    const double growth = std::clamp(std::pow(leastOff_, 1.0 / kOrder), 1.0, kMostGrowth);
    const int next = std::max(count + 1, static_cast<int>(count * growth));
    return count < most ? std::min(next, most) : next;
  }
  bool mayGoOn() const { return work_ < mostWork_ && !context_.isCancelled(); }
  /// A result with the iterations of all tries.
  LightCurve withEffort(LightCurve found) const {
    found.report.iterations = iterations_;
    found.report.tries = tries_;
    return found;
  }

  bool withPoints(int count) {
    const bool closed = reference_.isClosed();
    leastOff_ = std::numeric_limits<double>::infinity();
    const int degree = count - 1;
    const int lowest = task_.forms == LightForms::Quintic ? kLightQuintic : 2;
    const int spline = task_.forms == LightForms::UpToCubic ? kLightCubic : kLightQuintic;
    const int highest = task_.forms == LightForms::All ? kMostSpanDegree : spline;
    if (!closed && degree >= lowest && degree <= highest) {
      if (fit(degree, 1, BreakStart::Even, true)) return true;
      if (leastOff_ < kHopeless && fit(degree, 1, BreakStart::Even, false)) return true;
    }
    const int spans = closed ? count : count - spline;
    if (spans < 2) return false;
    if (fit(spline, spans, BreakStart::ByShape, true)) return true;
    return leastOff_ < kHopeless && fit(spline, spans, BreakStart::Even, true);
  }

  bool fit(int degree, int spans, BreakStart breaks, bool firstPhase) {
    auto start = startShape(reference_, degree, spans, breaks);
    if (!start) return false;
    LightAsk ask;
    ask.tolerance = options_.tolerance;
    ask.firstSlope = firstSlope_;
    ask.changes = changes_;
    ask.firstKappa = firstKappa_;
    ask.inflections = firstKappa_ ? bounds_.inflections : 0;
    ask.start = options_.start;
    ask.end = options_.end;
    ask.firstPhase = firstPhase;
    double calmShare = kCalmShare;
    for (int round = 0; round < kCheckRounds && !context_.isCancelled(); ++round) {
      if (task_.calm.atStart) ask.startRange = calmRange(reference_, false, calmShare);
      if (task_.calm.atEnd) ask.endRange = calmRange(reference_, true, calmShare);
      const LightFit fitted = fitLight(reference_, std::move(*start), ask, context_);
      iterations_ += fitted.iterations;
      ++tries_;
      work_ += fitted.iterations * spans;
      leastOff_ = std::min(leastOff_, fitted.worst / options_.tolerance);
      if (!fitted.reached) return false;
      auto curve = fitted.shape.toNurbs(reference_.length());
      if (curve && !reference_.isClosed()) curve = withHeldEnds(*curve, reference_, options_.start, options_.end);
      if (!curve) return false;
      const LightVerdict verdict = checkLight(*curve, reference_, bounds_);
      if (take(*curve, verdict, spans == 1 ? LightKind::Span : LightKind::Spline,
               static_cast<int>(fitted.shape.points.size())))
        return true;
      // The places of the fit have missed something: they are asked for a little more.
      if (verdict.worst > options_.tolerance) {
        if (verdict.worst > kNearly * options_.tolerance) return false;
        ask.reach *= kAskedLess * options_.tolerance / verdict.worst;
      } else {
        ask.signMargin *= kMoreSignMargin;
        calmShare *= kCalmShare;
      }
      ask.firstPhase = false;
      ask.signs = kMoreSigns;
      start = fitted.shape;
    }
    return false;
  }

  bool take(const NurbsCurve& curve, LightKind kind, int points) {
    return take(curve, checkLight(curve, reference_, bounds_), kind, points);
  }
  /// A curve that lost an extremum is kept for the case that none has them all.
  bool take(const NurbsCurve& curve, const LightVerdict& verdict, LightKind kind, int points) {
    if (!verdict.holds || hasHook(curve)) return false;
    if (task_.keepStructure && verdict.extrema > 0 && verdict.extrema > mostExtrema()) return false;
    const bool all =
        !task_.keepStructure || kind == LightKind::Line || kind == LightKind::Arc || verdict.extrema == mostExtrema();
    if (!all && !spare_.curve.isEmpty()) return false;
    LightCurve& target = all ? result_ : spare_;
    if (!all) target.report = result_.report;
    target.curve = curve;
    target.report.kind = kind;
    target.report.points = points;
    target.report.worst = verdict.worst;
    target.report.extrema = verdict.extrema;
    target.report.inflections = verdict.inflections;
    target.report.iterations = iterations_;
    target.report.tries = tries_;
    return all;
  }

  /// Where it was to have none.
  bool hasHook(const NurbsCurve& curve) const {
    if (!task_.calm.any()) return false;
    const EndHooks hooks = endHooks(curve, reference_);
    return (task_.calm.atStart && hooks.atStart) || (task_.calm.atEnd && hooks.atEnd);
  }

  const NurbsCurve& dense_;
  const LightReference& reference_;
  const LightOptions& options_;
  const LightTask& task_;
  const RunContext& context_;
  int changes_ = 0;
  std::optional<LightSign> firstSlope_, firstKappa_;
  std::optional<int> counted_;  ///< Extrema of the dense curve, once they are asked for.
  LightBounds bounds_;
  LightCurve result_, spare_;
  int iterations_ = 0, tries_ = 0;
  double work_ = 0.0, mostWork_ = 0.0;
  bool isTooMuch_ = false;
  double leastOff_ = 0.0;  // tolerances, of the fits with one number of points
};

/// The curve, or one without its hooks at open ends that needs few control points more.
LightCurve withCalmEnds(LightCurve found, const NurbsCurve& dense, const LightReference& reference,
                        const LightOptions& options, LightTask task, const RunContext& context) {
  const bool isFitted = found.report.kind == LightKind::Span || found.report.kind == LightKind::Spline;
  if (!isFitted || reference.isClosed() || context.isCancelled()) return found;
  const EndHooks hooks = endHooks(found.curve, reference);
  if (!hooks.any()) return found;
  // Where the curvature is held, it is the dense curve's anyhow.
  task.calm = {options.start != LightHold::Curvature, options.end != LightHold::Curvature};
  if (!task.calm.any()) return found;
  const LightReport& report = found.report;
  task.fewestPoints = report.points;
  task.mostPoints = std::min(
      {report.points + kWorthCalmEnds, report.pointsBefore - 1, task.mostPoints.value_or(report.pointsBefore)});
  LightCurve calm = LightSearch(dense, reference, options, task, context).run();
  if (calm.report.kind == LightKind::Dense || calm.report.extrema < report.extrema) return found;
  calm.report.iterations += report.iterations;
  calm.report.tries += report.tries;
  return calm;
}

}  // namespace

LightCurve searchLight(const NurbsCurve& dense, const LightReference& reference, const LightOptions& options,
                       const LightTask& task, const RunContext& context) {
  LightCurve found = LightSearch(dense, reference, options, task, context).run();
  return task.keepStructure ? withCalmEnds(std::move(found), dense, reference, options, task, context) : found;
}

}  // namespace batten
