// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/construct/construct_params.h"
#include "core/construct/pieces.h"

namespace batten {

/// What a closed curve of quintics asks for: a periodic one has a control point a station, and needs six.
inline constexpr int kFewestClosedStations = 6;

/// The stations of a piece made fit for a construction: distinct points, unit directions, and for open pieces one at
/// either end of the piece, exactly on corners. A missing end station takes the direction of the circle through the end
/// that touches the first station. Closed pieces with fewer than `fewestClosed` stations are measured anew from their
/// points. With ConstructEnds::Stations open pieces get none at their ends.
std::vector<Station> usableStations(const ConstructPiece&, int fewestClosed, ConstructEnds ends = ConstructEnds::Line);

/// Arc-corrected distances a_i = c_i (alpha_i / 2) / sin(alpha_i / 2) from each station to the next (closed: the last
/// to the first).
std::vector<double> arcCorrectedDistances(std::span<const Station> stations, bool closed);

/// The straight line between the ends of a piece that holds too little shape, as a quintic; Numerical if it has no
/// length.
Result<ConstructedPiece> straightPiece(const ConstructPiece&, const std::string& note);

/// Clamps a curve and puts its ends exactly where given.
Result<NurbsCurve> clampedWithEnds(const NurbsCurve&, const Vec2& start, const Vec2& end);

}  // namespace batten
