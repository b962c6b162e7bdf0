// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/line_means.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/base/hot_loop.h"
#include "core/base/parallel.h"

namespace batten {
namespace {

constexpr int kMeansTilePx = 128;          // [px] side of a tile
constexpr int kWays = 20;                  // directions of half a turn: their ends are a line's width apart
constexpr double kWayAcrossWidths = 0.35;  // standard deviation of the mean across the line
constexpr double kWayReach = 2.5;          // [standard deviations] along it: beyond is hardly any weight
constexpr double kWayStepWidths = 0.5;     // along it, from place to place
constexpr double kWaySideWidths = 1.3;  // from the middle of a line to those at its sides, clear of its blurred border

struct Tap {
  int x, y;
  float weight;
};

/// One direction: the places of a mean along it, and the step to the one at its left.
struct Way {
  std::vector<Tap> taps;
  cv::Point side;
};

std::vector<Way> waysFor(double widthPx, double alongPx) {
  std::vector<Way> ways;
  const double step = std::max(1.0, kWayStepWidths * widthPx);
  const int count = static_cast<int>(kWayReach * alongPx / step);
  const auto rounded = [](double v) { return static_cast<int>(std::lround(v)); };
  const auto weightAt = [&](int i) { return std::exp(-0.5 * std::pow(i * step / alongPx, 2)); };
  double sum = 0.0;
  for (int i = -count; i <= count; ++i) sum += weightAt(i);
  for (int k = 0; k < kWays; ++k) {
    const double a = std::numbers::pi * k / kWays, x = std::cos(a), y = std::sin(a);
    Way way;
    for (int i = -count; i <= count; ++i)
      way.taps.push_back({rounded(i * step * x), rounded(i * step * y), static_cast<float>(weightAt(i) / sum)});
    way.side = {rounded(-kWaySideWidths * widthPx * y), rounded(kWaySideWidths * widthPx * x)};
    ways.push_back(std::move(way));
  }
  return ways;
}

BATTEN_HOT_LOOP void addWeighted(const float* from, float weight, int count, float* to) {
  for (int i = 0; i < count; ++i) to[i] += weight * from[i];
}

BATTEN_HOT_LOOP void compareSides(const float* middle, const float* left, const float* right, int count, float* depth,
                                  float* squares) {
  for (int i = 0; i < count; ++i) {
    const float least = (left[i] < right[i] ? left[i] : right[i]) - middle[i];
    depth[i] = least > depth[i] ? least : depth[i];
    const float both = 0.5f * (left[i] + right[i]) - middle[i];
    squares[i] += both * both;
  }
}

/// One tile of the page. @param level with `rim` around it, which the ways reach.
void meansOfTile(const cv::Mat1f& level, int rim, const std::vector<Way>& ways, int sidePx, const cv::Rect& tile,
                 LineMeans& means) {
  cv::Mat1f mean(tile.height + 2 * sidePx, tile.width + 2 * sidePx);
  cv::Mat1f depth = means.depth(tile), squares(tile.size(), 0.0f);
  for (const Way& way : ways) {
    mean = 0.0f;
    for (int y = 0; y < mean.rows; ++y)
      for (const Tap& tap : way.taps)
        addWeighted(level[tile.y + y - sidePx + rim + tap.y] + tile.x - sidePx + rim + tap.x, tap.weight, mean.cols,
                    mean[y]);
    for (int y = 0; y < tile.height; ++y)
      compareSides(mean[y + sidePx] + sidePx, mean[y + sidePx + way.side.y] + sidePx + way.side.x,
                   mean[y + sidePx - way.side.y] + sidePx - way.side.x, tile.width, depth[y], squares[y]);
  }
  cv::Mat1f spread = means.spread(tile);
  cv::sqrt(squares / static_cast<double>(kWays), spread);
}

}  // namespace

LineMeans meansAlongLines(const cv::Mat1f& level, double widthPx, double alongPx, const cv::Mat1b& where,
                          const RunContext& context) {
  LineMeans means{cv::Mat1f::zeros(level.size()), cv::Mat1f::zeros(level.size())};
  const std::vector<Way> ways = waysFor(widthPx, alongPx);
  const int sidePx = static_cast<int>(std::ceil(kWaySideWidths * widthPx)) + 1;
  const int rim = sidePx + static_cast<int>(std::ceil(kWayReach * alongPx)) + 1;
  cv::Mat1f smooth;
  cv::GaussianBlur(level, smooth, {}, kWayAcrossWidths * widthPx, 0.0, cv::BORDER_REPLICATE);
  cv::copyMakeBorder(smooth, smooth, rim, rim, rim, rim, cv::BORDER_REPLICATE);
  const int columns = (level.cols + kMeansTilePx - 1) / kMeansTilePx,
            rows = (level.rows + kMeansTilePx - 1) / kMeansTilePx;
  const cv::Rect all({0, 0}, level.size());
  parallelFor(context, columns * rows, 1, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) {
      const cv::Rect tile =
          cv::Rect(k % columns * kMeansTilePx, k / columns * kMeansTilePx, kMeansTilePx, kMeansTilePx) & all;
      if (cv::countNonZero(where(tile)) > 0) meansOfTile(smooth, rim, ways, sidePx, tile, means);
    }
  });
  return means;
}

}  // namespace batten
