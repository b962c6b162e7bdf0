// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/run/corner_rounding.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/construct/typical/rounded_corner.h"
#include "core/curve/arc_length.h"
#include "core/curve/knot_operations.h"
#include "core/pipeline/run/curve_stages.h"

namespace batten {
namespace {

constexpr double kLargestShare = 0.45;
/// How evenly: nearly as round as a circular arc, and monotone to both sides.
constexpr double kForm = 0.85;
constexpr int kDegree = 5;
constexpr const char* kStaysSharp = "A corner could not be rounded: its sides do not meet ahead. It stays sharp.";

Joint jointAt(const NurbsCurve& curve, double u) {
  const auto d = curve.derivatives(u, 1);
  return {d[0], d[1].normalized(), curvature(curve, u).value_or(0.0)};
}

Result<NurbsCurve> asCurve(const TypicalCurve& arc, double start) {
  const auto q = arc.controlPoints();
  const Quintic quintic = elevatedCubic(q[0], q[1], q[2], q[3]);
  std::vector<double> knots(6, start);
  const double length = arc.edge * (1.0 + arc.ratio * std::cos(arc.turnRad) + arc.ratio * arc.ratio);
  knots.insert(knots.end(), 6, start + length);
  return NurbsCurve::make(kDegree, std::move(knots), {quintic.begin(), quintic.end()});
}

/// Two curves end to start as one, of degree 5 or that of the higher one.
Result<NurbsCurve> together(const NurbsCurve& first, const NurbsCurve& second) {
  std::vector<NurbsCurve> both;
  const int degree = std::max({kDegree, first.degree(), second.degree()});
  for (const NurbsCurve& one : {first, second}) {
    auto raised = one.degree() < degree ? elevated(one, degree) : Result<NurbsCurve>(one);
    if (!raised) return raised;
    both.push_back(std::move(*raised));
  }
  return joinAtCorners(both, 1e-6 * std::max(extent(first), extent(second)));
}

/// The curve without the last (first) `length`.
Result<NurbsCurve> shortened(const NurbsCurve& curve, double length, bool atEnd) {
  const ArcLength arc(curve);
  auto parts = split(curve, arc.parameter(atEnd ? arc.total() - length : length));
  if (!parts) return fail(parts.error());
  return atEnd ? parts->left : parts->right;
}

struct Neighbours {
  TracedCurve* before = nullptr;
  TracedCurve* behind = nullptr;
};

Neighbours neighboursOf(FairedSet& set, const PieceSet& pieces, const Corner& corner) {
  Neighbours found;
  for (TracedCurve& curve : set.curves) {
    const Piece& piece = pieces.pieces[curve.piece];
    if (piece.contour != corner.contour || piece.points.empty() || curve.faired.isEmpty()) continue;
    // Pieces begin and end with the very place of their corner.
    const auto isHere = [&](const Vec2& p) { return p == corner.positionPx; };
    if (piece.endIsCorner && isHere(piece.points.back())) found.before = &curve;
    if (piece.startIsCorner && isHere(piece.points.front())) found.behind = &curve;
  }
  return found;
}

bool roundOne(const Neighbours& at, double sizeMm) {
  const double room = std::min(ArcLength(at.before->faired).total(), ArcLength(at.behind->faired).total());
  const double size = std::min(sizeMm, kLargestShare * room);
  if (!(size > 0.0)) return false;
  const auto first = shortened(at.before->faired, size, true);
  if (!first) return false;
  // One curve from its corner back to it is cut at both ends.
  const bool same = at.before == at.behind;
  const auto second = shortened(same ? *first : at.behind->faired, size, false);
  if (!second) return false;
  const NurbsCurve& cutBefore = same ? *second : *first;
  const auto corner = roundCorner(jointAt(cutBefore, cutBefore.end()), jointAt(*second, second->start()), kForm);
  if (!corner) return false;
  const auto arc1 = asCurve(corner->arcs[0], 0.0), arc2 = asCurve(corner->arcs[1], 0.0);
  if (!arc1 || !arc2) return false;
  const auto behind = together(*arc2, *second);
  if (!behind) return false;
  const auto before = together(same ? *behind : *first, *arc1);
  if (!before) return false;
  if (!same) at.behind->faired = *behind;
  at.before->faired = *before;
  return true;
}

void addNote(std::string& notes, const std::string& note) {
  if (notes.find(note) != std::string::npos) return;
  notes.append(notes.empty() ? "" : " ").append(note);
}

/// The figures of the curve as it is exported: where a corner is cut off, the edge points lie beside it.
void measureAgain(TracedCurve& curve, const Piece& piece, const PageFrame& frame) {
  curve.fairedFigures = figuresOf(curve.faired, curve.closed, pointsToModel(piece.points, frame));
}

}  // namespace

void roundCorners(FairedSet& set, const PieceSet& pieces, const Recipe& recipe, const PageFrame& frame) {
  std::vector<bool> changed(pieces.pieces.size(), false);
  for (const Corner& corner : pieces.corners) {
    const auto mark = static_cast<std::size_t>(corner.mark);
    if (mark >= recipe.cornerMarks.size() || !(recipe.cornerMarks[mark].roundMm > 0.0)) continue;
    const Neighbours at = neighboursOf(set, pieces, corner);
    if (!at.before || !at.behind) continue;
    const bool done = roundOne(at, recipe.cornerMarks[mark].roundMm);
    for (TracedCurve* curve : {at.before, at.behind}) {
      if (done) changed[curve->piece] = true;
      if (!done) addNote(curve->fairing.note, kStaysSharp);
    }
  }
  for (TracedCurve& curve : set.curves) {
    const auto piece = static_cast<std::size_t>(curve.piece);
    if (changed[piece]) measureAgain(curve, pieces.pieces[piece], frame);
  }
}

}  // namespace batten
