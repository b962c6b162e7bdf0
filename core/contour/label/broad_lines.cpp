// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/label/broad_lines.h"

#include <algorithm>
#include <map>
#include <vector>

#include "core/base/disjoint_sets.h"
#include "core/base/statistics.h"

namespace batten {
namespace {

constexpr double kWidthStep = 1.5;  // of widths; more is the edge of a solid

// Pixels [first, last) of a chain, all of them broad.
struct BroadRun {
  int chain, first, last;
};

// What of the ink is broad, as runs along chains and junctions that hang together.
class BroadInk {
 public:
  BroadInk(InkGraph& graph, double leastPx) : graph_(graph), leastPx_(leastPx), sets_(0) {
    for (int i = 0; i < std::ssize(graph.chains()); ++i) {
      if (graph.chains()[i].isAlive) findRuns(i);
    }
    join();
  }

  // Relabels what is a line; see releaseBroadLines.
  bool release(double widestPenPx, const BitImage& shapes) {
    std::map<int, Widths> bySet;
    for (int i = 0; i < std::ssize(runs_); ++i) {
      Widths& widths = bySet[sets_.root(i)];
      const std::vector<InkPixel>& pixels = graph_.chains()[runs_[i].chain].pixels;
      for (int k = runs_[i].first; k < runs_[i].last; ++k)
        (shapes.at(pixels[k].x, pixels[k].y) ? widths.shapes : widths.strokes).push_back(pixels[k].widthPx());
    }
    std::vector<int> lines;
    for (auto& [root, widths] : bySet) {
      if (isLine(widths, widestPenPx)) lines.push_back(root);
    }
    const auto isOfLine = [&](int i) { return std::binary_search(lines.begin(), lines.end(), sets_.root(i)); };
    for (int i = 0; i < std::ssize(runs_); ++i) {
      if (isOfLine(i)) release(runs_[i]);
    }
    for (int i = 0; i < std::ssize(graph_.nodes()); ++i) {
      InkNode& node = graph_.nodes()[i];
      if (!isBroad(node) || !isOfLine(static_cast<int>(runs_.size()) + i)) continue;
      node.label = InkLabel::Stroke;
      for (InkPixel& p : node.pixels) p.label = InkLabel::Stroke;
    }
    return !lines.empty();
  }

 private:
  struct Widths {
    std::vector<double> strokes, shapes;  // [px] at each pixel
  };

  static bool isLine(Widths& widths, double widestPenPx) {
    if (widths.shapes.empty() || widths.shapes.size() >= widths.strokes.size()) return false;
    const double widestPx = *std::max_element(widths.shapes.begin(), widths.shapes.end());
    return widestPx <= std::min(widestPenPx, kWidthStep * upperMedian(widths.strokes));
  }

  void release(const BroadRun& run) {
    std::vector<InkPixel>& pixels = graph_.chains()[run.chain].pixels;
    int first = run.first, last = run.last;
    while (first > 0 && pixels[first - 1].label == InkLabel::Shape) --first;
    while (last < std::ssize(pixels) && pixels[last].label == InkLabel::Shape) ++last;
    for (int k = first; k < last; ++k) pixels[k].label = InkLabel::Stroke;
  }

  bool isBroad(const InkNode& node) const { return node.isJunction() && node.widthPx() > leastPx_; }

  void findRuns(int chain) {
    const std::vector<InkPixel>& pixels = graph_.chains()[chain].pixels;
    int first = 0;
    for (int k = 0; k <= std::ssize(pixels); ++k) {
      if (k < std::ssize(pixels) && pixels[k].widthPx() > leastPx_) continue;
      if (k > first) runs_.push_back({chain, first, k});
      first = k + 1;
    }
  }

  // Runs that reach a broad junction hang together there.
  void join() {
    const int count = static_cast<int>(runs_.size());
    sets_ = DisjointSets(count + static_cast<int>(graph_.nodes().size()));
    for (int i = 0; i < count; ++i) {
      const InkChain& chain = graph_.chains()[runs_[i].chain];
      const bool reaches[2] = {runs_[i].first == 0, runs_[i].last == std::ssize(chain.pixels)};
      for (int side = 0; side < 2; ++side) {
        if (reaches[side] && chain.node[side] && isBroad(graph_.nodes()[*chain.node[side]]))
          sets_.join(i, count + *chain.node[side]);
      }
    }
  }

  InkGraph& graph_;
  double leastPx_;
  std::vector<BroadRun> runs_;
  DisjointSets sets_;
};

}  // namespace

bool releaseBroadLines(InkGraph& graph, double penPx, double widestPenPx, const BitImage& shapes) {
  return BroadInk(graph, coreWidth(penPx)).release(widestPenPx, shapes);
}

}  // namespace batten
