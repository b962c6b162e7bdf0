// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/corner_page.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include "tests/support/ink_page.h"
#include "tests/support/render_page.h"

namespace batten::test {
namespace {

constexpr int kCornerColumns = 4, kCornerRows = 3, kZigzagCorners = 5;
constexpr double kBetweenPx = 40.0;  // lines
constexpr int kArcSteps = 24, kSmoothSteps = 200;

struct CornerLine {
  std::vector<Vec2> points, corners;
};

CornerLine zigzagLine(const Zigzags& of) {
  CornerLine line;
  Vec2 at = Vec2::Zero(), along = Eigen::Rotation2Dd(0.5 * of.turnRad) * Vec2::UnitX();
  line.points.push_back(at);
  for (int k = 0; k <= kZigzagCorners; ++k) {
    const Vec2 corner = at + of.legPx * along;
    if (k == kZigzagCorners || !(of.radiusPx > 0.0)) line.points.push_back(corner);
    if (k == kZigzagCorners) break;
    const double turn = k % 2 == 0 ? -of.turnRad : of.turnRad;
    if (of.radiusPx > 0.0) {
      const Vec2 from = corner - of.radiusPx * std::tan(0.5 * of.turnRad) * along;
      const Vec2 centre = from + std::copysign(of.radiusPx, turn) * leftNormal(along);
      for (int i = 0; i <= kArcSteps; ++i)
        line.points.emplace_back(centre + Eigen::Rotation2Dd(turn * i / kArcSteps) * (from - centre));
    }
    line.corners.push_back(corner);
    along = Eigen::Rotation2Dd(turn) * along;
    at = corner;
  }
  return line;
}

CornerLine smoothLine(Smooth kind, double radius) {
  CornerLine line;
  for (int k = 0; k < kSmoothSteps; ++k) {
    const double share = static_cast<double>(k) / kSmoothSteps, t = 2.0 * std::numbers::pi * share;
    const double period = 4.0 * radius, q = 2.0 * std::numbers::pi / period;
    const Vec2 onWave(2.0 * period * share, std::sin(2.0 * t) / (q * q * radius));
    const Vec2 onEllipse(9.0 * radius * std::cos(t), 3.0 * radius * std::sin(t));
    const Vec2 onCircle = radius * Vec2(std::cos(t), std::sin(t));
    line.points.push_back(kind == Smooth::Wave ? onWave : kind == Smooth::Ellipse ? onEllipse : onCircle);
  }
  return line;
}

CornerPage pageOfLines(const CornerLine& line, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  std::vector<CornerLine> lines;
  double size = 0.0;
  for (int i = 0; i < kCornerColumns * kCornerRows; ++i) {
    CornerLine turned = line;
    const Eigen::Rotation2Dd rotation(2.0 * std::numbers::pi * any(random));
    Vec2 low = Vec2::Constant(1e9), high = -low;
    for (Vec2& p : turned.points) p = rotation * p, low = low.cwiseMin(p), high = high.cwiseMax(p);
    const Vec2 middle = 0.5 * (low + high) - Vec2(any(random), any(random));
    for (Vec2& p : turned.points) p -= middle;
    for (Vec2& p : turned.corners) p = rotation * p - middle;
    size = std::max(size, (high - low).maxCoeff());
    lines.push_back(std::move(turned));
  }
  CornerPage page;
  const double cell = size + kBetweenPx;
  page.width = static_cast<int>(kCornerColumns * cell);
  page.height = static_cast<int>(kCornerRows * cell);
  for (int i = 0; i < std::ssize(lines); ++i) {
    const Vec2 centre = cell * Vec2(i % kCornerColumns + 0.5, i / kCornerColumns + 0.5);
    for (Vec2& p : lines[i].points) p += centre;
    for (const Vec2& p : lines[i].corners) page.corners.emplace_back(p + centre);
    page.lines.push_back(std::move(lines[i].points));
  }
  return page;
}

}  // namespace

CornerPage zigzagPage(const Zigzags& of, std::uint32_t seed) { return pageOfLines(zigzagLine(of), seed); }

CornerPage smoothPage(Smooth kind, double radiusPx, std::uint32_t seed) {
  return pageOfLines(smoothLine(kind, radiusPx), seed);
}

Scan scanOfCorners(const CornerPage& page, bool closed, double widthPx, double blurPx, double noise,
                   std::uint32_t seed) {
  std::vector<float> coverage(std::ptrdiff_t{page.width} * page.height, 0.0f);
  for (const auto& line : page.lines) inkOver(coverage, strokeCoverage(line, closed, widthPx, page.width, page.height));
  PageStyle style = penPage(noise, seed);
  style.blurPx = blurPx;
  return renderPage(std::move(coverage), page.width, page.height, style);
}

}  // namespace batten::test
