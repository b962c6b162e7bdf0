// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/threshold/paper_fold.h"

#include <algorithm>
#include <cmath>

#include "core/base/hot_loop.h"
#include "core/base/parallel.h"

namespace batten {
namespace {

BATTEN_HOT_LOOP void subtractRow(const std::uint16_t* in, const float* fold, std::uint16_t* __restrict out, int count) {
  for (int i = 0; i < count; ++i) {
    const float value = static_cast<float>(in[i]) - static_cast<float>(GreyImage::kGreyUnit) * fold[i] + 0.5f;
    const float low = value > 0.0f ? value : 0.0f;
    out[i] = static_cast<std::uint16_t>(low < 65535.0f ? low : 65535.0f);
  }
}

}  // namespace

double FoldCourse::scale() const { return std::max({std::fabs(from), std::fabs(to), 1.0}); }

double FoldCourse::bendAt(double t) const {
  const double s = t / scale();
  return bend[0] + s * (bend[1] + s * (bend[2] + s * bend[3]));
}

double PaperFold::at(double x, double y) const {
  const Vec2 p = Vec2(x, y) - course.origin;
  const double t = std::clamp(p.dot(course.along), course.from, course.to);
  const double d = p.dot(course.normal) - course.bendAt(t);
  if (d >= reach || stations < 1) return 0.0;
  const double k = std::clamp((t - course.from) / spacing, 0.0, stations - 1.0);
  const int k0 = std::min(static_cast<int>(k), std::max(0, stations - 2)), k1 = std::min(k0 + 1, stations - 1);
  const double share = k - k0;
  if (d <= -reach) return -(static_cast<double>(depth[k0]) + share * static_cast<double>(depth[k1] - depth[k0]));
  const double v = (d + reach) * kTapsPerPx;
  const int i = std::min(static_cast<int>(v), taps() - 2);
  const double part = v - i;
  const auto across = [&](std::ptrdiff_t station) {
    const float* row = profile.data() + station * taps() + i;
    return static_cast<double>(row[0]) + part * static_cast<double>(row[1] - row[0]);
  };
  const double first = across(k0);
  return first + share * (across(k1) - first);
}

std::pair<int, int> PaperFold::stripOfRow(int y, int width) const {
  double most = reach + 1.0;
  for (const double b : course.bend) most += std::fabs(b);
  const double slope = course.normal.x(), start = (Vec2(0.5, y + 0.5) - course.origin).dot(course.normal);
  if (std::fabs(slope) < 1e-9) return std::fabs(start) < most ? std::pair(0, width) : std::pair(0, 0);
  const double a = (-most - start) / slope, b = (most - start) / slope;
  const auto column = [&](double x) { return static_cast<int>(std::clamp(x, 0.0, static_cast<double>(width))); };
  return {column(std::floor(std::min(a, b))), column(std::ceil(std::max(a, b)) + 1.0)};
}

void PaperFold::addToRow(int y, float* row, int width) const {
  const auto [first, last] = stripOfRow(y, width);
  const bool darkBefore = (Vec2(0.5, y + 0.5) - course.origin).dot(course.normal) - course.bendAt(0.0) < 0.0;
  const bool darkBehind = (Vec2(width - 0.5, y + 0.5) - course.origin).dot(course.normal) < 0.0;
  const int begin = first > 0 && !darkBefore ? first : 0, end = last < width && !darkBehind ? last : width;
  for (int x = begin; x < end; ++x) row[x] += static_cast<float>(at(x + 0.5, y + 0.5));
}

GreyImage withoutFolds(const GreyImage& image, const std::vector<PaperFold>& folds, const RunContext& context) {
  GreyImage out(image.width, image.height);
  parallelFor(context, image.height, kRowsPerBlock, [&](int begin, int end) {
    std::vector<float> sum(image.width);
    for (int y = begin; y < end; ++y) {
      std::fill(sum.begin(), sum.end(), 0.0f);
      for (const PaperFold& fold : folds) fold.addToRow(y, sum.data(), image.width);
      subtractRow(image.row(y), sum.data(), out.row(y), image.width);
    }
  });
  return out;
}

}  // namespace batten
