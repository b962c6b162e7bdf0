// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/base/parallel.h"
#include "core/base/run_context.h"
#include "core/contour/subpixel/edge_profile.h"
#include "core/contour/subpixel/point_noise.h"

namespace batten {

inline constexpr double kEdgeGatePx = 1.5;         ///< [px] Farthest that an edge may lie from its crack.
inline constexpr double kLeastEdgeContrast = 2.0;  ///< [grey]
inline constexpr int kEdgesPerBlock = 512;         ///< Worked on together; the result does not depend on it.

/// An edge that was matched with the model of a blurred border, at one point of a line.
struct MatchedEdge {
  EdgeSpan span;
  double position = 0.0;           ///< [px] along the normal from the base.
  float ink = 0.0f, paper = 0.0f;  ///< [grey] side levels, smoothed along the line.
  /// What the pixels around it tell of its place; absent where they were not read.
  std::optional<PointInformation> information = {};
  double contrast() const { return paper - ink; }
};
/// One edge a point.
struct MatchedEdges {
  std::vector<MatchedEdge> edges;
  double blur = 1.1;   ///< [px] standard deviation of the edge's own blur.
  double noise = 0.0;  ///< [grey] robust standard deviation of the residuals.
  int count() const { return static_cast<int>(edges.size()); }
};

/// Calls body(i) for all points, in parallel; it writes only what belongs to its own point.
template <class Body>
void forEdgePoints(const RunContext& context, int count, const Body& body) {
  parallelFor(context, count, kEdgesPerBlock, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) body(i);
  });
}

/// The position on every profile that the grey values make most likely: blurred-edge model, one blur for the contour.
/// Not complete when cancelled.
MatchedEdges matchEdges(const EdgeProfiles& profiles, bool closed, const RunContext& context);

}  // namespace batten
