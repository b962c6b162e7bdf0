// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/end_page.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/render_page.h"

namespace batten::test {
namespace {

constexpr int kColumns = 4, kRows = 3, kCellPx = 320;
constexpr double kBodyPx = 110.0;    // of a stroke, without tapers,
constexpr double kBodyTapers = 2.0;  // and at least so many tapers: else it is a leaf and no line
constexpr double kBendRadiusPx = 150.0;
constexpr double kStepPx = 0.2;
constexpr double kSkew = 0.466;  // tangent of 25 degrees

// A course of length `length` through `middle` in a direction; straight, or an arc.
struct EndLine {
  Vec2 middle = Vec2::Zero(), along = Vec2::Zero();
  double bend = 0.0;  // [1/px]
  Vec2 direction(double s) const { return turned(along, bend * s); }
  Vec2 at(double s) const {
    const Vec2 side(-along.y(), along.x());
    if (bend == 0.0) return middle + s * along;
    return middle + (std::sin(bend * s) * along + (1.0 - std::cos(bend * s)) * side) / bend;
  }
  static Vec2 turned(const Vec2& v, double angle) {
    return {std::cos(angle) * v.x() - std::sin(angle) * v.y(), std::sin(angle) * v.x() + std::cos(angle) * v.y()};
  }
};

struct Ending {
  StrokeEnd kind;
  double radius, taperPx, half;  // half: of the length of the course
  double roomAt(double s) const {
    const double left = half - std::abs(s);
    return kind == StrokeEnd::Taper ? radius * std::clamp(left / taperPx, 0.0, 1.0) : radius;
  }
};

// The border of the ink, once round.
std::vector<Vec2> borderOf(const EndLine& course, const Ending& end) {
  std::vector<Vec2> border;
  const int steps = static_cast<int>(2.0 * end.half / kStepPx);
  const double skew = end.kind == StrokeEnd::Skewed ? kSkew : 0.0;
  for (const double side : {1.0, -1.0}) {
    // The cut leaves one side of the stroke longer than the other, at both ends the same.
    const double shift = side * skew * end.radius;
    for (int k = 0; k <= steps; ++k) {
      const double s = side * end.half * (2.0 * k / steps - 1.0) + shift;
      const Vec2 d = course.direction(s);
      border.push_back(course.at(s) + side * end.roomAt(s) * Vec2(-d.y(), d.x()));
    }
    if (end.kind != StrokeEnd::Round) continue;
    const Vec2 centre = course.at(side * end.half), out = side * course.direction(side * end.half);
    constexpr int kCapSteps = 64;
    for (int k = 1; k < kCapSteps; ++k) {
      const double angle = std::numbers::pi * (0.5 - static_cast<double>(k) / kCapSteps);
      border.push_back(centre + end.radius * EndLine::turned(out, angle));
    }
  }
  return border;
}

}  // namespace

EndPage endPage(StrokeEnd kind, double widthPx) {
  EndPage page{kColumns * kCellPx, kRows * kCellPx, {}, {}};
  page.coverage.assign(std::ptrdiff_t{page.width} * page.height, 0.0f);
  const double taper = kind == StrokeEnd::Taper ? std::clamp(8.0 * widthPx, 24.0, 72.0) : 0.0;
  const Ending end{kind, 0.5 * widthPx, taper, 0.5 * std::max(kBodyPx, kBodyTapers * taper) + taper};
  constexpr int kStrokes = kColumns * kRows;
  for (int i = 0; i < kStrokes; ++i) {
    const int column = i % kColumns, row = i / kColumns;
    const double angle = std::numbers::pi * (i == 0 ? 0.0 : i == 6 ? 0.5 : (i + 0.15) / kStrokes);
    EndLine course{{kCellPx * (column + 0.5) + 0.13 * i, kCellPx * (row + 0.5) + 0.31 * i},
                   {std::cos(angle), std::sin(angle)},
                   i % 3 == 2 ? (i % 2 == 0 ? 1.0 : -1.0) / kBendRadiusPx : 0.0};
    const std::vector<float> one = fillCoverage(borderOf(course, end), page.width, page.height);
    for (std::size_t k = 0; k < one.size(); ++k) page.coverage[k] = std::max(page.coverage[k], one[k]);
    for (const double side : {1.0, -1.0})
      page.ends.push_back({course.at(side * end.half), side * course.direction(side * end.half)});
  }
  return page;
}

}  // namespace batten::test
