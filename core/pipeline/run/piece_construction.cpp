// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/run/piece_construction.h"

#include <cstddef>
#include <iterator>
#include <new>
#include <utility>
#include <vector>

#include "core/pipeline/run/curve_stages.h"

namespace batten {
namespace {

bool hasLines(const PipelineOutput& out) {
  return out.contours && out.pieces && out.segments && out.segments->pieces.size() == out.pieces->pieces.size();
}

}  // namespace

Result<TracedCurve> constructPiece(const PipelineOutput& out, const Recipe& recipe, int piece,
                                   const RunContext& context) {
  if (!hasLines(out) || piece < 0 || piece >= std::ssize(out.pieces->pieces))
    return fail(ErrorCode::NoCurve, "There is no such line.");
  try {
    const std::size_t at = piece;
    ConstructedSet made = constructFromPoints(out, recipe, {at, at + 1}, context);
    if (context.isCancelled()) return cancelled();
    if (!made.curves.empty()) return std::move(made.curves.front());
    if (!made.failures.empty()) return fail(made.failures.front());
    return fail(ErrorCode::NoCurve, "No curve could be made from this line.");
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::OutOfMemory, "There is not enough memory to construct this line.");
  }
}

Result<std::vector<TracedCurve>> constructLine(const PipelineOutput& out, const Recipe& recipe, int contour,
                                               const RunContext& context) {
  const PieceRange range = hasLines(out) ? rangeOf(*out.pieces, contour) : PieceRange{};
  if (range.first == range.last) return fail(ErrorCode::NoCurve, "There is no such line.");
  try {
    ConstructedSet outcome = constructFromPoints(out, recipe, range, context);
    if (context.isCancelled()) return cancelled();
    std::vector<TracedCurve> curves(range.last - range.first);
    for (TracedCurve& curve : outcome.curves) {
      const std::size_t at = curve.piece - range.first;
      curves[at] = std::move(curve);
    }
    return curves;
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::OutOfMemory, "There is not enough memory to construct this line.");
  }
}

}  // namespace batten
