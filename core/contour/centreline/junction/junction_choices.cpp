// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/junction/junction_choices.h"

#include <algorithm>

#include "core/polyline/point_grid.h"

namespace batten {
namespace {

constexpr int kFewestBranches = 3;  // of a junction: where two meet there is nothing to choose

// The end whose edge comes nearest to the place; of two ends of one edge, the one that is nearer along it.
std::optional<int> endNear(const Vec2& place, double reachPx, std::span<const EdgeFromEnd> ends) {
  double least = reachPx * reachPx;
  int steps = 0;
  std::optional<int> nearest;
  for (int i = 0; i < std::ssize(ends); ++i) {
    for (int k = 0; k < ends[i].size(); ++k) {
      const double distance = (ends[i][k].at - place).squaredNorm();
      if (distance > least || (nearest && distance == least && k >= steps)) continue;
      least = distance;
      steps = k;
      nearest = i;
    }
  }
  return nearest;
}

// [px^2] To the middle of the junction, or to a fork of the ink that two strokes share there.
double squaredDistance(const SkeletonNode& node, const Vec2& place) {
  double least = (node.centre - place).squaredNorm();
  if (const LedThrough* led = node.leading(); led != nullptr) {
    for (const JunctionDisc& disc : led->discs) least = std::min(least, (disc.centre - place).squaredNorm());
  }
  return least;
}

}  // namespace

std::vector<std::optional<int>> choicesOfNodes(const SkeletonGraph& graph, std::span<const JunctionChoice> choices) {
  const std::vector<SkeletonNode>& nodes = graph.nodes();
  std::vector<std::optional<int>> choiceOf(nodes.size());
  for (int c = 0; c < std::ssize(choices); ++c) {
    double least = choices[c].reachPx * choices[c].reachPx;
    std::optional<int> nearest;
    for (int i = 0; i < std::ssize(nodes); ++i) {
      const double distance = squaredDistance(nodes[i], choices[c].positionPx);
      if (std::ssize(nodes[i].ends) < kFewestBranches || distance > least || (nearest && distance == least)) continue;
      least = distance;
      nearest = i;
    }
    if (nearest) choiceOf[*nearest] = c;
  }
  return choiceOf;
}

EndPairs chosenPairs(const JunctionChoice& choice, std::span<const EdgeFromEnd> ends) {
  EndPairs pairs;
  std::vector<bool> used(ends.size(), false);
  for (const BranchPair& pair : choice.pairs) {
    const auto first = endNear(pair.firstPx, choice.reachPx, ends);
    const auto second = endNear(pair.secondPx, choice.reachPx, ends);
    if (!first || !second || *first == *second || used[*first] || used[*second]) continue;
    used[*first] = used[*second] = true;
    pairs.emplace_back(std::min(*first, *second), std::max(*first, *second));
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::vector<StrokeJunction> junctionsOfLines(std::vector<StrokeJunction> junctions, std::span<const Contour> lines) {
  constexpr double kNearPx = 3.0;  // a point of a line is refined by less, and stands for those beside it
  constexpr int kStep = 2;         // points of a line
  if (junctions.empty()) return junctions;
  PointGrid<Vec2> grid(kNearPx);
  for (const Contour& line : lines) {
    for (std::size_t i = 0; i < line.points.size(); i += kStep)
      grid.add(line.points[i].unrefined, line.points[i].unrefined);
  }
  std::erase_if(junctions, [&](const StrokeJunction& junction) {
    if (junction.choice) return false;
    const auto isOfLine = [&](const Vec2& place) {
      bool isNear = false;
      grid.around(place, [&](const Vec2& at) { isNear = isNear || (at - place).norm() <= kNearPx; });
      return isNear;
    };
    return std::ranges::count_if(junction.branchesPx, isOfLine) < kFewestBranches;
  });
  return junctions;
}

}  // namespace batten
