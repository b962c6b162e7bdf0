// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/label/ink_graph.h"

#include <algorithm>
#include <cmath>

#include "core/base/angle.h"
#include "core/base/statistics.h"
#include "core/contour/centreline/skeleton/skeleton_nodes.h"

namespace batten {
namespace {

// A square end of a stroke makes a spur that sticks out .41 radii; nothing that is drawn is dropped.
constexpr double kSpurRadii = 1.6;
constexpr int kInkSpurRounds = 3;       // a spur may show only once another has gone
constexpr double kStraightDeg = 45.0;   // chains that bend more at a junction are no single stroke
constexpr double kWidthRatio = 1.6;     // nor those whose widths differ more, and a pixel
constexpr double kDegPerOctave = 40.0;  // what twice the width costs, as of a bend
constexpr double kLevelPx = 1.0;        // of a width, that the grid of pixels explains
// Beyond the disc of a junction, over which the direction and the width of a chain are taken: [stroke widths], and
// where strokes are thin as many pixels as keep a single step of the skeleton below 15 degrees.
constexpr double kEndReachWidths = 2.0, kLeastEndReachPx = 4.0;
constexpr double kRimReachWidths = 2.0, kRimReachPx = 2.0;  // along a line: within so much it widens into a solid
constexpr double kPathCoreWidths = 2.5;                     // and a pixel: where strokes cross the ink is no wider

InkPixel measured(const SkeletonPixel& p, const BitImage& ink) {
  return {p.x, p.y, static_cast<float>(inkRadius(ink, p.x, p.y))};
}

double stepLength(const InkPixel& a, const InkPixel& b) { return (a.centre() - b.centre()).norm(); }

double lengthOf(const InkChain& chain) {
  double sum = 0.0;
  for (std::size_t i = 1; i < chain.pixels.size(); ++i) sum += stepLength(chain.pixels[i - 1], chain.pixels[i]);
  return sum;
}

// Where lines run into solids along a chain: for each, the first pixel that is too wide for the line. What widens on
// the way there is marked, so that it does not count for the line's width. In order, none at the ends.
std::vector<int> rimsOf(std::vector<InkPixel>& p) {
  std::vector<int> rims;
  const int n = static_cast<int>(p.size());
  for (const int step : {1, -1}) {
    for (int i = step > 0 ? 0 : n - 1; i >= 0 && i < n; i += step) {
      if (p[i].inJunction) continue;
      const double width = std::max(1.0, p[i].widthPx()), reach = kRimReachWidths * width + kRimReachPx;
      double arc = 0.0;
      int k = i + step;
      for (; k >= 0 && k < n && arc <= reach; k += step) {
        arc += stepLength(p[k], p[k - step]);
        if (p[k].widthPx() > coreWidth(width)) break;
      }
      if (k < 0 || k >= n || arc > reach) continue;
      for (int m = k - step; m != i; m -= step) p[m].inJunction = true;
      const int cut = step > 0 ? k : k + 1;
      if (cut > 0 && cut < n) rims.push_back(cut);
      i = k;
    }
  }
  std::sort(rims.begin(), rims.end());
  rims.erase(std::unique(rims.begin(), rims.end()), rims.end());
  return rims;
}

// How a chain leaves a junction.
struct ChainEnd {
  int end = 0;
  Vec2 out = Vec2::Zero();  ///< Unit direction from the junction.
  double widthPx = 1.0;
};

ChainEnd chainEndAt(const InkChain& chain, int end, const InkNode& node) {
  const int n = static_cast<int>(chain.pixels.size());
  const auto at = [&](int k) -> const InkPixel& { return chain.pixels[end % 2 == 0 ? k : n - 1 - k]; };
  int first = 0;
  while (first < n - 1 && (at(first).centre() - node.centre).norm() < node.radius) ++first;
  const double from = (at(first).centre() - node.centre).norm();
  const double reach = std::max(kLeastEndReachPx, kEndReachWidths * at(first).widthPx());
  Vec2 sum = Vec2::Zero();
  std::vector<double> widths;
  for (int k = first; k < n && (at(k).centre() - node.centre).norm() <= from + reach; ++k) {
    sum += at(k).centre() - node.centre;
    widths.push_back(at(k).widthPx());
  }
  ChainEnd found;
  found.end = end;
  if (sum.norm() > 0.0) found.out = sum.normalized();
  if (!widths.empty()) found.widthPx = std::max(1.0, upperMedian(widths));
  return found;
}

// Cost of going on from one chain to another; absent: no pen does.
std::optional<double> costOfPassing(const ChainEnd& a, const ChainEnd& b) {
  const double bend = std::atan2(std::abs(cross(a.out, b.out)), -a.out.dot(b.out)) * kDegPerRad;
  const double octaves = std::abs(std::log2(a.widthPx / b.widthPx));
  if (bend > kStraightDeg || octaves > std::log2(kWidthRatio) + 1.0 / std::min(a.widthPx, b.widthPx)) return {};
  return bend + kDegPerOctave * octaves;
}

}  // namespace

double coreWidth(double strokeWidthPx) { return kPathCoreWidths * strokeWidthPx + 1.0; }

InkGraph::InkGraph(const BitImage& skeleton, const BitImage& ink, const RunContext& context) {
  const std::vector<SkeletonChain> found = skeletonChains(skeleton);
  if (context.isCancelled()) return;
  makeNodes(found, ink);
  makeChains(found, ink, context);
  if (context.isCancelled()) return;
  dropSpurs();
  markJunctions();
  cutAtRims();
  pairChainEnds();
  makePaths();
}

void InkGraph::makeNodes(const std::vector<SkeletonChain>& found, const BitImage& ink) {
  const SkeletonNodes numbers(found);
  nodes_.resize(numbers.count());
  for (const SkeletonPixel& p : numbers.pixels()) {
    InkNode& node = nodes_[numbers.nodeOf(p)];
    node.pixels.push_back(measured(p, ink));
    node.centre += node.pixels.back().centre();
    node.radius = std::max(node.radius, static_cast<double>(node.pixels.back().radius));
  }
  for (InkNode& node : nodes_) node.centre /= static_cast<double>(node.pixels.size());
  for (const SkeletonChain& c : found) {
    if (SkeletonNodes::isLink(c)) continue;
    InkChain chain;
    chain.isRing = c.closed;
    if (!c.closed) chain.node = {numbers.nodeOf(c.pixels.front()), numbers.nodeOf(c.pixels.back())};
    const int number = static_cast<int>(chains_.size());
    for (int side = 0; side < 2 && !c.closed; ++side) {
      // A single pixel has one end only.
      if (side == 1 && c.pixels.size() < 2) continue;
      nodes_[*chain.node[side]].ends.push_back(2 * number + side);
    }
    chains_.push_back(std::move(chain));
  }
}

void InkGraph::makeChains(const std::vector<SkeletonChain>& found, const BitImage& ink, const RunContext& context) {
  std::size_t number = 0;
  for (const SkeletonChain& c : found) {
    if (SkeletonNodes::isLink(c)) continue;
    if (context.isCancelled()) return;
    InkChain& chain = chains_[number++];
    for (const SkeletonPixel& p : c.pixels) chain.pixels.push_back(measured(p, ink));
  }
  for (int i = 0; i < static_cast<int>(nodes_.size()); ++i) splice(i);
}

bool InkGraph::isFreeEnd(int end) const {
  const std::optional<int> node = chains_[end / 2].node[end % 2];
  return node && !nodes_[*node].isJunction() && !nodes_[*node].isRim;
}

void InkGraph::removeChain(int chain) {
  for (int side = 0; side < 2; ++side) {
    const std::optional<int> node = chains_[chain].node[side];
    if (node) std::erase(nodes_[*node].ends, 2 * chain + side);
  }
  chains_[chain] = InkChain{};
  chains_[chain].isAlive = false;
}

void InkGraph::reverse(int chain) {
  InkChain& c = chains_[chain];
  std::reverse(c.pixels.begin(), c.pixels.end());
  std::swap(c.node[0], c.node[1]);
  // Both ends may lie at one node: all are renamed at once.
  std::vector<int> touched = {*c.node[0]};
  if (c.node[1] != c.node[0]) touched.push_back(*c.node[1]);
  for (const int node : touched) {
    for (int& end : nodes_[node].ends) {
      if (end / 2 == chain) end ^= 1;
    }
  }
}

// A node with two chains is none: they are one.
void InkGraph::splice(int node) {
  InkNode& n = nodes_[node];
  if (n.ends.size() != 2) return;
  const int a = n.ends[0] / 2, b = n.ends[1] / 2;
  if (a == b) {
    chains_[a].isRing = true;
    chains_[a].node = {};
    n.ends.clear();
    return;
  }
  if (n.ends[0] % 2 == 0) reverse(a);
  if (n.ends[1] % 2 == 1) reverse(b);
  InkChain& from = chains_[b];
  chains_[a].pixels.insert(chains_[a].pixels.end(), from.pixels.begin(), from.pixels.end());
  chains_[a].node[1] = from.node[1];
  n.ends.clear();
  for (int& end : nodes_[*from.node[1]].ends) {
    if (end == 2 * b + 1) end = 2 * a + 1;
  }
  from = InkChain{};
  from.isAlive = false;
}

void InkGraph::dropSpurs() {
  for (int round = 0; round < kInkSpurRounds; ++round) {
    std::vector<int> spurs;
    for (int i = 0; i < static_cast<int>(chains_.size()); ++i) {
      const InkChain& c = chains_[i];
      if (!c.isAlive || c.isRing) continue;
      const bool free[2] = {isFreeEnd(2 * i), isFreeEnd(2 * i + 1)};
      if (free[0] == free[1]) continue;
      const double junction = nodes_[*c.node[free[0] ? 1 : 0]].radius;
      const double tip = static_cast<double>((free[0] ? c.pixels.front() : c.pixels.back()).radius);
      if (lengthOf(c) + tip <= kSpurRadii * junction + 1.0) spurs.push_back(i);
    }
    for (const int spur : spurs) removeChain(spur);
    for (int i = 0; i < static_cast<int>(nodes_.size()); ++i) splice(i);
    if (spurs.empty()) break;
  }
}

void InkGraph::markJunctions() {
  for (InkChain& chain : chains_) {
    for (const std::optional<int> number : chain.node) {
      if (!chain.isAlive || !number || !nodes_[*number].isJunction()) continue;
      const InkNode& node = nodes_[*number];
      for (InkPixel& p : chain.pixels) {
        p.inJunction = p.inJunction || (p.centre() - node.centre).norm() < node.radius;
      }
    }
  }
}

// The width of a line that runs into a solid grows to that of the solid within two of its own; a limb swells slowly.
// The chain is cut where it has grown.
void InkGraph::cutAtRims() {
  const int count = static_cast<int>(chains_.size());
  for (int number = 0; number < count; ++number) {
    if (!chains_[number].isAlive || chains_[number].isRing) continue;
    const std::vector<int> cuts = rimsOf(chains_[number].pixels);
    int at = number;
    for (std::size_t k = 0; k < cuts.size(); ++k) {
      const int offset = k == 0 ? 0 : cuts[k - 1];
      at = cutChain(at, cuts[k] - offset);
    }
  }
}

// The pixels from `index` on become a chain of their own, which is returned.
int InkGraph::cutChain(int chain, int index) {
  const int number = static_cast<int>(chains_.size());
  InkChain rest;
  InkChain& first = chains_[chain];
  rest.pixels.assign(first.pixels.begin() + index, first.pixels.end());
  first.pixels.erase(first.pixels.begin() + index, first.pixels.end());
  rest.node[1] = first.node[1];
  for (int& end : nodes_[*rest.node[1]].ends) {
    if (end == 2 * chain + 1) end = 2 * number + 1;
  }
  const auto addRim = [&](const InkPixel& p, int end) {
    InkNode rim;
    rim.pixels = {p};
    rim.centre = p.centre();
    rim.radius = static_cast<double>(p.radius);
    rim.isRim = true;
    rim.ends = {end};
    nodes_.push_back(std::move(rim));
    return static_cast<int>(nodes_.size()) - 1;
  };
  first.node[1] = addRim(first.pixels.back(), 2 * chain + 1);
  rest.node[0] = addRim(rest.pixels.front(), 2 * number);
  chains_.push_back(std::move(rest));
  return number;
}

void InkGraph::pairChainEnds() {
  struct Option {
    double cost;
    int a, b;
  };
  partner_.assign(2 * chains_.size(), std::nullopt);
  for (const InkNode& node : nodes_) {
    if (!node.isJunction()) continue;
    std::vector<ChainEnd> ends;
    for (const int end : node.ends) ends.push_back(chainEndAt(chains_[end / 2], end, node));
    std::vector<Option> options;
    for (std::size_t i = 0; i < ends.size(); ++i) {
      for (std::size_t j = i + 1; j < ends.size(); ++j) {
        if (const auto cost = costOfPassing(ends[i], ends[j])) options.push_back({*cost, ends[i].end, ends[j].end});
      }
    }
    std::stable_sort(options.begin(), options.end(), [](const Option& a, const Option& b) { return a.cost < b.cost; });
    for (const Option& o : options) {
      if (partner_[o.a] || partner_[o.b]) continue;
      partner_[o.a] = o.b;
      partner_[o.b] = o.a;
    }
  }
}

void InkGraph::makePaths() {
  for (int first = 0; first < static_cast<int>(chains_.size()); ++first) {
    if (!chains_[first].isAlive || chains_[first].path) continue;
    InkPath path;
    std::vector<int> open = {first};
    chains_[first].path = static_cast<int>(paths_.size());
    while (!open.empty()) {
      const int chain = open.back();
      open.pop_back();
      path.chains.push_back(chain);
      for (int side = 0; side < 2; ++side) {
        const std::optional<int> partner = partner_[2 * chain + side];
        if (!partner || chains_[*partner / 2].path) continue;
        chains_[*partner / 2].path = chains_[first].path;
        open.push_back(*partner / 2);
      }
    }
    measurePath(path);
    paths_.push_back(std::move(path));
  }
}

void InkGraph::measurePath(InkPath& path) const {
  std::vector<double> widths;
  double ends = 0.0;
  std::vector<double> passages;  // radii of the junctions led through, each from both sides
  for (const int number : path.chains) {
    const InkChain& chain = chains_[number];
    const auto& p = chain.pixels;
    for (std::size_t i = 0; i < p.size(); ++i) {
      if (!p[i].inJunction) widths.push_back(p[i].widthPx());
      if (i > 0 && !p[i].inJunction && !p[i - 1].inJunction) path.lengthPx += stepLength(p[i - 1], p[i]);
    }
    if (chain.isRing) {
      path.lengthPx += stepLength(p.back(), p.front());
      continue;
    }
    for (int side = 0; side < 2; ++side) {
      const int end = 2 * number + side;
      if (isFreeEnd(end)) ends += static_cast<double>((side == 0 ? p.front() : p.back()).radius);
      if (partner_[end]) passages.push_back(nodes_[*chain.node[side]].radius);
    }
  }
  if (widths.empty()) return;
  double off = 0.0, all = 0.0;
  const double width = std::max(1.0, upperMedian(widths));
  for (const double w : widths) {
    off += std::max(0.0, std::abs(w - width) - kLevelPx);
    all += std::max(w, width);
  }
  path.widthPx = width;
  path.unevenness = off / all;
  path.lengthPx += ends;
  // Way through a blob is no length. Each passage was met twice.
  for (const double radius : passages) path.lengthPx += std::min(radius, width);
}

}  // namespace batten
