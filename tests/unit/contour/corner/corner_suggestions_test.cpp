// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contour/corner/corner_suggestions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "core/contour/corner/corner_marks.h"
#include "tests/support/angles.h"
#include "tests/support/contour_shapes.h"
#include "tests/unit/contour/corner/corner_lines.h"

namespace batten {
namespace {

using test::circle;
using test::CurvedPolygon;
using test::fromPoints;
using test::kDeg;
using test::letterK;
using test::traceShape;

TEST(SuggestCorners, NoneOnSmoothLines) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    for (const double radius : {15.0, 25.0, 60.0}) {
      EXPECT_TRUE(suggestCorners(fromPoints(circle(radius), true, 0.08, seed), 28 * kDeg, 16.0, {}).empty()) << radius;
    }
    std::vector<Vec2> ellipse, clothoid;
    for (int i = 0; i < 1200; ++i) {
      const double a = 2 * std::numbers::pi * i / 1200;
      ellipse.emplace_back(200 + 180 * std::cos(a), 150 + 60 * std::sin(a));
    }
    Vec2 p(0, 0);
    for (int i = 0; i < 800; ++i) {
      const double angle = 0.5 * i * i * 0.00006;  // ends at radius 21 px
      p += Vec2(std::cos(angle), std::sin(angle));
      clothoid.push_back(p);
    }
    EXPECT_TRUE(suggestCorners(fromPoints(ellipse, true, 0.08, seed), 28 * kDeg, 16.0, {}).empty());
    EXPECT_TRUE(suggestCorners(fromPoints(clothoid, false, 0.08, seed), 28 * kDeg, 16.0, {}).empty());
  }
}

// The border of dry ink: dents of a pixel or so, a few pixels long.
std::vector<Vec2> roughened(const std::vector<Vec2>& points, double rough, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> gauss(0.0, 1.0);
  std::vector<double> white(points.size());
  for (double& w : white) w = gauss(random);
  std::vector<Vec2> out = points;
  const int n = static_cast<int>(points.size());
  for (int i = 0; i < n; ++i) {
    double sum = 0.0, square = 0.0;
    for (int k = -6; k <= 6; ++k) {
      const double weight = std::exp(-0.5 * k * k / 4.0);
      sum += weight * white[(i + k + n) % n];
      square += weight * weight;
    }
    const Vec2 chord = points[(i + 1) % n] - points[(i + n - 1) % n];
    out[i] += rough * sum / std::sqrt(square) * leftNormal(chord.normalized());
  }
  return out;
}

TEST(SuggestCorners, DentsOfARaggedEdgeAreNone) {
  int onCircles = 0, onSquares = 0;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    onCircles += static_cast<int>(
        suggestCorners(fromPoints(roughened(circle(120.0), 0.45, seed), true), 28 * kDeg, 16.0, {}).size());
    std::vector<Vec2> square;
    for (int i = 0; i < 300; ++i) square.emplace_back(i, 0);
    for (int i = 0; i < 300; ++i) square.emplace_back(300, i);
    for (int i = 300; i > 0; --i) square.emplace_back(i, 300);
    for (int i = 300; i > 0; --i) square.emplace_back(0, i);
    for (const CornerSuggestion& s :
         suggestCorners(fromPoints(roughened(square, 0.4, seed), true), 28 * kDeg, 16.0, {})) {
      const bool corner = std::min(std::abs(s.positionPx.x()), std::abs(s.positionPx.x() - 300)) < 4.0 &&
                          std::min(std::abs(s.positionPx.y()), std::abs(s.positionPx.y() - 300)) < 4.0;
      onSquares += corner ? 1 : -1;
    }
  }
  EXPECT_LE(onCircles, 1);   // of 3800 px
  EXPECT_GE(onSquares, 17);  // of 20, none elsewhere
}

// Bristles hide the corners of dry brush strokes from short legs; more of the line shows them.
TEST(SuggestCorners, CornersOfAVeryRaggedEdgeAreFound) {
  int onSquares = 0, elsewhere = 0;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    std::vector<Vec2> square;
    for (int i = 0; i < 300; ++i) square.emplace_back(i, 0);
    for (int i = 0; i < 300; ++i) square.emplace_back(300, i);
    for (int i = 300; i > 0; --i) square.emplace_back(i, 300);
    for (int i = 300; i > 0; --i) square.emplace_back(0, i);
    for (const CornerSuggestion& s :
         suggestCorners(fromPoints(roughened(square, 1.0, seed), true), 35 * kDeg, 14.0, {})) {
      const bool corner = std::min(std::abs(s.positionPx.x()), std::abs(s.positionPx.x() - 300)) < 6.0 &&
                          std::min(std::abs(s.positionPx.y()), std::abs(s.positionPx.y() - 300)) < 6.0;
      ++(corner ? onSquares : elsewhere);
    }
  }
  EXPECT_GE(onSquares, 18);  // of 20
  EXPECT_LE(elsewhere, 1);
}

TEST(SuggestCorners, SayTheAngleThatAMarkGives) {
  const ContourSet set = traceShape(letterK().sampled(), 5.0, 3);
  const auto suggestions = suggestCorners(set, 28 * kDeg, 16.0, {});
  std::vector<CornerMark> marks;
  for (const CornerSuggestion& s : suggestions) marks.push_back({s.positionPx});
  const auto pieces = splitAtCorners(set, marks, {}, {});
  ASSERT_TRUE(pieces.has_value());
  ASSERT_EQ(pieces->corners.size(), suggestions.size());
  for (const Corner& corner : pieces->corners) {
    const CornerSuggestion& s = suggestions[corner.mark.value()];
    EXPECT_NEAR(s.turningAngleRad, corner.turningAngleRad, 1.5 * kDeg) << s.positionPx.transpose();
  }
}

TEST(SuggestCorners, EveryCornerOfALetterOnce) {
  const CurvedPolygon shape = letterK();
  const ContourSet set = traceShape(shape.sampled(), 5.0, 3);
  const auto suggestions = suggestCorners(set, 28 * kDeg, 16.0, {});
  EXPECT_EQ(suggestions.size(), shape.corners.size());
  for (const Vec2& corner : shape.corners) {
    const auto found = std::count_if(suggestions.begin(), suggestions.end(),
                                     [&](const CornerSuggestion& s) { return (s.positionPx - corner).norm() < 1.0; });
    EXPECT_EQ(found, 1) << corner.transpose();
  }
}

// A stroke 4 px wide round a hexagon of 90 px, whose corners are rounded by these radii [px].
ContourSet roundedHexagon(const std::vector<double>& radii, ContourKind kind) {
  std::vector<Vec2> points;
  for (int i = 0; i < 6; ++i) {
    const auto vertex = [](int k) {
      return Vec2(150 + 90 * std::cos(k * std::numbers::pi / 3), 150 + 90 * std::sin(k * std::numbers::pi / 3));
    };
    const Vec2 at = vertex(i), in = (at - vertex(i + 5)).normalized(), out = (vertex(i + 1) - at).normalized();
    const double tangent = radii[i] * std::tan(std::numbers::pi / 6);
    const Vec2 middle = at - tangent * in + radii[i] * leftNormal(in);
    for (int k = 0; k <= 10; ++k) {
      const double a = k / 10.0 * std::numbers::pi / 3;
      points.push_back(middle - radii[i] * (std::cos(a) * leftNormal(in) - std::sin(a) * in));
    }
    const double length = 90 - tangent - radii[(i + 1) % 6] * std::tan(std::numbers::pi / 6);
    for (double s = 0.8; s < length - 0.4; s += 0.8) points.push_back(at + (tangent + s) * out);
  }
  ContourSet set = fromPoints(points, true);
  set.contours[0].kind = kind;
  if (kind == ContourKind::Centreline)
    for (ContourPoint& p : set.contours[0].points) p.widthPx = 4.0f;
  return set;
}

int certainOf(const ContourSet& set) {
  int count = 0;
  for (const CornerSuggestion& s : suggestCorners(set, 28 * kDeg, 16.0, {})) count += s.certainty >= 0.95 ? 1 : 0;
  return count;
}

// Ink fills the corners of strokes, one more than the other; a border is as it is.
TEST(SuggestCorners, ALikelyCornerIsOneAmongItsLikeOnAStroke) {
  const std::vector<double> sharp(6, 1.0);
  std::vector<double> one = sharp, five(6, 12.0);
  one[2] = 12.0;
  five[2] = 1.0;
  EXPECT_EQ(certainOf(roundedHexagon(sharp, ContourKind::Centreline)), 6);
  EXPECT_EQ(certainOf(roundedHexagon(one, ContourKind::Centreline)), 6);
  EXPECT_EQ(certainOf(roundedHexagon(five, ContourKind::Centreline)), 1) << "too few like it";
  EXPECT_EQ(certainOf(roundedHexagon(one, ContourKind::Outline)), 5);
  one[2] = 30.0;
  EXPECT_EQ(certainOf(roundedHexagon(one, ContourKind::Centreline)), 5) << "a bend";
}

}  // namespace
}  // namespace batten
