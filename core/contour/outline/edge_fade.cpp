// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/outline/edge_fade.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/parallel.h"
#include "core/contour/subpixel/edge_profile.h"
#include "core/contour/subpixel/pixel_edge.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr double kFadeFromBlurs = 2.2, kFadeFromPx = 3.0;  // where slopes are measured from
constexpr double kFadeLeverPx = 4.0;                       // over which they are measured: long against the pixels
constexpr double kFadeSigma = 12.0;                        // points: tones change slowly
constexpr double kLargestFade = 0.4;                       // of the contrast, over the lever: another line
constexpr double kFaintestFade = 4.0;                      // [grey]
constexpr double kLargestFadePx = 0.5;                     // of the correction: more is no fading tone
constexpr float kLeastKnown = 0.05f;                       // of the points around
constexpr int kFadesPerBlock = 512;                        // worked on together; the result does not depend on it
constexpr double kFadeBaseSigma = 2.0;                     // points: noise of the points across the line
constexpr int kFadeDirectionReach = 2;                     // points to either side

double normalCdf(double x) { return NormalTable::instance().at(x).cdf; }

/// A ramp that begins at 0, blurred by 1.
double softRamp(double x) {
  const auto [cdf, pdf] = NormalTable::instance().at(x);
  return x * cdf + pdf;
}

/// What the levels and the position are fitted to (matched_edges.cpp), without noise: contrast 1, ink at u > 0 getting
/// lighter by `slope` a px.
struct FadingProfile {
  double blur = 1.0, slope = 0.0;
  double at(double u) const { return -normalCdf(u / blur) + slope * blur * softRamp(u / blur); }
};

/// [px] One round of such a fit: levels beside `position`, then one Newton step.
double fitRound(const FadingProfile& p, double position) {
  double modelInk = 0.0, modelPaper = 0.0, ink = 0.0, paper = 0.0;
  int inkCount = 0, paperCount = 0;
  for (int k = 0; k < kProfileSamples; ++k) {
    const double u = profileU(k), x = (u - position) / p.blur;
    if (u >= position + kSideFromPx) {
      ink += p.at(u);
      modelInk += normalCdf(x);
      ++inkCount;
    } else if (u <= position - kSideFromPx) {
      paper += p.at(u);
      modelPaper += normalCdf(x);
      ++paperCount;
    }
  }
  const double meanPaper = modelPaper / paperCount;
  const double contrast = (paper / paperCount - ink / inkCount) / (modelInk / inkCount - meanPaper);
  const double level = paper / paperCount + contrast * meanPaper;
  double top = 0.0, bottom = 0.0;
  for (int k = 0; k < kProfileSamples; ++k) {
    const auto [cdf, pdf] = NormalTable::instance().at((profileU(k) - position) / p.blur);
    const double gradient = contrast * pdf / p.blur;
    top += gradient * (p.at(profileU(k)) - (level - contrast * cdf));
    bottom += gradient * gradient;
  }
  return std::clamp(position + top / bottom, -kLargestFadePx, kLargestFadePx);
}

/// [px] How far the edge is found off per slope of one contrast a px on the ink side (towards the ink: positive). The
/// paper side's does the opposite.
double shiftPerSlope(double blur) {
  constexpr double kSmallSlope = 0.002;  // [1/px] small, since the shift per slope is a limit
  constexpr int kRounds = 12;            // of levels and position in turn
  double position = 0.0;
  for (int round = 0; round < kRounds; ++round) position = fitRound({blur, kSmallSlope}, position);
  return position / kSmallSlope;
}

std::vector<Vec2> fadeDirections(const Contour& c) {
  return directions(smoothPolyline(positionsOf(c.points), c.closed, kFadeBaseSigma), c.closed, kFadeDirectionReach);
}

/// [1/px] The slopes beyond the edge at every point, ink side less paper side, as a part of the contrast; nothing where
/// they cannot be seen.
std::vector<std::optional<float>> measureFade(const Contour& c, const GreyImage& grey, double blur,
                                              const RunContext& context) {
  const int n = static_cast<int>(c.points.size());
  std::vector<std::optional<float>> fade(n);
  const std::vector<Vec2> along = fadeDirections(c);
  const double from = std::max(kFadeFromPx, kFadeFromBlurs * blur), to = from + kFadeLeverPx;
  const double carried = normalCdf(to / blur) - normalCdf(from / blur);
  const auto onPage = [&](const Vec2& p) {
    return p.x() >= 0.0 && p.y() >= 0.0 && p.x() <= grey.width && p.y() <= grey.height;
  };
  parallelFor(context, n, kFadesPerBlock, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const Vec2 inward = leftNormal(along[i]), &p = c.points[i].at;  // with y down: ink lies to the right of travel
      if (!c.points[i].refined || !onPage(p + to * inward) || !onPage(p - to * inward)) continue;
      const auto level = [&](double u) { return sampleLinear(grey, p + u * inward); };
      const double inkNear = level(from), inkFar = level(to), paperNear = level(-from), paperFar = level(-to);
      const double seen = paperNear - inkNear;
      if (seen < kFaintestFade) continue;
      const double ink = (inkFar - inkNear + seen * carried) / kFadeLeverPx;
      const double paper = (paperNear - paperFar + seen * carried) / kFadeLeverPx;
      if (std::max(std::abs(ink), std::abs(paper)) * kFadeLeverPx > kLargestFade * seen) continue;
      const double contrast = seen + (ink + paper) * from;
      if (contrast < kFaintestFade) continue;
      fade[i] = static_cast<float>((ink - paper) / contrast);
    }
  });
  return fade;
}

}  // namespace

void undoFade(Contour& c, const GreyImage& grey, const RunContext& context) {
  const int n = static_cast<int>(c.points.size());
  if (n < 2 || !c.blurPx) return;
  const double blur = std::sqrt(*c.blurPx * *c.blurPx + kPixelVariance + PixelWindow::kVariance);
  const std::vector<std::optional<float>> measured = measureFade(c, grey, blur, context);
  if (context.isCancelled()) return;
  std::vector<float> fade, weight;  // apart, since smoothValues() takes plain numbers
  for (const auto& value : measured) {
    fade.push_back(value.value_or(0.0f));
    weight.push_back(value ? 1.0f : 0.0f);
  }
  fade = smoothValues(fade, c.closed, kFadeSigma);
  weight = smoothValues(weight, c.closed, kFadeSigma);
  const double perSlope = shiftPerSlope(blur);
  const std::vector<Vec2> along = fadeDirections(c);
  for (int i = 0; i < n; ++i) {
    if (!c.points[i].refined || weight[i] < kLeastKnown) continue;
    const double shift = perSlope * static_cast<double>(fade[i] / weight[i]);
    c.points[i].at -= std::clamp(shift, -kLargestFadePx, kLargestFadePx) * leftNormal(along[i]);
  }
}

}  // namespace batten
