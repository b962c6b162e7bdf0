// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/ink/faint_marks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/statistics.h"
#include "core/image/bits/run_pieces.h"

namespace batten {
namespace {

// Of their contrast: half of it parts ink from paper, and a small dot is blurred.
constexpr double kLeastOfStrokes = 0.4;
constexpr double kMostPens = 3.0;       // of a mark across its box: longer ink has a direction, and is judged as a line
constexpr double kAroundPens = 40.0;    // [pen widths] strokes that near lie in the same light
constexpr double kStepPens = 4.0;       // from one place on a line to the next
constexpr double kLeastBesidePx = 3.0;  // from ink to the paper beside it: its blurred edge
constexpr double kDarkShare = 0.25;     // of the pixels of a mark: its middle, without its blurred edge
constexpr int kFewestStrokeSamples = 20;  // of strokes, around a mark
constexpr double kLeastOfPage = 0.5;      // of the contrast of the page's lines: grain makes fainter lines, too
constexpr int kFewestPaper = 6;           // [px] around a mark

struct Box {
  int x0, y0, x1, y1;  // pixels [x0, x1) x [y0, y1)
};

class Contrasts {
 public:
  Contrasts(const BitImage& ink, const GreyImage& grey, double penPx)
      : ink_(ink), grey_(grey), besidePx_(static_cast<int>(std::lround(std::max(kLeastBesidePx, 0.5 * penPx)))) {}

  /// 0..1: what ink takes of the light of the paper around it. `levels`: of its pixels. Absent: all around is ink.
  std::optional<double> of(const Box& box, std::vector<float>& levels) const {
    paper_.clear();
    const Box frame{box.x0 - besidePx_, box.y0 - besidePx_, box.x1 + besidePx_, box.y1 + besidePx_};
    for (int x = frame.x0; x < frame.x1; ++x) {
      addPaper(x, frame.y0);
      addPaper(x, frame.y1 - 1);
    }
    for (int y = frame.y0 + 1; y + 1 < frame.y1; ++y) {
      addPaper(frame.x0, y);
      addPaper(frame.x1 - 1, y);
    }
    if (std::ssize(paper_) < kFewestPaper || levels.empty()) return std::nullopt;
    const double paper = std::max(1.0, static_cast<double>(upperMedian(paper_)));
    return 1.0 - static_cast<double>(lowerQuantile(levels, kDarkShare)) / paper;
  }

  /// Of a line at one of its points.
  std::optional<double> ofLine(const ContourPoint& point, double penPx) const {
    const int half =
        static_cast<int>(std::ceil(0.5 * static_cast<double>(point.widthPx.value_or(static_cast<float>(penPx)))));
    const int x = static_cast<int>(point.unrefined.x()), y = static_cast<int>(point.unrefined.y());
    std::vector<float> levels;
    for (int j = std::max(0, y - 1); j <= std::min(grey_.height - 1, y + 1); ++j) {
      for (int i = std::max(0, x - 1); i <= std::min(grey_.width - 1, x + 1); ++i)
        levels.push_back(static_cast<float>(grey_.row(j)[i]));
    }
    return of({x - half, y - half, x + half + 1, y + half + 1}, levels);
  }

 private:
  void addPaper(int x, int y) const {
    if (x >= 0 && y >= 0 && x < grey_.width && y < grey_.height && !ink_.at(x, y))
      paper_.push_back(static_cast<float>(grey_.row(y)[x]));
  }

  const BitImage& ink_;
  const GreyImage& grey_;
  int besidePx_;
  mutable std::vector<float> paper_;  ///< Scratch.
};

/// The contrast of the lines, by place.
class LineContrasts {
 public:
  LineContrasts(const ContourSet& lines, const Contrasts& contrasts, double penPx, const RunContext& context)
      : cellPx_(kAroundPens * penPx) {
    std::vector<double> all;
    const int step = std::max(1, static_cast<int>(std::lround(kStepPens * penPx)));
    for (const Contour& line : lines.contours) {
      if (context.isCancelled()) return;
      for (int i = step / 2; i < std::ssize(line.points); i += step) {
        const auto contrast = contrasts.ofLine(line.points[i], penPx);
        if (!contrast) continue;
        cells_[cellOf(line.points[i].unrefined)].push_back(*contrast);
        all.push_back(*contrast);
      }
    }
    if (!all.empty()) ofPage_ = upperMedian(all);
  }

  /// The median around a place; of the page where few lines are near. Absent: there are no lines.
  std::optional<double> around(const Vec2& at) const {
    std::vector<double> near;
    const auto [column, row] = cellOf(at);
    for (int j = row - 1; j <= row + 1; ++j) {
      for (int i = column - 1; i <= column + 1; ++i) {
        const auto cell = cells_.find({i, j});
        if (cell != cells_.end()) near.insert(near.end(), cell->second.begin(), cell->second.end());
      }
    }
    if (!ofPage_ || std::ssize(near) < kFewestStrokeSamples) return ofPage_;
    return std::max(upperMedian(near), kLeastOfPage * *ofPage_);
  }

 private:
  std::pair<int, int> cellOf(const Vec2& at) const {
    return {static_cast<int>(at.x() / cellPx_), static_cast<int>(at.y() / cellPx_)};
  }

  double cellPx_;
  std::map<std::pair<int, int>, std::vector<double>> cells_;
  std::optional<double> ofPage_;
};

}  // namespace

FaintMarks faintMarks(const BitImage& marks, const BitImage& ink, const ContourSet& lines, const GreyImage& grey,
                      std::optional<double> penPx, const RunContext& context) {
  FaintMarks faint{BitImage(marks.width, marks.height)};
  if (!penPx || !(*penPx > 0.0) || lines.contours.empty() || marks.count() == 0) return faint;
  const Contrasts contrasts(ink, grey, *penPx);
  const LineContrasts ofLines(lines, contrasts, *penPx, context);
  const RunPieces pieces = findPieces(marks, Connectivity::Eight, context);
  std::map<int, std::vector<InkRun>> runs;
  for (std::size_t i = 0; i < pieces.runs.size(); ++i) runs[pieces.piece[i]].push_back(pieces.runs[i]);
  for (const auto& [piece, ofPiece] : runs) {
    if (context.isCancelled()) return faint;
    Box box{marks.width, ofPiece.front().y, 0, ofPiece.back().y + 1};
    for (const InkRun& run : ofPiece) {
      box.x0 = std::min(box.x0, run.x0);
      box.x1 = std::max(box.x1, run.x1);
    }
    if (std::hypot(box.x1 - box.x0, box.y1 - box.y0) > kMostPens * *penPx) continue;
    std::vector<float> levels;
    for (const InkRun& run : ofPiece) {
      for (int x = run.x0; x < run.x1; ++x) levels.push_back(static_cast<float>(grey.row(run.y)[x]));
    }
    const auto own = contrasts.of(box, levels), strokes = ofLines.around(Vec2(box.x0, box.y0));
    if (!own || !strokes || *own >= kLeastOfStrokes * *strokes) continue;
    for (const InkRun& run : ofPiece) setBits(faint.ink, run);
    ++faint.count;
  }
  return faint;
}

}  // namespace batten
