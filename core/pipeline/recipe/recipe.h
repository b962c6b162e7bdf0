// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/construct/construct_params.h"
#include "core/contour/corner/corner_marks.h"
#include "core/contour/edge_params.h"
#include "core/contour/pen_strokes.h"
#include "core/contour/region_of_interest.h"
#include "core/contour/segment/regression_segments.h"
#include "core/curve/imported_line.h"
#include "core/fairing/fairing_params.h"
#include "core/image/bits/neighbourhood_filter.h"
#include "core/image/log_transform.h"
#include "core/image/page_preparation.h"
#include "core/image/scan.h"
#include "core/image/threshold/region_thresholds.h"
#include "core/pipeline/recipe/curve_numbers.h"
#include "core/pipeline/recipe/direction_marks.h"
#include "core/pipeline/recipe/scale_line.h"

namespace batten {

/// The target that the user has chosen for one natural span of a curve.
struct SpanChoice {
  Vec2 placePx = Vec2::Zero();  ///< In the span.
  int degree = 1;               ///< Of a target.
  bool operator==(const SpanChoice& o) const { return placePx == o.placePx && degree == o.degree; }
};

/// A choice of the user about one curve, attached by position so that it survives changes upstream: it belongs to every
/// piece that lies on the course of its anchors (see assignChoices), so that a line that breaks up keeps it.
struct PieceChoice {
  std::vector<Vec2> anchorsPx{};  ///< Along the line (see anchorsOf). A single one: the piece nearest to it, in 24 px.
  bool included = true;           ///< False: left out of fairing results and export.
  std::optional<FairingMode> mode{};      ///< Own fairing mode; absent = the recipe's.
  std::optional<FairingTarget> target{};  ///< Own target.
  std::optional<double> toleranceMm{};    ///< Own tolerance.
  std::optional<double> lowPassMm{};      ///< Own wavelength of the low-pass.
  std::optional<KeptExtrema> keepExtrema{};
  std::vector<Vec2> keepPx{};             ///< Extrema to keep, by place; not empty: counts instead of the number.
  std::vector<Vec2> splitsPx{};           ///< Where one target profile ends and the next begins.
  std::vector<ProfilePoint> profile{};    ///< Own drawn profile, from start to end of the piece.
  std::optional<TargetSpans> spans{};     ///< Own spans of the targets, where they are not split by hand.
  std::vector<SpanChoice> spanTargets{};  ///< Target mode: only these spans are moved.
  std::optional<TolerancePolicy> tolerancePolicy{};  ///< Own use of the tolerance.
  std::optional<FairingMeans> means{};               ///< Own way to move, on Bézier paths.
  std::optional<EndHold> startHold{}, endHold{};
  std::optional<ConstructMethod> method{};  ///< Own way of construction.
  std::optional<double> detail{};           ///< Own detail of a light curve, 0..1.
  /// Made for a part of a line that shares a choice: there it counts instead of that one, also where it says nothing.
  bool isPart = false;
  bool operator==(const PieceChoice&) const = default;

  /// True when the piece is not faired by the recipe's settings alone.
  bool hasFairing() const {
    return mode || target || toleranceMm || lowPassMm || keepExtrema || tolerancePolicy || means || startHold ||
           endHold || !keepPx.empty() || !profile.empty() || !spanTargets.empty();
  }
  /// Back to the recipe's settings; splits belong to the shape and stay.
  void clearFairing() {
    mode.reset();
    target.reset();
    toleranceMm.reset();
    lowPassMm.reset();
    keepExtrema.reset();
    tolerancePolicy.reset();
    means.reset();
    startHold.reset();
    endHold.reset();
    keepPx.clear();
    profile.clear();
    spanTargets.clear();
  }
  /// The common fairing with what is chosen here in its place; what is chosen by place on the drawing is not in it.
  FairingParams fairing(FairingParams common) const;
  /// True when the choice says nothing.
  bool isEmpty() const {
    return included && !hasFairing() && splitsPx.empty() && !spans && !method && !detail && !isPart;
  }
};

/// The size of a drawing that has no scan: white paper. Resolution: the recipe's.
struct BlankPage {
  int widthPx = 0;                      ///< [px] 16..20000
  int heightPx = 0;                     ///< [px] 16..20000
  double leftMm = 0.0, bottomMm = 0.0;  ///< [mm] Its lower left corner in the model frame, within 100 m of the origin.
  bool operator==(const BlankPage&) const = default;
};

/// A place on a line where the user wants two typical curves to meet (002 section 6, semi-automatic). Attached by
/// position like a corner mark: it belongs to the line nearest to it within the corner reach.
struct SegmentPoint {
  Vec2 positionPx = Vec2::Zero();
  bool operator==(const SegmentPoint& other) const { return positionPx == other.positionPx; }
};

/// A curvature extremum that the user keeps or takes out of the true and fair fit, by position: it belongs to the
/// nearest extremum of the nearest line (within 24 px).
struct ExtremumChoice {
  Vec2 positionPx = Vec2::Zero();
  bool keep = true;  ///< False: removed.
  bool operator==(const ExtremumChoice& o) const { return positionPx == o.positionPx && keep == o.keep; }
};

/// Everything the user decided: all parameters and all edits, one comparable value. Result = f(scan, recipe).
struct Recipe {
  std::optional<double> dpi;           ///< The user's own resolution; absent = the file's, else the assumed one.
  std::optional<ScaleLine> scaleLine;  ///< Where `dpi` comes from, if it was measured on the drawing.
  PageChoice scanPage;                 ///< Which page of the scan's file it is for.
  LogParams log{.enabled = false};     ///< Of the log picture, which is shown on request only.
  PreparationParams preparation;
  PaperParams paper;
  ThresholdParams threshold;
  FilterParams filter;
  EdgeParams edges;
  ContourParams contours;
  std::vector<PenStroke> penStrokes;      ///< Lines drawn by hand, behind all others.
  std::vector<ImportedFile> imports;      ///< Lines of other programs, behind those found on the scan.
  std::optional<BlankPage> page;          ///< The drawing was begun without a scan; null = it needs its scan.
  std::vector<RegionOfInterest> regions;  ///< Only what lies inside one of them is traced; none = the whole page.
  CornerParams corners;
  std::vector<CornerMark> cornerMarks;
  std::vector<Vec2> refusedCornersPx;  ///< Corners found without a mark that the user does not want, by place.
  SegmentParams segments;
  std::vector<SegmentPoint> segmentPoints;
  ConstructParams construct;
  FairingParams fairing;
  std::vector<PieceChoice> choices;
  std::vector<ExtremumChoice> extremumChoices;
  CurveNumbers curveNumbers;              ///< What the curves are called; changes no curve.
  std::vector<DirectionMark> directions;  ///< Of exported curves; the later of two for one curve counts.
  std::vector<StartMark> starts;          ///< Likewise.
  bool operator==(const Recipe&) const = default;
};

/// First invalid field, with its range, if any.
std::optional<Error> validate(const Recipe&);

}  // namespace batten
