// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/construct/construct_params.h"
#include "core/construct/pieces.h"
#include "core/construct/typical/typical_path.h"

namespace batten {

/// A fit or a path that runs this far [px, rms] from its points has lost its line.
inline constexpr double kLostRmsPx = 3.0;

/// A piece as the typical constructions take it: joints that roughly follow it, and its points, both from its start and
/// in px.
struct TypicalLine {
  std::vector<Joint> joints;  ///< Empty: too few stations. Closed: the last repeats the first.
  std::vector<Vec2> points;
  bool closed = false;
  Vec2 origin = Vec2::Zero();
  Vec2 end = Vec2::Zero();         ///< Open: where the line ends; it starts at the origin.
  std::optional<NurbsCurve> fair;  ///< The true and fair fit of the line, which the joints then lie on.

  Vec2 toLine(const Vec2& p) const { return p - origin; }
  Vec2 toPiece(const Vec2& p) const { return origin + p; }
};

/// Its joints lie on the true and fair fit where there is one, else on stations.
TypicalLine typicalLine(const ConstructPiece&, const ConstructParams&, const RunContext&);
/// The points of a piece in order from the start of the line; many are taken together in groups, without bias.
std::vector<Vec2> pointsAlong(const ConstructPiece&, const TypicalLine&);

/// A path as one B-spline of degree 5 where its piece lies, knots of multiplicity 4.
Result<NurbsCurve> pathCurve(const TypicalPath&, const TypicalLine&);
/// One note for each element of a path, in px of the piece.
std::vector<SegmentNote> segmentNotes(const TypicalPath&, const TypicalLine&);

}  // namespace batten
