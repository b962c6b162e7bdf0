// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/ink/row_vote.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "core/base/disjoint_sets.h"
#include "core/contour/label/ink_graph.h"
#include "core/contour/label/label_rules.h"

namespace batten {
namespace {

constexpr double kLargestOfPage = 0.25;  // [page diagonals] larger pieces are no letters
constexpr double kSameWidth = 1.5;       // ratio of strokes of one pen
constexpr double kSameSize = 2.0;        // ratio, of a letter with an ascender and one without
constexpr double kFarthest = 1.0;        // [heights of the lower one] between two of a row
constexpr double kLeastBeside = 0.5;     // of the height of the lower one, that the other stands beside
constexpr int kLeastInRow = 3;           // pieces: two are no row

// A piece of ink.
struct PieceInRow {
  int firstRun = 0;
  PieceBox box = {};
  double lengthPx = 0.0, widthPx = 1.0, widestPx = 0.0;  // of its strokes
  std::int64_t areaPx = 0, shapePx = 0, labelledPx = 0;
  bool isPencil = false;
  double sizePx() const { return std::max(box.width(), box.height()); }
  bool isShape() const { return 2 * shapePx > areaPx; }
  bool isLabelledShape() const { return 2 * labelledPx > areaPx; }
  bool isMixed() const { return shapePx > 0 && shapePx < areaPx; }
};

// What is known of the pieces, by the number of each.
struct Measured {
  std::vector<PieceInRow> pieces;
  std::vector<int> numberOfRun;  // of the piece that a run is part of
};

Measured measure(const InkPieces& ink, const BitImage& shapes) {
  const RunPieces& runs = ink.pieces;
  Measured measured;
  measured.numberOfRun.resize(runs.runs.size());
  const std::vector<PieceBox> boxes = boxesOfPieces(runs);
  for (int i = 0; i < std::ssize(runs.runs); ++i) {
    const InkRun& run = runs.runs[i];
    if (runs.piece[i] == i) {
      measured.numberOfRun[i] = static_cast<int>(measured.pieces.size());
      measured.pieces.push_back({.firstRun = i, .box = boxes[i]});
      measured.pieces.back().isPencil = ink.pencil != nullptr && ink.pencil->at(run.x0, run.y);
    }
    const int number = measured.numberOfRun[i] = measured.numberOfRun[runs.piece[i]];
    PieceInRow& piece = measured.pieces[number];
    piece.areaPx += run.x1 - run.x0;
    piece.shapePx += countBits(shapes, run);
    piece.labelledPx += countBits(ink.labelled, run);
  }
  std::vector<std::vector<std::pair<double, double>>> widths(measured.pieces.size());  // and lengths
  for (const StrokePath& path : ink.paths) {
    const std::optional<int> first = pieceOfPath(runs, path);
    if (!first) continue;
    PieceInRow& piece = measured.pieces[measured.numberOfRun[*first]];
    const double lengthPx = path.length();
    piece.lengthPx += lengthPx;
    widths[measured.numberOfRun[*first]].emplace_back(path.widthPx(), lengthPx);
    for (const StrokePathPoint& p : path.points)
      piece.widestPx = std::max(piece.widestPx, 2.0 * static_cast<double>(p.radius));
  }
  for (std::size_t i = 0; i < widths.size(); ++i)
    measured.pieces[i].widthPx = weightedMedian(std::move(widths[i])).value_or(1.0);
  return measured;
}

// Whether a piece may be a letter or a bar.
bool mayBeInRow(const PieceInRow& p, double largestPx) {
  return p.lengthPx >= kStrokeWidths * p.widthPx && p.widestPx <= coreWidth(p.widthPx) && p.sizePx() <= largestPx;
}

bool isAlike(double a, double b, double ratio) { return std::max(a, b) <= ratio * std::min(a, b); }

// Two boxes along one axis.
struct Placed {
  double gapPx;
  double beside;  // of the smaller one
};
Placed placed(int a0, int a1, int b0, int b1) {
  const double shared = std::min(a1, b1) - std::max(a0, b0);
  return {std::max(0.0, -shared), shared / std::min(a1 - a0, b1 - b0)};
}

bool areNeighbours(const PieceInRow& a, const PieceInRow& b) {
  if (!isAlike(a.widthPx, b.widthPx, kSameWidth)) return false;
  const Placed x = placed(a.box.x0, a.box.x1, b.box.x0, b.box.x1), y = placed(a.box.y0, a.box.y1, b.box.y0, b.box.y1);
  const auto areInRow = [](const Placed& along, const Placed& across, double sizeA, double sizeB) {
    return isAlike(sizeA, sizeB, kSameSize) && across.beside >= kLeastBeside &&
           along.gapPx <= kFarthest * std::min(sizeA, sizeB);
  };
  const auto isLying = [](const PieceBox& box) { return box.width() >= box.height(); };
  return areInRow(x, y, a.box.height(), b.box.height()) ||
         (isLying(a.box) && isLying(b.box) && areInRow(y, x, a.box.width(), b.box.width()));
}

// Joins neighbours. @param pieces in the order of their left sides.
DisjointSets rowsOf(const std::vector<PieceInRow>& pieces, const RunContext& context) {
  DisjointSets rows(static_cast<int>(pieces.size()));
  for (int i = 0; i < std::ssize(pieces) && !context.isCancelled(); ++i) {
    const double farthest = pieces[i].box.x1 + kFarthest * pieces[i].sizePx();
    for (int k = i + 1; k < std::ssize(pieces) && pieces[k].box.x0 <= farthest; ++k)
      if (areNeighbours(pieces[i], pieces[k])) rows.join(i, k);
  }
  return rows;
}

// How much of a row is shapes.
struct Share {
  double lengthPx = 0.0;
  int count = 0;
};

struct Row {
  Share all, pencil, shapes, labelledShapes;
  void add(const PieceInRow& p) {
    const auto addTo = [&](Share& share) {
      share.lengthPx += p.lengthPx;
      ++share.count;
    };
    addTo(all);
    if (p.isPencil) addTo(pencil);
    if (p.isShape()) addTo(shapes);
    if (p.isLabelledShape()) addTo(labelledShapes);
  }
  // Whether it is shapes; absent: it is no row, or length and number disagree, as where one long piece overrules many.
  std::optional<bool> isShape() const {
    const Share& share = 2.0 * pencil.lengthPx < all.lengthPx ? labelledShapes : shapes;
    const bool byLength = 2.0 * share.lengthPx > all.lengthPx;
    const bool agrees = byLength ? 2 * share.count >= all.count : 2 * share.count <= all.count;
    return all.count >= kLeastInRow && agrees ? std::optional(byLength) : std::nullopt;
  }
};

}  // namespace

std::optional<int> pieceOfPath(const RunPieces& pieces, const StrokePath& path) {
  if (path.points.empty()) return std::nullopt;
  const Vec2& middle = path.points[path.points.size() / 2].at;
  return pieceAt(pieces, static_cast<int>(middle.x()), static_cast<int>(middle.y()));
}

void voteInRows(const InkPieces& ink, BitImage& strokes, BitImage& shapes, const RunContext& context) {
  if (shapes.count() == 0) return;
  const Measured measured = measure(ink, shapes);
  const double largestPx = kLargestOfPage * std::hypot(strokes.width, strokes.height);
  std::vector<PieceInRow> pieces;
  for (const PieceInRow& p : measured.pieces)
    if (mayBeInRow(p, largestPx)) pieces.push_back(p);
  const auto isAnyShape = [](const PieceInRow& p) { return p.shapePx > 0; };
  if (std::none_of(pieces.begin(), pieces.end(), isAnyShape)) return;
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const PieceInRow& a, const PieceInRow& b) { return a.box.x0 < b.box.x0; });
  DisjointSets sets = rowsOf(pieces, context);
  if (context.isCancelled()) return;
  std::map<int, Row> rows;
  for (int i = 0; i < std::ssize(pieces); ++i) rows[sets.root(i)].add(pieces[i]);
  std::vector<std::optional<bool>> becomesShape(measured.pieces.size());
  for (int i = 0; i < std::ssize(pieces); ++i) {
    const std::optional<bool> isShape = rows.at(sets.root(i)).isShape();
    if (isShape && (pieces[i].isMixed() || pieces[i].isShape() != *isShape))
      becomesShape[measured.numberOfRun[pieces[i].firstRun]] = isShape;
  }
  for (std::size_t i = 0; i < measured.numberOfRun.size(); ++i) {
    const std::optional<bool>& isShape = becomesShape[measured.numberOfRun[i]];
    if (!isShape) continue;
    clearBits(*isShape ? strokes : shapes, ink.pieces.runs[i]);
    setBits(*isShape ? shapes : strokes, ink.pieces.runs[i]);
  }
}

}  // namespace batten
