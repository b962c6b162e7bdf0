// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/rectify/resample.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/base/parallel.h"

namespace batten {
namespace {

constexpr double kKernelReach = 2.0;   // [px of the kernel] to either side
constexpr double kWidestKernel = 8.0;  // [px of the picture for one of the page] far beyond what pages are made with
constexpr double kUnwidenedKernel = 1.02;  // up to here the kernel stays as it is

/// Keys' cubic kernel with a = -1/2, the third-order one.
double keysKernel(double x) {
  const double t = std::abs(x);
  if (t < 1.0) return (1.5 * t - 2.5) * t * t + 1.0;
  if (t < 2.0) return ((-0.5 * t + 2.5) * t - 4.0) * t + 2.0;
  return 0.0;
}

/// The pixels along one axis that a place takes, and their weights.
struct Taps {
  int first = 0, count = 0;
  std::array<float, 2 * static_cast<int>(kKernelReach* kWidestKernel) + 2> weights{};
};

/// @param at in pixels, whose centres lie at whole numbers.
void setTaps(Taps& taps, double at, double width) {
  const double widened = width <= kUnwidenedKernel ? 1.0 : std::min(width, kWidestKernel);
  const double reach = kKernelReach * widened;
  taps.first = static_cast<int>(std::floor(at - reach)) + 1;
  const int last = static_cast<int>(std::ceil(at + reach)) - 1;
  taps.count = last - taps.first + 1;
  double sum = 0.0;
  std::array<double, std::tuple_size_v<decltype(taps.weights)>> weights{};
  for (int i = 0; i < taps.count; ++i) sum += weights[i] = keysKernel((taps.first + i - at) / widened);
  for (int i = 0; i < taps.count; ++i) taps.weights[i] = static_cast<float>(weights[i] / sum);
}

struct GreyPixel {
  float value = 0.0f;
  void add(std::uint16_t pixel, float weight) { value += weight * static_cast<float>(pixel); }
  explicit operator std::uint16_t() const {
    return static_cast<std::uint16_t>(std::lround(std::clamp(value, 0.0f, 65535.0f)));
  }
};
struct ColourPixel {
  float red = 0.0f, green = 0.0f, blue = 0.0f;
  void add(const Rgb8& pixel, float weight) {
    red += weight * static_cast<float>(pixel.red);
    green += weight * static_cast<float>(pixel.green);
    blue += weight * static_cast<float>(pixel.blue);
  }
  explicit operator Rgb8() const {
    const auto byte = [](float v) { return static_cast<std::uint8_t>(std::lround(std::clamp(v, 0.0f, 255.0f))); };
    return {byte(red), byte(green), byte(blue)};
  }
};

template <class Sum, class Image>
void resampleInto(const Image& picture, const SheetMap& map, Image& page, const RunContext& context) {
  parallelFor(context, page.height, kRowsPerBlock / 4, [&](int begin, int end) {
    Taps across, down;
    for (int y = begin; y < end; ++y) {
      auto* out = page.row(y);
      for (int x = 0; x < page.width; ++x) {
        const Vec2 place(x + 0.5, y + 0.5);
        const Vec2 at = map.toPicture(place) - Vec2(0.5, 0.5);
        const Eigen::Matrix2d slope = map.slopeAt(place);
        setTaps(across, at.x(), slope.row(0).norm());
        setTaps(down, at.y(), slope.row(1).norm());
        Sum sum;
        for (int j = 0; j < down.count; ++j) {
          const auto* row = picture.row(std::clamp(down.first + j, 0, picture.height - 1));
          for (int i = 0; i < across.count; ++i)
            sum.add(row[std::clamp(across.first + i, 0, picture.width - 1)], down.weights[j] * across.weights[i]);
        }
        out[x] = static_cast<std::remove_reference_t<decltype(*out)>>(sum);
      }
    }
  });
}

}  // namespace

GreyImage resampled(const GreyImage& picture, const SheetMap& map, int widthPx, int heightPx,
                    const RunContext& context) {
  GreyImage page(widthPx, heightPx);
  resampleInto<GreyPixel>(picture, map, page, context);
  return page;
}

ColourImage resampled(const ColourImage& picture, const SheetMap& map, int widthPx, int heightPx,
                      const RunContext& context) {
  if (picture.isEmpty()) return {};
  ColourImage page(widthPx, heightPx);
  resampleInto<ColourPixel>(picture, map, page, context);
  return page;
}

}  // namespace batten
