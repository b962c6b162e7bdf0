// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// The conventions of the whole program, stated once.
///
/// Image frame: pixels, x right, y down. The first pixel covers [0,1] x [0,1], so its centre is (0.5, 0.5). Scans,
///   masks, contours, corner marks and regression segments live here. Grey is 0 = black to 255 = white as a real
///   number, whatever the bit depth of the file.
/// Model frame: millimetres, x right, y up, origin at the lower left corner of the page. Curves, curvature, plots,
///   targets and CAD exports live here. PageFrame (page_frame.h) is the only place that converts.
/// Curvature kappa [1/mm] is signed: positive where the curve turns left (counter-clockwise) in the model frame.
/// Radius rho = 1/kappa carries the sign; where |kappa| < kStraightCurvature / (extent of the curve) it has no value.
/// Arc length s [mm] runs from the start of a piece; "perimeter" is s divided by the length, 0..1.
/// Normal: the left normal of the direction of travel.
/// Knot vectors are full: number of control points + degree + 1 entries; degree = order - 1.

namespace batten {

/// |kappa| * extent below which a curve counts as straight and its radius has no value.
inline constexpr double kStraightCurvature = 1e-4;

/// Used when the file states no resolution and the user has not calibrated: one CSS pixel.
inline constexpr double kAssumedDpi = 96.0;

inline constexpr double kMillimetresPerInch = 25.4;  // by definition

/// The papers' 64 regions: 8 x 8.
inline constexpr int kRegionsPerSide = 8;
inline constexpr int kRegions = kRegionsPerSide * kRegionsPerSide;  // of a page

}  // namespace batten
