// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/exchange/model/cad_shape.h"

#include <gtest/gtest.h>

#include "core/curve/arc_length.h"
#include "tests/unit/exchange/exchange_shapes.h"

namespace batten {
namespace {

TEST(CadShape, FindsTheLineWhateverItsDegree) {
  for (int degree = 1; degree <= 7; ++degree) {
    const auto line = elevated(test::made(1, {0, 0, 50, 50}, {{10, 20}, {40, 60}}), degree);
    ASSERT_TRUE(line);
    const auto shape = simpleShape(*line);
    ASSERT_TRUE(shape && std::holds_alternative<CadLine>(*shape)) << degree;
    EXPECT_LT((std::get<CadLine>(*shape).to - Vec2(40, 60)).norm(), 1e-12);
  }
  EXPECT_FALSE(simpleShape(test::made(2, {0, 0, 0, 1, 1, 1}, {{0, 0}, {20, 0}, {10, 0}}))) << "it turns back";
  EXPECT_FALSE(simpleShape(test::oneSpan()));
}

TEST(CadShape, FindsArcsAndCirclesEitherWayRound) {
  for (const double sweep : {0.3, 1.5, 3.0, 5.5, 2 * M_PI}) {
    const auto curve = curveOf(CadArc{{30, -20}, 12.5, 0.7, sweep});
    ASSERT_TRUE(curve);
    for (int i = 0; i <= 50; ++i) {  // the curve is the circle by its definition
      const Vec2 p = curve->point(curve->start() + (curve->end() - curve->start()) * i / 50.0);
      EXPECT_NEAR((p - Vec2(30, -20)).norm(), 12.5, 1e-12);
    }
    EXPECT_NEAR(ArcLength(*curve).total(), 12.5 * sweep, 1e-8);
    for (const NurbsCurve& way : {*curve, reversed(*curve)}) {
      const auto shape = simpleShape(way);
      ASSERT_TRUE(shape && std::holds_alternative<CadArc>(*shape)) << sweep;
      const CadArc arc = std::get<CadArc>(*shape);
      EXPECT_NEAR(arc.radius, 12.5, 1e-11);
      EXPECT_NEAR(arc.sweepRad, sweep, 1e-11);
      EXPECT_LT((arc.centre - Vec2(30, -20)).norm(), 1e-11);
      if (sweep < 6.0) {
        EXPECT_LT((pointAt(arc, 0.0) - pointAt(CadArc{{30, -20}, 12.5, 0.7, sweep}, 0.0)).norm(), 1e-11);
      }
    }
  }
}

TEST(CadShape, BulgesAreArcsToTheLeftOrTheRight) {
  // A half circle above its chord: bulge -1 turns right from (0, 0) to (10, 0), over (5, 5).
  const CadPolyline line{{{{0, 0}, -1.0}, {{10, 0}, 0.0}, {{10, -5}, 0.0}}, false};
  EXPECT_LT((pointAt(line, 0.25) - Vec2(5, 5)).norm(), 1e-12);
  EXPECT_LT((pointAt(line, 1.0) - Vec2(10, -5)).norm(), 1e-12);
  const auto curve = curveOf(line);
  ASSERT_TRUE(curve) << curve.error().message;
  EXPECT_NEAR(ArcLength(*curve).total(), 5 * M_PI + 5, 1e-8);
}

TEST(CadShape, TellsADrawingThatReadsBackAsAnother) {
  CadDrawing drawing{{{"a", "l", test::oneSpan()}, {"b", "l", CadLine{{0, 0}, {1, 1}}}}, 1.0};
  CadDrawing same = drawing;
  EXPECT_EQ(largestDifference(drawing, same).value(), 0.0);
  std::get<CadLine>(same.entities[1].shape).to.x() += 0.25;
  EXPECT_NEAR(largestDifference(drawing, same).value(), 0.25, 1e-12);
  drawing.mmPerUnit = same.mmPerUnit = 25.4;
  EXPECT_NEAR(largestDifference(drawing, same).value(), 0.25 * 25.4, 1e-9) << "in mm";
  same.mmPerUnit = 1.0;
  EXPECT_FALSE(largestDifference(drawing, same)) << "another unit";
  same.mmPerUnit = 25.4;
  same.entities.pop_back();
  EXPECT_FALSE(largestDifference(drawing, same)) << "an entity is missing";
  same = drawing;
  same.entities[0].shape = CadLine{{0, 0}, {1, 1}};
  EXPECT_FALSE(largestDifference(drawing, same)) << "another kind";
}

}  // namespace
}  // namespace batten
