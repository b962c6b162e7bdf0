// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/base/page_frame.h"
#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/construct/pieces.h"
#include "core/contour/contour_set.h"
#include "core/contour/corner/corner_marks.h"
#include "core/contour/segment/regression_segments.h"
#include "core/curve/closest_point.h"
#include "core/curve/curvature_jump.h"
#include "core/fairing/fairing_report.h"
#include "core/image/page_preparation.h"
#include "core/image/scan.h"
#include "core/image/threshold/binarize.h"
#include "core/pipeline/recipe/recipe.h"
#include "core/pipeline/recipe/stage_id.h"
#include "core/pipeline/run/piece_numbers.h"
#include "core/pipeline/run/stage_cache.h"

namespace batten {

/// Numbers that say how good a curve is. Model frame.
struct CurveFigures {
  double lengthMm = 0.0;
  int controlPoints = 0;
  Deviation fromPoints;  ///< [mm] edge points from the curve.
  int extrema = 0;       ///< Curvature extrema of prominence >= kExtremumProminence / extent.
  int inflections = 0;
  double curvatureJump =
      0.0;  ///< [-] Largest at a joint, relative to the largest curvature at joints (largestCurvatureJump).
};

/// One curve from corner to corner (or a smooth closed one), sketched and faired. Model frame, mm.
struct TracedCurve {
  int contour = 0;  ///< Index into the contour set.
  int piece = 0;    ///< Index into the piece set.
  bool closed = false;
  bool included = true;  ///< The user's choice.
  NurbsCurve sketched;
  std::optional<NurbsCurve> dense;  ///< See ConstructedPiece::dense; absent: `sketched` itself.
  ConstructReport construct;
  CurveFigures sketchedFigures;
  NurbsCurve faired;  ///< Equal to `sketched` while the mode is None.
  FairingReport fairing;
  FairingParams fairingUsed;  ///< The recipe's parameters with the piece's own choices applied.
  CurveFigures fairedFigures;

  /// What fairing and its targets start from.
  const NurbsCurve& fairingStart() const { return dense ? *dense : sketched; }
  /// What the user sees is not the line but what was meant by it (construct.detail).
  bool isSimplified() const { return construct.light && construct.light->isSimplified; }
};

struct ConstructedSet {
  std::vector<TracedCurve> curves;  ///< `faired` not filled yet.
  std::vector<Error> failures;      ///< Pieces that gave no curve, with the reason.
};
struct FairedSet {
  std::vector<TracedCurve> curves;
};

/// Milliseconds and whether the output came from the cache, per stage.
struct StageTiming {
  double milliseconds = 0.0;
  bool fromCache = false;
  bool run = false;
};

/// All outputs of one run; a null pointer means that the stage was not asked for or failed.
struct PipelineOutput {
  std::shared_ptr<const PreparedPage> page;  ///< Made by the first stage; what all stages read of the scan.
  std::shared_ptr<const RegionThresholds> thresholds;
  std::shared_ptr<const BitImage> binary;
  std::shared_ptr<const FilteredImage> filtered;
  std::shared_ptr<const BitImage> edges;
  std::shared_ptr<const ContourSet> contours;
  std::shared_ptr<const PieceSet> pieces;
  std::shared_ptr<const PieceNumbers> numbers;  ///< Of `pieces`, and by TracedCurve::piece of the curves.
  std::shared_ptr<const SegmentSet> segments;
  std::shared_ptr<const ConstructedSet> constructed;
  std::shared_ptr<const FairedSet> faired;
  PageFrame frame;
  std::array<StageTiming, kStages.size()> timing;
  std::optional<Error> error;  ///< Why the run ended early; outputs before it are valid.
  std::optional<StageId> failedStage;
};

struct PipelineRequest {
  StageId upTo = StageId::Faired;
  /// Called after each stage, on the calling thread, with the outputs so far (what the live window shows first).
  std::function<void(StageId, const PipelineOutput&)> stageReady;
  bool needEdges = true;   ///< The edges layer is only made when someone looks at it.
  bool isPreview = false;  ///< A reduced page, shown until the lines of the page itself are there: nothing is enlarged.
};

/// Runs the stages in order, taking from `cache` what has not changed. Deterministic: the same scan and recipe give the
/// same output with any number of threads and any state of the cache. Never throws for bad input; see
/// PipelineOutput::error.
PipelineOutput runPipeline(const Scan&, const Recipe&, StageCache&, const PipelineRequest&, const RunContext&);

/// The grey that the stages of this output read: the prepared page, or the scan's own where that stayed as it is.
const GreyImage& tracedGrey(const Scan&, const PipelineOutput&);

/// The number of a curve of this output, from 1: what the user knows it by.
int curveNumber(const PipelineOutput&, const TracedCurve&);
/// The name of a curve in files and reports: the one of the file that it was imported from, else "Curve 3".
std::string nameOfCurve(const PipelineOutput&, const Recipe&, const TracedCurve&);
/// The name that a curve brought from the file that it was imported from; empty if it brought none.
std::string ownNameOfCurve(const PipelineOutput&, const Recipe&, const TracedCurve&);

/// What the constructions take of one line (contour): all its pieces, model frame. Empty if there is no such line.
ConstructContour lineInput(const PipelineOutput&, int contour);

/// Frame of the scan at the recipe's, the file's or the assumed resolution.
PageFrame frameFor(const Scan&, const Recipe&);
/// True when neither the recipe nor the file states a resolution.
bool isScaleAssumed(const Scan&, const Recipe&);

}  // namespace batten
