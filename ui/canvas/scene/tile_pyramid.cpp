// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/canvas/scene/tile_pyramid.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"

namespace batten {
namespace {

constexpr int kSmallestSide = 192;      // [px] of the coarsest level
constexpr double kPixelatedZoom = 3.0;  // from here on pixels are squares

TileLevel emptyLevel(int shift, const Scan& scan) {
  TileLevel level;
  level.shift = shift;
  level.width = std::max(1, scan.grey.width >> shift);
  level.height = std::max(1, scan.grey.height >> shift);
  level.tilesAcross = (level.width + TileLevel::kTile - 1) / TileLevel::kTile;
  const int down = (level.height + TileLevel::kTile - 1) / TileLevel::kTile;
  level.tiles.resize(std::ptrdiff_t{level.tilesAcross} * down << 16);
  if (!scan.colour.isEmpty()) level.colours.resize(level.tiles.size());
  return level;
}

/// Number of levels after which the longer side is small enough to paint from at any smaller zoom.
int levelCount(const GreyImage& grey) {
  int count = 0;
  while (std::max(grey.width, grey.height) >> (count + 1) >= kSmallestSide) ++count;
  return count;
}

std::uint8_t average(std::uint32_t sum, std::uint32_t unit) {
  return static_cast<std::uint8_t>((sum + unit / 2) / unit);
}

Rgb8 average(const Rgb8& a, const Rgb8& b, const Rgb8& c, const Rgb8& d) {
  const auto mean = [](int p, int q, int r, int t) { return static_cast<std::uint8_t>((p + q + r + t + 2) / 4); };
  return {mean(a.red, b.red, c.red, d.red), mean(a.green, b.green, c.green, d.green),
          mean(a.blue, b.blue, c.blue, d.blue)};
}

void halveScan(const Scan& scan, TileLevel& to, int y) {
  const int above = std::min(2 * y, scan.grey.height - 1), below = std::min(2 * y + 1, scan.grey.height - 1);
  const std::uint16_t *upper = scan.grey.row(above), *lower = scan.grey.row(below);
  for (int x = 0; x < to.width; ++x) {
    const int left = std::min(2 * x, scan.grey.width - 1), right = std::min(2 * x + 1, scan.grey.width - 1);
    const std::uint32_t sum = std::uint32_t{upper[left]} + upper[right] + lower[left] + lower[right];
    to.tiles[to.index(x, y)] = average(sum, 4 * 257);
  }
  if (to.colours.empty()) return;
  const Rgb8 *first = scan.colour.row(above), *second = scan.colour.row(below);
  for (int x = 0; x < to.width; ++x) {
    const int left = std::min(2 * x, scan.grey.width - 1), right = std::min(2 * x + 1, scan.grey.width - 1);
    to.colours[to.index(x, y)] = average(first[left], first[right], second[left], second[right]);
  }
}

void halveLevel(const TileLevel& from, TileLevel& to, int y) {
  const int upper = std::min(2 * y, from.height - 1), lower = std::min(2 * y + 1, from.height - 1);
  for (int x = 0; x < to.width; ++x) {
    const int left = std::min(2 * x, from.width - 1), right = std::min(2 * x + 1, from.width - 1);
    const std::uint32_t sum =
        std::uint32_t{from.at(left, upper)} + from.at(right, upper) + from.at(left, lower) + from.at(right, lower);
    to.tiles[to.index(x, y)] = average(sum, 4);
    if (!to.colours.empty())
      to.colours[to.index(x, y)] = average(from.colourAt(left, upper), from.colourAt(right, upper),
                                           from.colourAt(left, lower), from.colourAt(right, lower));
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

/// Goes over the rectangle and mixes the four pixels around each place. @param mix of four values and two weights.
template <class At, class Mix, class Value>
void blend(const Axis& columns, const Axis& rows, int width, Value* out, const At& at, const Mix& mix) {
  for (int j = rows.begin; j < rows.end; ++j) {
    const int wy = rows.weight[j], y0 = rows.first[j], y1 = rows.second[j];
    Value* to = out + std::ptrdiff_t{j} * width;
    for (int i = columns.begin; i < columns.end; ++i) {
      const int x0 = columns.first[i], x1 = columns.second[i];
      to[i] = mix(at(x0, y0), at(x1, y0), at(x0, y1), at(x1, y1), columns.weight[i], wy);
    }
  }
}

std::uint8_t mixedGrey(int a, int b, int c, int d, int wx, int wy) {
  const int upper = a * (256 - wx) + b * wx, lower = c * (256 - wx) + d * wx;
  return static_cast<std::uint8_t>((upper * (256 - wy) + lower * wy + (1 << 15)) >> 16);
}

QRgb mixedColour(const Rgb8& a, const Rgb8& b, const Rgb8& c, const Rgb8& d, int wx, int wy) {
  return qRgb(mixedGrey(a.red, b.red, c.red, d.red, wx, wy), mixedGrey(a.green, b.green, c.green, d.green, wx, wy),
              mixedGrey(a.blue, b.blue, c.blue, d.blue, wx, wy));
}

/// The level to paint from, and what the rectangle takes of it.
struct Sampled {
  const TileLevel* level;  ///< Null: the scan itself.
  Axis columns, rows;

  Sampled(const TilePyramid& pyramid, double zoom, const QRect& device) : level(pyramid.levelFor(zoom)) {
    const GreyImage& grey = pyramid.scan->grey;
    const int shift = level ? level->shift : 0;
    columns = axisFor(device.x(), device.width(), zoom, shift, level ? level->width : grey.width, grey.width);
    rows = axisFor(device.y(), device.height(), zoom, shift, level ? level->height : grey.height, grey.height);
  }
};

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
    TileLevel level = emptyLevel(shift, *scan);
    const int step = 1 << shift;
    // Four samples a pixel: rough, and there at once.
    for (int y = 0; y < level.height; ++y) {
      const int above = std::min(y * step + step / 4, grey.height - 1);
      const int below = std::min(y * step + 3 * step / 4, grey.height - 1);
      const std::uint16_t *upper = grey.row(above), *lower = grey.row(below);
      for (int x = 0; x < level.width; ++x) {
        const int left = std::min(x * step + step / 4, grey.width - 1);
        const int right = std::min(x * step + 3 * step / 4, grey.width - 1);
        const std::ptrdiff_t at = level.index(x, y);
        level.tiles[at] = average(std::uint32_t{upper[left]} + upper[right] + lower[left] + lower[right], 4 * 257);
        if (level.colours.empty()) continue;
        const Rgb8 *first = scan->colour.row(above), *second = scan->colour.row(below);
        level.colours[at] = average(first[left], first[right], second[left], second[right]);
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
  for (int shift = 1; shift <= levelCount(scan->grey); ++shift) {
    TileLevel level = emptyLevel(shift, *scan);
    parallelFor(context, level.height, 64, [&](int begin, int end) {
      for (int y = begin; y < end; ++y)
        shift == 1 ? halveScan(*scan, level, y) : halveLevel(pyramid->levels.back(), level, y);
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
  const Sampled from(pyramid, zoom, device);
  if (from.level)
    blend(
        from.columns, from.rows, device.width(), out, [&](int x, int y) { return int{from.level->at(x, y)}; },
        mixedGrey);
  else
    blend(
        from.columns, from.rows, device.width(), out,
        [&grey](int x, int y) { return (grey.row(y)[x] * 255 + 32768) >> 16; }, mixedGrey);
}

void sampleColours(const TilePyramid& pyramid, double zoom, const QRect& device, QRgb* out) {
  const ColourImage& colour = pyramid.scan->colour;
  const Sampled from(pyramid, zoom, device);
  if (from.level)
    blend(
        from.columns, from.rows, device.width(), out, [&](int x, int y) { return from.level->colourAt(x, y); },
        mixedColour);
  else
    blend(
        from.columns, from.rows, device.width(), out, [&colour](int x, int y) { return colour.row(y)[x]; },
        mixedColour);
}

}  // namespace batten
