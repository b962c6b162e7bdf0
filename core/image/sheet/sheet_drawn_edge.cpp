// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/sheet/sheet_drawn_edge.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/image/grown_mask.h"
#include "core/image/sheet/sheet_step.h"

namespace batten {
namespace {

constexpr double kPocketNeckShare = 0.02;  // of the diagonal: what hangs on the table by narrower parts is paper
constexpr int kAlongHullCells = 4;         // to either side
constexpr double kLeastOnHull = 0.3;       // of the edge between a sheet and what lies beside it

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
  std::vector<cv::Point> places, hull;
  cv::findNonZero(sheet, places);
  if (places.empty()) return sheet;
  cv::convexHull(places, hull);
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
  std::vector<cv::Point> places, hull;
  cv::findNonZero(even, places);
  if (places.empty()) return left;
  cv::convexHull(places, hull);
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

}  // namespace batten
