// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/fair/fair_fit.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <new>
#include <utility>

#include "core/base/parallel.h"
#include "core/construct/fair/fair_finish.h"
#include "core/construct/fair/fair_piece.h"
#include "core/construct/fair/fair_prepare.h"
#include "core/construct/fair/smooth_sections.h"
#include "core/construct/fair/stroke_grain.h"
#include "core/curve/arc_length.h"
#include "core/polyline/point_grid.h"

namespace batten {
namespace {

constexpr int kFitRounds = 6;              // of fits of a contour; stretches are cut where a round has failed
constexpr double kUsualLengthPx = 2000.0;  // of a line; longer ones have more places where noise looks like a bump
constexpr double kLeastReachPx = 8.0;      // of a curve from the points of a border with grain
constexpr int kFewestLooks = 8;            // at a curve, for places far from all points
constexpr double kWhiteDensity = 0.045;    // [px^2 px] of ordinary edge points; where a contour is too short to tell

/// The rest of the frame, which is most of what a piece holds, is of no use after the noise is known.
void keepBaseOnly(FairPiece& piece) {
  FairFrame bare;
  bare.base = std::move(piece.frame->base);
  piece.frame = std::move(bare);
}

/// What the pieces of a contour tell together of their noise.
struct PooledNoise {
  CutoffChoice choice;
  double density = 0.0;  ///< [px^2 px] As measured, or the usual one.
  double s0 = 0.0;       ///< [px^2 px] Not less than the floor.
};

PooledNoise pooledNoise(const std::vector<FairPiece>& pieces, const ConstructContour& contour,
                        const FairFitOptions& options) {
  std::vector<std::optional<CutoffTable>> tables;
  std::vector<double> leastVariance;
  tables.reserve(pieces.size());
  for (const FairPiece& piece : pieces) tables.push_back(piece.table);
  for (const ConstructPiece& piece : contour.pieces) leastVariance.push_back(piece.grain.density / options.blockPx);
  PooledNoise pooled{chooseCutoffs(tables, leastVariance, options.effectiveDofWeight)};
  const auto& k = pooled.choice.k;
  const bool measured = std::any_of(k.begin(), k.end(), [](const auto& of) { return of.has_value(); });
  pooled.density = measured ? options.blockPx * pooled.choice.blockVariance : kWhiteDensity;
  pooled.s0 = std::max(pooled.density, options.noiseDensityFloor);
  return pooled;
}

/// Smooths every piece by its own cut-off and weighs its points by the noise that this leaves.
void followNoise(std::vector<FairPiece>& pieces, const ConstructContour& contour, const PooledNoise& pooled,
                 const FairFitOptions& options, const RunContext& context) {
  std::vector<NoiseTrace> traces(pieces.size());
  parallelFor(context, static_cast<int>(pieces.size()), 1, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      FairPiece& piece = pieces[i];
      if (!piece.frame || context.isCancelled()) continue;
      const std::vector<double> prior =
          uniformPrior(*piece.frame, pooled.s0, CutoffTable::cutoffPx(*pooled.choice.k[i]));
      const auto smooth = localPosterior(*piece.frame, pooled.s0, prior, 0, options.emWidthPx, context);
      if (!smooth) continue;
      piece.rough = smooth->mean;
      traces[i] = noiseTrace(*piece.frame, smooth->mean, pooled.s0);
      keepBaseOnly(piece);
    }
  });
  const std::vector<LocalNoise> noise = localNoise(traces);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (pieces[i].frame)
      weighByNoise(pieces[i].data, noise[i], pooled.density, options.noiseDensityFloor,
                   contour.pieces[i].grain.density);
  }
}

Result<std::vector<ConstructedPiece>> fitPieces(const ConstructContour& contour, bool willBeCut,
                                                const FairFitOptions& options, const RunContext& context) {
  const int count = static_cast<int>(contour.pieces.size());
  std::vector<FairPiece> pieces(contour.pieces.size());
  const std::optional<double> ordinary = ordinarySigma(contour);
  parallelFor(context, count, 1, [&](int begin, int end) {
    for (int i = begin; i < end && !context.isCancelled(); ++i) {
      pieces[i] = prepareFairPiece(contour.pieces[i], contour.isStroke, ordinary, options, context);
    }
  });
  if (context.isCancelled()) return cancelled();
  const PooledNoise pooled = pooledNoise(pieces, contour, options);
  const std::vector<std::optional<int>>& cutoffs = pooled.choice.k;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (!cutoffs[i]) pieces[i].frame.reset();
  }
  followNoise(pieces, contour, pooled, options, context);
  if (context.isCancelled()) return cancelled();
  parallelFor(context, count, 1, [&](int begin, int end) {
    for (int i = begin; i < end && !context.isCancelled(); ++i) {
      const FairNoise noise{pooled.s0, CutoffTable::cutoffPx(cutoffs[i].value_or(0)), willBeCut};
      finishFairPiece(pieces[i], contour.pieces[i], noise, options, context);
      pieces[i].frame.reset();
      pieces[i].data = {};
      pieces[i].rough.resize(0);
    }
  });
  double squares = 0.0, points = 0.0;
  std::vector<ConstructedPiece> out;
  for (FairPiece& piece : pieces) {
    if (context.isCancelled() || !piece.result) return cancelled();
    if (!*piece.result) return fail(piece.result->error());
    out.push_back(std::move(**piece.result));
    squares += piece.squares;
    points += piece.pointCount;
  }
  if (points > 0.0) {
    for (ConstructedPiece& piece : out) piece.report.noisePx = std::sqrt(squares / points);
  }
  return out;
}

/// The stretches of all pieces fitted together, so that they share what is known of the noise; a stretch whose fit has
/// left its points is cut and fitted again.
Result<std::vector<ConstructedPiece>> fitParts(const ConstructContour& contour, const FairFitOptions& options,
                                               const RunContext& context) {
  std::vector<SmoothSections> parts;
  for (const ConstructPiece& piece : contour.pieces) {
    parts.emplace_back(piece, contour.isStroke, options);
  }
  for (int round = 0; round < kFitRounds; ++round) {
    ConstructContour stretches{{}, contour.isStroke};
    std::vector<std::size_t> counts;
    for (const SmoothSections& part : parts) {
      auto pieces = part.stretches();
      counts.push_back(pieces.size());
      std::move(pieces.begin(), pieces.end(), std::back_inserter(stretches.pieces));
    }
    auto fits = fitPieces(stretches, round + 1 < kFitRounds, options, context);
    if (!fits) return fits;
    bool again = false;
    const bool isLast = round + 1 == kFitRounds;
    auto next = std::make_move_iterator(fits->begin());
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const auto end = next + static_cast<std::ptrdiff_t>(counts[i]);
      again = parts[i].check({next, end}, isLast, context) || again;
      next = end;
      if (context.isCancelled()) return cancelled();
    }
    if (!again) break;
  }
  std::vector<ConstructedPiece> out;
  for (SmoothSections& part : parts) {
    auto piece = std::move(part).joined(context);
    if (context.isCancelled()) return cancelled();
    if (!piece) return fail(piece.error());
    out.push_back(std::move(*piece));
  }
  return out;
}

// Whether all of the curves lies within `reachPx` of some point. Where few points tell of a border, and with much
// noise, a curve may swing out between them.
bool keepsToPoints(const std::vector<ConstructedPiece>& fitted, const ConstructContour& contour, double reachPx,
                   const RunContext& context) {
  PointGrid<Vec2> points(reachPx);
  double length = 0.0;
  for (const ConstructPiece& piece : contour.pieces) {
    for (const PiecePoint& p : piece.points) points.add(p.at, p.at);
    length += static_cast<double>(piece.points.size());
  }
  for (const ConstructedPiece& piece : fitted) {
    const int count = std::max(kFewestLooks, static_cast<int>(2.0 * length / reachPx / std::ssize(fitted)));
    for (const CurveSample& sample : sampleByArcLength(piece.curve, count, context)) {
      bool isNear = false;
      points.around(sample.point, [&](const Vec2& at) { isNear = isNear || (at - sample.point).norm() <= reachPx; });
      if (!isNear) return false;
    }
  }
  return true;
}

}  // namespace

double costAsked(const ConstructContour& contour, const FairFitOptions& options) {
  double length = 0.0;
  for (const ConstructPiece& piece : contour.pieces) {
    for (std::size_t i = 1; i < piece.points.size(); ++i)
      length += (piece.points[i].at - piece.points[i - 1].at).norm();
  }
  return options.extremumSignificance + 2.0 * std::log(std::max(1.0, length / kUsualLengthPx));
}

Result<std::vector<ConstructedPiece>> fairFit(const ConstructContour& contour, const FairFitOptions& options,
                                              const RunContext& context) {
  const double lengths[] = {options.knotSpacingPx, options.blockPx, options.noiseDensityFloor, options.emWidthPx,
                            options.extremumSignificance};
  for (const double x : lengths) {
    if (!(x > 0.0) || !std::isfinite(x))
      return fail(ErrorCode::BadParameter, "An option of the fair fit must be above 0.");
  }
  try {
    FairFitOptions asked = options;
    asked.extremumSignificance = costAsked(contour, options);
    ConstructContour grained = contour;
    const StrokeGrain grain = strokeGrain(contour);
    for (ConstructPiece& piece : grained.pieces) piece.grain = grain;
    auto pieces = fitParts(grained, asked, context);
    if (pieces && contour.pencilPx && grain.density > 0.0 &&
        !keepsToPoints(*pieces, contour, std::max(kLeastReachPx, *contour.pencilPx), context))
      pieces = fitParts(contour, asked, context);
    if (!pieces) return pieces;
    for (ConstructedPiece& piece : *pieces) {
      for (ExtremumNote& note : piece.report.extrema) note.askedCost = asked.extremumSignificance;
    }
    return pieces;
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::OutOfMemory, "Not enough memory to fit the curve.");
  }
}

}  // namespace batten
