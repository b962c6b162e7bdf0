// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/run/piece_construction.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <new>
#include <utility>
#include <vector>

#include "core/pipeline/run/curve_stages.h"

namespace batten {

Result<TracedCurve> constructPiece(const PipelineOutput& out, const Recipe& recipe, int piece,
                                   const RunContext& context) {
  if (!out.pieces || !out.segments || !out.contours || piece < 0 || piece >= std::ssize(out.pieces->pieces))
    return fail(ErrorCode::NoCurve, "There is no such line.");
  try {
    ConstructedSet made = constructFromPoints(out, recipe, piece, piece + 1, context);
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
  const std::size_t count = lineInput(out, contour).pieces.size();
  if (count == 0) return fail(ErrorCode::NoCurve, "There is no such line.");
  try {
    const std::vector<Piece>& pieces = out.pieces->pieces;  // those of one line stand together
    const std::size_t first = std::ranges::find(pieces, contour, &Piece::contour) - pieces.begin();
    ConstructedSet outcome = constructFromPoints(out, recipe, first, first + count, context);
    if (context.isCancelled()) return cancelled();
    std::vector<TracedCurve> curves(count);
    for (TracedCurve& curve : outcome.curves) {
      const std::size_t at = curve.piece - first;
      curves[at] = std::move(curve);
    }
    return curves;
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::OutOfMemory, "There is not enough memory to construct this line.");
  }
}

}  // namespace batten
