// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/construct/construct_params.h"
#include "core/construct/pieces.h"

namespace batten {

/// The construction of 002 for one piece: wherever the line bends one way, typical curves with common tangents and
/// curvatures, every one with monotone curvature; at inflections and straight parts, which typical curves cannot draw,
/// quintic Hermite pieces. Chain: fitted to the points as a whole, as few segments as they ask for. Growing: one after
/// the other. Where `breakpoints` are given the segments meet there. G2 everywhere; degree 5, knots of multiplicity 4.
Result<ConstructedPiece> constructTypical(const ConstructPiece&, const ConstructParams&, const RunContext&);

/// Why a chain has transitions, with the part of its length for each reason: "40 % nearly straight, 7 % at
/// inflections".
std::string transitionCauses(std::span<const SegmentNote> segments);

}  // namespace batten
