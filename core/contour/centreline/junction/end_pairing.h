// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/base/vec2.h"
#include "core/contour/centreline/skeleton/skeleton_graph.h"

namespace batten {

/// How one end of an edge meets its junction.
struct MeetingEnd {
  int first = 0;            ///< Index, counted from the junction, of the first point with a middle of its own.
  Vec2 at = Vec2::Zero();   ///< [px] the course there.
  Vec2 out = Vec2::Zero();  ///< Unit direction away from the junction there.
  double radius = 0.5;      ///< [px] usual half-width beyond it.
};

/// The ends of a junction, by the points of their edges from it on, and of ink that two strokes share from where they
/// part and it is as wide as usual. Where two of three ends leave it side by side, the
/// third begins beyond the ink that is wider than usual: two strokes share it, and its middle is that of neither.
/// @param usualRadius [px] of the strokes of the page.
std::vector<MeetingEnd> measureEnds(std::span<const EdgeFromEnd> edges, const SkeletonNode& node, double usualRadius);

/// By what the ends of a junction are paired.
struct PairingScale {
  double nodeRadius = 0.0;   ///< [px] of the junction's disc.
  double usualRadius = 0.5;  ///< [px] of the strokes of the page.
  double maxBendDeg = 0.0;   ///< An end that bends to every other by more stays alone.
  bool ofBundles = false;    ///< Strokes will be merged: one may go on aside, as another one of its bundle.
  /// The ends lie in two rows (end_rows.h): what is wider holds more strokes, and no bolder one.
  bool areInRows = false;
  std::optional<double> narrowestPx = {};  ///< SkeletonNode::narrowestPx; absent: strokes may cross.
};

/// [deg] What it costs that two ends are one stroke: their bend, and with it how far one lies aside of the other's
/// course and how their widths differ; in rows how a strip would bend from one to the other.
/// @param freePx in rows, how far aside is no matter (EndRows::freePx).
double pairCostDeg(const MeetingEnd& p, const MeetingEnd& q, const PairingScale&, double freePx = 0.0);

/// Which ends of a junction are one stroke: over all of it at once, by their bend, by how far one lies aside of the
/// other's course, and by how alike their widths are. Strokes side by side in ink too wide for a crossing do not cross.
/// @return pairs of indices into `ends`, the lower one first.
std::vector<std::pair<int, int>> pairEnds(std::span<const MeetingEnd> ends, const PairingScale&);

/// Of three ends of which two leave the junction side by side: which of the two the third goes on to, where one arc of
/// a circle runs through it and only one of them, whatever the widths, as a rim that a straight line touches. Nothing
/// where that tells nothing.
std::optional<std::pair<int, int>> pairAlongArc(std::span<const EdgeFromEnd> edges, std::span<const MeetingEnd> ends,
                                                const PairingScale&);

}  // namespace batten
