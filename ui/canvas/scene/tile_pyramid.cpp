// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/scene/tile_pyramid.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"

namespace batten {
namespace {

constexpr int kSmallestSide = 192;      // [px] of the coarsest level
constexpr double kPixelatedZoom = 3.0;  // from here on pixels are squares

TileLevel emptyLevel(int shift, int scanWidth, int scanHeight) {
  TileLevel level;
  level.shift = shift;
  level.width = std::max(1, scanWidth >> shift);
  level.height = std::max(1, scanHeight >> shift);
  level.tilesAcross = (level.width + TileLevel::kTile - 1) / TileLevel::kTile;
  const int down = (level.height + TileLevel::kTile - 1) / TileLevel::kTile;
  level.tiles.resize(std::ptrdiff_t{level.tilesAcross} * down << 16);
  return level;
}

std::uint8_t* pixel(TileLevel& level, int x, int y) { return level.tiles.data() + level.index(x, y); }

/// Number of levels after which the shorter side is small enough to paint from at any smaller zoom.
int levelCount(const GreyImage& grey) {
  int count = 0;
  while (std::max(grey.width, grey.height) >> (count + 1) >= kSmallestSide) ++count;
  return count;
}

std::uint8_t average(std::uint32_t sum, std::uint32_t unit) {
  return static_cast<std::uint8_t>((sum + unit / 2) / unit);
}

void halveScan(const GreyImage& grey, TileLevel& to, int y) {
  const std::uint16_t* upper = grey.row(std::min(2 * y, grey.height - 1));
  const std::uint16_t* lower = grey.row(std::min(2 * y + 1, grey.height - 1));
  for (int x = 0; x < to.width; ++x) {
    const int left = std::min(2 * x, grey.width - 1), right = std::min(2 * x + 1, grey.width - 1);
    const std::uint32_t sum = std::uint32_t{upper[left]} + upper[right] + lower[left] + lower[right];
    *pixel(to, x, y) = average(sum, 4 * 257);
  }
}

void halveLevel(const TileLevel& from, TileLevel& to, int y) {
  const int upper = std::min(2 * y, from.height - 1), lower = std::min(2 * y + 1, from.height - 1);
  for (int x = 0; x < to.width; ++x) {
    const int left = std::min(2 * x, from.width - 1), right = std::min(2 * x + 1, from.width - 1);
    const std::uint32_t sum =
        std::uint32_t{from.at(left, upper)} + from.at(right, upper) + from.at(left, lower) + from.at(right, lower);
    *pixel(to, x, y) = average(sum, 4);
  }
}

/// Positions and weights along one axis: what every row (or column) of the rectangle has in common.
struct Axis {
  std::vector<int> first, second;
  std::vector<int> weight;  ///< 0..256 of the second.
  int begin = 0, end = 0;   ///< The part of the rectangle that lies on the page.
};

Axis axisFor(int from, int count, double zoom, int shift, int size, int scanSize) {
  Axis axis;
  axis.first.resize(count);
  axis.second = axis.first;
  axis.weight = axis.first;
  axis.begin = count;
  const double scale = 1.0 / (1 << shift);
  for (int i = 0; i < count; ++i) {
    const double scanPlace = (from + i + 0.5) / zoom;
    if (scanPlace < 0.0 || scanPlace >= scanSize) continue;
    axis.begin = std::min(axis.begin, i);
    axis.end = i + 1;
    if (zoom >= kPixelatedZoom) {
      axis.first[i] = axis.second[i] = std::min(size - 1, static_cast<int>(scanPlace * scale));
      continue;
    }
    const double place = scanPlace * scale - 0.5;
    const double cell = std::floor(place);
    axis.first[i] = std::clamp(static_cast<int>(cell), 0, size - 1);
    axis.second[i] = std::clamp(static_cast<int>(cell) + 1, 0, size - 1);
    axis.weight[i] = static_cast<int>(256.0 * (place - cell));
  }
  return axis;
}

template <class At>
void blend(const Axis& columns, const Axis& rows, int width, std::uint8_t* out, At&& at) {
  for (int j = rows.begin; j < rows.end; ++j) {
    const int wy = rows.weight[j], y0 = rows.first[j], y1 = rows.second[j];
    std::uint8_t* to = out + std::ptrdiff_t{j} * width;
    for (int i = columns.begin; i < columns.end; ++i) {
      const int c = i;
      const int wx = columns.weight[c], x0 = columns.first[c], x1 = columns.second[c];
      const int upper = at(x0, y0) * (256 - wx) + at(x1, y0) * wx;
      const int lower = at(x0, y1) * (256 - wx) + at(x1, y1) * wx;
      to[c] = static_cast<std::uint8_t>((upper * (256 - wy) + lower * wy + (1 << 15)) >> 16);
    }
  }
}

}  // namespace

const TileLevel* TilePyramid::levelFor(double zoom) const {
  const int wanted = std::max(0, static_cast<int>(std::floor(std::log2(1.0 / std::max(zoom, 1e-6)) + 0.5)));
  if (wanted == 0 && (isComplete || levels.empty())) return nullptr;
  const TileLevel* best = nullptr;
  for (const TileLevel& level : levels) {
    if (level.tiles.empty()) continue;
    best = &level;
    if (level.shift >= wanted) break;
  }
  return best;
}

std::shared_ptr<const TilePyramid> coarsePyramid(std::shared_ptr<const Scan> scan) {
  auto pyramid = std::make_shared<TilePyramid>();
  const GreyImage& grey = scan->grey;
  const int shift = std::max(0, levelCount(grey) - 1);
  if (shift > 0) {
    TileLevel level = emptyLevel(shift, grey.width, grey.height);
    const int step = 1 << shift;
    // Four samples a pixel: rough, and there at once.
    for (int y = 0; y < level.height; ++y) {
      const std::uint16_t* upper = grey.row(std::min(y * step + step / 4, grey.height - 1));
      const std::uint16_t* lower = grey.row(std::min(y * step + 3 * step / 4, grey.height - 1));
      for (int x = 0; x < level.width; ++x) {
        const int left = std::min(x * step + step / 4, grey.width - 1);
        const int right = std::min(x * step + 3 * step / 4, grey.width - 1);
        *pixel(level, x, y) = average(std::uint32_t{upper[left]} + upper[right] + lower[left] + lower[right], 4 * 257);
      }
    }
    pyramid->levels.push_back(std::move(level));
  } else {
    pyramid->isComplete = true;
  }
  pyramid->scan = std::move(scan);
  return pyramid;
}

std::shared_ptr<const TilePyramid> buildPyramid(std::shared_ptr<const Scan> scan, const RunContext& context) {
  auto pyramid = std::make_shared<TilePyramid>();
  const GreyImage& grey = scan->grey;
  for (int shift = 1; shift <= levelCount(grey); ++shift) {
    TileLevel level = emptyLevel(shift, grey.width, grey.height);
    parallelFor(context, level.height, 64, [&](int begin, int end) {
      for (int y = begin; y < end; ++y)
        shift == 1 ? halveScan(grey, level, y) : halveLevel(pyramid->levels.back(), level, y);
    });
    if (context.isCancelled()) return nullptr;
    pyramid->levels.push_back(std::move(level));
  }
  pyramid->isComplete = true;
  pyramid->scan = std::move(scan);
  return pyramid;
}

void sampleGrey(const TilePyramid& pyramid, double zoom, const QRect& device, std::uint8_t* out) {
  const GreyImage& grey = pyramid.scan->grey;
  const TileLevel* level = pyramid.levelFor(zoom);
  const int shift = level ? level->shift : 0;
  const int width = level ? level->width : grey.width, height = level ? level->height : grey.height;
  const Axis columns = axisFor(device.x(), device.width(), zoom, shift, width, grey.width);
  const Axis rows = axisFor(device.y(), device.height(), zoom, shift, height, grey.height);
  if (level)
    blend(columns, rows, device.width(), out, [level](int x, int y) { return static_cast<int>(level->at(x, y)); });
  else
    blend(columns, rows, device.width(), out, [&grey](int x, int y) { return (grey.row(y)[x] * 255 + 32768) >> 16; });
}

}  // namespace batten
