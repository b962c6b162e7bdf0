// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/image/tones/shading.h"

#include <opencv2/core.hpp>
#include <utility>

#include "core/image/grey_image.h"
#include "core/image/tones/pencil_tones.h"
#include "core/image/tones/tone_look.h"
#include "core/image/tones/without_tones.h"

namespace batten {
namespace {

/// Of the broad ink that even tones leave: what those of a pencil, and those full of lines, may leave to be taken.
/// Grain and hatching are lines, too.
constexpr double kLeftByPencil = 0.9, kLeftByFull = 0.6;

/// [px of the copy] Without the tones: ink that a brush of this radius fits into. Absent: there is no line.
std::optional<double> broadInkWithout(ToneAreas tones, int brush, const ToneCopy& copy, const RunContext& context) {
  tones.lineWidthPx /= tones.pixelsPerPx;
  tones.pixelsPerPx = 1;
  const std::optional<ToneLook> look = inkOfPage(withoutTones(copy.searched(), tones, context), context);
  return look ? std::optional(1.0 * cv::countNonZero(wideInk(look->ink, brush))) : std::nullopt;
}

}  // namespace

std::optional<ToneAreas> findShading(const ToneCopy& copy, const RunContext& context) {
  std::optional<ToneAreas> even = findToneAreas(copy, context);
  std::optional<ToneAreas> pencil = findPencilTones(copy, context);
  if (context.isCancelled()) return std::nullopt;
  if (!even) return pencil;
  const int brush = brushBeyondLines(even->lineWidthPx / even->pixelsPerPx);
  const std::optional<double> byEven = broadInkWithout(*even, brush, copy, context);
  const auto leavesLess = [&](const std::optional<ToneAreas>& tones, double share) {
    if (!tones || context.isCancelled()) return false;
    const std::optional<double> left = broadInkWithout(*tones, brush, copy, context);
    return left && (!byEven || *left < share * *byEven);
  };
  if (leavesLess(pencil, kLeftByPencil)) {
    even = std::move(pencil);
  } else if (even->leavesFull) {
    std::optional<ToneAreas> full = findToneAreasFullOfLines(copy, context);
    if (leavesLess(full, kLeftByFull)) even = std::move(full);
  }
  return context.isCancelled() ? std::nullopt : std::move(even);
}

}  // namespace batten
