// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/run/curve_stages.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>

#include "core/base/parallel.h"
#include "core/base/statistics.h"
#include "core/construct/construct.h"
#include "core/curve/arc_length.h"
#include "core/curve/fairable_shape.h"
#include "core/pipeline/run/imported_lines.h"
#include "core/pipeline/run/piece_choices.h"
#include "core/pipeline/run/segment_points.h"
#include "core/pipeline/run/stage_items.h"

namespace batten {
namespace {

Station stationToModel(const Station& s, const PageFrame& frame) {
  return {frame.pointToModel(s.point), frame.vectorToModel(s.direction).normalized(), frame.pointToModel(s.from),
          frame.pointToModel(s.to), s.along};
}

/// Where the user wants typical curves to meet on a piece.
std::vector<Vec2> breakpointsOf(const std::vector<std::size_t>& points, const Recipe& recipe, const PageFrame& frame) {
  std::vector<Vec2> places;
  places.reserve(points.size());
  for (const std::size_t point : points) places.push_back(frame.pointToModel(recipe.segmentPoints[point].positionPx));
  return places;
}

/// A piece with its stations in the model frame: what every method takes.
ConstructPiece pieceInput(const Piece& piece, const PieceSegments& segments, const PageFrame& frame) {
  ConstructPiece made{
      inFrame(static_cast<const PieceLine&>(piece), [&](const Vec2& p) { return frame.pointToModel(p); })};
  for (const Station& s : segments.stations) made.stations.push_back(stationToModel(s, frame));
  return made;
}

std::vector<PieceRange> rangesByContour(const PieceSet& set) {
  std::vector<PieceRange> ranges;
  for (std::size_t i = 0; i < set.pieces.size(); ++i) {
    if (ranges.empty() || set.pieces[ranges.back().first].contour != set.pieces[i].contour) ranges.push_back({i, i});
    ranges.back().last = i + 1;
  }
  return ranges;
}

ConstructContour inputOf(const ContourSet& contours, const PieceSet& pieces, const SegmentSet& segments,
                         PieceRange range, const PageFrame& frame) {
  const Contour& contour = contours.contours[pieces.pieces[range.first].contour];
  ConstructContour input;
  input.isStroke = contour.kind == ContourKind::Centreline;
  input.pencilPx = contour.pencilPx;
  input.isUneven = contour.isUneven;
  input.pixelMm = frame.mmPerPx;
  for (std::size_t i = range.first; i < range.last; ++i) {
    input.pieces.push_back(pieceInput(pieces.pieces[i], segments.pieces[i], frame));
    input.pieces.back().isDrawn = isDrawn(contour.kind);
  }
  return input;
}

/// [px] How wide the ink is along lines of a kind: of centre lines the median of their strokes, of outlines what their
/// area and length tell of the shapes between them; 0 = no such ink.
double inkWidth(const ContourSet& contours, ContourKind kind) {
  std::vector<float> widths;
  double area = 0.0, length = 0.0;
  for (const Contour& contour : contours.contours) {
    if (contour.kind != kind) continue;
    const auto own = strokeWidthsOf(contour.points);
    widths.insert(widths.end(), own.begin(), own.end());
    if (kind != ContourKind::Outline || !contour.closed) continue;
    area += contour.hole ? -contour.areaPx : contour.areaPx;
    length += contour.lengthPx;
  }
  if (!widths.empty()) return static_cast<double>(upperMedian(widths));
  // A stroke of width w and length l has about the area w l and an outline of 2 l.
  return length > 0.0 ? std::max(0.0, 2.0 * area / length) : 0.0;
}

class ContourBuilder {
 public:
  ContourBuilder(const ContourSet& contours, const PieceSet& pieces, const SegmentSet& segments, const Recipe& recipe,
                 const PageFrame& frame, const RunContext& context)
      : contours_(contours),
        pieces_(pieces),
        segments_(segments),
        recipe_(recipe),
        frame_(frame),
        context_(context),
        constraints_(assignExtremumChoices(pieces, recipe)),
        importStepPx_(importStepPx(recipe.imports, frame)) {
    for (const ContourKind kind : {ContourKind::Outline, ContourKind::Centreline}) {
      inkWidthPx_[kind] = inkWidth(contours, kind);
    }
    own_ = choicesForMethods(recipe);
    if (!own_.empty()) choices_ = assignChoices(pieces, own_).ofPiece;
    const auto isTypical = [](const PieceChoice& choice) { return choice.method == ConstructMethod::Typical; };
    const bool someTypical =
        recipe.construct.method == ConstructMethod::Typical || std::any_of(own_.begin(), own_.end(), isTypical);
    breakpoints_ =
        someTypical ? assignSegmentPoints(pieces, recipe) : std::vector<std::vector<std::size_t>>(pieces.pieces.size());
  }

  /// From the points of the line, whatever the user chose for its curves.
  ConstructedSet buildFromPoints(PieceRange range) const { return buildAlike(range); }

  ConstructedSet build(PieceRange range) const {
    auto imported = buildImported(range);
    ConstructedSet outcome = imported ? std::move(*imported) : buildAlike(range);
    if (choices_.empty()) return outcome;
    for (TracedCurve& curve : outcome.curves) {
      const auto& choice = choices_[curve.piece];
      if (!choice || !own_[*choice].method) continue;
      const bool isImported = contours_.contours[curve.contour].imported.has_value();
      constructAsChosen(curve, *own_[*choice].method, isImported);
    }
    return outcome;
  }

 private:
  ConstructedSet buildAlike(PieceRange range) const {
    ConstructedSet outcome;
    if (auto all = constructRange(range, recipe_.construct)) {
      addAll(outcome, range.first, *all);
      return outcome;
    } else if (range.last - range.first == 1) {
      outcome.failures.push_back(named(all.error(), range.first));
      return outcome;
    }
    // One piece that cannot be constructed must not cost its neighbours.
    for (std::size_t i = range.first; i < range.last && !context_.isCancelled(); ++i) {
      if (auto one = constructRange({i, i + 1}, recipe_.construct)) {
        addAll(outcome, i, *one);
      } else {
        outcome.failures.push_back(named(one.error(), i));
      }
    }
    return outcome;
  }

  Result<std::vector<ConstructedPiece>> constructRange(PieceRange range, const ConstructParams& asked) const {
    ConstructParams params = asked;
    // Groups of points, as in the paper, and a number that the user set are taken as they are.
    const SegmentParams& segments = recipe_.segments;
    const bool grouped = segments.mode == SegmentMode::Sturges || segments.mode == SegmentMode::Count;
    if (grouped || (segments.mode == SegmentMode::Stations && segments.count > 0)) params.maxDeviationPx = 0.0;
    ConstructContour input = inputOf(contours_, pieces_, segments_, range, frame_);
    const auto width = inkWidthPx_.find(contours_.contours[pieces_.pieces[range.first].contour].kind);
    if (width != inkWidthPx_.end() && width->second > 0.0) input.inkWidthPx = width->second;
    for (std::size_t i = range.first; i < range.last; ++i) {
      if (!choices_.empty() && choices_[i]) input.pieces[i - range.first].detail = own_[*choices_[i]].detail;
      input.pieces[i - range.first].breakpoints = breakpointsOf(breakpoints_[i], recipe_, frame_);
      for (const std::size_t constraint : constraints_[i]) {
        const ExtremumChoice& choice = recipe_.extremumChoices[constraint];
        const Vec2 place = frame_.pointToModel(choice.positionPx);
        input.pieces[i - range.first].constraints.push_back({place, choice.keep, static_cast<int>(constraint)});
      }
    }
    auto result = construct(input, params, context_);
    if (result && result->size() != input.pieces.size()) {
      return fail(ErrorCode::Numerical, "The construction gave another number of curves than pieces.");
    }
    return result;
  }

  /// A piece with a method of its own.
  void constructAsChosen(TracedCurve& curve, ConstructMethod method, bool evenIfCommon) const {
    if (method == recipe_.construct.method && !evenIfCommon) return;
    ConstructParams params = recipe_.construct;
    params.method = method;
    const std::size_t index = curve.piece;
    auto own = constructRange({index, index + 1}, params);
    if (own) {
      take(curve, std::move(own->front()));
    } else {
      curve.construct.note = "The method chosen for it failed: " + own.error().message;
    }
  }

  /// Curves of other programs stay what they are, until the user chooses a method for one of them. Nothing for other
  /// lines.
  std::optional<ConstructedSet> buildImported(PieceRange range) const {
    const Contour& contour = contours_.contours[pieces_.pieces[range.first].contour];
    const ImportedLine* line = importedLineOf(contour, recipe_.imports);
    if (line == nullptr || line->curves.empty()) return std::nullopt;
    const std::span<const Piece> pieces(pieces_.pieces.data() + range.first, range.last - range.first);
    const auto exact = importedCurves(*line, pieces, frame_, importStepPx_);
    if (!std::all_of(exact.begin(), exact.end(), [](const auto& curve) { return curve.has_value(); }))
      return std::nullopt;
    std::vector<ConstructedPiece> made(exact.size());
    parallelFor(context_, static_cast<int>(made.size()), 1, [&](int begin, int end) {
      for (int i = begin; i < end && !context_.isCancelled(); ++i) made[i] = {*exact[i], {}, fairableShape(*exact[i])};
    });
    ConstructedSet outcome;
    if (!context_.isCancelled()) addAll(outcome, range.first, made);
    return outcome;
  }

  Error named(Error error, std::size_t piece) const {
    const Vec2 at = anchorOf(pieces_.pieces[piece]);
    error.message = "Line " + std::to_string(pieces_.pieces[piece].contour + 1) + " near (" +
                    std::to_string(static_cast<int>(at.x())) + ", " + std::to_string(static_cast<int>(at.y())) +
                    ") gave no curve: " + error.message;
    return error;
  }

  /// The curves of the pieces from `first` on, which share the threads: a line may have thousands.
  void addAll(ConstructedSet& outcome, std::size_t first, std::vector<ConstructedPiece>& made) const {
    std::vector<TracedCurve> curves(made.size());
    parallelFor(context_, static_cast<int>(made.size()), 1, [&](int begin, int end) {
      for (int i = begin; i < end && !context_.isCancelled(); ++i) {
        const std::size_t index = first + i;
        curves[i].contour = pieces_.pieces[index].contour;
        curves[i].piece = static_cast<int>(index);
        curves[i].closed = pieces_.pieces[index].closed;
        take(curves[i], std::move(made[i]));
      }
    });
    std::move(curves.begin(), curves.end(), std::back_inserter(outcome.curves));
  }

  void take(TracedCurve& curve, ConstructedPiece made) const {
    const Piece& piece = pieces_.pieces[curve.piece];
    curve.sketched = made.curve;
    curve.dense = std::move(made.dense);
    curve.construct = std::move(made.report);
    curve.sketchedFigures = figuresOf(made.curve, piece.closed, pointsToModel(piece.points, frame_), context_);
  }

  const ContourSet& contours_;
  const PieceSet& pieces_;
  const SegmentSet& segments_;
  const Recipe& recipe_;
  const PageFrame& frame_;
  const RunContext& context_;
  std::map<ContourKind, double> inkWidthPx_;
  std::vector<PieceChoice> own_;                       ///< The choices that compete for the method.
  std::vector<std::optional<std::size_t>> choices_;    ///< Per piece, when there are such choices: which.
  std::vector<std::vector<std::size_t>> breakpoints_;  ///< Per piece, the segment points on it.
  std::vector<std::vector<std::size_t>> constraints_;
  double importStepPx_;
};

}  // namespace

std::vector<Vec2> pointsToModel(std::span<const PiecePoint> points, const PageFrame& frame) {
  std::vector<Vec2> result;
  result.reserve(points.size());
  for (const PiecePoint& p : points) result.push_back(frame.pointToModel(p.at));
  return result;
}

CurveFigures figuresOf(const NurbsCurve& curve, bool closed, const std::vector<Vec2>& points,
                       const RunContext& context) {
  CurveFigures figures;
  figures.lengthMm = ArcLength(curve, context).total();
  figures.controlPoints = curve.controlPointCount();
  if (context.isCancelled()) return figures;
  figures.fromPoints = deviation(curve, points, true, context);
  const double size = extent(curve);
  if (size > 0.0) {
    const CurvatureCounts counts = curvatureCounts(curve, kExtremumProminence / size, closed, context);
    figures.extrema = counts.extrema;
    figures.inflections = counts.inflections;
    if (context.isCancelled()) return figures;
    figures.curvatureJump = largestCurvatureJump(curve, closed);
  }
  return figures;
}

ConstructPiece typicalPieceOf(const PieceSet& pieces, const SegmentSet& segments, const Recipe& recipe,
                              const PageFrame& frame, std::size_t index) {
  ConstructPiece made = pieceInput(pieces.pieces[index], segments.pieces[index], frame);
  made.breakpoints = breakpointsOf(assignSegmentPoints(pieces, recipe)[index], recipe, frame);
  return made;
}

Result<ConstructedSet> constructAll(const ContourSet& contours, const PieceSet& pieces, const SegmentSet& segments,
                                    const Recipe& recipe, const PageFrame& frame, const RunContext& context) {
  if (segments.pieces.size() != pieces.pieces.size()) {
    return fail(ErrorCode::Numerical, "The segments do not belong to these pieces.");
  }
  const std::vector<PieceRange> ranges = rangesByContour(pieces);
  const RunContext inner = itemContext(context, ranges.size());
  const ContourBuilder builder(contours, pieces, segments, recipe, frame, inner);
  std::vector<ConstructedSet> outcomes(ranges.size());
  forEachItem(context, ranges.size(), [&](std::size_t i) { outcomes[i] = builder.build(ranges[i]); });
  if (context.isCancelled()) return cancelled();

  ConstructedSet set;
  for (ConstructedSet& outcome : outcomes) {
    std::move(outcome.curves.begin(), outcome.curves.end(), std::back_inserter(set.curves));
    std::move(outcome.failures.begin(), outcome.failures.end(), std::back_inserter(set.failures));
  }
  if (!set.curves.empty()) return set;
  return fail(ErrorCode::NoCurve,
              set.failures.empty()
                  ? "No line is left to construct a curve from. Reduce contours.min_length or the thresholds."
                  : "No curve could be made. " + set.failures.front().message);
}

PieceRange rangeOf(const PieceSet& set, int contour) {
  for (const PieceRange& range : rangesByContour(set)) {
    if (set.pieces[range.first].contour == contour) return range;
  }
  return {};
}

ConstructContour contourInput(const ContourSet& contours, const PieceSet& pieces, const SegmentSet& segments,
                              int contour, const PageFrame& frame) {
  if (segments.pieces.size() != pieces.pieces.size()) return {};
  const PieceRange range = rangeOf(pieces, contour);
  if (range.first == range.last || contour < 0 || contour >= std::ssize(contours.contours)) return {};
  return inputOf(contours, pieces, segments, range, frame);
}

ConstructedSet constructFromPoints(const PipelineOutput& out, const Recipe& recipe, const PieceRange& range,
                                   const RunContext& context) {
  Recipe alike = recipe;
  alike.choices.clear();
  const ContourBuilder builder(*out.contours, *out.pieces, *out.segments, alike, out.frame, context);
  return builder.buildFromPoints(range);
}

}  // namespace batten
