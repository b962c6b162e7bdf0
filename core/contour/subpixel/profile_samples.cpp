// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/subpixel/profile_samples.h"

#include <array>
#include <cstdint>
#include <cstring>

#include "core/base/hot_loop.h"
#include "core/contour/subpixel/cubic_weights.h"
#include "core/contour/subpixel/edge_profile.h"

namespace batten {
namespace {

constexpr int kCubicTaps = 4;  // pixels of a row that a cubic convolution reads

// Where the samples of a profile lie: the pixel whose centre is next to the upper left of each, and how far from it.
struct SamplePlaces {
  std::array<std::int32_t, kProfileSamples> pixel;
  std::array<double, kProfileSamples> right, down;  // 0..1
};

// Pixels around the samples, row by row of the page: so many beside each other for every sample.
template <int kTaps>
using PixelRows = std::array<std::array<std::uint16_t, kTaps * kProfileSamples>, kTaps>;

struct ProfileLine {
  double x, y, dx, dy;
  int width;
};

BATTEN_HOT_LOOP void placeProfile(const ProfileLine& line, SamplePlaces& places) {
  const double x0 = line.x, y0 = line.y, dx = line.dx, dy = line.dy;
  const int width = line.width;
  for (int k = 0; k < kProfileSamples; ++k) {
    const double u = (k - kProfileHalf) * kProfileStepPx;
    const double x = x0 + u * dx - 0.5, y = y0 + u * dy - 0.5;
    const int ix = static_cast<int>(x), iy = static_cast<int>(y);
    places.pixel[k] = iy * width + ix;
    places.right[k] = x - ix;
    places.down[k] = y - iy;
  }
}

BATTEN_HOT_LOOP void blendCubic(const SamplePlaces& places, const PixelRows<kCubicTaps>& rows, float* __restrict out) {
  const std::uint16_t *p0 = rows[0].data(), *p1 = rows[1].data(), *p2 = rows[2].data(), *p3 = rows[3].data();
  for (int k = 0; k < kProfileSamples; ++k) {
    const CubicWeights x = cubicWeights(places.right[k]), y = cubicWeights(places.down[k]);
    const auto along = [&](const std::uint16_t* p) {
      return x.before * p[4 * k] + x.here * p[4 * k + 1] + x.next * p[4 * k + 2] + x.after * p[4 * k + 3];
    };
    const double sum = y.before * along(p0) + y.here * along(p1) + y.next * along(p2) + y.after * along(p3);
    out[k] = static_cast<float>(sum / GreyImage::kGreyUnit);
  }
}

BATTEN_HOT_LOOP void blendLinear(const SamplePlaces& places, const PixelRows<2>& rows, float* __restrict out) {
  const std::uint16_t *a = rows[0].data(), *b = rows[1].data();
  for (int k = 0; k < kProfileSamples; ++k) {
    const double fx = places.right[k], fy = places.down[k];
    const double upper = (1 - fx) * a[2 * k] + fx * a[2 * k + 1], lower = (1 - fx) * b[2 * k] + fx * b[2 * k + 1];
    out[k] = static_cast<float>(((1 - fy) * upper + fy * lower) / GreyImage::kGreyUnit);
  }
}

// Whether the pixels from `before` to `after` the one of each sample lie on the page, across and down. Each coordinate
// only rises or only falls along the profile.
bool isProfileOnPage(const GreyImage& grey, const Vec2& base, const Vec2& normal, int before, int after) {
  for (const int k : {0, kProfileSamples - 1}) {
    const double x = base.x() + profileU(k) * normal.x() - 0.5, y = base.y() + profileU(k) * normal.y() - 0.5;
    if (!(x >= before && y >= before && x < grey.width - after && y < grey.height - after)) return false;
  }
  return true;
}

template <int kTaps>
void readPixels(const GreyImage& grey, const SamplePlaces& places, int before, PixelRows<kTaps>& rows) {
  for (int j = 0; j < kTaps; ++j) {
    const std::uint16_t* from = grey.pixels.data() + (j - before) * grey.pitch() - before;
    for (int k = 0; k < kProfileSamples; ++k)
      std::memcpy(rows[j].data() + kTaps * k, from + places.pixel[k], kTaps * sizeof(std::uint16_t));
  }
}

}  // namespace

void sampleProfile(const GreyImage& grey, const Vec2& base, const Vec2& normal, bool cubic, float* out) {
  if (!isProfileOnPage(grey, base, normal, cubic ? 1 : 0, cubic ? 2 : 1)) {
    for (int k = 0; k < kProfileSamples; ++k) {
      const Vec2 at = base + profileU(k) * normal;
      out[k] = static_cast<float>(cubic ? sampleCubic(grey, at) : sampleLinear(grey, at));
    }
    return;
  }
  SamplePlaces places;
  placeProfile({base.x(), base.y(), normal.x(), normal.y(), static_cast<int>(grey.pitch())}, places);
  if (cubic) {
    PixelRows<kCubicTaps> rows;
    readPixels<kCubicTaps>(grey, places, 1, rows);
    blendCubic(places, rows, out);
  } else {
    PixelRows<2> rows;
    readPixels<2>(grey, places, 0, rows);
    blendLinear(places, rows, out);
  }
}

}  // namespace batten
