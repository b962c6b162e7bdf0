// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/curve/width_profile.h"
#include "core/pipeline/run/pipeline.h"

namespace batten {

/// [mm] The stroke's width along one of the two shapes of a traced curve, from the widths that were measured at the
/// points of its line and, where the stroke is too thin for its edges to be told apart, from the darkness of its ink.
/// Absent for lines without widths: outlines, pen strokes, imported ones.
std::optional<WidthProfile> strokeWidthsAlong(const PipelineOutput&, const Scan&, const TracedCurve&,
                                              const NurbsCurve& shape);

}  // namespace batten
