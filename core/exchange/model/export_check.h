// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/base/result.h"
#include "core/exchange/model/export_model.h"

namespace batten {

/// Whether one curve ends where the next starts, but for rounding: a millionth of their size.
bool doMeet(const NurbsCurve& before, const NurbsCurve& behind);
/// Whether every piece ends where the next starts, the last one where the first does, and none is broken within.
bool isLoop(const std::vector<ExportPiece>& pieces);
/// Of a loop: the least geometric continuity where its pieces meet, its start included. 0 place, 1 direction, 2
/// curvature, 3 slope of the curvature over arc length. Measured, to a millionth of the size; 3 may be more.
int continuityOf(const std::vector<ExportPiece>& pieces);

/// Why a document must not be written: nothing in it, a curve without pieces, a number that is not finite, a frame
/// without size, a curve that is said to be closed and is not. Every writer asks this first, so that no file ever holds
/// a NaN.
std::optional<Error> exportProblem(const ExportDocument&);

}  // namespace batten
