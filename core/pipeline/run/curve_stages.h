// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/pipeline/run/pipeline.h"

namespace batten {

/// The pieces [first, last) of one contour, which stand together.
struct PieceRange {
  std::size_t first = 0, last = 0;
};
/// Where the pieces of a contour stand; empty if it has none.
PieceRange rangeOf(const PieceSet&, int contour);

/// Places of the points of a piece in the model frame.
std::vector<Vec2> pointsToModel(std::span<const PiecePoint>, const PageFrame&);

/// Figures of one curve; `points` are the edge points in model mm, in order.
CurveFigures figuresOf(const NurbsCurve&, bool closed, const std::vector<Vec2>& points, const RunContext&);

/// One piece in the model frame, as typical chains take it (they do not ask which points of a stroke were drawn).
ConstructPiece typicalPieceOf(const PieceSet&, const SegmentSet&, const Recipe&, const PageFrame&, std::size_t piece);

/// Curves of all pieces: image px become model mm here and nowhere else. Contours are constructed side by side; a
/// contour that fails as a whole is tried piece by piece, and what then fails is listed.
/// @return NoCurve, with the first reason, if no piece gave a curve.
Result<ConstructedSet> constructAll(const ContourSet&, const PieceSet&, const SegmentSet&, const Recipe&,
                                    const PageFrame&, const RunContext&);

/// What the constructions take of one contour: all its pieces. Empty if it has none.
ConstructContour contourInput(const ContourSet&, const PieceSet&, const SegmentSet&, int contour, const PageFrame&);

/// Pieces of one line constructed from their points, whatever the user chose for its curves. What gave no curve is
/// listed.
ConstructedSet constructFromPoints(const PipelineOutput&, const Recipe&, const PieceRange&, const RunContext&);

}  // namespace batten
