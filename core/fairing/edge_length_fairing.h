// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/curve/nurbs_curve.h"
#include "core/fairing/fairing_params.h"
#include "core/fairing/fairing_report.h"

namespace batten {

/// True when a fairing asks for the edge lengths of a Bezier path: target and low-pass mode only.
bool movesEdgeLengths(const FairingParams&);

/// Shape modification of a Bezier path on a specified curvature by the edge lengths a_1 to a_5 of each piece's control
/// polygon (001 section 6, Eq 12 to 16): towards a polynomial or the drawn profile (target mode), or the path's own
/// curvature without its short waves (low-pass mode). The path must be one of quintic pieces: knots of multiplicity 3
/// or more; any other curve has its control points moved instead, and the note says so.
///
/// As in the paper the end of a piece moves and what follows moves along; an open path is then rotated and scaled onto
/// its end. Closed paths, and open ones with a held tangent, keep every joint where it is. Of both ways the one that
/// comes nearer to the profile is taken. The profile is followed only as far as the tolerance allows: the specified
/// curvature is a share of the way from the path's own. One curvature at every joint (G2), ends exactly where they
/// were.
Result<FairedCurve> fairByEdgeLengths(const NurbsCurve& path, bool closed, const FairingParams&, const RunContext&);

/// False where there are no edge lengths to move; true for a path of quintic pieces.
bool isBezierPath(const NurbsCurve&);
/// Says in the report that control points were moved, unless it says something else.
void noteNoPath(FairingReport&);

/// The same towards this profile, whatever mode and target say.
Result<FairedCurve> fairByEdgeLengths(const NurbsCurve& path, bool closed, const TargetProfile&, const FairingParams&,
                                      const RunContext&);

}  // namespace batten
