// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/light/light_pieces.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "core/base/parallel.h"
#include "core/construct/light/detail_curve.h"
#include "core/curve/arc_length.h"
#include "core/curve/corners_inside.h"
#include "core/curve/curvature.h"
#include "core/curve/curve_start.h"
#include "core/curve/fairable_shape.h"

namespace batten {
namespace {

constexpr double kStepPx = 0.5;        // of the samples of the dense curve
constexpr double kMostOfWidth = 0.25;  // of the ink's width: the tolerance of the least detail
constexpr double kMostOfSize = 0.01;   // of the curve's size, where the width is not known
constexpr double kSmoothShare = 0.01;  // of the samples' distance: what a curve without joints may lie off
// tolerances: the removal deviation that keeps an extremum, by detail
constexpr double kLeastSignificance = 0.1, kMostSignificance = 0.25;
constexpr double kDetailStep = 0.1;          // of `detail`: the steps of which the smaller ones are compared
constexpr int kFewestControlPoints = 2;      // of any curve
constexpr int kMostCompared = 40;            // control points
constexpr int kFarMore = 2 * kMostCompared;  // what no smaller detail has so many fewer than
constexpr double kRaggedDetail = 0.8;        // of ragged outlines of uneven ink
constexpr double kWaveLength = 4.0;          // tolerances of length for each extremum: waves, not a form that was drawn
constexpr double kLeastRagged = 40.0;        // tolerances of length: what is shorter is a form
constexpr double kRaggedLength = 12.0;       // tolerances of length for each extremum: ragged where there is less

std::string reasonOf(LightObstacle obstacle) {
  switch (obstacle) {
    case LightObstacle::None:
      break;
    case LightObstacle::NoNormal:
      return "It has a corner or a point without tangent.";
    case LightObstacle::Structure:
      return "No curve with fewer control points was found within the tolerance and without "
             "additional curvature extrema.";
    case LightObstacle::Points:
      return "It needs more control points than a smaller detail gives.";
    case LightObstacle::Effort:
      return "The search was given up: the curvature wavers too often.";
  }
  return {};
}

/// Whether a knot inside repeats so often, or more.
bool hasKnotsOf(const NurbsCurve& curve, int multiplicity) {
  const auto knots = curve.knots();
  const int more = std::max(2, multiplicity) - 1;
  for (int i = 0; i + more < std::ssize(knots); ++i)
    if (knots[i] == knots[i + more] && knots[i] > curve.start() && knots[i] < curve.end()) return true;
  return false;
}

/// Ragged: more extrema than a line that was meant so could have. @param length of the curve
/// @param lengthForEach of the curve, at least
bool isRagged(const NurbsCurve& curve, bool closed, double length, double lengthForEach, const RunContext& context) {
  return countedExtrema(curve, closed, context) * lengthForEach > length;
}

Result<LightCurve> lightOf(const NurbsCurve& dense, bool closed, const LightOptions& options, bool simplified,
                           const RunContext& context) {
  const bool ragged = simplified && isRagged(dense, closed, ArcLength(dense, context).total(),
                                             kRaggedLength * options.tolerance, context);
  if (ragged) {
    if (auto simple = simplifiedCurve(dense, closed, options, context)) return std::move(*simple);
  }
  auto light = makeLight(dense, closed, options, context);
  if (!light || ragged || !simplified) return light;
  if (light->report.kind != LightKind::Dense && light->report.sectionsDense == 0) return light;
  LightOptions fewer = options;
  if (light->report.kind != LightKind::Dense)
    fewer.mostPoints = std::min(fewer.mostPoints, std::max(kFewestControlPoints, light->report.points - 1));
  auto simple = simplifiedCurve(dense, closed, fewer, context);
  return simple && simple->report.points < light->report.points ? Result<LightCurve>(std::move(*simple)) : light;
}

int detailStep(double detail) { return static_cast<int>(std::lround(detail / kDetailStep)); }

struct DetailAsked {
  double detail = 0.0;     ///< 0..1.
  bool isCompared = true;  ///< With smaller ones.
};

/// What one detail comes to.
struct DetailCurve {
  LightCurve light;
  LightOptions options;
  double detail = 0.0;
};

/// The lightest of the curves of this and every smaller detail: each holds what this one asks, as it lies nearer and
/// keeps more. So more detail never gives more control points than a smaller one; beyond kMostCompared, where that
/// takes long, it may, and beyond kFarMore none is compared. One that has more curvature extrema than the dense curve
/// is none of them. A detail that nobody set is not compared: that would take several times as long.
Result<DetailCurve> lightestUpTo(DetailAsked asked, const NurbsCurve& dense, bool closed, const ConstructParams& params,
                                 const ConstructContour& contour, const RunContext& context) {
  std::optional<DetailCurve> best;
  std::optional<int> mostExtrema;
  const auto addsExtrema = [&](const NurbsCurve& curve) {
    if (!mostExtrema) mostExtrema = countedExtrema(dense, closed, context);
    return countedExtrema(curve, closed, context) > *mostExtrema;
  };
  int step = detailStep(asked.detail);
  while (step >= 0 && (asked.isCompared || !best)) {
    DetailCurve one;
    one.detail = step * kDetailStep;
    one.options = lightOptions(params, contour, dense, one.detail);
    const bool isAny = best && best->light.report.kind != LightKind::Dense;
    if (best && best->light.report.points > kFarMore) break;
    if (best) one.options.mostPoints = std::min(kMostCompared, isAny ? best->light.report.points - 1 : kMostCompared);
    if (one.options.mostPoints < kFewestControlPoints) break;
    auto light = lightOf(dense, closed, one.options, step > 0, context);
    if (!light && best && !context.isCancelled()) break;
    if (!light) return fail(light.error());
    one.light = std::move(*light);
    if (step > 0 && addsExtrema(one.light.curve)) {
      --step;
      continue;
    }
    const bool isFewer = one.light.report.kind != LightKind::Dense && one.light.report.points <= one.options.mostPoints;
    // With fewer points wanted, the same detail may have another way.
    if (!isFewer) --step;
    if (!best || isFewer) best = std::move(one);
  }
  return std::move(*best);
}

void finishExact(ConstructedPiece& piece, bool closed, LightKind kind) {
  piece.report.isLine = piece.report.isLine || kind == LightKind::Line;
  piece.report.isCircle = piece.report.isCircle || (closed && kind == LightKind::Arc);
}

void lighten(ConstructedPiece& piece, bool closed, DetailAsked asked, const ConstructParams& params,
             const ConstructContour& contour, const RunContext& context) {
  auto lightest = lightestUpTo(asked, piece.curve, closed, params, contour, context);
  if (!lightest) return;  // cancelled, or nothing that a light curve could stand for
  const double pixelMm = contour.pixelMm;
  const LightOptions& options = lightest->options;
  LightCurve* light = &lightest->light;
  const bool simplified = lightest->detail > 0.0;  // a smaller detail may have had fewer points
  piece.report.light = lightNote(*light, piece.curve, pixelMm);
  piece.report.light->tolerancePx = options.tolerance / pixelMm;
  if (light->report.necks > 0 && piece.report.note.empty()) {
    piece.report.note = light->report.necks == 1 ? "A spike or notch narrower than the detail was removed."
                                                 : std::to_string(light->report.necks) +
                                                       " spikes and notches narrower than the detail were removed.";
  }
  if (light->report.kind == LightKind::Dense) return;
  piece.report.light->isSimplified = simplified;
  piece.dense = std::exchange(piece.curve, std::move(light->curve));
  const Vec2 start = piece.dense->point(piece.dense->start());
  if (simplified) {
    if (closed && !piece.curve.isRational() && cornersInside(piece.curve).empty() && !beginsAtCorner(piece.curve))
      piece.curve = startedNear(piece.curve, start);
    piece.report.light->points = piece.curve.controlPointCount();
    piece.dense = piece.curve.isRational() ? std::nullopt : fairingStartOf(piece.curve, closed, options);
    finishExact(piece, closed, light->report.kind);
    return;
  }
  // Shares of the length mean the same on both: what is pointed at on the one is split on the other.
  if (closed && !piece.curve.isRational()) {
    piece.curve = startedNear(piece.curve, start);
    piece.report.light->points = piece.curve.controlPointCount();
  }
  finishExact(piece, closed, light->report.kind);
}

/// Whether the tool made the border of uneven ink ragged, and nothing says how much of that is meant.
bool isRaggedByTool(const NurbsCurve& dense, const ConstructContour& contour, int piece, const ConstructParams& params,
                    const RunContext& context) {
  if (!contour.isUneven || !params.smoothRagged || contour.pieces[piece].detail || params.detail >= kRaggedDetail)
    return false;
  const double tolerance = lightOptions(params, contour, dense, kRaggedDetail).tolerance;
  const double length = ArcLength(dense, context).total();
  return length > kLeastRagged * tolerance &&
         isRagged(dense, contour.pieces[piece].closed, length, kWaveLength * tolerance, context);
}

/// Lightens a ragged outline of uneven ink, and says so. What the dense curve had to say, of sharp turns, goes with it.
void lightenRagged(ConstructedPiece& piece, bool closed, const ConstructParams& params, const ConstructContour& contour,
                   const RunContext& context) {
  const std::string ofDense = std::exchange(piece.report.note, {});
  lighten(piece, closed, {kRaggedDetail, false}, params, contour, context);
  if (!piece.report.light || !piece.report.light->isSimplified) {
    if (piece.report.note.empty()) piece.report.note = ofDense;
    return;
  }
  const std::string spikes = piece.report.note.empty() ? "" : " " + piece.report.note;
  piece.report.note =
      "The ink is uneven and its border ragged: drawn as it was meant (construct.smooth_ragged)." + spikes;
}

}  // namespace

LightOptions lightOptions(const ConstructParams& params, double pixelMm) {
  LightOptions options;
  options.tolerance = params.lightTolerancePx * pixelMm;
  options.step = kStepPx * pixelMm;
  return options;
}

LightOptions lightOptions(const ConstructParams& params, const ConstructContour& contour, const NurbsCurve& dense,
                          double detail) {
  LightOptions options = lightOptions(params, contour.pixelMm);
  const double most =
      contour.inkWidthPx ? kMostOfWidth * *contour.inkWidthPx * contour.pixelMm : kMostOfSize * extent(dense);
  if (most > options.tolerance) options.tolerance *= std::pow(most / options.tolerance, detail);
  options.significance = kLeastSignificance + detail * (kMostSignificance - kLeastSignificance);
  return options;
}

std::optional<NurbsCurve> fairingStartOf(const NurbsCurve& light, bool closed, const LightOptions& options) {
  const bool isJoined = light.isRational() || (hasKnotsOf(light, light.degree() - 1) && cornersInside(light).empty());
  if (isJoined) {
    if (auto smooth = smoothShape(light, closed, kSmoothShare * options.step)) return smooth;
  }
  return fairableShape(light);
}

LightNote lightNote(const LightCurve& light, const NurbsCurve& dense, double pixelMm) {
  const LightReport& report = light.report;
  LightNote note;
  note.found = report.kind != LightKind::Dense;
  note.exact = report.kind == LightKind::Line || report.kind == LightKind::Arc;
  note.points = light.curve.controlPointCount();
  note.pointsBefore = dense.controlPointCount();
  note.movedPx = report.worst / pixelMm;
  note.sections = report.sections;
  note.sectionsDense = report.sectionsDense;
  note.corners = report.corners;
  note.why = reasonOf(report.obstacle);
  return note;
}

Result<void> makePiecesLight(std::vector<ConstructedPiece>& made, const ConstructContour& contour,
                             const ConstructParams& params, const RunContext& context) {
  parallelFor(context, static_cast<int>(made.size()), 1, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      if (context.isCancelled() || made[i].curve.isEmpty()) continue;
      const bool closed = contour.pieces[i].closed;
      if (isRaggedByTool(made[i].curve, contour, i, params, context)) {
        lightenRagged(made[i], closed, params, contour, context);
      } else {
        lighten(made[i], closed, {contour.pieces[i].detail.value_or(params.detail)}, params, contour, context);
      }
    }
  });
  if (context.isCancelled()) return cancelled();
  return {};
}

}  // namespace batten
