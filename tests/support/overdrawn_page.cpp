// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/overdrawn_page.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "core/contour/centreline/centreline.h"
#include "tests/support/angles.h"
#include "tests/support/ink_page.h"
#include "tests/support/render_page.h"
#include "tests/support/truth_shapes.h"

namespace batten::test {

IntendedLine straightLine(const Vec2& a, const Vec2& b) {
  return [a, b](double t) { return Vec2(a + t * (b - a)); };
}

IntendedLine cubicLine(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  return [=](double t) {
    const double u = 1.0 - t;
    return Vec2(u * u * u * a + 3.0 * u * u * t * b + 3.0 * u * t * t * c + t * t * t * d);
  };
}

Vec2 beanAt(double t) {
  const double a = 2.0 * kPi * t, r = 190.0 + 45.0 * std::cos(a) - 30.0 * std::cos(2.0 * a + 0.7);
  return {320.0 + r * std::cos(a), 320.0 + r * std::sin(a)};
}

PenPath strokeAlong(const IntendedLine& line, double from, double to, double offset, double waver, double phase) {
  PenPath points;
  constexpr int kSteps = 1500;
  for (int i = 0; i <= kSteps; ++i) {
    const double part = static_cast<double>(i) / kSteps, t = from + (to - from) * part;
    const Vec2 along = line(t + 1e-4) - line(t - 1e-4);
    points.push_back(line(t) + (offset + waver * std::sin(phase + 5.0 * part)) * leftNormal(along.normalized()));
  }
  return points;
}

PenPath wanderAlong(const IntendedLine& line, double from, double to, double scatterPx, unsigned seed) {
  constexpr int kSteps = 1500, kWaves = 4;
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> turn(0.0, 2.0 * kPi);
  double size[kWaves], phase[kWaves];
  for (int w = 0; w < kWaves; ++w) {
    size[w] = scatterPx * normal(random) / (w == 0 ? 1.4 : 2.0);
    phase[w] = w == 0 ? 0.5 * kPi : turn(random);
  }
  PenPath points;
  for (int i = 0; i <= kSteps; ++i) {
    const double part = static_cast<double>(i) / kSteps, t = from + (to - from) * part;
    double offset = 0.0;
    for (int w = 0; w < kWaves; ++w) offset += size[w] * std::sin(phase[w] + 3.0 * w * part);
    const Vec2 along = line(t + 1e-4) - line(t - 1e-4);
    points.push_back(line(t) + offset * leftNormal(along.normalized()));
  }
  return points;
}

void drawOver(std::vector<PenPath>& strokes, const IntendedLine& line, int count, double spreadPx, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int k = 0; k < count; ++k) {
    const double offset = count > 1 ? spreadPx * (static_cast<double>(k) / (count - 1) - 0.5) : 0.0;
    const double from = 0.03 * (unit(random) - 0.5), to = 1.0 + 0.03 * (unit(random) - 0.5);
    strokes.push_back(strokeAlong(line, from, to, offset, 0.15 * spreadPx, 2.0 * kPi * unit(random)));
  }
}

Scan overdrawnScan(const std::vector<PenPath>& strokes) {
  constexpr int kSide = kOverdrawnPagePx;
  std::vector<float> cover(std::ptrdiff_t{kSide} * kSide, 0.0f);
  for (const PenPath& s : strokes) inkOver(cover, strokeCoverage(s, false, kOverdrawnPenPx, kSide, kSide));
  return renderPage(std::move(cover), kSide, kSide, penPage(5.0));
}

ContourSet traceOverdrawn(const std::vector<PenPath>& strokes, double mergeWidths) {
  const GreyImage grey = overdrawnScan(strokes).grey;
  EdgeParams params;
  params.mergeWidths = mergeWidths;
  Result<ContourSet> set = centrelines(penInk(grey), grey, params, {});
  return set ? std::move(*set) : ContourSet{};
}

std::vector<Contour> mergedLines(const std::vector<PenPath>& strokes, double distancePx) {
  return traceOverdrawn(strokes, distancePx / kOverdrawnInkPx - 1.0).contours;
}

}  // namespace batten::test
