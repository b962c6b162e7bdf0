// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/sheet/sheet_drawn_edge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/statistics.h"
#include "core/base/vec2.h"
#include "core/image/grown_mask.h"
#include "core/image/sheet/mask_outline.h"
#include "core/image/sheet/sheet_step.h"

namespace batten {
namespace {

constexpr double kPocketNeckShare = 0.02;  // of the diagonal: what hangs on the table by narrower parts is paper
constexpr int kAlongHullCells = 4;         // to either side
constexpr double kLeastOnHull = 0.3;       // of the edge between a sheet and what lies beside it
constexpr int kEdgeStep = 3, kAlongEdgeCells = 6;  // between two places of an edge; to either side for its direction
constexpr int kInLineCells = 3, kBesideLineCells = 9;  // to either side of an edge: a line on it, and paper beside that
constexpr float kSamePaper = 0.1f, kLeastLineDepth = 0.25f;  // of the brightness of the paper
constexpr double kLeastFramed = 0.6;                         // of the places

/// The parts of a mask that touch another one.
cv::Mat1b partsTouching(const cv::Mat1b& mask, const cv::Mat1b& other) {
  cv::Mat1b near;
  cv::dilate(other, near, cv::getStructuringElement(cv::MORPH_RECT, {3, 3}));
  cv::Mat1i labels;
  std::vector<bool> touches(cv::connectedComponents(mask, labels, 8, CV_32S), false);
  for (int j = 0; j < mask.rows; ++j) {
    for (int i = 0; i < mask.cols; ++i) {
      if (near(j, i) != 0) touches[labels(j, i)] = true;
    }
  }
  cv::Mat1b out(mask.size(), static_cast<unsigned char>(0));
  for (int j = 0; j < mask.rows; ++j) {
    for (int i = 0; i < mask.cols; ++i) out(j, i) = labels(j, i) > 0 && touches[labels(j, i)] ? 255 : 0;
  }
  return out;
}

/// Whether a dark line runs between paper of about the same brightness. Absent: one side lies outside the picture.
std::optional<bool> isLineAcross(const SheetCells& cells, const cv::Point& at, const Vec2& normal) {
  const Vec2 place(at.x, at.y);
  std::array<float, 2> paper{};
  for (const int side : {0, 1}) {
    std::vector<float> levels =
        levelsAlong(cells, place, side == 0 ? normal : Vec2(-normal), {kInLineCells + 1, kBesideLineCells});
    if (std::ssize(levels) < (kBesideLineCells - kInLineCells) / 2) return std::nullopt;
    paper[side] = upperMedian(std::move(levels));
  }
  const float darker = std::min(paper[0], paper[1]);
  if (std::max(paper[0], paper[1]) > (1.0f + kSamePaper) * darker) return false;
  float darkest = darker;
  for (int d = -kInLineCells; d <= kInLineCells; ++d)
    if (const auto p = cellAt(cells, place + d * normal))
      darkest = std::min(darkest, static_cast<float>(cells.dark(*p)));
  return darkest <= (1.0f - kLeastLineDepth) * darker;
}

}  // namespace

cv::Mat discOf(const cv::Size& size, double shareOfDiagonal) {
  const int radius = std::max(1, static_cast<int>(std::lround(shareOfDiagonal * std::hypot(size.width, size.height))));
  return cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * radius + 1, 2 * radius + 1});
}

cv::Mat1b borderOf(const cv::Size& size) {
  cv::Mat1b border(size, 255);
  border(cv::Rect(1, 1, size.width - 2, size.height - 2)) = 0;
  return border;
}

cv::Mat1b withoutPockets(const cv::Mat1b& beside) {
  const cv::Mat disc = discOf(beside.size(), kPocketNeckShare);
  const cv::Mat1b border = borderOf(beside.size());
  cv::Mat1b core, table, broad;
  cv::erode(beside, core, disc, {-1, -1}, 1, cv::BORDER_REPLICATE);
  cv::dilate(partsTouching(core, border), table, disc);
  cv::dilate(core, broad, disc);
  const cv::Mat1b narrow = beside & (broad == 0);
  return table | partsTouching(narrow, table | border);
}

cv::Mat1b withTonesThatBulge(const cv::Mat1b& sheet) {
  const std::vector<cv::Point> hull = hullOf(sheet);
  if (hull.empty()) return sheet;
  cv::Mat1b along(sheet.size(), static_cast<unsigned char>(0));
  cv::polylines(along, std::vector<std::vector<cv::Point>>{hull}, true, 255, 2 * kAlongHullCells + 1);
  cv::Mat1i labels;
  cv::Mat stats, centres;
  const int count = cv::connectedComponentsWithStats(sheet == 0, labels, stats, centres, 8, CV_32S);
  const cv::Mat1b edge = grownMask(sheet, 1) & (sheet == 0);
  std::vector<int> all(count, 0), onHull(count, 0);
  for (int j = 0; j < sheet.rows; ++j) {
    for (int i = 0; i < sheet.cols; ++i) {
      if (edge(j, i) == 0) continue;
      ++all[labels(j, i)];
      onHull[labels(j, i)] += along(j, i) != 0 ? 1 : 0;
    }
  }
  cv::Mat1b with = sheet.clone();
  for (int k = 1; k < count; ++k) {
    const bool isLarge = stats.at<int>(k, cv::CC_STAT_AREA) >= kLeastPatch * static_cast<double>(sheet.total());
    if (isLarge && onHull[k] < kLeastOnHull * all[k]) with.setTo(255, labels == k);
  }
  return with;
}

cv::Mat1b withoutTonesAtEdge(const cv::Mat1b& beside, const cv::Mat1b& even, const SheetCells& cells) {
  cv::Mat1b left = beside.clone();
  const std::vector<cv::Point> hull = hullOf(even);
  if (hull.empty()) return left;
  cv::Mat1b within(even.size(), static_cast<unsigned char>(0));
  cv::fillConvexPoly(within, hull, 255);
  const cv::Mat1b table = slowlyContinued(beside & (within == 0), cells);
  cv::Mat1b drawn = beside & within & (table == 0);
  // Paper between close strokes is of the tone.
  cv::morphologyEx(drawn, drawn, cv::MORPH_CLOSE, discOf(drawn.size(), kNeckShare));
  cv::morphologyEx(drawn, drawn, cv::MORPH_OPEN, discOf(drawn.size(), kNeckShare));
  drawn &= within & (table == 0);
  cv::Mat1i labels;
  cv::Mat stats, centres;
  const int count = cv::connectedComponentsWithStats(drawn, labels, stats, centres, 8, CV_32S);
  for (int k = 1; k < count; ++k) {
    if (stats.at<int>(k, cv::CC_STAT_AREA) >= kLeastPatch * static_cast<double>(even.total()))
      left.setTo(0, labels == k);
  }
  return left;
}

bool isDrawnFrame(const cv::Mat1b& sheet, const SheetCells& cells) {
  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(sheet.clone(), outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  int edges = 0, lines = 0;
  for (const std::vector<cv::Point>& outline : outlines) {
    const int n = static_cast<int>(outline.size());
    for (int i = 0; n > 2 * kAlongEdgeCells && i < n; i += kEdgeStep) {
      const cv::Point chord = outline[(i + kAlongEdgeCells) % n] - outline[(i + n - kAlongEdgeCells) % n];
      const double length = std::hypot(chord.x, chord.y);
      if (!(length > 0.0)) continue;
      const std::optional<bool> isLine = isLineAcross(cells, outline[i], Vec2(-chord.y / length, chord.x / length));
      edges += isLine ? 1 : 0;
      lines += isLine && *isLine ? 1 : 0;
    }
  }
  return edges > 0 && lines >= kLeastFramed * edges;
}

}  // namespace batten
