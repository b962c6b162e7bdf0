// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/tones/without_tones.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <variant>
#include <vector>

#include "core/base/interpolation.h"
#include "core/base/parallel.h"
#include "core/image/grown_mask.h"

namespace batten {
namespace {

constexpr double kWidthPerBlur = 2.3548;  // of a Gaussian at half its height, per sigma: 2 sqrt(2 ln 2)
// sqrt(2 pi): the steepest slope of a step of 1, blurred, is 1 / (sigma sqrt(2 pi)).
constexpr double kSlopePerBlur = 2.5066;
constexpr double kBorderWidth = 0.5;  // [line widths] of the line that a border becomes
constexpr double kReach = 3.0;        // [sigmas] of the blur
constexpr int kTilePx = 64;           // of the areas' pixels, along a side

cv::Mat1b mapOf(const std::vector<std::uint8_t>& values, const ToneAreas& areas) {
  return {areas.rows, areas.columns, const_cast<std::uint8_t*>(values.data())};
}

/// One map of the areas, read between its pixels: bilinear.
class Place {
 public:
  Place(const ToneAreas& areas, int x, int y)
      : in_(areas.columns, areas.rows, (x + 0.5) / areas.pixelsPerPx - 0.5, (y + 0.5) / areas.pixelsPerPx - 0.5),
        columns_(areas.columns) {}
  double of(const std::vector<std::uint8_t>& map) const {
    return in_.of([&](int i, int j) { return at(map, i, j); }, FastBetween());
  }
  bool isPaper(const std::vector<std::uint8_t>& ground) const {
    return (at(ground, in_.left, in_.upper) & at(ground, in_.right, in_.upper) & at(ground, in_.left, in_.lower) &
            at(ground, in_.right, in_.lower)) == 255;
  }

 private:
  int at(const std::vector<std::uint8_t>& map, int i, int j) const { return map[std::ptrdiff_t{j} * columns_ + i]; }

  BilinearPlace<double> in_;
  int columns_;
};

/// Borders of tones become lines, tile by tile of the areas. @pre some are bare.
class BareBorders {
 public:
  BareBorders(const GreyImage& scanned, const ToneAreas& areas)
      : scanned_(scanned),
        areas_(areas),
        sigma_(std::max(1.0, kBorderWidth * areas.lineWidthPx / kWidthPerBlur)),
        reachPx_(static_cast<int>(std::ceil(kReach * sigma_))),
        reach_(reachPx_ / areas.pixelsPerPx + 2) {
    near_ = grownMask(mapOf(*areas.bare, areas), reach_);
  }

  int tileColumns() const { return (areas_.columns + kTilePx - 1) / kTilePx; }
  int tileRows() const { return (areas_.rows + kTilePx - 1) / kTilePx; }

  /// What does not depend on other tiles: the page is read with what the blur reaches around it.
  void drawTile(int i, int j, GreyImage& page) const {
    const cv::Rect all(0, 0, areas_.columns, areas_.rows);
    const cv::Rect tile = cv::Rect(i * kTilePx, j * kTilePx, kTilePx, kTilePx) & all;
    if (cv::countNonZero(near_(tile)) == 0) return;
    const int rim = 2 * reach_;
    const cv::Rect wide = cv::Rect(tile.x - rim, tile.y - rim, tile.width + 2 * rim, tile.height + 2 * rim) & all;
    const cv::Mat1f cover = coverOf(wide);
    const int f = areas_.pixelsPerPx;
    const int right = tile.br().x == areas_.columns ? page.width : tile.br().x * f;
    const int bottom = tile.br().y == areas_.rows ? page.height : tile.br().y * f;
    for (int y = tile.y * f; y < bottom; ++y)
      for (int x = tile.x * f; x < right; ++x) {
        if (near_(std::min(y / f, areas_.rows - 1), std::min(x / f, areas_.columns - 1)) == 0) continue;
        const int v = std::clamp(y - wide.y * f, 1, cover.rows - 2), u = std::clamp(x - wide.x * f, 1, cover.cols - 2);
        const double slope =
            std::hypot(0.5 * (cover(v, u + 1) - cover(v, u - 1)), 0.5 * (cover(v + 1, u) - cover(v - 1, u)));
        const double depth = areas_.lineDarkness / 255.0 * std::min(1.0, slope * sigma_ * kSlopePerBlur);
        page.row(y)[x] = static_cast<std::uint16_t>(std::lround(page.row(y)[x] * (1.0 - depth)));
      }
  }

 private:
  /// 0..1 of the tone, blurred, at each pixel of the page within `box`.
  cv::Mat1f coverOf(const cv::Rect& box) const {
    const int f = areas_.pixelsPerPx;
    const cv::Mat1b ground = mapOf(areas_.ground, areas_)(box), paper = mapOf(areas_.paper, areas_)(box);
    const cv::Mat1b tones = shrunkMask(ground, reach_);
    cv::Mat1f cover(box.height * f, box.width * f, 0.0f);
    for (int y = 0; y < cover.rows; ++y)
      for (int x = 0; x < cover.cols; ++x) {
        const double tone = tones(y / f, x / f);
        if (tone >= 255.0) continue;
        const double level =
            255.0 * scanned_.level(x + box.x * f, y + box.y * f) / std::max<int>(1, paper(y / f, x / f));
        cover(y, x) = static_cast<float>(std::clamp((255.0 - level) / (255.0 - tone), 0.0, 1.0));
      }
    cv::GaussianBlur(cover, cover, {2 * reachPx_ + 1, 2 * reachPx_ + 1}, sigma_, sigma_, cv::BORDER_REPLICATE);
    return cover;
  }

  const GreyImage& scanned_;
  const ToneAreas& areas_;
  double sigma_;  // [px of the page] of the blur
  int reachPx_;   // [px of the page] of the blur
  int reach_;     // the same in pixels of the areas, and a little more: the border is seen as exactly as they are
  cv::Mat1b near_;
};

/// What was filled shows no paper: it is at least as dark as lines.
std::uint16_t brightestAt(const ToneAreas& areas, const Place& place) {
  const double share = areas.filled ? place.of(*areas.filled) / 255.0 : 0.0;
  if (!(share > 0.0)) return 65535;
  const double paper = GreyImage::kGreyUnit * place.of(areas.paper);
  return static_cast<std::uint16_t>(std::lround(paper * (1.0 - share * areas.lineDarkness / 255.0)));
}

/// By what the depth below the ground is multiplied. @param ground 0..1 of the paper.
double gainAt(const ToneAreas& areas, const Place& place, double ground, double depth) {
  if (const auto* most = std::get_if<ToneAreas::MostGain>(&areas.gain))
    return std::min(1.0 / ground, place.of(most->units) / ToneAreas::kGainUnit);
  if (!(depth > 0.0)) return ToneAreas::kGrainGain;
  return place.of(std::get<ToneAreas::KnownGain>(areas.gain).units) / ToneAreas::kGainUnit;
}

}  // namespace

GreyImage withoutTones(GreyImage page, const ToneAreas& areas, const RunContext& context) {
  const GreyImage scanned = areas.bare ? page : GreyImage();
  parallelFor(context, page.height, 32, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < page.width; ++x) {
        const Place place(areas, x, y);
        page.row(y)[x] = std::min(page.row(y)[x], brightestAt(areas, place));
        if (place.isPaper(areas.ground)) continue;
        const double ground = std::max(1.0, place.of(areas.ground)) / 255.0;
        const double paper = GreyImage::kGreyUnit * place.of(areas.paper);
        const double depth = paper * ground - page.row(y)[x];
        const double bright = paper - gainAt(areas, place, ground, depth) * depth;
        page.row(y)[x] = static_cast<std::uint16_t>(std::clamp(bright + 0.5, 0.0, 65535.0));
      }
  });
  if (!areas.bare || context.isCancelled()) return page;
  const BareBorders borders(scanned, areas);
  parallelFor(context, borders.tileColumns() * borders.tileRows(), 1, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) borders.drawTile(k % borders.tileColumns(), k / borders.tileColumns(), page);
  });
  return page;
}

}  // namespace batten
