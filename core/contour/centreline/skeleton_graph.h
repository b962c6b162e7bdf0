// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/contour/centreline/stroke_paths.h"

namespace batten {

/// A stretch of skeleton between two nodes; its ends are numbered 2 * edge + side.
struct SkeletonEdge {
  std::vector<StrokePathPoint> points;
  std::array<std::optional<int>, 2> node;  ///< At the start and the end; none on rings.
  double length = 0.0;
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

struct SkeletonNode {
  Vec2 centre = Vec2::Zero();
  double radius = 0.0;  ///< [px] of the largest disc of ink there; of all discs, where junctions were merged.
  std::vector<int> ends;
};

/// The skeleton as a graph that gets simpler: junctions of several pixels are one node, spurs go, short links vanish.
class SkeletonGraph {
 public:
  SkeletonGraph(const std::vector<SkeletonChain>& chains, const BitImage& ink);

  /// Drops side branches that only a bump or a corner of the border caused. `factor` in stroke widths.
  void pruneSpurs(double factor);
  /// Makes one node of junctions that are nearer than their discs allow to tell apart (a crossing at a shallow angle).
  /// `ofBundles`: all the crossings of overdrawn strokes with others too.
  void mergeJunctions(bool ofBundles);

  const std::vector<SkeletonEdge>& edges() const { return edges_; }
  const std::vector<SkeletonNode>& nodes() const { return nodes_; }
  /// [px] median radius of the ink along the skeleton.
  double medianRadius() const { return medianRadius_; }

 private:
  int edgeCount() const { return static_cast<int>(edges_.size()); }
  int nodeCount() const { return static_cast<int>(nodes_.size()); }
  std::optional<int> spurTip(int edge, double factor) const;
  bool closesCorner(int edge, int node) const;
  double sharedLength(int link) const;
  bool isOneCrossing(const std::vector<int>& nodes) const;
  double meanRadius(int edge) const;
  void removeEdge(int edge);
  void splice(int node);
  void appendEdge(int into, int from);
  void reverse(int edge);
  void markCorner(int edge, int side, const Vec2& centre, double reach);
  void leadToTip(int edge, int side, const Vec2& tip, double reach);
  Vec2 turningPoint(int spur, int tipSide) const;

  std::vector<SkeletonEdge> edges_;
  std::vector<SkeletonNode> nodes_;
  double medianRadius_ = 0.5;
};

}  // namespace batten
