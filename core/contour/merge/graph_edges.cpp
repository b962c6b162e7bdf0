// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/merge/graph_edges.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/contour/merge/stroke_lines.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

// Attachments that are one node.
class NodeNumbers {
 public:
  explicit NodeNumbers(std::size_t attachments) : parent_(attachments), number_(attachments, -1) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  void join(int a, int b) { parent_[place(root(a))] = root(b); }
  int of(int attachment, MeanGraph& edges) {
    int& n = number_[place(root(attachment))];
    if (n < 0) {
      n = static_cast<int>(edges.nodes.size());
      edges.nodes.emplace_back();
    }
    return n;
  }

 private:
  static std::size_t place(int i) { return static_cast<std::size_t>(i); }
  int root(int i) {
    while (parent_[place(i)] != i) i = parent_[place(i)] = parent_[place(parent_[place(i)])];
    return i;
  }
  std::vector<int> parent_, number_;
};

// Where something is attached to a piece, or the piece to something.
struct AttachedMark {
  int index = 0, attachment = 0;
  bool end = false;  // of the piece itself
};

struct PieceCut {
  int index = 0, attachment = 0;
};

std::vector<std::vector<AttachedMark>> marksOf(const StrokePieces& pieces) {
  std::vector<std::vector<AttachedMark>> marks(pieces.pieces.size());
  for (int a = 0; a < static_cast<int>(pieces.attachments.size()); ++a) {
    const StrokePieces::Attachment& m = pieces.attachments[a];
    const auto piece = static_cast<std::size_t>(m.piece);
    const int last = static_cast<int>(pieces.pieces[piece].points.size()) - 1;
    marks[piece].push_back({m.side == 0 ? 0 : last, a, true});
    marks[m.onto].push_back({m.index, a, false});
  }
  for (auto& m : marks)
    std::stable_sort(m.begin(), m.end(),
                     [](const AttachedMark& a, const AttachedMark& b) { return a.index < b.index; });
  return marks;
}

std::vector<PieceCut> cutsOf(const MeanLine& line, const std::vector<AttachedMark>& m, double distancePx,
                             NodeNumbers& numbers) {
  const int together = static_cast<int>(distancePx), snap = static_cast<int>(std::max(6.0, 0.5 * distancePx));
  const int last = static_cast<int>(line.points.size()) - 1;
  std::vector<PieceCut> cuts;
  for (std::size_t i = 0; i < m.size();) {
    std::size_t k = i;
    long sum = 0;
    int own = -1;
    for (; k < m.size() && (k == i || m[k].index - m[k - 1].index <= together); ++k) {
      // Both ends of a short piece are two nodes.
      if (own >= 0 && m[k].end && m[k].index != own) break;
      sum += m[k].index;
      if (m[k].end) own = m[k].index;
      numbers.join(m[k].attachment, m[i].attachment);
    }
    int index = own >= 0 ? own : static_cast<int>(sum / static_cast<long>(k - i));
    // The ends of a short piece are near both.
    if (!line.closed && own < 0) {
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

void addPiece(MeanLine line, std::vector<PieceCut> cuts, NodeNumbers& numbers, MeanGraph& edges) {
  if (cuts.empty()) return edges.add(std::move(line), -1, -1);
  if (line.closed) {
    const int first = cuts.front().index;
    turnTo(line, first);
    line.closed = false;
    for (PieceCut& cut : cuts) cut.index -= first;
    cuts.push_back({static_cast<int>(line.points.size()) - 1, cuts.front().attachment});
  }
  int from = 0, node = -1;
  const auto add = [&](int to, int next) {
    if (to - from >= 2) edges.add(partOf(line, from, to), node, next);
  };
  for (const PieceCut& cut : cuts) {
    const int next = numbers.of(cut.attachment, edges);
    add(cut.index, next);
    from = cut.index;
    node = next;
  }
  add(static_cast<int>(line.points.size()) - 1, -1);
}

}  // namespace

void MeanGraph::add(MeanLine line, int from, int to) {
  GraphEdge edge;
  edge.length = polylineLength(line.points, line.closed);
  edge.line = std::move(line);
  edge.node[0] = from;
  edge.node[1] = to;
  const int number = static_cast<int>(edges.size());
  if (from >= 0) nodes[from].push_back(2 * number);
  if (to >= 0) nodes[to].push_back(2 * number + 1);
  edges.push_back(std::move(edge));
}

void MeanGraph::remove(int edge) {
  GraphEdge& gone = edges[edge];
  for (const int side : {0, 1})
    if (gone.node[side] >= 0) std::erase(nodes[gone.node[side]], 2 * edge + side);
  gone = GraphEdge{};
  gone.alive = false;
}

MeanGraph graphOf(StrokePieces pieces, double distancePx) {
  MeanGraph edges;
  NodeNumbers numbers(pieces.attachments.size());
  const std::vector<std::vector<AttachedMark>> marks = marksOf(pieces);
  std::vector<std::vector<PieceCut>> cuts;
  for (std::size_t p = 0; p < pieces.pieces.size(); ++p)
    cuts.push_back(cutsOf(pieces.pieces[p], marks[p], distancePx, numbers));
  for (std::size_t p = 0; p < pieces.pieces.size(); ++p)
    addPiece(std::move(pieces.pieces[p]), std::move(cuts[p]), numbers, edges);
  return edges;
}

}  // namespace batten
