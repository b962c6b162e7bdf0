// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/run/pipeline.h"

#include <chrono>
#include <new>

#include "core/contour/trace_contours.h"
#include "core/image/bits/laplacian_edges.h"
#include "core/image/fine_page.h"
#include "core/pipeline/run/corner_places.h"
#include "core/pipeline/run/curve_stages.h"
#include "core/pipeline/run/fair_stage.h"
#include "core/pipeline/run/imported_lines.h"
#include "core/pipeline/run/stage_keys.h"

namespace batten {
namespace {

template <class T>
std::size_t vectorBytes(const std::vector<T>& v) {
  return v.capacity() * sizeof(T);
}

// Sizes for the cache's limit: large parts exactly, the rest approximately.
std::size_t bytesOf(const PreparedPage& page) {
  return sizeof(page) + (page.grey ? vectorBytes(page.grey->pixels) : 0);
}
std::size_t bytesOf(const RegionThresholds& t) {
  std::size_t bytes = sizeof(t) + vectorBytes(t.paper.grey);
  for (const PaperFold& fold : t.paper.folds)
    bytes += sizeof(fold) + vectorBytes(fold.depth) + vectorBytes(fold.profile);
  return bytes;
}
std::size_t bytesOf(const BitImage& image) { return sizeof(image) + vectorBytes(image.words); }
std::size_t bytesOf(const FilteredImage& image) { return bytesOf(image.ink); }
std::size_t bytesOf(const std::optional<FinePage>& fine) {
  return sizeof(fine) + (fine ? vectorBytes(fine->grey->pixels) + bytesOf(fine->ink) : 0);
}
std::size_t bytesOf(const ContourSet& set) {
  std::size_t bytes = sizeof(set);
  for (const auto* lines : {&set.contours, &set.sheetEdges})
    for (const Contour& c : *lines) bytes += sizeof(c) + vectorBytes(c.points);
  for (const StrokeJunction& junction : set.junctions) {
    bytes += sizeof(junction) + vectorBytes(junction.branchesPx) + vectorBytes(junction.pairs) +
             vectorBytes(junction.pairings);
    for (const EndPairs& pairing : junction.pairings) bytes += vectorBytes(pairing);
  }
  return bytes;
}
std::size_t bytesOf(const PieceSet& set) {
  std::size_t bytes = sizeof(set) + vectorBytes(set.corners);
  for (const Piece& p : set.pieces) bytes += sizeof(p) + vectorBytes(p.points);
  return bytes;
}
std::size_t bytesOf(const PieceNumbers& numbers) {
  std::size_t bytes = sizeof(numbers) + vectorBytes(numbers.ofPiece) + vectorBytes(numbers.known.curves);
  for (const NumberedCurve& curve : numbers.known.curves) bytes += vectorBytes(curve.placesPx);
  return bytes;
}
std::size_t bytesOf(const SegmentSet& set) {
  std::size_t bytes = sizeof(set);
  for (const PieceSegments& p : set.pieces) bytes += sizeof(p) + vectorBytes(p.stations);
  return bytes;
}
std::size_t bytesOf(const std::vector<TracedCurve>& curves) {
  std::size_t bytes = 0;
  for (const TracedCurve& c : curves) {
    const NurbsCurve& largest = c.fairingStart();
    const std::size_t points = largest.isEmpty() ? 0 : largest.controlPointCount();
    bytes += sizeof(c) + 4 * points * sizeof(Vec2) + vectorBytes(c.construct.extrema) + vectorBytes(c.construct.noise);
  }
  return bytes;
}
std::size_t bytesOf(const ConstructedSet& set) { return sizeof(set) + bytesOf(set.curves); }
std::size_t bytesOf(const FairedSet& set) { return sizeof(set) + bytesOf(set.curves); }

class PipelineRun {
 public:
  PipelineRun(const Scan& scan, const Recipe& recipe, StageCache& cache, const PipelineRequest& request,
              const RunContext& context)
      : scan_(scan), recipe_(recipe), cache_(cache), request_(request), context_(context) {}

  PipelineOutput runStages() {
    if (auto wrong = validate(recipe_)) {
      out_.error = std::move(wrong);
      return std::move(out_);
    }
    out_.frame = frameFor(scan_, recipe_);
    keys_ = stageKeys(scan_, recipe_, out_.frame);
    for (const StageId stage : kStages) {
      if (stage > request_.upTo) break;
      if (stage == StageId::Edges && !request_.needEdges) continue;
      if (!runStage(stage)) break;
      if (request_.stageReady) request_.stageReady(stage, out_);
    }
    return std::move(out_);
  }

 private:
  bool runStage(StageId stage) {
    switch (stage) {
      case StageId::Thresholds:
        return thresholds();
      case StageId::Binary:
        return step(stage, out_.binary, [&]() -> Result<BitImage> {
          if (isBlank(scan_)) return BitImage(scan_.grey.width, scan_.grey.height);
          return binarizePage(grey(), *out_.thresholds, recipe_.threshold, context_);
        });
      case StageId::Filtered:
        return step(stage, out_.filtered, [&] { return neighbourhoodFilter(*out_.binary, recipe_.filter, context_); });
      case StageId::Edges:
        return step(stage, out_.edges, [&] { return laplacianEdges(out_.filtered->ink, context_); });
      case StageId::Contours:
        return step(stage, out_.contours, [&] { return lines(); });
      case StageId::Pieces:
        return step(stage, out_.pieces, [&] { return pieces(); }) && numberPiecesOnce();
      case StageId::Segments:
        return step(stage, out_.segments, [&] { return regressionSegments(*out_.pieces, recipe_.segments, context_); });
      case StageId::Curves:
        return step(stage, out_.constructed, [&] {
          return constructAll(*out_.contours, *out_.pieces, *out_.segments, recipe_, out_.frame, context_);
        });
      case StageId::Faired:
        return step(stage, out_.faired, [&] {
          return fairAll(*out_.constructed, *out_.contours, *out_.pieces, recipe_, out_.frame, context_);
        });
    }
    return false;
  }

  const GreyImage& grey() const { return tracedGrey(scan_, out_); }

  /// What the thresholds are measured on: of an empty page a part, which is as white as the whole.
  const GreyImage& thresholdGrey() {
    constexpr int kPartPx = 512;  // of a side
    if (!isBlank(scan_) || std::max(scan_.grey.width, scan_.grey.height) <= kPartPx) return grey();
    part_ = GreyImage::uniform(std::min(scan_.grey.width, kPartPx), std::min(scan_.grey.height, kPartPx), 0xffff);
    return part_;
  }

  Result<PieceSet> pieces() {
    std::vector<Corner> certain;
    if (recipe_.corners.automatic) {
      certain =
          certainCorners(*out_.contours, grey(), recipe_.refusedCornersPx, recipe_.corners.snapDistancePx, context_);
      if (context_.isCancelled()) return cancelled();
    }
    const bool hasCorners = !recipe_.cornerMarks.empty() || !certain.empty();
    const GreyImage& even = hasCorners ? flattenedScan() : grey();
    return splitAtCorners(*out_.contours, recipe_.cornerMarks, recipe_.corners, context_, &even, certain);
  }

  /// The page that all stages read, kept for the runs that change thresholds alone, and its thresholds.
  bool thresholds() {
    const Clock::time_point begin = begin_ = Clock::now();
    const bool isPrepared = fill(StageId::Thresholds, keys_.page, out_.page, [&]() -> Result<PreparedPage> {
      return isBlank(scan_) ? PreparedPage{} : preparePage(scan_, preparationOf(recipe_), context_);
    });
    if (!isPrepared) return false;
    const bool isDone = step(StageId::Thresholds, out_.thresholds, [&] {
      return findThresholds(thresholdGrey(), recipe_.paper, recipe_.threshold, context_);
    });
    begin_ = begin;
    takeTime(StageId::Thresholds);
    return isDone;
  }

  /// What the pieces are called; kept for the runs that change only later stages.
  bool numberPiecesOnce() {
    HashBuilder h;
    h.text("curve numbers").hash(keys_[StageId::Pieces]).integer(recipe_.curveNumbers.lastGiven);
    for (const NumberedCurve& curve : recipe_.curveNumbers.curves) {
      h.integer(curve.number).integer(std::ssize(curve.placesPx));
      for (const Vec2& p : curve.placesPx) h.number(p.x()).number(p.y());
    }
    const bool made = fill(StageId::Pieces, h.finish(), out_.numbers, [&]() -> Result<PieceNumbers> {
      return numberPieces(*out_.pieces, recipe_.curveNumbers, context_);
    });
    if (made) takeTime(StageId::Pieces);
    return made;
  }

  /// The scan without its folds, made once a run.
  const GreyImage& flattenedScan() {
    const auto& folds = out_.thresholds->paper.folds;
    if (folds.empty()) return grey();
    if (!even_) even_ = withoutFolds(grey(), folds, context_);
    return *even_;
  }

  /// Of outlines and of lines that stand for several strokes no more is wanted than the page shows.
  bool wantsFinePage() const {
    const EdgeParams& edges = recipe_.edges;
    return !request_.isPreview && edges.mode != EdgeMode::Outline && !(edges.mergeWidths > 0.0) && !edges.intent;
  }

  /// The fine page of all ink, or that there is none; kept for the runs that change how lines are followed.
  Result<std::shared_ptr<const std::optional<FinePage>>> fineOf(const GreyImage& grey) {
    using Fine = std::optional<FinePage>;
    if (!wantsFinePage()) return std::make_shared<const Fine>();
    auto fine = cache_.find<Fine>(keys_.fine);
    if (fine) return fine;
    auto made = finePage(grey, out_.filtered->ink, {recipe_.paper, recipe_.threshold, recipe_.filter}, context_);
    if (!made) return fail(made.error());
    if (context_.isCancelled()) return cancelled();
    fine = std::make_shared<const Fine>(std::move(*made));
    cache_.store(keys_.fine, fine, bytesOf(*fine));
    return fine;
  }

  /// The lines of the page, or of the parts of it that the user wants.
  Result<ContourSet> traceRegions() {
    if (isBlank(scan_)) return fail(ErrorCode::NoCurve, "The page is empty.");
    const GreyImage& grey = flattenedScan();
    if (context_.isCancelled()) return cancelled();
    const auto found = fineOf(grey);
    if (!found) return fail(found.error());
    const std::optional<FinePage>& fine = **found;
    const auto trace = [&](const BitImage& ink, const FinePage* page) {
      return traceContours(ink, grey, recipe_.edges, recipe_.contours, context_,
                           {page, wantsFinePage() ? &out_.thresholds->paper : nullptr});
    };
    if (recipe_.regions.empty()) {
      auto set = trace(out_.filtered->ink, fine ? &*fine : nullptr);
      const bool isRuled = !out_.page->rulings.empty();
      if (!set && set.error().code == ErrorCode::NoCurve && (isRuled || !out_.page->dots.empty()))
        return fail(ErrorCode::NoCurve,
                    std::string("No line was found beside the ") + (isRuled ? "ruled lines" : "printed dots") +
                        ": if these are the drawing, keep them (Ruled lines, paper.rulings=keep). " +
                        set.error().message);
      return set;
    }
    const BitImage ink = inkTouching(out_.filtered->ink, recipe_.regions, context_);
    const std::optional<FinePage> part = fine ? std::optional(onInk(*fine, ink, context_)) : std::nullopt;
    auto set = trace(ink, part ? &*part : nullptr);
    if (set) {
      const double limit = recipe_.contours.minWidths * set->report.widthPx.value_or(0.0);
      set = keepInside(std::move(*set), recipe_.regions, std::max(limit, recipe_.contours.minLengthPx));
    }
    const bool isEmpty = set ? set->contours.empty() : set.error().code == ErrorCode::NoCurve;
    if (!isEmpty) return set;
    return fail(ErrorCode::NoCurve, "No line lies inside the region: draw a larger one or clear it.");
  }

  /// The lines found on the scan, and behind them those of other programs and those drawn by hand. The found ones are
  /// kept by themselves, so that a new stroke does not trace the page again.
  Result<ContourSet> lines() {
    if (recipe_.penStrokes.empty() && recipe_.imports.empty()) {
      if (isBlank(scan_))
        return fail(ErrorCode::NoCurve, "The page is empty. Draw a line with the pen, or import curves.");
      return traceRegions();
    }
    auto traced = cache_.find<ContourSet>(keys_.traced);
    if (!traced) {
      auto found = traceRegions();
      if (context_.isCancelled()) return cancelled();
      // On white paper, or beside a drawing that gives no line, the strokes are the drawing.
      if (!found && found.error().code != ErrorCode::NoCurve) return found;
      traced = std::make_shared<const ContourSet>(found ? std::move(*found) : ContourSet{});
      if (found) cache_.store(keys_.traced, traced, bytesOf(*traced));
    }
    const ContourSet drawn = withImports(*traced, recipe_.imports, out_.frame, context_);
    if (context_.isCancelled()) return cancelled();
    return withPenStrokes(drawn, recipe_.penStrokes,
                          {static_cast<double>(scan_.grey.width), static_cast<double>(scan_.grey.height)});
  }

  /// Fills `slot` from the cache or by running `work`; false if the run ends here.
  template <class T, class Work>
  bool step(StageId stage, std::shared_ptr<const T>& slot, const Work& work) {
    begin_ = Clock::now();
    StageTiming& timing = out_.timing[indexOf(stage)];
    timing.run = true;
    bool isMade = false;
    const auto make = [&] {
      isMade = true;
      return work();
    };
    if (!fill(stage, keys_[stage], slot, make)) return false;
    timing.fromCache = !isMade;
    takeTime(stage);
    return true;
  }

  /// As step(), for one of the outputs of a stage.
  template <class T, class Work>
  bool fill(StageId stage, const ContentHash& key, std::shared_ptr<const T>& slot, const Work& work) {
    try {
      if (context_.isCancelled()) return stop(stage, {ErrorCode::Cancelled, "Cancelled.", {}});
      slot = cache_.find<T>(key);
      if (!slot) {
        Result<T> result = work();
        // A stage that was interrupted may hand back what it had: never kept.
        if (context_.isCancelled()) return stop(stage, {ErrorCode::Cancelled, "Cancelled.", {}});
        if (!result) return stop(stage, std::move(result).error());
        slot = std::make_shared<const T>(std::move(*result));
        cache_.store(key, slot, bytesOf(*slot));
      }
    } catch (const std::bad_alloc&) {
      slot = nullptr;
      return stop(stage, {ErrorCode::OutOfMemory,
                          "There is not enough memory for the stage \"" + std::string(name(stage)) +
                              "\". Close other programs, or scan at a lower resolution.",
                          {}});
    } catch (const std::exception& e) {
      slot = nullptr;
      return stop(stage, {ErrorCode::Numerical,
                          "The stage \"" + std::string(name(stage)) +
                              "\" failed on this drawing. Change its settings or report it.",
                          e.what()});
    }
    return true;
  }

  void takeTime(StageId stage) {
    out_.timing[indexOf(stage)].milliseconds = std::chrono::duration<double, std::milli>(Clock::now() - begin_).count();
  }

  bool stop(StageId stage, Error error) {
    takeTime(stage);
    out_.error = std::move(error);
    out_.failedStage = stage;
    return false;
  }

  const Scan& scan_;
  const Recipe& recipe_;
  StageCache& cache_;
  const PipelineRequest& request_;
  const RunContext& context_;
  using Clock = std::chrono::steady_clock;
  Clock::time_point begin_;  ///< Of the present stage.
  StageKeys keys_;
  PipelineOutput out_;
  std::optional<GreyImage> even_;
  GreyImage part_;
};

}  // namespace

PipelineOutput runPipeline(const Scan& scan, const Recipe& recipe, StageCache& cache, const PipelineRequest& request,
                           const RunContext& context) {
  return PipelineRun(scan, recipe, cache, request, context).runStages();
}

const GreyImage& tracedGrey(const Scan& scan, const PipelineOutput& output) {
  return output.page && output.page->grey ? *output.page->grey : scan.grey;
}

int curveNumber(const PipelineOutput& output, const TracedCurve& curve) {
  // Curves of an older run may be shown beside the pieces of a newer one, for a moment.
  const bool isKnown = output.numbers && curve.piece >= 0 && curve.piece < std::ssize(output.numbers->ofPiece);
  return isKnown ? output.numbers->ofPiece[curve.piece] : curve.piece + 1;
}

std::string ownNameOfCurve(const PipelineOutput& output, const Recipe& recipe, const TracedCurve& curve) {
  if (!output.pieces || !output.contours || curve.piece < 0 || curve.piece >= std::ssize(output.pieces->pieces))
    return {};
  return importedNameOf(*output.pieces, curve.piece, *output.contours, recipe.imports);
}

std::string nameOfCurve(const PipelineOutput& output, const Recipe& recipe, const TracedCurve& curve) {
  std::string own = ownNameOfCurve(output, recipe, curve);
  return own.empty() ? curveName(curveNumber(output, curve)) : own;
}

ConstructContour lineInput(const PipelineOutput& output, int contour) {
  if (!output.contours || !output.pieces || !output.segments) return {};
  return contourInput(*output.contours, *output.pieces, *output.segments, contour, output.frame);
}

PageFrame frameFor(const Scan& scan, const Recipe& recipe) {
  PageFrame frame = pageFrame(scan, recipe.dpi ? recipe.dpi : scan.dpi);
  if (recipe.page) {
    frame.leftMm = recipe.page->leftMm;
    frame.bottomMm = recipe.page->bottomMm;
  }
  return frame;
}

bool isScaleAssumed(const Scan& scan, const Recipe& recipe) { return !recipe.dpi && !scan.dpi; }

}  // namespace batten
