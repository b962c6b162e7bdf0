// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/run/fair_stage.h"

#include <algorithm>
#include <new>

#include "core/curve/arc_length.h"
#include "core/fairing/edge_length_fairing.h"
#include "core/fairing/fairing.h"
#include "core/fairing/fairing_line.h"
#include "core/pipeline/run/choice_course.h"
#include "core/pipeline/run/corner_rounding.h"
#include "core/pipeline/run/curve_stages.h"
#include "core/pipeline/run/piece_choices.h"
#include "core/pipeline/run/stage_items.h"

namespace batten {
namespace {

/// Share of the length below which a part of a split curve is none.
constexpr double kLeastPart = 1e-3;

/// [px] A place farther than this from a curve lies on another part of the line whose choice it shares.
constexpr double kPlaceReachPx = 24.0;

/// Places on the page as ascending shares of the curve's arc length.
std::vector<double> fractionsOf(const std::vector<Vec2>& placesPx, const NurbsCurve& curve, const PageFrame& frame) {
  std::vector<double> fractions;
  if (placesPx.empty() || curve.isEmpty()) return fractions;
  const ArcLength arc(curve);
  if (!(arc.total() > 0.0)) return fractions;
  for (const Vec2& place : placesPx) {
    const auto closest = closestPoint(curve, frame.pointToModel(place));
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
  // A split at an end of the curve parts nothing.
  std::erase_if(params.targets.splits, [](double f) { return f < kLeastPart || f > 1.0 - kLeastPart; });
  return params;
}

/// What the fairing may know of the line. A drawn stroke has no noise to be told from what was meant.
FairingLine lineOf(const Piece& piece, ContourKind kind, const PageFrame& frame) {
  FairingLine line;
  line.pixelMm = frame.mmPerPx;
  if (kind == ContourKind::Pen) return line;
  // Blur rounds the edge near a corner, and the width of a stroke its middle: as in the fair fit.
  const double reach = kind == ContourKind::Centreline ? 8.0 : 4.0;
  for (const Vec2& p : piece.points) {
    const bool nearStart = piece.startIsCorner && (p - piece.points.front()).norm() < reach;
    const bool nearEnd = piece.endIsCorner && (p - piece.points.back()).norm() < reach;
    if (!nearStart && !nearEnd) line.points.push_back(frame.pointToModel(p));
  }
  return line;
}

void fairOne(TracedCurve& curve, const Piece& piece, ContourKind kind, const PageFrame& frame,
             const RunContext& context) {
  curve.faired = curve.sketched;
  curve.fairedFigures = curve.sketchedFigures;
  if (!curve.included || curve.fairingUsed.mode == FairingMode::None) return;
  auto result = movesEdgeLengths(curve.fairingUsed)
                    ? fairByEdgeLengths(curve.sketched, curve.closed, curve.fairingUsed, context)
                    : fair(curve.sketched, curve.closed, curve.fairingUsed, context, lineOf(piece, kind, frame));
  if (!result) {
    curve.fairing.why = Termination::Degenerate;
    curve.fairing.note = "Left as sketched: " + result.error().message;
    return;
  }
  curve.faired = result->curve;
  curve.fairing = std::move(result->report);
  curve.fairedFigures = figuresOf(curve.faired, curve.closed, pointsToModel(piece.points, frame));
}

}  // namespace

Result<FairedSet> fairAll(const ConstructedSet& constructed, const ContourSet& contours, const PieceSet& pieces,
                          const Recipe& recipe, const PageFrame& frame, const RunContext& context) {
  const auto choices = assignChoices(pieces, recipe.choices).ofPiece;
  FairedSet set{constructed.curves};
  const RunContext inner = itemContext(context, set.curves.size());
  forEachItem(context, set.curves.size(), [&](std::size_t i) {
    TracedCurve& curve = set.curves[i];
    const auto piece = static_cast<std::size_t>(curve.piece);
    curve.included = !choices[piece] || recipe.choices[*choices[piece]].included;
    curve.fairingUsed = paramsFor(choices[piece], recipe, pieces.pieces[piece], curve.sketched, frame);
    const ContourKind kind = contours.contours[curve.contour].kind;
    fairOne(curve, pieces.pieces[piece], kind, frame, inner);
  });
  if (context.isCancelled()) return cancelled();
  roundCorners(set, pieces, recipe, frame);
  return set;
}

}  // namespace batten
