// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/pencil/grain_closing.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/parallel.h"
#include "core/contour/centreline/pencil/lettering.h"
#include "core/image/bits/bit_steps.h"
#include "core/image/bits/ink_grain.h"
#include "core/image/bits/ink_holes.h"
#include "core/image/bits/run_pieces.h"

namespace batten {
namespace {

// Where there is ink: rows, and columns by words.
struct InkBox {
  int top, bottom, left, right;
};

InkBox boxOfInk(const BitImage& ink) {
  InkBox box{.top = ink.height, .bottom = -1, .left = ink.wordsPerRow, .right = -1};
  for (int y = 0; y < ink.height; ++y) {
    for (int i = 0; i < ink.wordsPerRow; ++i) {
      if (ink.row(y)[i] == 0) continue;
      box.top = std::min(box.top, y);
      box.bottom = y;
      box.left = std::min(box.left, i);
      box.right = std::max(box.right, i);
    }
  }
  return box;
}

// Closes rows [y0, y1). Ink farther away than twice the radius has no say.
void closeRows(const BitImage& ink, const InkBox& box, int y0, int y1, double radius, BitImage& closed) {
  const int margin = static_cast<int>(std::ceil(radius)) + 2;
  const int x0 = box.left * 64 - margin, top = y0 - 2 * margin;
  cv::Mat mat(y1 - y0 + 4 * margin, (box.right - box.left + 1) * 64 + 2 * margin, CV_8U, cv::Scalar(0));
  for (int y = std::max(0, top); y < std::min(ink.height, top + mat.rows); ++y) {
    std::uint8_t* row = mat.ptr<std::uint8_t>(y - top);
    for (int i = box.left; i <= box.right; ++i) {
      for (std::uint64_t bits = ink.row(y)[i]; bits != 0; bits &= bits - 1)
        row[i * 64 + std::countr_zero(bits) - x0] = 255;
    }
  }
  cv::Mat distance;
  cv::distanceTransform(mat == 0, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  const cv::Mat dilated = distance <= radius;
  cv::distanceTransform(dilated, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  const cv::Mat body = (distance > radius) | mat;
  for (int y = y0; y < y1; ++y) {
    const std::uint8_t* row = body.ptr<std::uint8_t>(y - top);
    for (int x = std::max(0, x0); x < std::min(ink.width, x0 + body.cols); ++x)
      if (row[x - x0] != 0) closed.set(x, y, true);
  }
}

// Fills the holes of the ink that no disc of diameter `limitPx` fits into.
void fillNarrowHoles(BitImage& ink, double limitPx, const RunContext& context) {
  std::vector<InkHole> holes = findInkHoles(ink, context);
  measureWidths(ink, holes, context);
  if (context.isCancelled()) return;
  for (const InkHole& hole : holes) {
    if (hole.widthPx >= limitPx) continue;
    for (const InkRun& run : hole.runs) setBits(ink, run);
  }
}

// For the first run of every piece of `closed` what the ink in it is torn by.
std::vector<InkCounts> countsOfPieces(const RunPieces& closed, const BitImage& ink, const RunContext& context) {
  const BitImage border = without(ink, shrunken(ink, 1, context));
  std::vector<InkCounts> counts(closed.runs.size());
  for (std::size_t i = 0; i < closed.runs.size(); ++i)
    counts[closed.piece[i]].add({countBits(ink, closed.runs[i]), countBits(border, closed.runs[i])});
  const auto addSmall = [&](const RunPieces& parts) {
    const std::vector<std::int64_t> area = areasOfPieces(parts);
    for (std::size_t i = 0; i < parts.runs.size(); ++i) {
      const auto piece = area[i] > 0 ? pieceAt(closed, parts.runs[i].x0, parts.runs[i].y) : std::nullopt;
      if (!piece || counts[*piece].border == 0) continue;
      const double widthPx = counts[*piece].widthPx();
      if (static_cast<double>(area[i]) < widthPx * widthPx) ++counts[*piece].small;
    }
  };
  addSmall(findPieces(ink, Connectivity::Eight, context));
  addSmall(findPieces(paperOf(ink), Connectivity::Four, context));
  return counts;
}

// The strokes of small lettering lie no farther apart than the specks of a pencil: where none tear it, it is as it was.
BitImage withWholeLetters(BitImage closed, const BitImage& ink, double widthPx, const RunContext& context) {
  const RunPieces pieces = findPieces(closed, Connectivity::Eight, context);
  const std::vector<PieceBox> boxes = boxesOfPieces(pieces);
  const std::vector<InkCounts> counts = countsOfPieces(pieces, ink, context);
  if (context.isCancelled()) return closed;
  for (std::size_t i = 0; i < pieces.runs.size(); ++i) {
    const int piece = pieces.piece[i];
    if (!mayBeLettering(boxes[piece], widthPx, kPencilLetters) || counts[piece].grain() > kWholeInk) continue;
    clearBits(closed, pieces.runs[i]);
    copyBits(ink, pieces.runs[i], closed);
  }
  return closed;
}

}  // namespace

BitImage closeInk(const BitImage& ink, double diameterPx, const RunContext& context) {
  constexpr int kRowsAtOnce = 256;  // so that no plane of distances, 4 bytes a pixel, is as large as the page
  BitImage closed(ink.width, ink.height);
  const InkBox box = boxOfInk(ink);
  for (int y = box.top; y <= box.bottom; y += kRowsAtOnce) {
    if (context.isCancelled()) return closed;
    closeRows(ink, box, y, std::min(box.bottom + 1, y + kRowsAtOnce), 0.5 * diameterPx, closed);
  }
  fillNarrowHoles(closed, diameterPx + 2.0, context);
  return closed;
}

double grainClosing(double widthPx) {
  constexpr double kClosingWidths = 0.75;  // between the specks of a pencil there is less, and a pixel
  return kClosingWidths * widthPx + 1.0;
}

BitImage closeGrain(const BitImage& ink, double widthPx, bool isFinePage, const RunContext& context) {
  constexpr double kLeastTorn = 0.003;  // a speck or a hole in 333 widths of stroke
  if (isFinePage && measureGrain(ink, context).perWidth < kLeastTorn) return ink;
  BitImage closed = closeInk(ink, grainClosing(widthPx), context);
  if (!isFinePage || context.isCancelled()) return closed;
  return withWholeLetters(std::move(closed), ink, widthPx, context);
}

BitImage mostlyInk(const BitImage& closed, const BitImage& ink, double share, const RunContext& context) {
  const RunPieces pieces = findPieces(closed, Connectivity::Eight, context);
  const std::vector<std::int64_t> area = areasOfPieces(pieces);
  std::vector<std::int64_t> inked(pieces.runs.size());
  for (std::size_t i = 0; i < pieces.runs.size(); ++i) inked[pieces.piece[i]] += countBits(ink, pieces.runs[i]);
  BitImage kept(closed.width, closed.height);
  for (std::size_t i = 0; i < pieces.runs.size(); ++i) {
    const int piece = pieces.piece[i];
    if (static_cast<double>(inked[piece]) >= share * static_cast<double>(area[piece])) setBits(kept, pieces.runs[i]);
  }
  return kept;
}

}  // namespace batten
