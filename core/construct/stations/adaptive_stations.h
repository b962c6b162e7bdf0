// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/run_context.h"
#include "core/construct/pieces.h"

namespace batten {

/// A station and how much closer to its neighbours than at first it stands.
struct SpacedStation : Station {
  double share = 1.0;  ///< 0..1. Its distance from its neighbours, in distances that there were at first.
  int halvings = 0;    ///< How often the interval after it was halved.
};

/// Stations along a piece.
struct StationSet {
  std::vector<SpacedStation> stations;
  int added = 0;
  /// [px] How far the points lie from the curve, in the mean over 5 px, where that is clearly more than wanted.
  std::optional<double> missedPx = {};

  std::vector<Station> plain() const { return {stations.begin(), stations.end()}; }
};

/// The curve through stations: one polyline per interval from station to station, ends included. Empty where there is
/// none.
using CurveThrough = std::function<std::vector<std::vector<Vec2>>(const StationSet&)>;

/// Stations set closer, by halving their distance, wherever the curve through them leaves the points of the piece: by
/// more than `tolerancePx` in the mean over 5 px, and by more than 1.5 times the noise of the points, so that noise
/// alone adds none. What is added and its neighbours are measured anew, from as many points as their own distance
/// allows: stations far apart take a hairpin for a straight line. Neighbouring distances differ by a factor of 2 at
/// most, but nothing is halved into a gap between the points. Everything else stays as it is, and all of it where the
/// points do not go along with the stations. What comes nearest to the points is returned, at least the start.
StationSet adaptiveStations(const ConstructPiece& piece, StationSet start, double tolerancePx,
                            const CurveThrough& curve, const RunContext& context);

/// Message for the user if the maximum deviation was not reached; else empty.
std::string maxDeviationNote(const StationSet& set);

/// The stations as they are.
StationSet givenStations(std::vector<Station> stations);

}  // namespace batten
