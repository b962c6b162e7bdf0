// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/plane.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/hot_loop.h"
#include "core/base/parallel.h"

namespace batten {
namespace {

BATTEN_HOT_LOOP void scaleRow(const std::uint16_t* in, float* __restrict out, int count) {
  constexpr float kScale = static_cast<float>(1.0 / GreyImage::kGreyUnit);  // to grey levels 0..255
  for (int i = 0; i < count; ++i) out[i] = static_cast<float>(in[i]) * kScale;
}

BATTEN_HOT_LOOP void addPairs(const std::uint16_t* a, const std::uint16_t* b, float* __restrict out, int count) {
  constexpr float kScale = static_cast<float>(0.25 / GreyImage::kGreyUnit);  // mean of four, in grey levels
  for (int i = 0; i < count; ++i) {
    const int sum = a[2 * i] + a[2 * i + 1] + b[2 * i] + b[2 * i + 1];
    out[i] = static_cast<float>(sum) * kScale;
  }
}

BATTEN_HOT_LOOP void addRow(const std::uint16_t* in, std::uint32_t* __restrict sums, int count) {
  for (int i = 0; i < count; ++i) sums[i] += in[i];
}

BATTEN_HOT_LOOP void addThreeRows(const std::uint16_t* a, const std::uint16_t* b, const std::uint16_t* c,
                                  std::uint32_t* __restrict sums, int count) {
  for (int i = 0; i < count; ++i) sums[i] = std::uint32_t{a[i]} + b[i] + c[i];
}
BATTEN_HOT_LOOP void addFourRows(const std::uint16_t* const* rows, std::uint32_t* __restrict sums, int count) {
  const std::uint16_t *a = rows[0], *b = rows[1], *c = rows[2], *d = rows[3];
  for (int i = 0; i < count; ++i) sums[i] = std::uint32_t{a[i]} + b[i] + c[i] + d[i];
}

/// Means of the sums by threes or fours, each over as many rows, as grey levels. Sum and divisor are whole numbers that
/// a float holds exactly, so that one division gives the float nearest to the mean.
BATTEN_HOT_LOOP void meansByThrees(const std::uint32_t* sums, float* __restrict out, int count) {
  constexpr auto kDivisor = static_cast<float>(9.0 * GreyImage::kGreyUnit);  // nine values, to grey levels
  for (int i = 0; i < count; ++i) {
    const auto sum = static_cast<std::int32_t>(sums[3 * i] + sums[3 * i + 1] + sums[3 * i + 2]);
    out[i] = static_cast<float>(sum) / kDivisor;
  }
}
BATTEN_HOT_LOOP void meansByFours(const std::uint32_t* sums, float* __restrict out, int count) {
  constexpr auto kDivisor = static_cast<float>(16.0 * GreyImage::kGreyUnit);  // sixteen values, to grey levels
  for (int i = 0; i < count; ++i) {
    const auto sum = static_cast<std::int32_t>(sums[4 * i] + sums[4 * i + 1] + sums[4 * i + 2] + sums[4 * i + 3]);
    out[i] = static_cast<float>(sum) / kDivisor;
  }
}
void meansOf(const std::uint32_t* sums, float* out, int count, int shrink) {
  for (int i = 0; i < count; ++i) {
    std::uint64_t sum = 0;
    for (int k = 0; k < shrink; ++k) sum += sums[i * shrink + k];
    out[i] = static_cast<float>(static_cast<double>(sum) / (shrink * shrink) / GreyImage::kGreyUnit);
  }
}

/// The blocks of one row that are whole. Sums of whole numbers are exact, in whatever order they are added.
void shrinkRow(const GreyImage& image, int y, int shrink, std::vector<std::uint32_t>& sums, float* out) {
  const int count = image.width / shrink, first = y * shrink;
  sums.resize(image.width);
  if (shrink == 3) {
    addThreeRows(image.row(first), image.row(first + 1), image.row(first + 2), sums.data(), count * shrink);
    return meansByThrees(sums.data(), out, count);
  }
  if (shrink == 4) {
    const std::array rows{image.row(first), image.row(first + 1), image.row(first + 2), image.row(first + 3)};
    addFourRows(rows.data(), sums.data(), count * shrink);
    return meansByFours(sums.data(), out, count);
  }
  std::fill(sums.begin(), sums.end(), 0u);
  for (int i = 0; i < shrink; ++i) addRow(image.row(first + i), sums.data(), count * shrink);
  meansOf(sums.data(), out, count, shrink);
}

BATTEN_HOT_LOOP void alongLoop(const float* in, float* __restrict out, int count, const float* kernel, int radius) {
  if (radius == 1) {
    for (int i = 0; i < count; ++i) out[i] = kernel[0] * in[i] + kernel[1] * (in[i - 1] + in[i + 1]);
    return;
  }
  for (int i = 0; i < count; ++i) {
    out[i] = kernel[0] * in[i] + kernel[1] * (in[i - 1] + in[i + 1]) + kernel[2] * (in[i - 2] + in[i + 2]);
  }
  for (int k = 3; k <= radius; ++k) {
    const float weight = kernel[k];
    for (int i = 0; i < count; ++i) out[i] += weight * (in[i - k] + in[i + k]);
  }
}

BATTEN_HOT_LOOP void acrossPair(const float* a, const float* b, float* __restrict out, int count, float weight) {
  for (int i = 0; i < count; ++i) out[i] += weight * (a[i] + b[i]);
}

BATTEN_HOT_LOOP void acrossFirst(const float* const* rows, float* __restrict out, int count, float middle, float side) {
  const float *a = rows[-1], *m = rows[0], *b = rows[1];
  for (int i = 0; i < count; ++i) out[i] = middle * m[i] + side * (a[i] + b[i]);
}

float meanOfBlock(const GreyImage& image, int x0, int y0, int shrink) {
  double sum = 0.0;
  const int x1 = std::min(x0 + shrink, image.width), y1 = std::min(y0 + shrink, image.height);
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) sum += image.row(y)[x];
  }
  return static_cast<float>(sum / ((x1 - x0) * (y1 - y0)) / GreyImage::kGreyUnit);
}

}  // namespace

std::vector<float> gaussianKernel(double variance) {
  if (variance <= 0.5) return {static_cast<float>(1.0 - variance), static_cast<float>(variance / 2.0)};
  const int radius = std::max(2, static_cast<int>(std::ceil(3.0 * std::sqrt(variance))));
  std::vector<double> taps;
  double sum = 0.0;
  for (int k = 0; k <= radius; ++k) {
    taps.push_back(std::exp(-0.5 * k * k / variance));
    sum += (k == 0 ? 1.0 : 2.0) * taps.back();
  }
  std::vector<float> kernel;
  kernel.reserve(taps.size());
  for (const double tap : taps) kernel.push_back(static_cast<float>(tap / sum));
  return kernel;
}

void smoothAlong(const float* in, float* out, int count, const std::vector<float>& kernel) {
  alongLoop(in, out, count, kernel.data(), static_cast<int>(kernel.size()) - 1);
}

void smoothAcross(const float* const* rows, float* out, int count, const std::vector<float>& kernel) {
  const auto radius = static_cast<int>(kernel.size()) - 1;
  const float* const* middle = rows + radius;
  acrossFirst(middle, out, count, kernel[0], kernel[1]);
  for (int k = 2; k <= radius; ++k) {
    acrossPair(middle[-k], middle[k], out, count, kernel[k]);
  }
}

namespace {

/// A row smoothed along itself; its ends are repeated outside.
void smoothWholeRow(const float* in, float* out, int width, const std::vector<float>& kernel,
                    std::vector<float>& padded) {
  const auto radius = static_cast<int>(kernel.size()) - 1;
  // Some pixels, from a copy that goes on beyond the ends.
  const auto smoothPart = [&](int begin, int end) {
    padded.resize(end - begin + 2 * radius);
    for (int i = 0; i < std::ssize(padded); ++i) padded[i] = in[std::clamp(begin - radius + i, 0, width - 1)];
    smoothAlong(padded.data() + radius, out + begin, end - begin, kernel);
  };
  if (width <= 2 * radius) return smoothPart(0, width);
  smoothPart(0, radius);
  smoothAlong(in + radius, out + radius, width - 2 * radius, kernel);
  smoothPart(width - radius, width);
}

}  // namespace

Plane smooth(const Plane& in, const std::vector<float>& kernel, const RunContext& context) {
  Plane out(in.width, in.height);
  const auto radius = static_cast<int>(kernel.size()) - 1;
  const std::ptrdiff_t width = in.width;
  parallelFor(context, in.height, kRowsPerBlock, [&](int begin, int end) {
    // The rows that one smoothed row is made of, each at its number modulo theirs.
    const int count = 2 * radius + 1;
    std::vector<float> padded, ring(width * count);
    std::vector<const float*> rows(count);
    const auto lineAt = [&](int y) { return ring.data() + width * ((y + count) % count); };
    const auto load = [&](int y) {
      smoothWholeRow(in.row(std::clamp(y, 0, in.height - 1)), lineAt(y), in.width, kernel, padded);
    };
    for (int y = begin - radius; y < begin + radius; ++y) load(y);
    for (int y = begin; y < end; ++y) {
      load(y + radius);
      for (int i = 0; i < count; ++i) rows[i] = lineAt(y - radius + i);
      smoothAcross(rows.data(), out.row(y), in.width, kernel);
    }
  });
  return out;
}

Plane shrinkGrey(const GreyImage& image, int shrink, const RunContext& context) {
  Plane out((image.width + shrink - 1) / shrink, (image.height + shrink - 1) / shrink);
  parallelFor(context, out.height, kRowsPerBlock, [&](int begin, int end) {
    std::vector<std::uint32_t> sums;
    for (int y = begin; y < end; ++y) {
      if (shrink == 1) {
        scaleRow(image.row(y), out.row(y), out.width);
        continue;
      }
      const bool isWhole = (y + 1) * shrink <= image.height;
      if (isWhole && shrink == 2) {
        addPairs(image.row(2 * y), image.row(2 * y + 1), out.row(y), image.width / 2);
      } else if (isWhole) {
        shrinkRow(image, y, shrink, sums, out.row(y));
      }
      for (int x = isWhole ? image.width / shrink : 0; x < out.width; ++x)
        out.row(y)[x] = meanOfBlock(image, x * shrink, y * shrink, shrink);
    }
  });
  return out;
}

}  // namespace batten
