// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/merge/stroke_graph.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "core/base/disjoint_sets.h"
#include "core/contour/merge/stroke_lines.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr double kLeastSnap = 6.0;  // points: an attachment as near to the end of a piece is at its end

// Attachments that are one node.
class NodeNumbers {
 public:
  explicit NodeNumbers(std::ptrdiff_t attachments) : sets_(static_cast<int>(attachments)), number_(attachments) {}
  void join(int a, int b) { sets_.join(a, b); }
  int of(int attachment, StrokeGraph& graph) {
    std::optional<int>& number = number_[sets_.root(attachment)];
    if (!number) {
      number = static_cast<int>(graph.nodes.size());
      graph.nodes.emplace_back();
    }
    return *number;
  }

 private:
  DisjointSets sets_;
  std::vector<std::optional<int>> number_;
};

// Where something is attached to a piece, or the piece to something.
struct AttachedMark {
  int index = 0, attachment = 0;
  bool end = false;  // of the piece itself
};

struct PieceCut {
  int index = 0, attachment = 0;
};

std::vector<std::vector<AttachedMark>> marksOf(const RemainingLines& pieces) {
  std::vector<std::vector<AttachedMark>> marks(pieces.pieces.size());
  for (int a = 0; a < std::ssize(pieces.attachments); ++a) {
    const RemainingLines::Attachment& m = pieces.attachments[a];
    const int last = pieces.pieces[m.piece].count() - 1;
    marks[m.piece].push_back({m.side == 0 ? 0 : last, a, true});
    marks[m.onto].push_back({m.index, a, false});
  }
  for (auto& m : marks)
    std::stable_sort(m.begin(), m.end(),
                     [](const AttachedMark& a, const AttachedMark& b) { return a.index < b.index; });
  return marks;
}

std::vector<PieceCut> cutsOf(const MeanLine& line, const std::vector<AttachedMark>& m, double distancePx,
                             NodeNumbers& numbers) {
  const int together = static_cast<int>(distancePx), snap = static_cast<int>(std::max(kLeastSnap, 0.5 * distancePx));
  const int last = line.count() - 1;
  std::vector<PieceCut> cuts;
  for (int i = 0; i < std::ssize(m);) {
    int k = i;
    long sum = 0;
    std::optional<int> own;
    for (; k < std::ssize(m) && (k == i || m[k].index - m[k - 1].index <= together); ++k) {
      // Both ends of a short piece are two nodes.
      if (own && m[k].end && m[k].index != *own) break;
      sum += m[k].index;
      if (m[k].end) own = m[k].index;
      numbers.join(m[k].attachment, m[i].attachment);
    }
    int index = own.value_or(static_cast<int>(sum / (k - i)));
    // The ends of a short piece are near both.
    if (!line.closed && !own) {
      if (index < snap && index <= last - index) {
        index = 0;
      } else if (index > last - snap) {
        index = last;
      }
    }
    cuts.push_back({index, m[i].attachment});
    i = k;
  }
  return cuts;
}

void addPiece(MeanLine line, std::vector<PieceCut> cuts, NodeNumbers& numbers, StrokeGraph& graph) {
  if (cuts.empty()) return graph.add(std::move(line), std::nullopt, std::nullopt);
  if (line.closed) {
    const int first = cuts.front().index;
    startAt(line, first);
    line.closed = false;
    for (PieceCut& cut : cuts) cut.index -= first;
    cuts.push_back({line.count() - 1, cuts.front().attachment});
  }
  int from = 0;
  std::optional<int> node;
  const auto add = [&](int to, std::optional<int> next) {
    if (to - from >= 2) graph.add(partOf(line, from, to), node, next);
  };
  for (const PieceCut& cut : cuts) {
    const int next = numbers.of(cut.attachment, graph);
    add(cut.index, next);
    from = cut.index;
    node = next;
  }
  add(line.count() - 1, std::nullopt);
}

}  // namespace

void StrokeGraph::add(MeanLine line, std::optional<int> from, std::optional<int> to) {
  GraphEdge edge;
  edge.length = polylineLength(positionsOf(line), line.closed);
  edge.line = std::move(line);
  edge.node = {from, to};
  const int number = static_cast<int>(edges.size());
  if (from) nodes[*from].push_back(2 * number);
  if (to) nodes[*to].push_back(2 * number + 1);
  edges.push_back(std::move(edge));
}

void StrokeGraph::remove(int edge) {
  GraphEdge& gone = edges[edge];
  for (const int side : {0, 1})
    if (gone.node[side]) std::erase(nodes[*gone.node[side]], 2 * edge + side);
  gone = GraphEdge{};
  gone.alive = false;
}

StrokeGraph graphOf(RemainingLines pieces, double distancePx) {
  StrokeGraph graph;
  NodeNumbers numbers(std::ssize(pieces.attachments));
  const std::vector<std::vector<AttachedMark>> marks = marksOf(pieces);
  std::vector<std::vector<PieceCut>> cuts;
  cuts.reserve(pieces.pieces.size());
  for (int p = 0; p < std::ssize(pieces.pieces); ++p)
    cuts.push_back(cutsOf(pieces.pieces[p], marks[p], distancePx, numbers));
  for (int p = 0; p < std::ssize(pieces.pieces); ++p)
    addPiece(std::move(pieces.pieces[p]), std::move(cuts[p]), numbers, graph);
  return graph;
}

}  // namespace batten
