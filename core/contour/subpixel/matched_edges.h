// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "core/base/parallel.h"
#include "core/base/run_context.h"
#include "core/contour/subpixel/edge_profile.h"
#include "core/contour/subpixel/point_noise.h"

namespace batten {

inline constexpr double kEdgeGatePx = 1.5;         ///< [px] Farthest that an edge may lie from its crack.
inline constexpr double kLeastEdgeContrast = 2.0;  ///< [grey]
inline constexpr int kEdgesPerBlock = 512;         ///< Worked on together; the result does not depend on it.

/// Edges that were matched with the model of a blurred border, one entry per point.
struct MatchedEdges {
  std::vector<EdgeSpan> span;
  std::vector<double> position;   ///< [px] along the normal from the base
  std::vector<float> ink, paper;  ///< [grey] side levels, smoothed along the line
  double blur = 1.1;              ///< [px] standard deviation of the edge's own blur
  double noise = 0.0;             ///< [grey] robust standard deviation of the residuals
  std::vector<PointInformation> information;
};

/// Calls body(i) for all points, in parallel; it writes only what belongs to its own point.
template <class Body>
void forEdgePoints(const RunContext& context, std::size_t count, const Body& body) {
  parallelFor(context, static_cast<int>(count), kEdgesPerBlock, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) body(static_cast<std::size_t>(i));
  });
}

/// The position on every profile that the grey values make most likely: blurred-edge model, one blur for the contour.
/// Not complete when cancelled.
MatchedEdges matchEdges(const ProfileBand& band, bool closed, const RunContext& context);

}  // namespace batten
