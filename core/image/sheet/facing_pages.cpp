// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/sheet/facing_pages.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "core/base/parallel.h"
#include "core/base/statistics.h"
#include "core/image/grown_mask.h"
#include "core/image/sheet/mask_outline.h"
#include "core/image/sheet/sheet_levels.h"

namespace batten {
namespace {

constexpr double kMostGutterShare = 0.04;  // of the diagonal: the gutter of an open book with its shadow
constexpr double kLeastAlongGutter = 0.3;  // of the longer side of the facing page lies along the gutter
// [grey] By which the tint of its paper may differ, as light falls on it from another side; of what is like the other
// page in size and place, as light from the desk may tint one page.
constexpr float kMostPaperTint = 14.0f, kMostTintOfPages = 30.0f;
constexpr double kLeastAlike = 0.8, kLeastConvex = 0.92;  // of the larger page; of its hull
constexpr double kShadingShare = 0.12;                    // of the diagonal: farther from the gutter paper is flat
constexpr int kGutterStepCells = 10;                      // from one value along the gutter to the next
constexpr int kAlongReach = 2;                            // values to either side that are counted with one
constexpr double kPaperRankBesideGutter = 0.75;  // of the cells at one distance: at least a quarter is free of ink
constexpr double kDarkestBesideGutter = 0.6, kDarkestFlat = 0.9;  // of the flat paper: what is darker was drawn
constexpr double kBrightest = 1.1;                                // of the flat paper: no level is higher

cv::Mat1b grown(const cv::Mat1b& mask, double shareOfDiagonal) {
  return grownMask(mask, static_cast<int>(std::ceil(shareOfDiagonal * std::hypot(mask.cols, mask.rows))));
}

/// Whether a part is like the other page of a book: as large, as high beside the gutter, and convex.
/// @param gutter the box of what lies along it.
bool areAlike(const cv::Mat1b& page, const cv::Mat1b& other, const cv::Rect& gutter) {
  const double area = cv::countNonZero(page), otherArea = cv::countNonZero(other);
  if (std::min(area, otherArea) < kLeastAlike * std::max(area, otherArea)) return false;
  const cv::Rect a = cv::boundingRect(page), b = cv::boundingRect(other), both = a | b;
  const bool isUpright = gutter.height >= gutter.width;
  const int shared =
      isUpright ? std::min(a.br().y, b.br().y) - std::max(a.y, b.y) : std::min(a.br().x, b.br().x) - std::max(a.x, b.x);
  if (shared < kLeastAlike * (isUpright ? both.height : both.width)) return false;
  return area >= kLeastConvex * cv::contourArea(hullOf(page));
}

struct TwoPages {
  std::array<cv::Mat1b, 2> masks;
};

/// The two largest parts; absent if the second is no page beside the first.
std::optional<TwoPages> pagesOf(const BitImage& inside) {
  cv::Mat1b all(inside.height, inside.width, static_cast<unsigned char>(0));
  for (int j = 0; j < all.rows; ++j) {
    for (int i = 0; i < all.cols; ++i) all(j, i) = inside.at(i, j) ? 255 : 0;
  }
  cv::Mat1i labels;
  cv::Mat stats, centres;
  const int count = cv::connectedComponentsWithStats(all, labels, stats, centres, 4, CV_32S);
  std::vector<int> order;
  for (int k = 1; k < count; ++k) order.push_back(k);
  const auto area = [&](int k) { return stats.at<int>(k, cv::CC_STAT_AREA); };
  std::ranges::stable_sort(order, [&](int a, int b) { return area(a) > area(b); });
  if (order.size() < 2 || area(order[1]) < kLeastFacingPage * area(order[0])) return std::nullopt;
  return TwoPages{{cv::Mat1b(labels == order[0]), cv::Mat1b(labels == order[1])}};
}

/// Where a cell lies as seen from the gutter, in cells.
struct GutterFrame {
  cv::Mat1f distance;  ///< From the other page.
  cv::Point2f middle, along{0.0f, 1.0f};
  float alongAt(int i, int j) const {
    return (static_cast<float>(i) - middle.x) * along.x + (static_cast<float>(j) - middle.y) * along.y;
  }
};

GutterFrame frameOf(const cv::Mat1b& page, const cv::Mat1b& other) {
  GutterFrame frame;
  cv::distanceTransform(other == 0, frame.distance, cv::DIST_L2, cv::DIST_MASK_5);
  std::vector<cv::Point> places;
  cv::findNonZero(grown(other, kMostGutterShare) & page, places);
  if (places.size() < 2) return frame;
  cv::Vec4f line;
  cv::fitLine(places, line, cv::DIST_L2, 0.0, 0.01, 0.01);
  frame.along = {line[0], line[1]};
  frame.middle = {line[2], line[3]};
  return frame;
}

/// Level of the paper of one page by distance from the gutter and place along it.
class GutterShading {
 public:
  GutterShading(const cv::Mat1f& levels, const cv::Mat1b& page, const cv::Mat1b& other) : frame_(frameOf(page, other)) {
    const double diagonal = std::hypot(page.cols, page.rows);
    distances_ = std::max(2, static_cast<int>(kShadingShare * diagonal));
    reach_ = static_cast<float>(diagonal);
    stations_ = 2 * static_cast<int>(diagonal / kGutterStepCells) + 1;
    std::vector<std::vector<float>> bins(std::size_t(distances_) * std::size_t(stations_));
    for (int j = 0; j < page.rows; ++j) {
      for (int i = 0; i < page.cols; ++i) {
        if (page(j, i) == 0 || frame_.distance(j, i) >= static_cast<float>(distances_)) continue;
        bins[index(static_cast<int>(frame_.distance(j, i)), nearestStation(i, j))].push_back(levels(j, i));
      }
    }
    collect(bins);
  }
  /// Absent where nothing is known.
  std::optional<float> at(int i, int j) const {
    const float d = std::clamp(frame_.distance(j, i) - 0.5f, 0.0f, static_cast<float>(distances_ - 1));
    const float s = std::clamp(stationOf(i, j), 0.0f, static_cast<float>(stations_ - 1));
    const int d0 = std::min(static_cast<int>(d), distances_ - 2), s0 = std::min(static_cast<int>(s), stations_ - 2);
    const float u = d - static_cast<float>(d0), v = s - static_cast<float>(s0);
    float sum = 0.0f, weight = 0.0f;
    for (const int a : {0, 1}) {
      for (const int b : {0, 1}) {
        const std::optional<float>& level = levels_[index(d0 + a, s0 + b)];
        if (!level) continue;
        const float w = (a ? u : 1.0f - u) * (b ? v : 1.0f - v);
        sum += w * *level;
        weight += w;
      }
    }
    return weight > 0.0f ? std::optional(sum / weight) : std::nullopt;
  }

 private:
  std::size_t index(int distance, int station) const {
    return std::size_t(distance) * std::size_t(stations_) + std::size_t(station);
  }
  float stationOf(int i, int j) const { return (frame_.alongAt(i, j) + reach_) / kGutterStepCells; }
  int nearestStation(int i, int j) const {
    return std::clamp(static_cast<int>(std::lround(stationOf(i, j))), 0, stations_ - 1);
  }
  void collect(const std::vector<std::vector<float>>& bins) {
    levels_.assign(bins.size(), std::nullopt);
    std::vector<float> values;
    for (int d = 0; d < distances_; ++d) {
      for (int s = 0; s < stations_; ++s) {
        values.clear();
        for (int k = std::max(0, s - kAlongReach); k <= std::min(stations_ - 1, s + kAlongReach); ++k) {
          const std::vector<float>& bin = bins[index(d, k)];
          values.insert(values.end(), bin.begin(), bin.end());
        }
        if (values.empty()) continue;
        const float level = lowerQuantile(values, kPaperRankBesideGutter);
        if (level > 0.0f) levels_[index(d, s)] = level;
      }
    }
    // Between the page and the gutter, and beyond its edges, the nearest distance that holds cells counts.
    for (int s = 0; s < stations_; ++s) {
      for (int d = 1; d < distances_; ++d)
        if (!levels_[index(d, s)]) levels_[index(d, s)] = levels_[index(d - 1, s)];
      for (int d = distances_ - 2; d >= 0; --d)
        if (!levels_[index(d, s)]) levels_[index(d, s)] = levels_[index(d + 1, s)];
    }
    leaveOutTones();
  }
  /// Paper dims towards the gutter, and only so much: a dark area within it is a tone that was drawn.
  void leaveOutTones() {
    std::vector<float> outer;
    for (int s = 0; s < stations_; ++s)
      if (const auto& level = levels_[index(distances_ - 1, s)]) outer.push_back(*level);
    if (outer.empty()) return;
    const double flat = static_cast<double>(upperMedian(outer));
    for (int s = 0; s < stations_; ++s) {
      float brightest = 0.0f;
      for (int d = 0; d < distances_; ++d) {
        std::optional<float>& level = levels_[index(d, s)];
        if (!level) continue;
        brightest = std::max(brightest, *level);
        const double least = std::lerp(kDarkestBesideGutter, kDarkestFlat, d / (distances_ - 1.0)) * flat;
        level = static_cast<float>(std::clamp(static_cast<double>(brightest), least, kBrightest * flat));
      }
    }
  }

  GutterFrame frame_;
  int distances_ = 0, stations_ = 0;
  float reach_ = 0.0f;
  std::vector<std::optional<float>> levels_;
};

}  // namespace

bool isFacingPage(const cv::Mat1b& page, const cv::Mat1b& sheet, const SheetCells& cells, const ShadedPaper& shaded) {
  const int right = page.cols - 1, bottom = page.rows - 1;
  const auto isAt = [&](int x, int y) { return page(y, x) != 0 ? 1 : 0; };
  if (isAt(0, 0) + isAt(right, 0) + isAt(0, bottom) + isAt(right, bottom) > 1) return false;
  const cv::Rect along = cv::boundingRect(cv::Mat1b(grown(sheet, kMostGutterShare) & page));
  const cv::Rect box = cv::boundingRect(page);
  if (std::max(along.width, along.height) < kLeastAlongGutter * std::max(box.width, box.height)) return false;
  const PaperLook of = paperLookOf(page, cells), with = paperLookOf(sheet, cells);
  const auto [darker, brighter] = std::minmax(of.colour[0], with.colour[0]);
  if (static_cast<double>(darker) < kDarkestOnSheet * static_cast<double>(brighter)) return false;
  const float most = areAlike(page, sheet, along) ? kMostTintOfPages : kMostPaperTint;
  for (const int k : {1, 2})
    if (std::fabs(of.colour[k] - with.colour[k]) > most) return false;
  const double grainOf = std::max(cv::mean(cells.rough, page)[0], kLeastGrain);
  const double grainWith = std::max(cv::mean(cells.rough, sheet)[0], kLeastGrain);
  if (std::max(grainOf, grainWith) > kSameGrain * std::min(grainOf, grainWith)) return false;
  return shaded.isDrawnOn(page);
}

std::optional<GreyImage> pagesOnOneLevel(const GreyImage& page, const BitImage& inside, int cellPx,
                                         const RunContext& context) {
  const std::optional<TwoPages> pages = pagesOf(inside);
  if (!pages) return std::nullopt;
  std::vector<float> levels = levelsOfCells(page, inside, cellPx, context);
  if (context.isCancelled()) return std::nullopt;
  const cv::Mat1f ofCells(inside.height, inside.width, levels.data());
  std::vector<float> all;
  std::ranges::copy_if(levels, std::back_inserter(all), [](float level) { return level > 0.0f; });
  const float target = upperMedian(all);
  std::vector<float> gain(levels.size(), 1.0f);
  for (const int k : {0, 1}) {
    const GutterShading shading(ofCells, pages->masks[k], pages->masks[1 - k]);
    // One cell farther, for the values between cells.
    cv::Mat1b around;
    cv::dilate(pages->masks[k], around, cv::getStructuringElement(cv::MORPH_RECT, {3, 3}));
    for (int j = 0; j < inside.height; ++j) {
      for (int i = 0; i < inside.width; ++i) {
        const std::optional<float> level = around(j, i) != 0 ? shading.at(i, j) : std::nullopt;
        if (level) gain[std::ptrdiff_t{j} * inside.width + i] = target / *level;
      }
    }
  }
  GreyImage out = page;
  parallelFor(context, page.height, kRowsPerBlock, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const RowBetweenCells row(gain, inside.width, cellPx, y);
      std::uint16_t* at = out.row(y);
      for (int x = 0; x < page.width; ++x)
        at[x] = static_cast<std::uint16_t>(std::clamp(at[x] * row.at(x), 0.0, 65535.0));
    }
  });
  return out;
}

}  // namespace batten
