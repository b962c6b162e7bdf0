// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/outline/texture_holes.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "core/base/statistics.h"
#include "core/image/bits/ink_holes.h"
#include "core/image/bits/mask_distance.h"

namespace batten {
namespace {

constexpr double kWideHole = 1.0 / 6.0;  // of the width of the shape, filled
constexpr double kEvenInk = 0.03;        // robust standard deviation as part of the hole's contrast
constexpr double kVeryEvenInk = 0.01;    // and where most holes of the page lie in uneven ink
constexpr int kFewHoles = 5;             // fewer uneven ones are no texture
constexpr double kFarWider = 4.0;        // times the median of the uneven holes
constexpr double kSoftBorderPx = 3.0;    // [px] as far as a border's blur reaches into the ink
constexpr int kInkAroundPx = 10;         // [px] from a hole: its surroundings
constexpr int kFewestInkPixels = 20;     // to tell even ink
constexpr int kHolesPerLook = 64;        // between two looks at the cancel token
constexpr int kRowsAtOnce = 256;         // of the surroundings of a hole: a hole may be as large as the page

double diameterOf(std::int32_t squaredDistance) { return 2.0 * std::sqrt(squaredDistance) - 1.0; }

cv::Rect boxOf(const InkHole& hole) {
  cv::Rect box;
  for (const InkRun& run : hole.runs) box |= cv::Rect(run.x0, run.y, run.x1 - run.x0, 1);
  return box;
}

class HoleSearch {
 public:
  HoleSearch(const BitImage& ink, const GreyImage& grey, const RunContext& context)
      : ink_(ink), grey_(grey), context_(context), holes_(findInkHoles(ink, context)) {
    // With fewer holes the answer is known: see texture().
    if (std::ssize(holes_) < kFewHoles) holes_.clear();
  }

  // Those that are texture.
  std::vector<InkHole> texture() {
    if (holes_.empty() || context_.isCancelled()) return {};
    measureWidths(ink_, holes_, context_);
    keepNarrow();
    if (std::ssize(holes_) < kFewHoles || context_.isCancelled()) return {};
    std::vector<double> uneven;
    for (const InkHole& hole : holes_) {
      if (std::ssize(uneven) % kHolesPerLook == 0 && context_.isCancelled()) return {};
      uneven.push_back(unevennessAround(hole).value_or(0.0));  // what cannot be told counts as even
    }
    std::vector<double> widths, ranked = uneven;
    const double limit = upperMedian(ranked) >= kEvenInk ? kVeryEvenInk : kEvenInk;
    for (std::size_t i = 0; i < holes_.size(); ++i)
      if (uneven[i] >= limit) widths.push_back(holes_[i].widthPx);
    if (std::ssize(widths) < kFewHoles) return {};
    const double wide = kFarWider * upperMedian(widths);
    std::vector<InkHole> found;
    for (std::size_t i = 0; i < holes_.size(); ++i)
      if (uneven[i] >= limit && holes_[i].widthPx < wide) found.push_back(std::move(holes_[i]));
    return found;
  }

 private:
  // Drops the holes that are wide against the shape that they lie in.
  void keepNarrow() {
    BitImage shapes = ink_;
    for (const InkHole& hole : holes_)
      for (const InkRun& run : hole.runs) setBits(shapes, run);
    MaskDistance toOutside(shapes);
    std::stable_sort(holes_.begin(), holes_.end(),
                     [](const InkHole& a, const InkHole& b) { return a.middleY < b.middleY; });
    std::erase_if(holes_, [&](const InkHole& hole) { return context_.isCancelled() || !isNarrow(hole, toOutside); });
  }

  // Uphill from the middle of the hole to the middle of the shape, or as far as it takes to be wide enough.
  static bool isNarrow(const InkHole& hole, MaskDistance& toOutside) {
    constexpr int kAroundPx = 2;  // a step of the distance map must not end the climb
    cv::Point at(hole.middleX, hole.middleY);
    std::int32_t height = toOutside.squared(at.x, at.y);
    for (;;) {
      if (hole.widthPx < kWideHole * diameterOf(height)) return true;
      const cv::Point from = at;
      for (int y = from.y - kAroundPx; y <= from.y + kAroundPx; ++y) {
        for (int x = from.x - kAroundPx; x <= from.x + kAroundPx; ++x) {
          const std::int32_t there = toOutside.squared(x, y);
          if (there <= height) continue;
          height = there;
          at = {x, y};
        }
      }
      if (at == from) return false;
    }
  }

  // Pixels of rows and columns of the page, also beyond its border; 255 = set.
  template <class IsSet>
  static cv::Mat maskOf(const cv::Rect& box, const IsSet& isSet) {
    cv::Mat mask(box.height, box.width, CV_8U, cv::Scalar(0));
    for (int y = 0; y < box.height; ++y)
      for (int x = 0; x < box.width; ++x) mask.at<std::uint8_t>(y, x) = isSet(box.x + x, box.y + y) ? 255 : 0;
    return mask;
  }

  static cv::Mat distanceInside(const cv::Mat& mask) {
    cv::Mat distance;
    cv::distanceTransform(mask, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    return distance;
  }

  // The grey levels of the ink around a hole in rows [y0, y1), its soft border left out. @param box the hole with its
  // surroundings.
  std::vector<double> levelsAround(const InkHole& hole, const cv::Rect& box, int y0, int y1) const {
    std::vector<double> levels;
    const cv::Rect rows = cv::Rect(box.x, y0 - kInkAroundPx - 1, box.width, y1 - y0 + 2 * (kInkAroundPx + 1)) & box;
    const cv::Mat toPaper = distanceInside(maskOf(rows, [&](int x, int y) { return ink_.at(x, y); }));
    cv::Mat notHole(rows.height, rows.width, CV_8U, cv::Scalar(255));
    for (const InkRun& run : hole.runs) {
      if (run.y < rows.y || run.y >= rows.y + rows.height) continue;
      notHole(cv::Rect(run.x0 - rows.x, run.y - rows.y, run.x1 - run.x0, 1)).setTo(0);
    }
    const cv::Mat toHole = distanceInside(notHole);
    for (int y = y0; y < y1; ++y) {
      for (int x = box.x; x < box.x + box.width; ++x) {
        const auto at = cv::Point(x - rows.x, y - rows.y);
        const bool isInside = static_cast<double>(toPaper.at<float>(at)) >= kSoftBorderPx;
        if (isInside && static_cast<double>(toHole.at<float>(at)) <= kInkAroundPx) levels.push_back(grey_.level(x, y));
      }
    }
    return levels;
  }

  // Absent where there is too little ink to tell.
  std::optional<double> unevennessAround(const InkHole& hole) const {
    constexpr int kMargin = 1;  // [px] of paper around the page
    const cv::Rect page(-kMargin, -kMargin, ink_.width + 2 * kMargin, ink_.height + 2 * kMargin);
    const cv::Rect own = boxOf(hole);
    const cv::Rect box = cv::Rect(own.x - kInkAroundPx, own.y - kInkAroundPx, own.width + 2 * kInkAroundPx,
                                  own.height + 2 * kInkAroundPx) &
                         page;
    std::vector<double> levels;
    for (int y = box.y; y < box.y + box.height; y += kRowsAtOnce) {
      if (context_.isCancelled()) return std::nullopt;
      const std::vector<double> more = levelsAround(hole, box, y, std::min(box.y + box.height, y + kRowsAtOnce));
      levels.insert(levels.end(), more.begin(), more.end());
    }
    if (std::ssize(levels) < kFewestInkPixels) return std::nullopt;
    const double middle = upperMedian(levels);
    for (double& level : levels) level -= middle;
    double brightest = 0.0;
    for (const InkRun& run : hole.runs)
      for (int x = run.x0; x < run.x1; ++x) brightest = std::max(brightest, grey_.level(x, run.y));
    return robustSigma(levels) / std::max(1.0, brightest - middle);
  }

  const BitImage& ink_;
  const GreyImage& grey_;
  const RunContext& context_;
  std::vector<InkHole> holes_;
};

}  // namespace

EvenInk fillTextureHoles(BitImage ink, const GreyImage& grey, const RunContext& context) {
  if (ink.width <= 0 || ink.height <= 0) return {std::move(ink), 0};
  try {
    BitImage even = ink;
    HoleSearch search(ink, grey, context);
    const std::vector<InkHole> texture = search.texture();
    for (const InkHole& hole : texture)
      for (const InkRun& run : hole.runs) setBits(even, run);
    return {std::move(even), static_cast<int>(texture.size())};
  } catch (const cv::Exception&) {
    throw std::bad_alloc();
  }
}

}  // namespace batten
