// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/run/fair_stage.h"

#include <algorithm>
#include <new>

#include "core/construct/light/light_corners.h"
#include "core/construct/light/light_pieces.h"
#include "core/curve/arc_length.h"
#include "core/curve/corners_inside.h"
#include "core/curve/curvature.h"
#include "core/curve/curve_start.h"
#include "core/fairing/corner_sections.h"
#include "core/fairing/edge_length_fairing.h"
#include "core/fairing/fairing.h"
#include "core/fairing/fairing_report.h"
#include "core/fairing/model/fairing_line.h"
#include "core/fairing/target_advice.h"
#include "core/pipeline/run/choice_course.h"
#include "core/pipeline/run/corner_rounding.h"
#include "core/pipeline/run/curve_stages.h"
#include "core/pipeline/run/fairing_distance.h"
#include "core/pipeline/run/piece_choices.h"
#include "core/pipeline/run/stage_items.h"

namespace batten {
namespace {

/// Share of the length below which a part of a split curve is none.
constexpr double kLeastPart = 1e-3;

// notes of curves that stay as they were
constexpr const char* kLeavesTolerance = "Unchanged: fairing would leave the tolerance.";
constexpr const char* kHasMoreExtrema = "Unchanged: fairing would add curvature extrema.";
// and what to do about it
constexpr const char* kRaiseTolerance = "Raise the tolerance.";
constexpr const char* kTakeOtherTarget = "This target is too far from the curve: choose another.";

// and of those that fairing made no lighter
constexpr const char* kStayedDense = "Stayed dense: no lighter curve was found within the tolerance.";

/// [px] A place farther than this from a curve lies on another part of the line whose choice it shares.
constexpr double kPlaceReachPx = 24.0;

/// Places on the page as ascending shares of the curve's arc length.
std::vector<double> fractionsOf(const std::vector<Vec2>& placesPx, const NurbsCurve& curve, const PageFrame& frame) {
  std::vector<double> fractions;
  if (placesPx.empty() || curve.isEmpty()) return fractions;
  const ArcLength arc(curve);
  if (!(arc.total() > 0.0)) return fractions;
  const ClosestPointFinder finder(curve);
  for (const Vec2& place : placesPx) {
    const auto closest = finder.closestTo(frame.pointToModel(place));
    if (closest.distance > kPlaceReachPx * frame.mmPerPx) continue;
    fractions.push_back(std::clamp(arc.at(closest.u) / arc.total(), 0.0, 1.0));
  }
  std::sort(fractions.begin(), fractions.end());
  fractions.erase(std::unique(fractions.begin(), fractions.end()), fractions.end());
  return fractions;
}

FairingParams paramsFor(const std::optional<std::size_t>& choice, const Recipe& recipe, const Piece& piece,
                        const NurbsCurve& curve, const PageFrame& frame) {
  FairingParams params = recipe.fairing;
  if (!choice) return params;
  const PieceChoice own = alongPiece(recipe.choices[*choice], piece);
  params = own.fairing(std::move(params));
  params.keptAt = fractionsOf(own.keepPx, curve, frame);
  params.targets.splits = fractionsOf(own.splitsPx, curve, frame);
  for (const SpanChoice& span : own.spanTargets) {
    const auto at = fractionsOf({span.placePx}, curve, frame);
    if (!at.empty()) params.spanTargets.push_back({at.front(), span.degree});
  }
  // A split at an end of the curve parts nothing.
  std::erase_if(params.targets.splits, [](double f) { return f < kLeastPart || f > 1.0 - kLeastPart; });
  return params;
}

/// What the fairing may know of the line. A drawn or imported line has no noise to be told from what was meant.
FairingLine lineOf(const Piece& piece, ContourKind kind, const PageFrame& frame) {
  FairingLine line;
  line.pixelMm = frame.mmPerPx;
  if (isDrawn(kind)) return line;
  // Blur rounds the edge near a corner, and the width of a stroke its middle: as in the fair fit.
  const double reach = kind == ContourKind::Centreline ? 8.0 : 4.0;
  for (const PiecePoint& p : piece.points) {
    const bool nearStart = piece.startIsCorner && (p.at - piece.points.front().at).norm() < reach;
    const bool nearEnd = piece.endIsCorner && (p.at - piece.points.back().at).norm() < reach;
    if (!nearStart && !nearEnd) line.points.push_back(frame.pointToModel(p.at));
  }
  return line;
}

LightHold asLightHold(const EndHold& hold) {
  return hold.curvature ? LightHold::Curvature : hold.tangent ? LightHold::Tangent : LightHold::Position;
}

/// Fairs the curve of one line from where its fairing starts, and makes the faired one light where the sketched one was
/// to be.
class LineFairing {
 public:
  LineFairing(const TracedCurve& curve, FairingLine line, LightOptions light, const RunContext& context)
      : curve_(curve), line_(std::move(line)), light_(light), context_(context) {
    light_.start = asLightHold(curve.fairingUsed.startHold);
    light_.end = asLightHold(curve.fairingUsed.endHold);
    // What was simplified already needs no more of the tolerance than this to have few control points.
    if (curve.isSimplified()) light_.tolerance = std::max(light.tolerance, kLightShare * curve.fairingUsed.toleranceMm);
  }

  Result<FairedCurve> run() const {
    FairingParams params = curve_.fairingUsed;
    if (!movesEdgeLengths(params)) params.takenMm = startsOffMm(curve_, context_);
    auto faired = fairedWithin(params);
    if (!faired || params.mode == FairingMode::None) return faired;
    if (isStill(*faired)) return asSketched(std::move(*faired));
    if (!curve_.construct.light) return measured(std::move(*faired));
    if (auto light = madeLight(*faired)) return *light;
    // The light curve would have left the tolerance, all of which the fairing took: it leaves some of it to the light
    // one.
    FairingParams closer = params;
    closer.takenMm += light_.tolerance;
    const double left = params.toleranceMm - params.takenMm;
    if (params.toleranceMm - closer.takenMm < kFairingShare * left || context_.isCancelled())
      return stayingDense(std::move(*faired));
    const auto again = fairedWithin(closer);
    if (again && isAsFair(again->report, faired->report)) {
      if (auto light = madeLight(*again)) {
        light->report.neededMm = faired->report.neededMm;
        // A refusal says why itself.
        const bool isRefused = light->report.note != again->report.note;
        if (!isRefused && again->report.extremaAfter == faired->report.extremaAfter)
          light->report.note = faired->report.note;
        return *light;
      }
    }
    return stayingDense(std::move(*faired));
  }

 private:
  static constexpr double kFairingShare = 0.5;  // of the tolerance, is left to the fairing
  static constexpr double kLightShare = 0.1;    // of the tolerance

  Result<FairedCurve> fairedWithin(const FairingParams& params) const {
    return fairedAs(curve_, params, context_, line_);
  }

  /// What the tolerance allows counts for more than few control points: what a note says is needed is enough.
  bool isAsFair(const FairingReport& closer, const FairingReport& faired) const {
    if (faired.withinTolerance && !closer.withinTolerance) return false;
    return curve_.fairingUsed.mode != FairingMode::Monotone || closer.extremaAfter <= faired.extremaAfter;
  }

  bool isStill(const FairedCurve& faired) const {
    return faired.report.maxDeviationMm == 0.0 || faired.curve == curve_.fairingStart();
  }

  /// The curve that the user sees, with what the fairing that left it so has to say.
  FairedCurve asSketched(FairedCurve faired) const {
    faired.curve = curve_.sketched;
    faired.report.extremaBefore = countedExtrema(curve_.sketched, curve_.closed, context_);
    faired.report.extremaAfter = faired.report.extremaBefore;
    faired.report.maxDeviationMm = 0.0;
    return faired;
  }
  FairedCurve refused(FairedCurve faired, const char* note) const {
    const double needed = faired.report.neededMm.value_or(0.0);
    const bool isTooFar =
        curve_.fairingUsed.mode == FairingMode::Target && needed > mostSensibleToleranceMm(curve_.sketched);
    faired.report.note = note;
    addSentence(faired.report.note, isTooFar ? kTakeOtherTarget : kRaiseTolerance);
    faired.report.withinTolerance = false;
    return asSketched(std::move(faired));
  }

  /// Counted and measured against the curve that the user sees, where fairing started from another.
  FairedCurve measured(FairedCurve faired) const {
    faired.report.extremaBefore = countedExtrema(curve_.sketched, curve_.closed, context_);
    if (faired.report.extremaAfter > faired.report.extremaBefore) return refused(std::move(faired), kHasMoreExtrema);
    if (!curve_.dense) return faired;
    faired.report.maxDeviationMm = movedMm(faired.curve, curve_, context_);
    const bool isWithin = faired.report.maxDeviationMm <= curve_.fairingUsed.toleranceMm;
    return isWithin ? faired : refused(std::move(faired), kLeavesTolerance);
  }

  FairedCurve stayingDense(FairedCurve faired) const {
    FairedCurve result = measured(std::move(faired));
    if (result.curve.controlPointCount() > curve_.sketched.controlPointCount())
      addSentence(result.report.note, kStayedDense);
    return result;
  }

  /// The faired curve as a light one that holds the fairing's tolerance; none when there is none.
  std::optional<FairedCurve> madeLight(const FairedCurve& faired) const {
    auto light = lightBetweenCorners(faired.curve, curve_.closed, light_, context_);
    if (!light) return std::nullopt;
    FairedCurve result{std::move(*light), faired.report};
    const NurbsCurve& start = curve_.fairingStart();
    if (curve_.closed && !result.curve.isRational() && !beginsAtCorner(result.curve))
      result.curve = startedNear(result.curve, start.point(start.start()));
    result.report.maxDeviationMm = movedMm(result.curve, curve_, context_);
    if (result.report.maxDeviationMm > curve_.fairingUsed.toleranceMm) return std::nullopt;
    result.report.extremaAfter = countedExtrema(result.curve, curve_.closed, context_);
    if (result.report.extremaAfter > faired.report.extremaAfter) return std::nullopt;
    result.report.extremaBefore = countedExtrema(curve_.sketched, curve_.closed, context_);
    return result.report.extremaAfter <= result.report.extremaBefore ? result
                                                                     : refused(std::move(result), kHasMoreExtrema);
  }

  const TracedCurve& curve_;
  const FairingLine line_;
  LightOptions light_;
  const RunContext& context_;
};

/// The dense curve ends a little otherwise than the light one: where an end is held, it is that of the curve that the
/// user sees, so fairing starts from it.
void startFromSeenEnds(TracedCurve& curve, const LightOptions& light) {
  const auto isHeld = [](const EndHold& hold) { return hold.tangent || hold.curvature; };
  const FairingParams& params = curve.fairingUsed;
  if (curve.closed || params.mode == FairingMode::None || !(isHeld(params.startHold) || isHeld(params.endHold))) return;
  if (!curve.dense || !curve.construct.light || curve.isSimplified()) return;
  curve.dense = fairingStartOf(curve.sketched, false, light);
}

void fairOne(TracedCurve& curve, const Piece& piece, ContourKind kind, const Recipe& recipe, const PageFrame& frame,
             const RunContext& context) {
  curve.faired = curve.sketched;
  curve.fairedFigures = curve.sketchedFigures;
  if (!curve.included || curve.fairingUsed.mode == FairingMode::None) return;
  const bool isSimplified = curve.isSimplified();
  // An arc is as fair as a curve can be; its note says so. Only a target may ask for another curve.
  const bool isExact = curve.construct.light && (curve.sketched.isRational() || curve.construct.isLine);
  if (isExact && (isSimplified || curve.fairingUsed.mode != FairingMode::Target)) return;
  const LightOptions light = lightOptions(recipe.construct, frame.mmPerPx);
  // What was simplified has left the points of the line behind.
  FairingLine line = isSimplified ? FairingLine{} : lineOf(piece, kind, frame);
  auto result = LineFairing(curve, std::move(line), light, context).run();
  if (!result) {
    curve.fairing.why = Termination::Degenerate;
    curve.fairing.note = "Unchanged: " + result.error().message;
    return;
  }
  curve.faired = result->curve;
  curve.fairing = std::move(result->report);
  curve.fairedFigures = figuresOf(curve.faired, curve.closed, pointsToModel(piece.points, frame), context);
}

}  // namespace

Result<FairedCurve> fairedAs(const TracedCurve& curve, const FairingParams& params, const RunContext& context,
                             const FairingLine& line) {
  return movesEdgeLengths(params) ? fairByEdgeLengths(curve.sketched, curve.closed, params, context)
                                  : fairBetweenCorners(curve.fairingStart(), curve.closed, params, context, line);
}

Result<FairedSet> fairAll(const ConstructedSet& constructed, const ContourSet& contours, const PieceSet& pieces,
                          const Recipe& recipe, const PageFrame& frame, const RunContext& context) {
  const auto choices = assignChoices(pieces, recipe.choices).ofPiece;
  FairedSet set{constructed.curves};
  const RunContext inner = itemContext(context, set.curves.size());
  forEachItem(context, set.curves.size(), [&](std::size_t i) {
    TracedCurve& curve = set.curves[i];
    const int piece = curve.piece;
    curve.included = !choices[piece] || recipe.choices[*choices[piece]].included;
    curve.fairingUsed = paramsFor(choices[piece], recipe, pieces.pieces[piece], curve.fairingStart(), frame);
    startFromSeenEnds(curve, lightOptions(recipe.construct, frame.mmPerPx));
    const ContourKind kind = contours.contours[curve.contour].kind;
    fairOne(curve, pieces.pieces[piece], kind, recipe, frame, inner);
  });
  if (context.isCancelled()) return cancelled();
  roundCorners(set, pieces, recipe, frame, context);
  if (context.isCancelled()) return cancelled();
  return set;
}

}  // namespace batten
