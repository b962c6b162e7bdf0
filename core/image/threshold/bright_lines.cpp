// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/threshold/bright_lines.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/base/parallel.h"
#include "core/base/statistics.h"
#include "core/image/plane.h"

namespace batten {
namespace {

constexpr int kFirstStep = 16;                     // [px] of the first look
constexpr double kDarkPage = 128.0;                // [grey] the median of a dark page is less
constexpr std::int64_t kMostLookedAt = 1'000'000;  // of the page as it is looked at closely
constexpr int kGroundCell = 32;                    // pixels of that a side: the ground is the median
constexpr float kClearly = 24.0f;                  // [grey] from the ground
constexpr double kOfBrighter = 3.0;                // times what is darker: grain and a picture with tones have less
constexpr double kLeastBright = 0.002, kMostBright = 0.35;  // of the pixels

double medianOf(const GreyImage& page) {
  std::vector<std::uint16_t> samples;
  for (int y = 0; y < page.height; y += kFirstStep)
    for (int x = 0; x < page.width; x += kFirstStep) samples.push_back(page.row(y)[x]);
  return samples.empty() ? kDarkPage : upperMedian(std::move(samples)) / static_cast<double>(GreyImage::kGreyUnit);
}

/// What differs clearly from the ground.
struct Contrast {
  double brighter = 0.0, darker = 0.0;  ///< [grey] Sums.
  std::int64_t bright = 0;              ///< Pixels.
};

Contrast contrastOfCells(const Plane& grey, int top) {
  Contrast found;
  std::vector<float> cell;
  const int bottom = std::min(grey.height, top + kGroundCell);
  for (int left = 0; left < grey.width; left += kGroundCell) {
    const int right = std::min(grey.width, left + kGroundCell);
    cell.clear();
    for (int y = top; y < bottom; ++y) cell.insert(cell.end(), grey.row(y) + left, grey.row(y) + right);
    const float ground = upperMedian(std::vector<float>(cell));
    for (const float value : cell) {
      const float off = value - ground;
      if (off > kClearly) {
        found.brighter += static_cast<double>(off);
        ++found.bright;
      } else if (off < -kClearly) {
        found.darker -= static_cast<double>(off);
      }
    }
  }
  return found;
}

}  // namespace

bool areLinesBrighter(const GreyImage& page, const RunContext& context) {
  if (page.pixels.empty() || medianOf(page) >= kDarkPage) return false;
  int shrink = 1;
  while (std::int64_t{page.width} * page.height / (shrink * shrink) > kMostLookedAt) shrink *= 2;
  const Plane grey = shrinkGrey(page, shrink, context);
  if (context.isCancelled()) return false;
  std::vector<Contrast> rows((grey.height + kGroundCell - 1) / kGroundCell);
  parallelFor(context, static_cast<int>(rows.size()), 1, [&](int begin, int end) {
    for (int j = begin; j < end; ++j) rows[j] = contrastOfCells(grey, j * kGroundCell);
  });
  if (context.isCancelled()) return false;
  Contrast all;
  for (const Contrast& row : rows) {
    all.brighter += row.brighter;
    all.darker += row.darker;
    all.bright += row.bright;
  }
  const double share = static_cast<double>(all.bright) / (1.0 * grey.width * grey.height);
  return share >= kLeastBright && share <= kMostBright && all.brighter >= kOfBrighter * all.darker;
}

}  // namespace batten
