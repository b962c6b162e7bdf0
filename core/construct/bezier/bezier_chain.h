// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_context.h"
#include "core/construct/construct_params.h"
#include "core/construct/pieces.h"
#include "core/construct/stations/adaptive_stations.h"
#include "core/curve/bezier_quintics.h"

namespace batten {

/// The Bezier path of 001: from station to station a quadratic on the crossing of both regression lines, elevated to
/// degree 5; where the lines do not cross well (inflections) a cubic with handles of a third of the chord. G1.
std::vector<Quintic> bezierPath(std::span<const Station> stations, bool closed);

/// Curvature to aim at: the changes of direction between stations over the distance, low-passed by a local-linear
/// Gaussian of standard deviation `width` [px] (a plain mean would bias the ends), once over the data and once over
/// what that missed, so that bends keep their height. One value per wanted arc length.
std::vector<double> lowPassedCurvature(std::span<const Station> stations, bool closed, double width,
                                       std::span<const double> arcLengths);
/// The same with a width [px] of its own at every station; in between it changes evenly.
std::vector<double> lowPassedCurvature(std::span<const Station> stations, bool closed, std::span<const double> widths,
                                       std::span<const double> arcLengths);

/// Stations as places, directions and curvatures, faired.
struct FairedJoints {
  std::vector<Joint> joints;    ///< One per station; closed: the first once more at the end.
  std::vector<double> lengths;  ///< [px] From joint to joint.
  Termination why = Termination::NotRun;
};
/// Joints of the Bezier path (mean curvature of both sides) moved towards a fair curve. @pre at least 2 stations,
/// closed 3. @param lowPass standard deviation of the low pass in mean distances of stations; where stations were set
/// closer, in their own.
FairedJoints fairedJoints(const StationSet& stations, bool closed, double lowPass, const RunContext& context);

/// The usable stations of a piece, set closer where the path (with a low pass of at most one station) would leave the
/// line by more than params.maxDeviationPx.
StationSet bezierStations(const ConstructPiece&, const ConstructParams&, const RunContext&);

/// The construction of 001 for one piece: the Bezier path; at joints the mean curvature of both sides; then the joints
/// (offset, direction, curvature) are faired towards the low-passed curvature by Levenberg-Marquardt. G2; one B-spline
/// of degree 5 with knots of multiplicity 3. Open ends stay where they are. Without low pass (0) the path stays as it
/// is but for the curvatures at its joints, which become one.
Result<ConstructedPiece> constructBezierChain(const ConstructPiece&, const ConstructParams&, const RunContext&);

}  // namespace batten
