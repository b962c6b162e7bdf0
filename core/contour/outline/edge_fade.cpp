// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/outline/edge_fade.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/contour/subpixel/edge_profile.h"
#include "core/contour/subpixel/pixel_edge.h"
#include "core/polyline/polyline_tools.h"

namespace batten {
namespace {

constexpr double kFadeFromBlurs = 2.2, kFadeFromPx = 3.0;  // where slopes are measured from
constexpr double kFadeLeverPx = 4.0;
constexpr double kFadeSigma = 12.0;    // points: tones change slowly
constexpr double kLargestFade = 0.4;   // of the contrast, over the lever: another line
constexpr double kFaintestFade = 4.0;  // [grey]
constexpr double kLargestFadePx = 0.5;
constexpr float kLeastKnown = 0.05f;  // of the points around
constexpr int kFadesPerBlock = 512;

double normalCdf(double x) {
  double cdf, pdf;
  NormalTable::instance().eval(x, cdf, pdf);
  return cdf;
}

/// A ramp that begins at 0, blurred by 1.
double softRamp(double x) {
  double cdf, pdf;
  NormalTable::instance().eval(x, cdf, pdf);
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
    double cdf, pdf;
    NormalTable::instance().eval((profileU(k) - position) / p.blur, cdf, pdf);
    const double gradient = contrast * pdf / p.blur;
    top += gradient * (p.at(profileU(k)) - (level - contrast * cdf));
    bottom += gradient * gradient;
  }
  return std::clamp(position + top / bottom, -kLargestFadePx, kLargestFadePx);
}

/// [px] How far the edge is found off per slope of one contrast a px on the ink side (towards the ink: positive). The
/// paper side's does the opposite.
double shiftPerSlope(double blur) {
  constexpr double kSmallSlope = 0.002;
  constexpr int kRounds = 12;
  double position = 0.0;
  for (int round = 0; round < kRounds; ++round) position = fitRound({blur, kSmallSlope}, position);
  return position / kSmallSlope;
}

/// The slopes beyond the edge, ink side less paper side, as a part of the contrast [1/px]; weight 0: not known.
struct FadeBand {
  std::vector<float> fade, weight;
};

FadeBand measureFade(const Contour& c, const GreyImage& grey, double blur, const RunContext& context) {
  const auto n = c.points.size();
  FadeBand band{std::vector<float>(n, 0.0f), std::vector<float>(n, 0.0f)};
  const std::vector<Vec2> along = directions(smoothPolyline(positionsOf(c.points), c.closed, 2.0), c.closed, 2);
  const double from = std::max(kFadeFromPx, kFadeFromBlurs * blur), to = from + kFadeLeverPx;
  const double carried = normalCdf(to / blur) - normalCdf(from / blur);
  const auto onPage = [&](const Vec2& p) {
    return p.x() >= 0.0 && p.y() >= 0.0 && p.x() <= grey.width && p.y() <= grey.height;
  };
  parallelFor(context, static_cast<int>(n), kFadesPerBlock, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) {
      const auto i = static_cast<std::size_t>(k);
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
      band.fade[i] = static_cast<float>((ink - paper) / contrast);
      band.weight[i] = 1.0f;
    }
  });
  return band;
}

}  // namespace

void undoFade(Contour& c, const GreyImage& grey, const RunContext& context) {
  const auto n = c.points.size();
  if (n < 2 || !(c.blurPx > 0.0)) return;
  const double blur = std::sqrt(c.blurPx * c.blurPx + kPixelVariance + PixelWindow::kVariance);
  FadeBand band = measureFade(c, grey, blur, context);
  if (context.isCancelled()) return;
  band.fade = smoothValues(band.fade, c.closed, kFadeSigma);
  band.weight = smoothValues(band.weight, c.closed, kFadeSigma);
  const double perSlope = shiftPerSlope(blur);
  const std::vector<Vec2> along = directions(smoothPolyline(positionsOf(c.points), c.closed, 2.0), c.closed, 2);
  for (std::size_t i = 0; i < n; ++i) {
    if (!c.points[i].refined || band.weight[i] < kLeastKnown) continue;
    const double shift = perSlope * static_cast<double>(band.fade[i] / band.weight[i]);
    c.points[i].at -= std::clamp(shift, -kLargestFadePx, kLargestFadePx) * leftNormal(along[i]);
  }
}

}  // namespace batten
