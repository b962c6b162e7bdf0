// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/outline/texture_holes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <new>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/base/statistics.h"

namespace batten {
namespace {

constexpr double kWideHole = 1.0 / 6.0;  // of the width of the shape, filled
constexpr double kEvenInk = 0.03;        // robust standard deviation as part of the hole's contrast
constexpr double kVeryEvenInk = 0.01;    // and where most holes of the page lie in uneven ink
constexpr int kFewHoles = 5;             // fewer uneven ones are no texture
constexpr double kFarWider = 4.0;        // times the median of the uneven holes
constexpr double kSoftBorderPx = 3.0;    // [px] as far as a border's blur reaches into the ink
constexpr double kInkAroundPx = 10.0;    // [px] from a hole: its surroundings
constexpr int kFewestInkPixels = 20;     // to tell even ink
constexpr int kHolesPerLook = 64;        // between two looks at the cancel token
constexpr int kMargin = 1;               // [px] of paper around the page

// A region of paper inside the ink; places are those of the page with its margin.
struct InkHole {
  cv::Rect box;
  cv::Point middle;        // of its largest disc
  double widthPx = 0.0;    // diameter of that disc
  double brightest = 0.0;  // [grey]
  double uneven = 0.0;     // of the ink around, as part of the hole's contrast
};

cv::Mat matOf(const BitImage& ink) {
  cv::Mat mat(ink.height + 2 * kMargin, ink.width + 2 * kMargin, CV_8U, cv::Scalar(0));
  for (int y = 0; y < ink.height; ++y) {
    std::uint8_t* row = mat.ptr<std::uint8_t>(y + kMargin) + kMargin;
    for (int i = 0; i < ink.wordsPerRow; ++i) {
      for (std::uint64_t bits = ink.row(y)[i]; bits != 0; bits &= bits - 1) row[i * 64 + std::countr_zero(bits)] = 255;
    }
  }
  return mat;
}

cv::Mat distanceInside(const cv::Mat& mask) {
  cv::Mat distance;
  cv::distanceTransform(mask, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  return distance;
}

class HoleSearch {
 public:
  HoleSearch(const BitImage& ink, const GreyImage& grey) : grey_(grey), ink_(matOf(ink)) {
    const cv::Mat paper = ink_ == 0;
    cv::Mat boxes, centroids;
    const int count = cv::connectedComponentsWithStats(paper, region_, boxes, centroids, 4, CV_32S);
    outside_ = region_.at<int>(0, 0);
    holes_.resize(count);
    for (int i = 0; i < count; ++i) {
      holes_[i].box = {boxes.at<int>(i, cv::CC_STAT_LEFT), boxes.at<int>(i, cv::CC_STAT_TOP),
                       boxes.at<int>(i, cv::CC_STAT_WIDTH), boxes.at<int>(i, cv::CC_STAT_HEIGHT)};
    }
    if (!any()) return;
    measureWidths(distanceInside(paper));
    filled_ = distanceInside(region_ != outside_);
  }

  bool any() const { return holes_.size() > 2; }  // ink is one region, paper around it another

  // Which regions are holes of texture.
  std::vector<bool> texture(const RunContext& context) {
    std::vector<double> all;
    for (int i = 0; i < static_cast<int>(holes_.size()); ++i) {
      if (i % kHolesPerLook == 0 && context.isCancelled()) return {};
      InkHole& hole = holes_[i];
      if (!isHole(i) || hole.widthPx >= kWideHole * shapeWidth(hole)) continue;
      hole.uneven = unevennessAround(i);
      all.push_back(hole.uneven);
    }
    std::vector<bool> isTexture(holes_.size(), false);
    if (all.empty()) return isTexture;
    const double limit = upperMedian(all) >= kEvenInk ? kVeryEvenInk : kEvenInk;
    std::vector<double> widths;
    for (const InkHole& hole : holes_) {
      if (hole.uneven >= limit) widths.push_back(hole.widthPx);
    }
    if (static_cast<int>(widths.size()) < kFewHoles) return isTexture;
    const double wide = kFarWider * upperMedian(widths);
    for (std::size_t i = 0; i < holes_.size(); ++i)
      isTexture[i] = holes_[i].uneven >= limit && holes_[i].widthPx < wide;
    return isTexture;
  }

  EvenInk filled(BitImage ink, const std::vector<bool>& isTexture) const {
    for (std::size_t i = 0; i < isTexture.size(); ++i) {
      if (!isTexture[i]) continue;
      overHole(static_cast<int>(i), [&](const cv::Point& p) { ink.set(p.x - kMargin, p.y - kMargin, true); });
    }
    return {std::move(ink), static_cast<int>(std::count(isTexture.begin(), isTexture.end(), true))};
  }

 private:
  bool isHole(int i) const { return i != outside_ && holes_[i].widthPx > 0.0; }

  template <class Visit>
  void overHole(int i, const Visit& visit) const {
    const cv::Rect& box = holes_[i].box;
    for (int y = box.y; y < box.y + box.height; ++y) {
      for (int x = box.x; x < box.x + box.width; ++x) {
        if (region_.at<int>(y, x) == i) visit(cv::Point(x, y));
      }
    }
  }

  double greyAt(int x, int y) const {
    return static_cast<double>(
        grey_.level(std::clamp(x - kMargin, 0, grey_.width - 1), std::clamp(y - kMargin, 0, grey_.height - 1)));
  }

  void measureWidths(const cv::Mat& toInk) {
    for (int y = 0; y < ink_.rows; ++y) {
      for (int x = 0; x < ink_.cols; ++x) {
        const int region = region_.at<int>(y, x);
        if (region == outside_ || ink_.at<std::uint8_t>(y, x) != 0) continue;
        InkHole& hole = holes_[region];
        const double width = 2.0 * static_cast<double>(toInk.at<float>(y, x)) - 1.0;
        if (width > hole.widthPx) {
          hole.widthPx = width;
          hole.middle = {x, y};
        }
        hole.brightest = std::max(hole.brightest, greyAt(x, y));
      }
    }
  }

  // [px] Of the shape with its holes filled, across the hole: uphill to the middle of the shape.
  double shapeWidth(const InkHole& hole) const {
    constexpr int kAroundPx = 2;
    cv::Point at = hole.middle;
    for (;;) {
      cv::Point best = at;
      for (int y = std::max(0, at.y - kAroundPx); y <= std::min(filled_.rows - 1, at.y + kAroundPx); ++y) {
        for (int x = std::max(0, at.x - kAroundPx); x <= std::min(filled_.cols - 1, at.x + kAroundPx); ++x) {
          if (filled_.at<float>(y, x) > filled_.at<float>(best)) best = {x, y};
        }
      }
      if (best == at) return 2.0 * static_cast<double>(filled_.at<float>(at)) - 1.0;
      at = best;
    }
  }

  // 0 where there is too little ink to tell.
  double unevennessAround(int number) const {
    const InkHole& hole = holes_[number];
    const int around = static_cast<int>(kInkAroundPx);
    const cv::Rect box =
        cv::Rect(hole.box.x - around, hole.box.y - around, hole.box.width + 2 * around, hole.box.height + 2 * around) &
        cv::Rect(0, 0, ink_.cols, ink_.rows);
    const cv::Mat toPaper = distanceInside(ink_(box)), toHole = distanceInside(region_(box) != number);
    std::vector<double> levels;
    for (int y = 0; y < box.height; ++y) {
      for (int x = 0; x < box.width; ++x) {
        const bool isInside = static_cast<double>(toPaper.at<float>(y, x)) >= kSoftBorderPx;
        if (!isInside || static_cast<double>(toHole.at<float>(y, x)) > kInkAroundPx) continue;
        levels.push_back(greyAt(box.x + x, box.y + y));
      }
    }
    if (static_cast<int>(levels.size()) < kFewestInkPixels) return 0.0;
    const double middle = upperMedian(levels);
    for (double& level : levels) level -= middle;
    return robustSigma(levels) / std::max(1.0, hole.brightest - middle);
  }

  const GreyImage& grey_;
  cv::Mat ink_, region_, filled_;  // ink 255; number of the region, all ink is one; distance from the outer border
  int outside_ = 0;
  std::vector<InkHole> holes_;  // by region
};

}  // namespace

EvenInk fillTextureHoles(BitImage ink, const GreyImage& grey, const RunContext& context) {
  if (ink.width <= 0 || ink.height <= 0) return {std::move(ink), 0};
  try {
    HoleSearch search(ink, grey);
    if (!search.any() || context.isCancelled()) return {std::move(ink), 0};
    return search.filled(std::move(ink), search.texture(context));
  } catch (const cv::Exception&) {
    throw std::bad_alloc();
  }
}

}  // namespace batten
