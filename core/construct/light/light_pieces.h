// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/construct/construct_params.h"
#include "core/construct/light/light_curve.h"
#include "core/construct/pieces.h"

namespace batten {

/// What ConstructParams asks of a light curve in the model frame, with pixels of this size.
LightOptions lightOptions(const ConstructParams&, double pixelMm);

/// The same for a piece's detail (0..1): the tolerance grows by equal factors from that of the light curve to a quarter
/// of the width of the ink (where that is not known, 1 % of the size of the curve), and what may go with it.
LightOptions lightOptions(const ConstructParams&, const ConstructContour&, const NurbsCurve& dense, double detail);

/// Figures of a light curve for the report; control points as the list of curves and the files count them.
LightNote lightNote(const LightCurve&, const NurbsCurve& dense, double pixelMm);

/// What fairing starts from where it is to keep the ends of a light curve: the curve itself with more knots, and, where
/// its pieces meet with one tangent or curvature only, or it is rational, a quintic close to it that has its ends.
/// Absent: the curve itself.
std::optional<NurbsCurve> fairingStartOf(const NurbsCurve& light, bool closed, const LightOptions&);

/// Makes the curves of pieces light: each keeps the dense one beside it (ConstructedPiece::dense) and says in its
/// report what was won. A curve without a lighter version is kept, with a note.
/// Ragged outlines of uneven ink have a detail of at least 0.8 (ConstructParams::smoothRagged).
Result<void> makePiecesLight(std::vector<ConstructedPiece>& made, const ConstructContour&, const ConstructParams&,
                             const RunContext&);

}  // namespace batten
