// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/ruling/dot_marks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <opencv2/imgproc.hpp>

namespace batten {
namespace {

constexpr double kLargestMark = 1.0 / 80.0;  // of the longer side of the page: what is wider is no mark
constexpr int kLeastMarkReach = 7;           // [px]
constexpr double kLeastMarkDepth = 0.06;     // of the paper's light
constexpr double kSmoothing = 0.5;           // [px^2] the grain of single pixels goes
constexpr double kLeastMarkFilled = 0.55;    // of its box, less half a pixel, at half depth: a disc fills 0.79
constexpr double kMostOblong = 2.2;          // seen from the side
constexpr int kLeastMarkArea = 3;            // [px]
constexpr int kPartOfSide = 9;               // a part that is looked at is the ninth of the page across and down,
constexpr int kParts = 4;                    // of four by four at even distances: a fifth of the page
constexpr int kFewestMarkedParts = 5, kFewestMarksOfPart = 2;  // of them, with so many marks
constexpr double kStillPaper = 0.85;                           // of the paper beside: a shadow; less is another thing

cv::Mat1b bytesOf(const Plane& grey, const RunContext& context) {
  const Plane smoothed = smooth(grey, gaussianKernel(kSmoothing), context);
  cv::Mat1b bytes(grey.height, grey.width);
  if (context.isCancelled()) return bytes;
  for (int y = 0; y < grey.height; ++y) {
    const float* from = smoothed.row(y);
    std::uint8_t* to = bytes.ptr<std::uint8_t>(y);
    for (int x = 0; x < grey.width; ++x) to[x] = static_cast<std::uint8_t>(std::clamp(from[x] + 0.5f, 0.0f, 255.0f));
  }
  return bytes;
}

/// The mark in the box of a dark piece; of area 0 if it is none.
DotMark markIn(const cv::Mat1b& less, const cv::Mat1b& paper, const cv::Rect& box) {
  DotMark mark;
  double peak = 0.0;
  cv::minMaxLoc(less(box), nullptr, &peak);
  const int half = static_cast<int>(std::ceil(0.5 * peak));
  int count = 0, x0 = box.br().x, x1 = box.x, y0 = box.br().y, y1 = box.y;
  double sum = 0.0, sumX = 0.0, sumY = 0.0;
  for (int y = box.y; y < box.br().y; ++y) {
    for (int x = box.x; x < box.br().x; ++x) {
      const int value = less(y, x);
      if (value < half) continue;
      ++count;
      x0 = std::min(x0, x), x1 = std::max(x1, x), y0 = std::min(y0, y), y1 = std::max(y1, y);
      sum += value, sumX += value * (x + 0.5), sumY += value * (y + 0.5);
    }
  }
  const int w = x1 - x0 + 1, h = y1 - y0 + 1;
  if (count < kLeastMarkArea || count < kLeastMarkFilled * (w - 0.5) * (h - 0.5)) return mark;
  if (std::max(w, h) > std::max(kMostOblong * std::min(w, h), std::min(w, h) + 1.0)) return mark;
  mark.at = {sumX / sum, sumY / sum};
  mark.width = w, mark.height = h, mark.area = count;
  mark.depth = peak / std::max(1.0, 1.0 * paper(static_cast<int>(mark.at.y()), static_cast<int>(mark.at.x())));
  const int around = std::max(w, h);
  const cv::Rect page({}, less.size());
  const cv::Rect own = cv::Rect(x0 - 1, y0 - 1, w + 2, h + 2) & page;
  const cv::Rect wide = cv::Rect(x0 - around, y0 - around, w + 2 * around, h + 2 * around) & page;
  mark.isAlone = cv::countNonZero(less(wide) >= half) == cv::countNonZero(less(own) >= half);
  return mark;
}

}  // namespace

double DotMarks::paperAt(const Vec2& at) const {
  const int x = std::clamp(static_cast<int>(at.x()), 0, width - 1);
  const int y = std::clamp(static_cast<int>(at.y()), 0, height - 1);
  return paper[std::ptrdiff_t{y} * width + x];
}

bool DotMarks::isHidden(const Vec2& at, double reach, double level) const {
  if (paperAt(at) < kStillPaper * level) return true;
  const int x0 = std::max(0, static_cast<int>(at.x() - reach)),
            x1 = std::min(width, static_cast<int>(at.x() + reach) + 1);
  const int y0 = std::max(0, static_cast<int>(at.y() - reach)),
            y1 = std::min(height, static_cast<int>(at.y() + reach) + 1);
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x)
      if (dark[std::ptrdiff_t{y} * width + x] != 0) return true;
  }
  return false;
}

namespace {

/// @param reach [px] Wider pieces are no marks.
DotMarks dotMarksOf(const Plane& grey, int reach, const RunContext& context) {
  DotMarks found;
  found.width = grey.width;
  found.height = grey.height;
  const cv::Mat1b bytes = bytesOf(grey, context);
  if (context.isCancelled()) return found;
  cv::Mat1b paper;
  cv::morphologyEx(bytes, paper, cv::MORPH_CLOSE, cv::getStructuringElement(cv::MORPH_RECT, {reach, reach}));
  const cv::Mat1b less = paper - bytes;
  cv::Mat1b dark(grey.height, grey.width);
  for (int y = 0; y < grey.height; ++y) {
    for (int x = 0; x < grey.width; ++x) dark(y, x) = less(y, x) > kLeastMarkDepth * paper(y, x) ? 1 : 0;
  }
  cv::Mat1i labels;
  cv::Mat stats, middles;
  const int count = cv::connectedComponentsWithStats(dark, labels, stats, middles, 8, CV_32S);
  for (int k = 1; k < count; ++k) {
    const cv::Rect box(stats.at<int>(k, cv::CC_STAT_LEFT), stats.at<int>(k, cv::CC_STAT_TOP),
                       stats.at<int>(k, cv::CC_STAT_WIDTH), stats.at<int>(k, cv::CC_STAT_HEIGHT));
    if (stats.at<int>(k, cv::CC_STAT_AREA) < kLeastMarkArea) continue;
    const DotMark mark = std::max(box.width, box.height) <= reach ? markIn(less, paper, box) : DotMark();
    if (mark.area > 0.0)
      found.marks.push_back(mark);
    else
      found.longestOther = std::max(found.longestOther, std::hypot(box.width, box.height));
  }
  found.paper.assign(paper.begin(), paper.end());
  found.dark.assign(dark.begin(), dark.end());
  return found;
}

int reachOn(const Plane& grey) {
  return std::max(kLeastMarkReach, static_cast<int>(kLargestMark * std::max(grey.width, grey.height)) | 1);
}

}  // namespace

DotMarks findDotMarks(const Plane& grey, const RunContext& context) { return dotMarksOf(grey, reachOn(grey), context); }

bool hasMarksAllOver(const Plane& grey, const RunContext& context) {
  const int width = grey.width / kPartOfSide, height = grey.height / kPartOfSide;
  if (std::min(width, height) < kLeastMarkReach) return false;
  int marked = 0;
  for (int part = 0; part < kParts * kParts; ++part) {
    if (marked >= kFewestMarkedParts) return true;
    if (marked + kParts * kParts - part < kFewestMarkedParts) return false;
    const int x0 = (2 * (part % kParts) + 1) * grey.width / (2 * kParts) - width / 2;
    const int y0 = (2 * (part / kParts) + 1) * grey.height / (2 * kParts) - height / 2;
    Plane seen(width, height);
    for (int y = 0; y < height; ++y) std::copy_n(grey.row(y0 + y) + x0, width, seen.row(y));
    const DotMarks found = dotMarksOf(seen, reachOn(grey), context);
    if (context.isCancelled()) return false;
    marked += std::ranges::count_if(found.marks, &DotMark::isAlone) >= kFewestMarksOfPart ? 1 : 0;
  }
  return marked >= kFewestMarkedParts;
}

}  // namespace batten
