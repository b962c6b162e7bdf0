// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/light/light_curve.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/construct/light/exact_shape.h"
#include "core/construct/light/held_ends.h"
#include "core/construct/light/light_check.h"

namespace batten {
namespace {

constexpr double kRankedProminence = 2e-3;  // times 1 / diagonal: extrema that have a removal deviation
constexpr int kFewestOpenPoints = 3, kFewestClosedPoints = 4;
constexpr int kMostSpanDegree = 7;
constexpr int kStepShare = 16;       // counts of 32 points and more rise by 2, of 48 by 3, ...
constexpr double kMostWork = 3e4;    // iterations times spans: half a second or so
constexpr int kCheckRounds = 4;      // of one fit, while the strict check finds a little missing
constexpr double kAskedLess = 0.98;  // of the tolerance over what was missed: the next round's
constexpr double kMoreSignMargin = 5.0,
                 kMoreSigns = 3.0;  // times the margin of the signs, and their weight, in the next round
constexpr double kNearly = 1.3;     // tolerances: more than a little

class LightSearch {
 public:
  LightSearch(const NurbsCurve& dense, const LightReference& reference, const LightOptions& options,
              const RunContext& context)
      : dense_(dense), reference_(reference), options_(options), context_(context) {
    result_.report.ranked = rankedExtrema(reference, kRankedProminence / reference.diagonal());
    auto kept = significantExtrema(result_.report.ranked, options.significance * options.tolerance);
    changes_ = static_cast<int>(kept.size());
    const double rise = reference.samples().back().kappa - reference.samples().front().kappa;
    if (!kept.empty()) {
      firstSign_ = kept.front().maximum ? 1 : -1;
    } else if (!reference.isClosed() && std::abs(rise) > lightProminence(reference)) {
      firstSign_ = rise > 0.0 ? 1 : -1;
    }
    const double least = lightProminence(reference);
    for (const LightSample& sample : reference.samples()) {
      if (std::abs(sample.kappa) <= least) continue;
      firstKappaSign_ = sample.kappa > 0.0 ? 1 : -1;
      break;
    }
    bounds_ = {options.tolerance, changes_, countInflections(reference, least)};
  }

  LightCurve run() {
    result_.report.pointsBefore = free(dense_.controlPointCount(), dense_.degree());
    result_.report.extremaAsked = changes_;
    if (exact()) return std::move(result_);
    if (!rising() && !spare_.curve.isEmpty()) result_ = withEffort(std::move(spare_));
    if (result_.curve.isEmpty()) {
      result_.curve = dense_;
      result_.report.kind = LightKind::Dense;
      result_.report.points = result_.report.pointsBefore;
    }
    return std::move(result_);
  }

 private:
  int free(int controlPoints, int degree) const {
    return reference_.isClosed() ? controlPoints - degree : controlPoints;
  }

  bool exact() {
    const auto line = exactLine(reference_, options_.tolerance);
    if (line && isHeld(*line)) return take(*line, LightKind::Line, 2);
    const auto arc = exactArc(reference_, options_.tolerance);
    return arc && isHeld(*arc) && take(*arc, LightKind::Arc, 3);
  }

  bool isHeld(const NurbsCurve& curve) const {
    return reference_.isClosed() || endsAreHeld(curve, reference_, options_.start, options_.end);
  }

  /// Counts from the fewest possible up, in steps that grow with the count; back to the smallest one that is enough.
  bool rising() {
    const int fewest =
        reference_.isClosed() ? std::max(kFewestClosedPoints, changes_) : std::max(kFewestOpenPoints, changes_ + 2);
    const int most = result_.report.pointsBefore - 1;
    int failed = fewest - 1;
    for (int count = fewest; count <= most && mayGoOn(); count += std::max(1, count / kStepShare)) {
      if (!withPoints(count)) {
        failed = count;
        continue;
      }
      LightCurve best = std::move(result_);
      while (best.report.points - failed > 1 && mayGoOn()) {
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
    return false;
  }
  bool mayGoOn() const { return work_ < kMostWork && !context_.isCancelled(); }
  /// A result with the iterations of all tries.
  LightCurve withEffort(LightCurve found) const {
    found.report.iterations = iterations_;
    found.report.tries = tries_;
    return found;
  }

  bool withPoints(int count) {
    const bool closed = reference_.isClosed();
    if (!closed && count - 1 <= kMostSpanDegree && count >= 3) {
      for (const bool firstPhase : {true, false}) {
        if (fit(count - 1, 1, BreakStart::Even, firstPhase)) return true;
      }
    }
    const int spans = closed ? count : count - 5;
    if (spans < 2) return false;
    return fit(5, spans, BreakStart::ByShape, true) || fit(5, spans, BreakStart::Even, true);
  }

  bool fit(int degree, int spans, BreakStart breaks, bool firstPhase) {
    auto start = startShape(reference_, degree, spans, breaks);
    if (!start) return false;
    LightAsk ask;
    ask.tolerance = options_.tolerance;
    ask.firstSign = firstSign_;
    ask.changes = changes_;
    ask.firstKappaSign = firstKappaSign_;
    ask.inflections = bounds_.inflections;
    ask.start = options_.start;
    ask.end = options_.end;
    ask.firstPhase = firstPhase;
    for (int round = 0; round < kCheckRounds && !context_.isCancelled(); ++round) {
      const LightFit fitted = fitLight(reference_, std::move(*start), ask, context_);
      iterations_ += fitted.iterations;
      ++tries_;
      work_ += fitted.iterations * spans;
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
    if (!verdict.holds) return false;
    const bool all = verdict.extrema == changes_ || kind == LightKind::Line || kind == LightKind::Arc;
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

  const NurbsCurve& dense_;
  const LightReference& reference_;
  const LightOptions& options_;
  const RunContext& context_;
  int changes_ = 0, firstSign_ = 0, firstKappaSign_ = 0;
  LightBounds bounds_;
  LightCurve result_, spare_;
  int iterations_ = 0, tries_ = 0;
  double work_ = 0.0;
};

}  // namespace

Result<LightCurve> makeLight(const NurbsCurve& dense, bool closed, const LightOptions& options,
                             const RunContext& context) {
  if (!(options.tolerance > 0.0) || !(options.step > 0.0) || !(options.significance >= 0.0)) {
    return fail(ErrorCode::BadParameter, "The tolerance of a light curve must be above 0.");
  }
  const auto reference = LightReference::make(dense, closed, options.step);
  if (!reference) {
    LightCurve same{dense, {}};
    same.report.points = same.report.pointsBefore = dense.controlPointCount();
    return same;
  }
  LightCurve found = LightSearch(dense, *reference, options, context).run();
  if (context.isCancelled()) return cancelled();
  return found;
}

}  // namespace batten
