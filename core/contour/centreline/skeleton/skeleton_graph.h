// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/contour/centreline/skeleton/skeleton.h"
#include "core/contour/centreline/stroke_path.h"
#include "core/image/bits/bit_image.h"

namespace batten {

/// A stretch of skeleton between two nodes; its ends are numbered 2 * edge + side.
struct SkeletonEdge {
  std::vector<StrokePathPoint> points;
  std::array<std::optional<int>, 2> node;  ///< At the start and the end; none on rings.
  double length = 0.0;                     ///< [px]
  bool alive = true;
  bool ring = false;  ///< A closed loop without a node.
};

/// The points of an edge from one of its ends on.
class EdgeFromEnd {
 public:
  EdgeFromEnd(const std::vector<StrokePathPoint>& points, int side) : points_(points), isReversed_(side == 1) {}
  int size() const { return static_cast<int>(points_.size()); }
  const StrokePathPoint& operator[](int k) const { return points_[isReversed_ ? size() - 1 - k : k]; }

 private:
  std::span<const StrokePathPoint> points_;
  bool isReversed_;
};

/// [radii of a junction's disc] Beyond it a stroke has its own middle.
inline constexpr double kTrimRadii = 1.1;

struct JunctionDisc {
  Vec2 centre = Vec2::Zero();  ///< [px]
  double radius = 0.0;         ///< [px]
};

/// The ends of a junction as the ink that strokes share there has told them: four of two strokes (shared_ink.h), more
/// of a tangle (tangles.h).
struct LedThrough {
  std::vector<std::pair<int, int>> pairs;  ///< Which ends are one stroke, as indices into the ends of the node.
  std::vector<JunctionDisc> discs;         ///< Of each end: where the strokes part.
  bool isDoubtful = false;
};

struct SkeletonNode {
  Vec2 centre = Vec2::Zero();  ///< [px]
  double radius = 0.0;         ///< [px] of the largest disc of ink there; of all discs, where junctions were merged.
  std::vector<int> ends;       ///< Of edges, 2 * edge + side.
  /// [px] Least half-width of the ink between the junctions of which it was made; absent where it was one from the
  /// start.
  std::optional<double> narrowestPx = {};
  std::optional<LedThrough> led = {};  ///< Not valid any more where other ends have come.

  const LedThrough* leading() const { return led && ends.size() == led->discs.size() ? &*led : nullptr; }
  /// The disc in which the i-th end has no middle of its own.
  JunctionDisc discOf(int i) const { return leading() ? led->discs[i] : JunctionDisc{centre, radius}; }
};

/// Unit direction in which an edge leaves `from`, where its end `side` is: of the chord of about `reach` px from there.
Vec2 leavingDirection(const SkeletonEdge& edge, int side, const Vec2& from, double reach);

/// The skeleton as a graph: junctions of several pixels are one node. It gets simpler by pruneSpurs() and
/// mergeJunctions().
class SkeletonGraph {
 public:
  SkeletonGraph(const std::vector<SkeletonChain>& chains, const BitImage& ink);

  const std::vector<SkeletonEdge>& edges() const { return edges_; }
  const std::vector<SkeletonNode>& nodes() const { return nodes_; }
  int edgeCount() const { return static_cast<int>(edges_.size()); }
  int nodeCount() const { return static_cast<int>(nodes_.size()); }
  const SkeletonEdge& edge(int i) const { return edges_[i]; }
  const SkeletonNode& node(int i) const { return nodes_[i]; }
  /// [px] median radius of the ink along the skeleton.
  double medianRadius() const { return medianRadius_; }
  /// [px] of the ink along one edge.
  double meanRadius(int edge) const;
  /// [px] of the ink where an edge is narrow: a quarter of it is narrower. Strokes that cross lie on one another there.
  double narrowRadius(int edge) const;

  SkeletonEdge& edge(int i) { return edges_[i]; }
  SkeletonNode& node(int i) { return nodes_[i]; }
  void removeEdge(int edge);
  /// Makes one edge of two, if these are all that meet at the node.
  void splice(int node);

 private:
  void appendEdge(int into, int from);
  void reverse(int edge);

  std::vector<SkeletonEdge> edges_;
  std::vector<SkeletonNode> nodes_;
  double medianRadius_ = 0.5;  ///< [px]
};

}  // namespace batten
