// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/run/corner_rounding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "core/base/number_text.h"
#include "core/construct/typical/corner_blend.h"
#include "core/construct/typical/rounded_corner.h"
#include "core/curve/arc_length.h"
#include "core/curve/closest_point.h"
#include "core/curve/knot_operations.h"
#include "core/pipeline/run/curve_stages.h"

namespace batten {
namespace {

constexpr double kLargestShare = 0.45;  // of the room along a side
/// How evenly: nearly as round as a circular arc, and monotone to both sides.
constexpr double kForm = 0.85;
constexpr int kDegree = 5;  // of the rounding curve
// a note
constexpr const char* kStaysSharp = "A corner could not be rounded because its sides do not meet when extended.";

Result<NurbsCurve> asCurve(const TypicalCurve& arc) {
  const auto q = arc.controlPoints();
  const Quintic quintic = elevatedCubic(q[0], q[1], q[2], q[3]);
  std::vector<double> knots(6, 0.0);
  knots.insert(knots.end(), 6, arc.size());
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
    if (piece.endIsCorner && isHere(piece.points.back().at)) found.before = &curve;
    if (piece.startIsCorner && isHere(piece.points.front().at)) found.behind = &curve;
  }
  return found;
}

/// A rounding in two halves: one goes to each side.
struct Rounding {
  NurbsCurve first, second;
  double radiusMm = 0.0;
};

std::optional<Rounding> byTypicalCurves(const BlendEnd& before, const BlendEnd& behind, bool withCurvature) {
  const auto jointOf = [&](const BlendEnd& end) {
    return Joint{end.point, end.tangent, withCurvature ? end.kappa : 0.0};
  };
  const auto corner = roundCorner(jointOf(before), jointOf(behind), kForm);
  if (!corner || (withCurvature && !corner->curvatureAtEnds)) return std::nullopt;
  const auto first = asCurve(corner->arcs[0]), second = asCurve(corner->arcs[1]);
  if (!first || !second) return std::nullopt;
  return Rounding{*first, *second, std::min(smallestRadius(*first), smallestRadius(*second))};
}

std::optional<Rounding> byBlend(const BlendEnd& before, const BlendEnd& behind, BlendContact contact) {
  const auto blend = blendCorner(before, behind, contact);
  if (!blend) return std::nullopt;
  const auto curve = reparametrized(blend->curve, 0.0, ArcLength(blend->curve).total());
  if (!curve) return std::nullopt;
  const auto halves = split(*curve, 0.5 * (curve->start() + curve->end()));
  if (!halves) return std::nullopt;
  return Rounding{halves->left, halves->right, blend->smallestRadiusMm};
}

/// The roundest way to join two ends with this contact.
std::optional<Rounding> roundingOf(const BlendEnd& before, const BlendEnd& behind, RoundingJoint joint) {
  if (joint == RoundingJoint::Tangent) return byTypicalCurves(before, behind, false);
  if (joint == RoundingJoint::CurvatureSlope) return byBlend(before, behind, BlendContact::G3);
  auto blend = byBlend(before, behind, BlendContact::G2);
  auto typical = byTypicalCurves(before, behind, true);
  return !blend || (typical && typical->radiusMm > blend->radiusMm) ? std::move(typical) : std::move(blend);
}

/// One corner between two curves.
class RoundedSides {
 public:
  RoundedSides(const Neighbours& at, RoundingJoint joint, CancelCheck check) : at_(at), joint_(joint), check_(check) {
    const double room = std::min(ArcLength(at.before->faired).total(), ArcLength(at.behind->faired).total());
    // One curve from its corner back to it is cut at both ends.
    most_ = kLargestShare * room;
  }

  /// A rounding that begins this far from the corner.
  struct Sized {
    double sizeMm = 0.0;
    NurbsCurve before, behind;  ///< The sides, cut.
    Rounding rounding;
    std::string note = {};  ///< Where it is not as large as was wanted.
  };
  std::optional<Sized> sized(double sizeMm) const {
    if (!(sizeMm > 0.0) || check_.isCancelled()) return std::nullopt;
    auto before = shortened(at_.before->faired, sizeMm, true);
    if (!before) return std::nullopt;
    auto behind = shortened(isOne() ? *before : at_.behind->faired, sizeMm, false);
    if (!behind) return std::nullopt;
    const NurbsCurve& first = isOne() ? *behind : *before;
    auto rounding = roundingOf(blendEndAt(first, first.end()), blendEndAt(*behind, behind->start()), joint_);
    if (!rounding) return std::nullopt;
    return Sized{sizeMm, *before, *behind, std::move(*rounding)};
  }

  /// Of the distance, or where the sides bend so that less is rounder, of less.
  std::optional<Sized> byDistance(double sizeMm) const {
    const double wanted = std::min(sizeMm, most_);
    auto best = sized(wanted);
    for (const double share : kSmaller) {
      auto smaller = sized(share * wanted);
      if (smaller && (!best || smaller->rounding.radiusMm > kRounder * best->rounding.radiusMm))
        best = std::move(smaller);
    }
    if (best && best->sizeMm < wanted) {
      best->note = "A corner is rounded from " + millimetresText(best->sizeMm) +
                   " on, because a larger rounding would have a smaller radius here.";
    } else if (best && wanted < sizeMm) {
      best->note = "A corner is rounded from " + millimetresText(wanted) + " on, because its sides are too short.";
    }
    return best;
  }

  std::optional<Sized> byRadius(double radiusMm) const {
    std::optional<Sized> wide;
    double low = 0.0;
    for (int i = kRadiusSteps; i >= 1; --i) {
      auto tried = sized(most_ * std::pow(kRadiusStep, i - 1));
      if (!tried) continue;
      if (!wide || tried->rounding.radiusMm > wide->rounding.radiusMm) {
        if (wide) low = wide->sizeMm;
        wide = std::move(tried);
      }
      if (wide->rounding.radiusMm >= radiusMm) break;
    }
    if (!wide) return std::nullopt;
    if (wide->rounding.radiusMm < radiusMm) {
      wide->note = "A corner is rounded by " + millimetresText(wide->rounding.radiusMm) +
                   ", because no larger radius fits between its sides.";
      return wide;
    }
    for (int i = 0; i < kRadiusHalvings && wide->rounding.radiusMm > kRadiusMet * radiusMm; ++i) {
      auto middle = sized(0.5 * (low + wide->sizeMm));
      if (middle && middle->rounding.radiusMm >= radiusMm) {
        wide = std::move(middle);
      } else {
        low = 0.5 * (low + wide->sizeMm);
      }
    }
    return wide;
  }

  /// Puts the rounding between the sides.
  bool apply(const Sized& one) const {
    const auto behind = together(one.rounding.second, one.behind);
    if (!behind) return false;
    const auto before = together(isOne() ? *behind : one.before, one.rounding.first);
    if (!before) return false;
    if (!isOne()) at_.behind->faired = *behind;
    at_.before->faired = *before;
    return true;
  }

 private:
  /// Sizes beside the wanted one, and how much rounder they must be to be taken.
  static constexpr std::array kSmaller = {0.7, 0.5, 0.3};
  static constexpr double kRounder = 1.02;  // times
  /// Sizes tried for a radius, each this share of the one before, and how near the radius is to be met.
  static constexpr int kRadiusSteps = 18, kRadiusHalvings = 30;
  static constexpr double kRadiusStep = 0.7, kRadiusMet = 1.001;  // both as shares

  static std::string millimetresText(double mm) { return significantText(mm, 3) + " mm"; }
  bool isOne() const { return at_.before == at_.behind; }

  const Neighbours& at_;
  RoundingJoint joint_;
  CancelCheck check_;
  double most_ = 0.0;
};

/// What is to be said of the rounding; empty where it is as the mark asks.
std::string roundOne(const Neighbours& at, const CornerMark& mark, CancelCheck check) {
  const RoundedSides sides(at, mark.joint, check);
  const auto rounded =
      mark.roundBy == RoundingSize::Radius ? sides.byRadius(mark.roundMm) : sides.byDistance(mark.roundMm);
  return rounded && sides.apply(*rounded) ? rounded->note : kStaysSharp;
}

void addNote(std::string& notes, const std::string& note) {
  if (notes.find(note) != std::string::npos) return;
  notes.append(notes.empty() ? "" : " ").append(note);
}

/// The figures of the curve as it is exported: where a corner is cut off, the edge points lie beside it.
void measureAgain(TracedCurve& curve, const NurbsCurve& unrounded, const Piece& piece, const PageFrame& frame,
                  const RunContext& context) {
  curve.fairing.roundedMm =
      std::max(deviation(curve.faired, unrounded, context).max, deviation(unrounded, curve.faired, context).max);
  curve.fairedFigures = figuresOf(curve.faired, curve.closed, pointsToModel(piece.points, frame), context);
}

}  // namespace

void roundCorners(FairedSet& set, const PieceSet& pieces, const Recipe& recipe, const PageFrame& frame,
                  const RunContext& context) {
  std::vector<NurbsCurve> unrounded(pieces.pieces.size());
  for (const Corner& corner : pieces.corners) {
    if (!corner.mark) continue;
    const int mark = *corner.mark;
    if (mark >= std::ssize(recipe.cornerMarks) || !(recipe.cornerMarks[mark].roundMm > 0.0)) continue;
    const Neighbours at = neighboursOf(set, pieces, corner);
    if (!at.before || !at.behind) continue;
    for (const TracedCurve* curve : {at.before, at.behind}) {
      NurbsCurve& before = unrounded[curve->piece];
      if (before.isEmpty()) before = curve->faired;
    }
    const std::string note = roundOne(at, recipe.cornerMarks[mark], context);
    if (context.isCancelled()) return;
    if (note.empty()) continue;
    for (TracedCurve* curve : {at.before, at.behind}) addNote(curve->fairing.note, note);
  }
  for (TracedCurve& curve : set.curves) {
    const int piece = curve.piece;
    const NurbsCurve& before = unrounded[piece];
    if (!before.isEmpty() && !(before == curve.faired))
      measureAgain(curve, before, pieces.pieces[piece], frame, context);
  }
}

}  // namespace batten
