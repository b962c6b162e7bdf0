// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/pencil/stroke_split.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <new>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/image/bits/run_pieces.h"

namespace batten {
namespace {

// Area and fat area of every component (keyed by its first run).
struct Bulk {
  std::int64_t area = 0, longRuns = 0, fat = 0;
};

// The fat parts of a page at a coarse scale: cells that an opening by the disc leaves.
struct FatCells {
  int factor = 1;
  cv::Mat fat;
};

FatCells fatCells(const BitImage& ink, double limitPx) {
  constexpr double kCellsPerLimit = 16.0;  // an opening to a sixteenth of its disc is exact enough for a share
  FatCells cells;
  cells.factor = std::max(1, static_cast<int>(limitPx / kCellsPerLimit));
  const int f = cells.factor, columns = (ink.width + f - 1) / f, rows = (ink.height + f - 1) / f;
  // One cell of paper all round: outside the page is paper.
  cv::Mat coarse(rows + 2, columns + 2, CV_8U, cv::Scalar(0));
  std::vector<int> sum(columns);
  for (int j = 0; j < rows; ++j) {
    std::fill(sum.begin(), sum.end(), 0);
    for (int y = j * f; y < std::min(ink.height, (j + 1) * f); ++y) {
      for (int i = 0; i < ink.wordsPerRow; ++i) {
        for (std::uint64_t bits = ink.row(y)[i]; bits != 0; bits &= bits - 1) {
          ++sum[(i * 64 + std::countr_zero(bits)) / f];
        }
      }
    }
    for (int i = 0; i < columns; ++i) {
      if (2 * sum[i] >= f * f) coarse.at<std::uint8_t>(j + 1, i + 1) = 255;
    }
  }
  cv::Mat inside, toCore;
  cv::distanceTransform(coarse, inside, cv::DIST_L2, cv::DIST_MASK_5);
  const double radius = 0.5 * limitPx / f;
  const cv::Mat core = inside > radius;
  if (cv::countNonZero(core) == 0) {
    cells.fat = cv::Mat(rows, columns, CV_8U, cv::Scalar(0));
    return cells;
  }
  cv::distanceTransform(core == 0, toCore, cv::DIST_L2, cv::DIST_MASK_5);
  cells.fat = cv::Mat(toCore <= radius)(cv::Rect(1, 1, columns, rows)).clone();
  return cells;
}

std::int64_t fatPart(const InkRun& run, const FatCells& cells) {
  std::int64_t sum = 0;
  const std::uint8_t* row = cells.fat.ptr<std::uint8_t>(run.y / cells.factor);
  for (int x = run.x0; x < run.x1;) {
    const int cell = x / cells.factor, next = std::min(run.x1, (cell + 1) * cells.factor);
    if (row[cell] != 0) sum += next - x;
    x = next;
  }
  return sum;
}

// Ink pixels in a column through (x, y), no more than `most` counted.
int heightAt(const BitImage& ink, int x, int y, int most) {
  int height = 1;
  for (int yy = y - 1; height < most && ink.at(x, yy); --yy) ++height;
  for (int yy = y + 1; height < most && ink.at(x, yy); ++yy) ++height;
  return height;
}

constexpr double kWidestStroke = 0.025;  // of the side of a square as large as the page: 6 mm on A4
constexpr double kLongChord = 0.7;       // of the diameter of a disc
constexpr double kLeastLongRuns = 0.35;  // of the area of a piece: with less it cannot be half a disc's chords

std::vector<bool> shapesByWidth(const BitImage& ink, const RunPieces& pieces, double limitPx) {
  std::vector<bool> shapes(pieces.runs.size(), false);
  std::vector<Bulk> bulk(pieces.runs.size());
  bool anyThick = false;
  for (int i = 0; i < std::ssize(pieces.runs); ++i) {
    const InkRun& r = pieces.runs[i];
    Bulk& b = bulk[pieces.piece[i]];
    b.area += r.x1 - r.x0;
    // The chords of a disc that are longer than .7 diameters make up 4/5 of it.
    const int chord = static_cast<int>(kLongChord * limitPx);
    if (r.x1 - r.x0 >= chord && heightAt(ink, (r.x0 + r.x1) / 2, r.y, chord) >= chord) b.longRuns += r.x1 - r.x0;
  }
  for (const Bulk& b : bulk)
    anyThick = anyThick || (b.area > 0 && b.longRuns >= kLeastLongRuns * static_cast<double>(b.area));
  if (!anyThick) return shapes;
  const FatCells fat = fatCells(ink, limitPx);
  for (int i = 0; i < std::ssize(pieces.runs); ++i) {
    bulk[pieces.piece[i]].fat += fatPart(pieces.runs[i], fat);
  }
  for (int i = 0; i < std::ssize(pieces.runs); ++i) {
    const Bulk& b = bulk[pieces.piece[i]];
    shapes[i] = 2 * b.fat > b.area;
  }
  return shapes;
}

StrokeSplit split(const BitImage& ink, const RunContext& context) {
  StrokeSplit result{BitImage(ink.width, ink.height), BitImage(ink.width, ink.height)};
  const RunPieces pieces = findPieces(ink, Connectivity::Eight, context);
  if (context.isCancelled()) return result;
  const double side = std::sqrt(static_cast<double>(ink.width) * ink.height);
  const std::vector<bool> shapes = shapesByWidth(ink, pieces, kWidestStroke * side);
  for (int i = 0; i < std::ssize(pieces.runs); ++i)
    copyBits(ink, pieces.runs[i], shapes[i] ? result.shapes : result.strokes);
  return result;
}

}  // namespace

Result<StrokeSplit> splitStrokes(const BitImage& ink, const RunContext& context) {
  if (ink.width <= 0 || ink.height <= 0) return StrokeSplit{ink, ink};
  if (context.isCancelled()) return cancelled();
  try {
    StrokeSplit result = split(ink, context);
    if (context.isCancelled()) return cancelled();
    return result;
  } catch (const cv::Exception& e) {
    return fail(ErrorCode::OutOfMemory, "Not enough memory to tell strokes from shapes.", e.what());
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::OutOfMemory, "Not enough memory to tell strokes from shapes.");
  }
}

}  // namespace batten
