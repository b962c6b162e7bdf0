// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/tones/shading.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "core/image/grey_image.h"
#include "core/image/tones/pencil_tones.h"
#include "core/image/tones/tone_look.h"
#include "core/image/tones/without_tones.h"

namespace batten {
namespace {

/// Of the broad ink that other even tones leave: what tones full of lines may leave. Grain and hatching are lines, too.
constexpr double kLeftByFullTones = 0.6;

/// [px of the copy] Without the tones: ink that a brush of this radius fits into.
double broadInkWithout(ToneAreas tones, int brush, const ToneCopy& copy, const RunContext& context) {
  tones.lineWidthPx /= tones.pixelsPerPx;
  tones.pixelsPerPx = 1;
  const std::optional<ToneLook> look = inkOfPage(withoutTones(copy.searched(), tones, context), context);
  if (!look) return 0.0;
  cv::Mat1b broad;
  const cv::Mat disc = cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * brush + 1, 2 * brush + 1});
  cv::morphologyEx(look->ink, broad, cv::MORPH_OPEN, disc);
  return cv::countNonZero(broad);
}

}  // namespace

std::optional<ToneAreas> findShading(const ToneCopy& copy, const RunContext& context) {
  std::optional<ToneAreas> even = findToneAreas(copy, context), pencil = findPencilTones(copy, context);
  if (context.isCancelled()) return std::nullopt;
  if (!even) return pencil;
  double widthPx = even->lineWidthPx / even->pixelsPerPx;
  if (pencil) widthPx = std::min(widthPx, pencil->lineWidthPx / pencil->pixelsPerPx);
  const int brush = static_cast<int>(std::ceil(kWiderThanLines * widthPx + 1.0));
  const auto left = [&](const ToneAreas& tones) { return broadInkWithout(tones, brush, copy, context); };
  const double byEven = left(*even);
  if (pencil && left(*pencil) < byEven) return context.isCancelled() ? std::nullopt : std::move(pencil);
  std::optional<ToneAreas> full = findToneAreasFullOfLines(copy, context);
  if (full && left(*full) <= kLeftByFullTones * byEven) even = std::move(full);
  return context.isCancelled() ? std::nullopt : std::move(even);
}

}  // namespace batten
