// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/fair_fit.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <new>
#include <utility>

#include "core/base/parallel.h"
#include "core/construct/fair_piece.h"

namespace batten {
namespace {

constexpr double kWhiteDensity = 0.045;  // [px^2 px] of ordinary edge points; where a contour is too short to tell

Result<std::vector<ConstructedPiece>> fitPieces(const ConstructContour& contour, const FairFitOptions& options,
                                                const RunContext& context) {
  const int count = static_cast<int>(contour.pieces.size());
  std::vector<FairPiece> pieces(contour.pieces.size());
  parallelFor(context, count, 1, [&](int begin, int end) {
    for (int i = begin; i < end && !context.isCancelled(); ++i) {
      const auto at = static_cast<std::size_t>(i);
      pieces[at] = prepareFairPiece(contour.pieces[at], contour.isStroke, contour.pixelMm, options);
    }
  });
  if (context.isCancelled()) return cancelled();
  std::vector<CutoffTable> tables;
  for (const FairPiece& piece : pieces) tables.push_back(piece.table);
  const CutoffChoice choice = chooseCutoffs(tables, options.effectiveDofWeight);
  const bool measured = std::any_of(choice.k.begin(), choice.k.end(), [](int k) { return k >= 0; });
  const double density = measured ? options.blockPx * choice.blockVariance : kWhiteDensity;
  const double s0 = std::max(density, options.noiseDensityFloor);
  parallelFor(context, count, 1, [&](int begin, int end) {
    for (int i = begin; i < end && !context.isCancelled(); ++i) {
      const auto at = static_cast<std::size_t>(i);
      if (choice.k[at] < 0) pieces[at].frame.reset();
      const double cutoff = CutoffTable::cutoffPx(std::max(0, choice.k[at]));
      finishFairPiece(pieces[at], contour.pieces[at], contour.pixelMm, s0, cutoff, options, context);
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
  for (ConstructedPiece& piece : out) piece.report.noisePx = points > 0.0 ? std::sqrt(squares / points) : 0.0;
  return out;
}

}  // namespace

Result<std::vector<ConstructedPiece>> fairFit(const ConstructContour& contour, const FairFitOptions& options,
                                              const RunContext& context) {
  if (!(contour.pixelMm > 0.0) || !std::isfinite(contour.pixelMm)) {
    return fail(ErrorCode::BadParameter, "The size of a pixel must be above 0 mm.");
  }
  const double lengths[] = {options.knotSpacingPx, options.blockPx, options.noiseDensityFloor, options.emWidthPx,
                            options.keepExtremaCost};
  for (const double x : lengths) {
    if (!(x > 0.0) || !std::isfinite(x))
      return fail(ErrorCode::BadParameter, "An option of the fair fit must be above 0.");
  }
  try {
    return fitPieces(contour, options, context);
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::OutOfMemory, "Not enough memory to fit the curve.");
  }
}

}  // namespace batten
