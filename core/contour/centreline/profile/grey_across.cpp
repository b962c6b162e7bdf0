// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/centreline/profile/grey_across.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

#include "core/base/hot_loop.h"
#include "core/contour/centreline/profile/stroke_profile.h"

namespace batten {
namespace {

constexpr int kSamplesAtOnce = 128;  // most profiles are shorter

// Samples at work: the pixel at the upper left of each, and how far it lies from its centre towards the others.
struct SamplesAcross {
  std::array<std::int32_t, kSamplesAtOnce> pixel;
  std::array<float, kSamplesAtOnce> right, down;
  std::array<std::uint16_t, 2 * kSamplesAtOnce> upper, lower;  // two pixels each
};

// Where samples [first, first + count) of a profile lie.
struct ProfileRow {
  double x, y, dx, dy;
  int first, half, width;
};

BATTEN_HOT_LOOP void placeSamples(const ProfileRow& row, int count, std::int32_t* __restrict pixel,
                                  float* __restrict right, float* __restrict down) {
  const double x = row.x, y = row.y, dx = row.dx, dy = row.dy;
  const int start = row.first - row.half, width = row.width;
  for (int k = 0; k < count; ++k) {
    const double u = (start + k) * kStrokeStepPx;
    const double fx = x + u * dx - 0.5, fy = y + u * dy - 0.5;
    const int x0 = static_cast<int>(fx), y0 = static_cast<int>(fy);
    pixel[k] = y0 * width + x0;
    right[k] = static_cast<float>(fx - x0);
    down[k] = static_cast<float>(fy - y0);
  }
}

BATTEN_HOT_LOOP void blendSamples(const SamplesAcross& s, int count, float* __restrict out) {
  constexpr auto kScale = static_cast<float>(1.0 / GreyImage::kGreyUnit);  // to grey levels 0..255
  for (int k = 0; k < count; ++k) {
    const auto a0 = static_cast<float>(s.upper[2 * k]), a1 = static_cast<float>(s.upper[2 * k + 1]);
    const auto b0 = static_cast<float>(s.lower[2 * k]), b1 = static_cast<float>(s.lower[2 * k + 1]);
    const float top = a0 + s.right[k] * (a1 - a0), low = b0 + s.right[k] * (b1 - b0);
    out[k] = (top + s.down[k] * (low - top)) * kScale;
  }
}

// Whether all pixels around the samples of a profile lie on the page. Each coordinate only rises or only falls.
bool staysOnPage(const GreyImage& grey, const Vec2& at, const Vec2& normal, int half) {
  const double reach = half * kStrokeStepPx;
  for (const double u : {-reach, reach}) {
    const double fx = at.x() + u * normal.x() - 0.5, fy = at.y() + u * normal.y() - 0.5;
    if (!(fx >= 0.0 && fy >= 0.0 && fx < grey.width - 1.0 && fy < grey.height - 1.0)) return false;
  }
  return true;
}

BATTEN_HOT_LOOP void meanLoop(const float* first, int count, const float* w, float sum, float* __restrict out) {
  static_assert(kMeanHalf == 6);
  const auto row = [&](int k) { return first + std::ptrdiff_t{k} * count; };
  const float *r0 = row(0), *r1 = row(1), *r2 = row(2), *r3 = row(3), *r4 = row(4), *r5 = row(5), *r6 = row(6);
  const float *r7 = row(7), *r8 = row(8), *r9 = row(9), *r10 = row(10), *r11 = row(11), *r12 = row(12);
  const float w0 = w[0], w1 = w[1], w2 = w[2], w3 = w[3], w4 = w[4], w5 = w[5], w6 = w[6];
  for (int k = 0; k < count; ++k) {
    const float before = w6 * r0[k] + w5 * r1[k] + w4 * r2[k] + w3 * r3[k] + w2 * r4[k] + w1 * r5[k];
    out[k] =
        (before + w0 * r6[k] + w1 * r7[k] + w2 * r8[k] + w3 * r9[k] + w4 * r10[k] + w5 * r11[k] + w6 * r12[k]) / sum;
  }
}

BATTEN_HOT_LOOP void meansOfPaper(const float* p, int count, double* __restrict means) {
  static_assert(kPaperSamples == 5);
  for (int k = 0; k < count; ++k) {
    const double sum = 0.0 + p[k] + p[k + 1] + p[k + 2] + p[k + 3] + p[k + 4];
    means[k] = sum / kPaperSamples;
  }
}

// Gaussian of .5 px: two samples.
constexpr int kSmoothHalf = 5;
// Weights by the distance in samples, and the sum of all taps.
constexpr std::array<float, kSmoothHalf + 1> kSmoothKernel = {0.2021f, 0.1779f, 0.1212f, 0.0639f, 0.0261f, 0.00825f};
constexpr float kSmoothSum = [] {
  float sum = kSmoothKernel[0];
  for (int d = 1; d <= kSmoothHalf; ++d) sum += 2.0f * kSmoothKernel[d];
  return sum;
}();

BATTEN_HOT_LOOP void smoothInside(const float* p, int count, float* __restrict out) {
  static_assert(kSmoothHalf == 5);
  constexpr auto& w = kSmoothKernel;  // short for the sum below
  for (int k = kSmoothHalf; k < count - kSmoothHalf; ++k) {
    const float sum = w[0] * p[k] + w[1] * (p[k - 1] + p[k + 1]) + w[2] * (p[k - 2] + p[k + 2]) +
                      w[3] * (p[k - 3] + p[k + 3]) + w[4] * (p[k - 4] + p[k + 4]) + w[5] * (p[k - 5] + p[k + 5]);
    out[k] = sum / kSmoothSum;
  }
}

// One that has only `reach` samples to one side.
float smoothEnd(const float* at, int reach) {
  float sum = kSmoothKernel[0] * at[0], weight = kSmoothKernel[0];
  BATTEN_UNROLL
  for (int d = 1; d < kSmoothHalf; ++d) {
    if (d > reach) break;
    sum += kSmoothKernel[d] * (at[-d] + at[d]);
    weight += 2.0f * kSmoothKernel[d];
  }
  return sum / weight;
}

}  // namespace

void sampleAcross(const GreyImage& grey, const Vec2& at, const Vec2& normal, int half, float* out) {
  const int samples = 2 * half + 1;
  if (!staysOnPage(grey, at, normal, half)) {
    for (int k = 0; k < samples; ++k) {
      const double u = (k - half) * kStrokeStepPx;
      out[k] = sampleGrey(grey, at.x() + u * normal.x(), at.y() + u * normal.y());
    }
    return;
  }
  SamplesAcross s;
  for (int first = 0; first < samples; first += kSamplesAtOnce) {
    const int count = std::min(kSamplesAtOnce, samples - first);
    placeSamples({at.x(), at.y(), normal.x(), normal.y(), first, half, static_cast<int>(grey.pitch())}, count,
                 s.pixel.data(), s.right.data(), s.down.data());
    const std::uint16_t *upper = grey.pixels.data(), *lower = upper + grey.pitch();
    for (int k = 0; k < count; ++k) {
      std::memcpy(s.upper.data() + 2 * k, upper + s.pixel[k], 2 * sizeof(std::uint16_t));
      std::memcpy(s.lower.data() + 2 * k, lower + s.pixel[k], 2 * sizeof(std::uint16_t));
    }
    blendSamples(s, count, out + first);
  }
}

void meanOfProfiles(const float* first, int count, const float* weights, float sum, float* out) {
  meanLoop(first, count, weights, sum, out);
}

void meansOfBoxes(const float* p, int box, int count, double* means) {
  if (box == kPaperSamples) return meansOfPaper(p, count, means);
  for (int k = 0; k < count; ++k) {
    double sum = 0.0;
    for (int j = 0; j < box; ++j) sum += p[k + j];
    means[k] = sum / box;
  }
}

void smoothAcrossStroke(const float* profile, int count, float* out) {
  smoothInside(profile, count, out);
  const int side = std::min(kSmoothHalf, (count + 1) / 2);
  for (int k = 0; k < side; ++k) {
    out[k] = smoothEnd(profile + k, k);
    out[count - 1 - k] = smoothEnd(profile + count - 1 - k, k);
  }
}

}  // namespace batten
