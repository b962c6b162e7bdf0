// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/construct/fair/fewest_knots.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <string>

#include "tests/unit/construct/fair_shapes.h"

namespace batten {
namespace {

struct Shape {
  std::string name;
  std::vector<Vec2> points;
  bool closed;
};

std::vector<Shape> shapes() {
  const auto bump = [](double s, double at, double width) { return std::exp(-std::pow((s - at) / width, 2)); };
  const auto clothoid = test::curveOfCurvature(700.0, [](double s) { return 0.0005 + 6e-6 * s; });
  const auto roofs = test::curveOfCurvature(
      620.0, [&](double s) { return 0.0006 + 0.0045 * bump(s, 167, 90) + 0.005 * bump(s, 484, 80); });
  const auto wave = test::curveOfCurvature(900.0, [](double s) { return 0.006 * std::sin(s / 60.0); });
  std::vector<Vec2> ellipse;
  std::mt19937 random(5);
  std::normal_distribution<double> normal(0.0, 0.1);
  for (int i = 0; i < 1532; ++i) {
    const double t = 2.0 * std::numbers::pi * i / 1532, scale = 1.0 + normal(random) / 250.0;
    ellipse.emplace_back(scale * 300.0 * std::cos(t), scale * 180.0 * std::sin(t));
  }
  return {{"clothoid", test::noisyPoints(clothoid, 0.127, 2), false},
          {"roofs", test::noisyPoints(roofs, 0.127, 2), false},
          {"wave", test::noisyPoints(wave, 0.127, 2), false},
          {"ellipse", ellipse, true}};
}

ConstructedPiece fitWith(const Shape& shape, double share, bool corners = false) {
  ConstructContour contour;
  contour.pixelMm = 0.1;
  contour.pieces.resize(1);
  ConstructPiece& piece = contour.pieces[0];
  for (const Vec2& p : shape.points) piece.points.push_back({0.1 * p + Vec2(20.0, 30.0)});
  piece.closed = shape.closed;
  piece.startIsCorner = piece.endIsCorner = corners;
  FairFitOptions options;
  options.knotRemovalTolerance = share;
  auto fit = test::fitInMillimetres(contour, options);
  EXPECT_TRUE(fit.has_value());
  return fit ? std::move(fit->front()) : ConstructedPiece{};
}

/// Farthest that dense samples of one curve lie from dense samples of another (mm), by brute force.
double farthest(const NurbsCurve& a, const NurbsCurve& b) {
  std::vector<Vec2> dense;
  for (int i = 0; i <= 3000; ++i) dense.push_back(b.point(b.start() + (b.end() - b.start()) * i / 3000.0));
  double worst = 0.0;
  for (int i = 0; i <= 300; ++i) {
    const Vec2 p = a.point(a.start() + (a.end() - a.start()) * i / 300.0);
    double nearest = 1e9;
    for (std::size_t k = 1; k < dense.size(); ++k) {  // chords of half a pixel leave the curve by less than 1e-4 px
      const Vec2 along = dense[k] - dense[k - 1];
      const double t = std::clamp((p - dense[k - 1]).dot(along) / along.squaredNorm(), 0.0, 1.0);
      nearest = std::min(nearest, (p - dense[k - 1] - t * along).squaredNorm());
    }
    worst = std::max(worst, std::sqrt(nearest));
  }
  return worst;
}

TEST(FewestKnots, FewerPointsWithinTheNoiseAndWithTheSameExtrema) {
  for (const Shape& shape : shapes()) {
    const auto full = fitWith(shape, 0.0), fewer = fitWith(shape, 0.25);
    EXPECT_EQ(fewer.report.fullControlPoints, full.curve.controlPointCount()) << shape.name;
    EXPECT_LT(fewer.curve.controlPointCount(), 0.75 * full.curve.controlPointCount()) << shape.name;
    EXPECT_EQ(fewer.curve.degree(), 5);
    const double movedPx = farthest(fewer.curve, full.curve) / 0.1;
    EXPECT_LT(movedPx, 0.25 * fewer.report.noisePx.value() * 1.05) << shape.name;
    EXPECT_NEAR(movedPx, fewer.report.knotRemovalMovedPx, 0.35 * fewer.report.knotRemovalMovedPx + 5e-4) << shape.name;
    EXPECT_EQ(test::extremaOf(fewer.curve, shape.closed).size(), test::extremaOf(full.curve, shape.closed).size())
        << shape.name;
  }
}

TEST(FewestKnots, MoreNoiseAllowedMeansFewerPoints) {
  for (const Shape& shape : shapes()) {
    int last = 1 << 20;
    for (const double share : {0.0, 0.05, 0.25, 1.0}) {
      const int count = fitWith(shape, share).curve.controlPointCount();
      EXPECT_LE(count, last) << shape.name << " " << share;
      last = count;
    }
  }
}

TEST(FewestKnots, EndsStayExactAndClosedCurvesMeet) {
  for (const Shape& shape : shapes()) {
    const auto fewer = fitWith(shape, 0.25, !shape.closed);
    const NurbsCurve& c = fewer.curve;
    if (!shape.closed) {
      EXPECT_EQ(c.point(c.start()), Vec2(0.1 * shape.points.front() + Vec2(20.0, 30.0)));
      EXPECT_EQ(c.point(c.end()), Vec2(0.1 * shape.points.back() + Vec2(20.0, 30.0)));
      continue;
    }
    const auto start = c.derivatives(c.start(), 4), end = c.derivatives(c.end(), 4);
    const double spacing = c.breaks()[1] - c.breaks()[0];
    for (std::size_t d = 0; d < 5; ++d)
      EXPECT_LT((start[d] - end[d]).norm(), 1e-10 * 30.0 * std::pow(10.0 / spacing, static_cast<double>(d))) << d;
  }
}

}  // namespace
}  // namespace batten
