// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/base/run_context.h"
#include "core/base/vec2.h"
#include "core/contour/centreline/skeleton/skeleton.h"
#include "core/image/bits/bit_image.h"

namespace batten {

/// How a piece of ink is followed.
enum class InkLabel {
  Stroke,  ///< Along its middle.
  Shape,   ///< Along its border.
};

/// [px] By which two radii (to the nearest centre of a paper pixel) exceed the width of a stroke: that centre lies up
/// to half the diagonal of a pixel outside the edge, on both sides together half a diagonal on an average.
inline constexpr double kRadiiBeyondWidthPx = 0.7;

/// A skeleton pixel with its room in the ink.
struct InkPixel {
  int x = 0, y = 0;
  float radius = 0.0f;      ///< [px] from its centre to the nearest centre of a paper pixel.
  bool inJunction = false;  ///< Within the disc of a junction, where width and length are undefined.
  InkLabel label = InkLabel::Stroke;
  Vec2 centre() const { return {x + 0.5, y + 0.5}; }
  /// [px] stroke width, corrected for the pixel grid.
  double widthPx() const { return 2.0 * static_cast<double>(radius) - kRadiiBeyondWidthPx; }
};

/// A stretch of skeleton between two nodes. Its ends are numbered 2 * chain + side.
struct InkChain {
  std::vector<InkPixel> pixels;
  std::array<std::optional<int>, 2> node = {};  ///< Absent: the chain is a ring.
  bool isAlive = true;                          ///< False: dropped or spliced into another.
  bool isRing = false;
  std::optional<int> path = {};  ///< Index of the ink path that holds it.
};

/// A free end (one chain) or a junction of the skeleton (more); touching junction pixels are one node. The rim, where a
/// line runs into a solid, is a node of each of its two chains.
struct InkNode {
  std::vector<InkPixel> pixels;
  Vec2 centre = Vec2::Zero();  ///< [px]
  double radius = 0.0;         ///< [px] of the largest disc of ink at one of its pixels.
  InkLabel label = InkLabel::Stroke;
  bool isRim = false;  ///< Where a line runs into a solid.
  std::vector<int> ends;
  bool isJunction() const { return ends.size() > 1; }
  /// [px] of the ink at the junction.
  double widthPx() const { return 2.0 * radius - kRadiiBeyondWidthPx; }
};

/// Chains joined straight through junctions: what one movement of a pen may have drawn.
struct InkPath {
  std::vector<int> chains;
  double lengthPx = 0.0;          ///< Of the pen path; a junction counts as one or two widths at most.
  std::optional<double> widthPx;  ///< Median outside junctions; absent: it has no pixel there.
  double unevenness = 0.0;        ///< 1 - (area shared with the same path at one width / area of both); 0..1.
  InkLabel label = InkLabel::Stroke;
  /// Length in widths; 0 where there is no width.
  double elongation() const { return widthPx ? lengthPx / *widthPx : 0.0; }
};

/// [px] Ink wider than this is no stroke of this width, nor a crossing of two: at any angle they hold no larger disc.
double coreWidth(double strokeWidthPx);

/// The skeleton of a page as paths: spurs dropped, junction discs cut out, chains cut where a line runs into a solid,
/// ends of chains at junctions paired by direction and width. Deterministic.
class InkGraph {
 public:
  /// @param skeleton of `ink` (thinToSkeleton). Unfinished when the context is cancelled.
  InkGraph(const BitImage& skeleton, const BitImage& ink, const RunContext&);

  // Labels are set from outside (label_rules.h); nothing else is to be changed.
  std::vector<InkChain>& chains() { return chains_; }
  std::vector<InkNode>& nodes() { return nodes_; }
  std::vector<InkPath>& paths() { return paths_; }
  const std::vector<InkChain>& chains() const { return chains_; }
  const std::vector<InkNode>& nodes() const { return nodes_; }
  const std::vector<InkPath>& paths() const { return paths_; }
  /// The end that a chain's end goes on with through its junction; absent: none.
  std::optional<int> partner(int end) const { return partner_[end]; }

 private:
  void makeNodes(const std::vector<SkeletonChain>& found, const BitImage& ink);
  void makeChains(const std::vector<SkeletonChain>& found, const BitImage& ink, const RunContext&);
  void dropSpurs();
  void removeChain(int chain);
  void reverse(int chain);
  void splice(int node);
  void markJunctions();
  void cutAtRims();
  int cutChain(int chain, int index);
  void pairChainEnds();
  void makePaths();
  void measurePath(InkPath&) const;
  bool isFreeEnd(int end) const;

  std::vector<InkChain> chains_;
  std::vector<InkNode> nodes_;
  std::vector<InkPath> paths_;
  std::vector<std::optional<int>> partner_;
};

}  // namespace batten
