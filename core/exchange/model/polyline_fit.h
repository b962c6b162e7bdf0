// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "core/exchange/model/cad_shape.h"

namespace batten {

struct PolylineFit {
  CadPolyline line;
  double largestError = 0.0;  ///< Measured distance of the polyline from the curves, in their unit.
};
/// A polyline through curves that follow each other, within `tolerance` of them: chords, or with `arcs` pairs of arcs
/// that keep the direction at their ends (biarcs), halved until they are near enough. Ends of curves are vertices.
/// `closed`: the last curve ends where the first starts. @pre curves not empty, tolerance > 0.
PolylineFit polylineWithin(std::span<const NurbsCurve> curves, bool closed, double tolerance, bool arcs);

}  // namespace batten
