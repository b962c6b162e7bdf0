// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/model/line_joining.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "core/curve/curvature.h"
#include "core/curve/knot_operations.h"
#include "core/exchange/model/export_check.h"

namespace batten {
namespace {

constexpr double kEndsMeet = 1e-6;  ///< Of the size of the smaller line.

/// One end of an open line.
struct LineEnd {
  std::size_t line = 0;
  bool isStart = true;
  Vec2 at = Vec2::Zero();
  double near = 0.0;
};

/// For each line the ends that alone meet its start and its end.
struct Neighbours {
  std::optional<LineEnd> atStart, atEnd;
};

bool canJoin(const ExportCurve& line) { return line.isImported && !line.closed && !line.pieces.empty(); }

std::vector<LineEnd> endsOf(const std::vector<ExportCurve>& lines) {
  std::vector<LineEnd> ends;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!canJoin(lines[i])) continue;
    const NurbsCurve &front = lines[i].pieces.front().curve, &back = lines[i].pieces.back().curve;
    double size = 0.0;
    for (const ExportPiece& piece : lines[i].pieces) size = std::max(size, extent(piece.curve));
    ends.push_back({i, true, front.point(front.start()), kEndsMeet * size});
    ends.push_back({i, false, back.point(back.end()), kEndsMeet * size});
  }
  return ends;
}

std::vector<Neighbours> neighboursOf(const std::vector<ExportCurve>& lines) {
  std::vector<LineEnd> ends = endsOf(lines);
  std::sort(ends.begin(), ends.end(), [](const LineEnd& a, const LineEnd& b) { return a.at.x() < b.at.x(); });
  std::vector<int> met(ends.size(), 0);
  std::vector<std::size_t> other(ends.size(), 0);
  for (std::size_t i = 0; i < ends.size(); ++i) {
    for (std::size_t k = i + 1; k < ends.size() && ends[k].at.x() - ends[i].at.x() <= ends[i].near; ++k) {
      const bool meet = (ends[k].at - ends[i].at).norm() <= std::min(ends[i].near, ends[k].near) &&
                        lines[ends[k].line].layer == lines[ends[i].line].layer;
      if (!meet) continue;
      ++met[i];
      ++met[k];
      other[i] = k;
      other[k] = i;
    }
  }
  std::vector<Neighbours> neighbours(lines.size());
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (met[i] != 1 || met[other[i]] != 1 || ends[other[i]].line == ends[i].line) continue;
    (ends[i].isStart ? neighbours[ends[i].line].atStart : neighbours[ends[i].line].atEnd) = ends[other[i]];
  }
  return neighbours;
}

void reverseWhole(ExportCurve& line) {
  std::reverse(line.pieces.begin(), line.pieces.end());
  for (ExportPiece& piece : line.pieces) {
    piece.curve = reversed(piece.curve);
    if (piece.width) piece.width = reversed(*piece.width);
  }
}

/// A line of a chain, and whether it is run through from its end to its start.
struct Link {
  std::size_t line = 0;
  bool isReversed = false;
};

/// The lines from one on, in the direction in which it is left, up to the end of the chain or back to the first.
std::vector<Link> walk(const std::vector<Neighbours>& neighbours, Link from) {
  std::vector<Link> chain{from};
  while (true) {
    const Neighbours& here = neighbours[chain.back().line];
    const auto& next = chain.back().isReversed ? here.atStart : here.atEnd;
    if (!next || next->line == from.line) return chain;
    chain.push_back({next->line, !next->isStart});
  }
}

bool isChosen(const ExportCurve& line) {
  return std::any_of(line.pieces.begin(), line.pieces.end(), [](const ExportPiece& p) { return p.keepsDirection; });
}

/// The chain that a line belongs to, from its begin, the way its first line runs, or one whose direction was chosen.
std::vector<Link> chainOf(const std::vector<ExportCurve>& lines, const std::vector<Neighbours>& neighbours,
                          std::size_t line) {
  std::vector<Link> chain = walk(neighbours, {line, false});
  const auto last = chain.back();
  const bool isLoop =
      chain.size() > 1 && (last.isReversed ? neighbours[last.line].atStart : neighbours[last.line].atEnd).has_value();
  if (!isLoop) {
    // What lies before the line: walked from it backwards, and reversed.
    std::vector<Link> before = walk(neighbours, {line, true});
    before.erase(before.begin());
    std::reverse(before.begin(), before.end());
    for (Link& link : before) link.isReversed = !link.isReversed;
    chain.insert(chain.begin(), before.begin(), before.end());
  }
  const auto chosen =
      std::find_if(chain.begin(), chain.end(), [&](const Link& link) { return isChosen(lines[link.line]); });
  if (chosen != chain.end() && chosen->isReversed) {
    std::reverse(chain.begin(), chain.end());
    for (Link& link : chain) link.isReversed = !link.isReversed;
  }
  return chain;
}

}  // namespace

std::vector<ExportCurve> joinedLines(std::vector<ExportCurve> lines) {
  const std::vector<Neighbours> neighbours = neighboursOf(lines);
  std::vector<ExportCurve> result;
  std::vector<bool> isTaken(lines.size(), false);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (isTaken[i]) continue;
    if (!neighbours[i].atStart && !neighbours[i].atEnd) {
      result.push_back(std::move(lines[i]));
      continue;
    }
    const std::vector<Link> chain = chainOf(lines, neighbours, i);
    ExportCurve whole = lines[i];
    whole.pieces.clear();
    for (const Link& link : chain) {
      ExportCurve& line = lines[link.line];
      isTaken[link.line] = true;
      if (link.isReversed) reverseWhole(line);
      for (ExportPiece& piece : line.pieces) {
        if (piece.name.empty()) piece.name = line.name.empty() ? line.id : line.name;
        whole.pieces.push_back(std::move(piece));
      }
    }
    whole.closed = isLoop(whole.pieces);
    result.push_back(std::move(whole));
  }
  return result;
}

}  // namespace batten
