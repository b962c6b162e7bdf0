// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <random>

#include "core/image/scan.h"
#include "core/image/sheet/paper_sheet.h"

namespace batten::test {

inline constexpr int kPhotoWidth = 820, kPhotoHeight = 640;

/// A photograph, pixel by pixel: grey of what lies at a place, and how rough it is there.
struct PhotoPixel {
  double grey = 235.0, rough = 1.5;
};
inline Scan photo(const std::function<PhotoPixel(double, double)>& at) {
  Scan scan;
  scan.grey = GreyImage(kPhotoWidth, kPhotoHeight);
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 1.0);
  for (int y = 0; y < kPhotoHeight; ++y) {
    for (int x = 0; x < kPhotoWidth; ++x) {
      const PhotoPixel p = at(x + 0.5, y + 0.5);
      const double level = std::clamp(p.grey + p.rough * noise(random), 0.0, 255.0);
      scan.grey.row(y)[x] = static_cast<std::uint16_t>(std::lround(level) * 257);
    }
  }
  return scan;
}

inline std::optional<PaperSheet> sheetOf(const Scan& scan) { return findPaperSheet(scan.grey, scan.colour, {}); }

}  // namespace batten::test
