// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/threshold/whole_ink.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/image/bits/bit_steps.h"
#include "core/image/bits/ink_grain.h"
#include "core/image/bits/run_pieces.h"

namespace batten {
namespace {

constexpr int kRing = 3;  // [px] how far the weaker level shows beside the ink
constexpr double kCellWidths = 40.0;  // side of a cell in stroke widths: about a word
constexpr int kLeastCell = 8;         // [px]

/// Sums over cells of the page.
class InkCells {
 public:
  InkCells(int width, int height, double sidePx)
      : side_(std::max(kLeastCell, static_cast<int>(sidePx))),
        columns_((width + side_ - 1) / side_),
        rows_((height + side_ - 1) / side_),
        cells_(std::ptrdiff_t{columns_} * rows_) {}
  InkCounts& at(int x, int y) { return cells_[std::ptrdiff_t{y / side_} * columns_ + x / side_]; }
  /// Of the cell and its neighbours.
  InkCounts near(int x, int y) const {
    const int column = x / side_, row = y / side_;
    InkCounts sum;
    for (int j = std::max(0, row - 1); j <= std::min(rows_ - 1, row + 1); ++j)
      for (int i = std::max(0, column - 1); i <= std::min(columns_ - 1, column + 1); ++i)
        sum.add(cells_[std::ptrdiff_t{j} * columns_ + i]);
    return sum;
  }

 private:
  int side_, columns_, rows_;
  std::vector<InkCounts> cells_;
};

/// Adds the pieces that are smaller than a square of the width of the ink around them to the cells where they begin.
void addSmall(const RunPieces& parts, InkCells& cells) {
  const std::vector<std::int64_t> area = areasOfPieces(parts);
  for (std::size_t i = 0; i < parts.runs.size(); ++i) {
    if (area[i] == 0) continue;
    const InkCounts around = cells.near(parts.runs[i].x0, parts.runs[i].y);
    if (around.border > 0 && static_cast<double>(area[i]) < around.widthPx() * around.widthPx())
      ++cells.at(parts.runs[i].x0, parts.runs[i].y).small;
  }
}

}  // namespace

LevelMasks withWholePieces(LevelMasks smoothed, double smoothingPx, const LevelMasks& fine, const RunContext& context) {
  const RunPieces pieces = findPieces(smoothed.ink, Connectivity::Eight, context);
  const BitImage border = without(fine.ink, shrunken(fine.ink, 1, context));
  const RunPieces specks = findPieces(fine.ink, Connectivity::Eight, context),
                  holes = findPieces(paperOf(fine.ink), Connectivity::Four, context);
  if (context.isCancelled()) return smoothed;
  const InkCounts page{fine.ink.count(), border.count()};
  if (page.border == 0) return smoothed;
  InkCells cells(fine.ink.width, fine.ink.height, kCellWidths * page.widthPx());
  std::vector<InkCounts> found(pieces.runs.size());
  std::vector<InkCounts> ofRun(pieces.runs.size());
  for (std::size_t i = 0; i < pieces.runs.size(); ++i) {
    const InkRun& run = pieces.runs[i];
    ofRun[i] = {countBits(fine.ink, run), countBits(border, run)};
    found[pieces.piece[i]].add(ofRun[i]);
    cells.at(run.x0, run.y).add(ofRun[i]);
  }
  addSmall(specks, cells);
  addSmall(holes, cells);
  std::vector<double> grain(pieces.runs.size(), 0.0);
  for (std::size_t i = 0; i < pieces.runs.size(); ++i)
    grain[pieces.piece[i]] +=
        static_cast<double>(ofRun[i].border) * cells.near(pieces.runs[i].x0, pieces.runs[i].y).grain();
  BitImage whole(smoothed.ink.width, smoothed.ink.height), other = whole;
  for (std::size_t i = 0; i < pieces.runs.size(); ++i) {
    const int piece = pieces.piece[i];
    const InkCounts& ink = found[piece];
    const bool isRoundedOff = ink.border > 0 && smoothingPx > kSmoothingPerWidth * ink.widthPx();
    const bool isTorn = grain[piece] > kWholeInk * static_cast<double>(ink.border);
    setBits(isRoundedOff && !isTorn ? whole : other, pieces.runs[i]);
  }
  whole = without(grown(whole, kRing, context), other);
  const auto choose = [&](BitImage of, const BitImage& finer) {
    return either(without(std::move(of), whole), both(finer, whole));
  };
  smoothed.ink = choose(std::move(smoothed.ink), fine.ink);
  if (smoothed.certain) smoothed.certain = choose(std::move(*smoothed.certain), *fine.certain);
  if (smoothed.faint) smoothed.faint = choose(std::move(*smoothed.faint), *fine.faint);
  return smoothed;
}

}  // namespace batten
